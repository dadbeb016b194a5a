/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/curve.h"
#include "plugins/patch/patch_text.h"

#include <impinge/formula.h>

enum { PROFILE, PATH, PROFILE_WEIGHTS, PATH_WEIGHTS };

static const imp_parameter parameters[] = {
    [PROFILE] = ROW_PATCH_POINTS("profile", "length", "[[0,0,0],[0,0.5,1],[0,1,0]]", 3, 0,
                                 "control points [x,y,z] of the Bezier curve that is moved"),
    [PATH] = ROW_PATCH_POINTS("path", "length", "[[0,0,0],[0.5,0,0.5],[1,0.5,0]]", 3, 0,
                              "control points [x,y,z] of the Bezier curve along which it is moved"),
    [PROFILE_WEIGHTS] = ROW_CURVE_WEIGHTS("profile_weights", "profile"),
    [PATH_WEIGHTS] = ROW_CURVE_WEIGHTS("path_weights", "path"),
};

typedef struct sweep_instance {
    patch *profile, *path;
} sweep_instance;

static void sweep_destroy(void *self)
{
    sweep_instance *s = self;
    if (s != NULL) {
        free(s->profile);
        free(s->path);
    }
    free(s);
}

static imp_status sweep_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = curve_check(values, PROFILE, PROFILE_WEIGHTS, why);
    if (status == IMP_STATUS_OK) status = curve_check(values, PATH, PATH_WEIGHTS, why);
    if (status != IMP_STATUS_OK) return status;
    sweep_instance *s = calloc(1, sizeof *s);
    if (s != NULL) {
        s->profile = curve_new(&values[PROFILE], &values[PROFILE_WEIGHTS]);
        s->path = curve_new(&values[PATH], &values[PATH_WEIGHTS]);
    }
    if (s == NULL || s->profile == NULL || s->path == NULL) {
        sweep_destroy(s);
        return IMP_STATUS_INTERNAL;
    }
    *self = s;
    return IMP_STATUS_OK;
}

static void sweep_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static void sweep_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const sweep_instance *s = self;
    imp_model profile[3], path[3];
    (void)t;
    curve_at(s->profile, u, 0, profile);
    curve_at(s->path, v, 1, path);
    for (int i = 0; i < 3; ++i) out[i] = imp_add(profile[i], path[i]);
}
IMP_SURFACE_FORMULA(sweep_formula)

static imp_status sweep_write_formula(const void *self, const imp_text_sink *to)
{
    const sweep_instance *s = self;
    curve_write(s->profile, 'p', 'u', to);
    curve_write(s->path, 'q', 'v', to);
    imp_add_text(to, "u in [0, 1]; v in [0, 1]; p0 + q0; p1 + q1; p2 + q2");
    return IMP_STATUS_OK;
}

static const imp_surface_type sweep = {
    IMP_SURFACE_FIELDS_OF("sweep", sweep, sweep_formula, sweep_destroy),
    .write_formula = sweep_write_formula,
    .summary = "translational sweep: a Bezier curve moved, without turning, along another",
    .equation =
        "profile(u) + path(v), each sum_i B_i w_i P_i / sum_i B_i w_i over its control points "
        "P and weights w, u and v in [0,1]",
    .source = NULL,
    .example = "sweep profile=[[0,0,0],[0,1,1],[0,2,0]] path=[[0,0,0],[1,0,1],[2,1,0]]",
};

PUBLISH_SURFACE(sweep);
