/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/near.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* A rectangular sheet with a plane wave travelling across it. u and v are lengths: a particle of
 * the sheet moves up and down only. */

enum { SIZE, AMPLITUDE, WAVELENGTH, DIRECTION, SPEED, CENTER };

#define WAVE_FAR 1e100
#define WAVE_SHORT 1e-100

static const imp_parameter parameters[] = {
    [SIZE] = IMP_ROW("size", "length", "[2,2]", IMP_PARAMETER_MIN_OPEN, 1, 2, 0, 0, WAVE_FAR,
                     "extent of the sheet along x and y"),
    [AMPLITUDE] = IMP_ROW_NUMBER("amplitude", "length", "0.1", "greatest height above the mean"),
    [WAVELENGTH] = IMP_ROW("wavelength", "length", "1", 0, 0, 0, 0, WAVE_SHORT, WAVE_FAR,
                           "distance from crest to crest"),
    [DIRECTION] = IMP_ROW("direction", "1", "[1,0]", 0, 1, 2, 0, -WAVE_FAR, WAVE_FAR,
                          "direction in which the crests travel, in x and y; any vector but 0"),
    [SPEED] = IMP_ROW("speed", "length/time", "1", 0, 0, 0, 0, -WAVE_FAR, WAVE_FAR,
                      "speed of the crests; 0: a corrugated sheet at rest"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct ripple_instance {
    double half[2], amplitude, center[3];
    near_constant along_x, along_y; /* wave vector, rad/length */
    near_constant frequency;        /* rad/time */
} ripple_instance;

/* 2 pi / wavelength times the unit vector, and times the speed. */
static void set_wave(ripple_instance *s, const double *direction, double wavelength, double speed)
{
    imp_model number = imp_div(imp_scale(imp_const_pi(), 2), imp_num(wavelength));
    const double size = imp_larger(fabs(direction[0]), fabs(direction[1]));
    imp_model d[2];
    for (int i = 0; i < 2; ++i) d[i] = imp_div(imp_num(direction[i]), imp_num(size));
    imp_model length = imp_sqrt(imp_add(imp_sqr(d[0]), imp_sqr(d[1])));
    s->along_x = near_of(imp_mul(number, imp_div(d[0], length)));
    s->along_y = near_of(imp_mul(number, imp_div(d[1], length)));
    s->frequency = near_of(imp_scale(number, speed));
}

static imp_status ripple_fill(ripple_instance *s, const imp_value *values, imp_create_error *why)
{
    const double *direction = values[DIRECTION].number;
    if (!(fabs(direction[0]) >= WAVE_SHORT || fabs(direction[1]) >= WAVE_SHORT))
        return imp_reject(why, DIRECTION, -1,
                          "[%g,%g] has no direction; must be any vector but 0 (some component at "
                          "least %g)",
                          direction[0], direction[1], WAVE_SHORT);
    for (int i = 0; i < 2; ++i) s->half[i] = values[SIZE].number[i] / 2;
    s->amplitude = values[AMPLITUDE].number[0];
    set_wave(s, direction, values[WAVELENGTH].number[0], values[SPEED].number[0]);
    imp_copy_vector(s->center, &values[CENTER]);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(ripple, ripple_instance)

static void ripple_domain(const void *self, double lo[3], double hi[3])
{
    const ripple_instance *s = self;
    imp_set_domain(lo, hi, -s->half[0], s->half[0], -s->half[1], s->half[1]);
}

static void ripple_formula(const void *self, imp_model u, imp_model v, imp_model t,
                           imp_model out[3])
{
    const ripple_instance *s = self;
    imp_model place = imp_add(near_scale(u, s->along_x), near_scale(v, s->along_y));
    imp_model wave = imp_sin(imp_sub(place, near_scale(t, s->frequency)));
    out[0] = imp_shift(u, s->center[0]);
    out[1] = imp_shift(v, s->center[1]);
    out[2] = imp_shift(imp_scale(wave, s->amplitude), s->center[2]);
}
IMP_SURFACE_FORMULA(ripple_formula)

static const imp_surface_type ripple = {
    IMP_SURFACE_FIELDS(ripple, ripple_formula),
    .renew = ripple_renew,
    .summary = "rectangular sheet with a plane wave travelling across it",
    .equation = "center + (u, v, amplitude sin(2 pi (d.(u,v) - speed t) / wavelength)), "
                "d = direction/|direction|, |u| <= size_x / 2, |v| <= size_y / 2",
    .source = NULL,
    .formula = "u in [-size0/2, size0/2]; v in [-size1/2, size1/2]; way = (direction0*u + "
               "direction1*v)/hypot(direction0, direction1); center0 + u; center1 + v; center2 "
               "+ amplitude*sin(2*pi*(way - speed*t)/wavelength)",
    .example = "ripple size=4,4 amplitude=0.2 wavelength=1 direction=1,1 speed=2",
};

PUBLISH_SURFACE(ripple);
