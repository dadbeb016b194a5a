/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/curve.h"
#include "plugins/patch/patch_text.h"
#include "plugins/patch/round_profile.h"

#include <impinge/formula.h>

enum { PROFILE, WEIGHTS, CENTER };

static const imp_parameter parameters[] = {
    [PROFILE] =
        ROW_PATCH_POINTS("profile", "length", "[[0.6,-1],[1.5,-0.4],[0,0.4],[0.6,1]]", 2, 0,
                         "control points [r,z] of the Bezier curve that turns; r may be negative"),
    [WEIGHTS] = ROW_CURVE_WEIGHTS("weights", "profile"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "the point r = z = 0"),
};

typedef struct revolution_instance {
    patch *profile;
    round_profile round;
    double center[3];
} revolution_instance;

static void revolution_destroy(void *self)
{
    revolution_instance *s = self;
    if (s != NULL) free(s->profile);
    free(s);
}

static imp_status revolution_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = curve_check(values, PROFILE, WEIGHTS, why);
    if (status != IMP_STATUS_OK) return status;
    revolution_instance *s = calloc(1, sizeof *s);
    if (s != NULL) s->profile = curve_new(&values[PROFILE], &values[WEIGHTS]);
    if (s == NULL || s->profile == NULL) {
        revolution_destroy(s);
        return IMP_STATUS_INTERNAL;
    }
    const imp_value *points = &values[PROFILE], *weights = &values[WEIGHTS];
    s->round = round_profile_of(points->number, imp_is_given(weights) ? weights->number : NULL,
                                points->extent[0]);
    imp_copy_vector(s->center, &values[CENTER]);
    *self = s;
    return IMP_STATUS_OK;
}

static void revolution_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, 0, 1);
}

static void revolution_formula(const void *self, imp_model u, imp_model v, imp_model t,
                               imp_model out[3])
{
    const revolution_instance *s = self;
    imp_model sin_u, cos_u, profile[3];
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    curve_at(s->profile, v, 1, profile);
    out[0] = imp_shift(imp_mul(profile[0], cos_u), s->center[0]);
    out[1] = imp_shift(imp_mul(profile[0], sin_u), s->center[1]);
    out[2] = imp_shift(profile[1], s->center[2]);
}
IMP_SURFACE_FORMULA(revolution_formula)

static imp_model revolution_gap(const void *self, imp_model x, imp_model y, imp_model z,
                                imp_model t)
{
    const revolution_instance *s = self;
    (void)t;
    const imp_model m[3] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                            imp_shift(z, -s->center[2])};
    return round_profile_distance(&s->round, m);
}
IMP_DISTANCE_FORMULA(revolution_gap)

static imp_status revolution_symmetry(const void *self, imp_symmetry *symmetry)
{
    const revolution_instance *s = self;
    round_profile_symmetry(&s->round, symmetry);
    memcpy(symmetry->center, s->center, sizeof s->center);
    return IMP_STATUS_OK;
}

static imp_status revolution_write_formula(const void *self, const imp_text_sink *to)
{
    curve_write(((const revolution_instance *)self)->profile, 'p', 'v', to);
    imp_add_text(to, "u in [0, 2*pi]; v in [0, 1]; center0 + p0*cos(u); center1 + p0*sin(u); "
                     "center2 + p1");
    return IMP_STATUS_OK;
}

static const imp_surface_type revolution = {
    IMP_SURFACE_FIELDS_OF("revolution", revolution, revolution_formula, revolution_destroy),
    .distance = revolution_gap_distance,
    .symmetry = revolution_symmetry,
    .write_formula = revolution_write_formula,
    .summary = "surface of revolution about the z axis; its profile is a Bezier curve",
    .equation = "center + (r(v) cos u, r(v) sin u, z(v)), (r,z)(v) = sum_i B_i(v) w_i profile_i / "
                "sum_i B_i(v) w_i, u in [0,2pi], v in [0,1]",
    .source = NULL,
    .example = "revolution profile=[[0,0],[1,0],[0.2,1],[0.8,1.5]]",
};

PUBLISH_SURFACE(revolution);
