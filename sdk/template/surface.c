/* SPDX-FileCopyrightText: @author@
 * SPDX-License-Identifier: MIT */

/* A square drumhead that is fixed at its rim and swings up and down. Replace the formula, its
 * domain and the parameters with your own. */

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* --- Parameters ------------------------------------------------------------------------------- */

enum { HEIGHT, RATE };

static const imp_parameter parameters[] = {
    [HEIGHT] = IMP_ROW_NUMBER("height", "length", "0.25", "how far the middle swings"),
    [RATE] = IMP_ROW_POSITIVE("rate", "rad/time", "6", "how fast it swings"),
};

typedef struct drum {
    double height, rate;
} drum;

/* The host has checked the kind and range of each value against the table above. Check everything
 * else here, and on an error return imp_reject(why, ...). */
static imp_status drum_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    drum *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->height = values[HEIGHT].number[0];
    made->rate = values[RATE].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

/* --- The surface ------------------------------------------------------------------------------ */

/* -1 <= u, v <= 1, at any time. */
static void drum_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, -1, 1, -1, 1);
}

/* x = u, y = v, z = height (1 - u^2) (1 - v^2) sin(rate t). The operations are those of
 * <impinge/model.h>; evaluation, rates and inclusions follow from them, with proof. */
static void drum_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const drum *d = self;
    imp_model one = imp_num(1);
    imp_model swing = imp_sin(imp_scale(t, d->rate));
    imp_model shape = imp_mul(imp_sub(one, imp_sqr(u)), imp_sub(one, imp_sqr(v)));
    out[0] = u;
    out[1] = v;
    out[2] = imp_scale(imp_mul(shape, swing), d->height);
}
IMP_SURFACE_FORMULA(drum_formula)

/* --- The plugin ------------------------------------------------------------------------------- */

static const imp_surface_type type = {
    IMP_SURFACE_FIELDS_OF("@name@", drum, drum_formula, free),
    .summary = "square drumhead that swings",
    .equation = "(u, v, height (1 - u^2) (1 - v^2) sin(rate t)), u and v in [-1,1]",
    .source = NULL,
    .formula = "u in [-1, 1]; v in [-1, 1]; u; v; height*(1 - u^2)*(1 - v^2)*sin(rate*t)",
    .example = "@name@ height=0.5",
};

#ifndef PACKAGE_VERSION /* set by configure; the default for a build without it: */
#define PACKAGE_VERSION "0.1"
#endif
IMPINGE_SURFACE_PLUGIN("@name@", PACKAGE_VERSION, "MIT", "@author@", type);
