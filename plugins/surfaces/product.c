/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/curve.h"
#include "plugins/patch/patch_text.h"

#include <impinge/formula.h>

/* The spherical product of two plane curves, scaled along the axes. c is the profile, from pole to
 * pole, and d the outline that each parallel follows. */

enum { K, C, D, C_WEIGHTS, D_WEIGHTS, CENTER };

static const imp_parameter parameters[] = {
    [K] = IMP_ROW("k", "1", "[1,1,1]", 0, 1, 3, 0, -PATCH_FAR, PATCH_FAR, "scale along x, y and z"),
    [C] = ROW_PATCH_POINTS("c", "length", "[[0,-1],[1.3,-1],[1.3,1],[0,1]]", 2, 0,
                           "control points [width,height] of the profile, a Bezier curve"),
    [D] = ROW_PATCH_POINTS("d", "1", "[[1,0],[1,2],[-2,2],[-2,-2],[1,-2],[1,0]]", 2, 0,
                           "control points [x,y] of the outline, a Bezier curve"),
    [C_WEIGHTS] = ROW_CURVE_WEIGHTS("c_weights", "c"),
    [D_WEIGHTS] = ROW_CURVE_WEIGHTS("d_weights", "d"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct product_instance {
    patch *c, *d;
    double k[3], center[3];
} product_instance;

static void product_destroy(void *self)
{
    product_instance *s = self;
    if (s != NULL) {
        free(s->c);
        free(s->d);
    }
    free(s);
}

static imp_status product_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = curve_check(values, C, C_WEIGHTS, why);
    if (status == IMP_STATUS_OK) status = curve_check(values, D, D_WEIGHTS, why);
    if (status != IMP_STATUS_OK) return status;
    product_instance *s = calloc(1, sizeof *s);
    if (s != NULL) {
        s->c = curve_new(&values[C], &values[C_WEIGHTS]);
        s->d = curve_new(&values[D], &values[D_WEIGHTS]);
    }
    if (s == NULL || s->c == NULL || s->d == NULL) {
        product_destroy(s);
        return IMP_STATUS_INTERNAL;
    }
    imp_copy_vector(s->k, &values[K]);
    imp_copy_vector(s->center, &values[CENTER]);
    *self = s;
    return IMP_STATUS_OK;
}

static void product_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static void product_formula(const void *self, imp_model u, imp_model v, imp_model t,
                            imp_model out[3])
{
    const product_instance *s = self;
    imp_model c[3], d[3];
    (void)t;
    curve_at(s->c, u, 0, c);
    curve_at(s->d, v, 1, d);
    out[0] = imp_shift(imp_scale(imp_mul(c[0], d[0]), s->k[0]), s->center[0]);
    out[1] = imp_shift(imp_scale(imp_mul(c[0], d[1]), s->k[1]), s->center[1]);
    out[2] = imp_shift(imp_scale(c[1], s->k[2]), s->center[2]);
}
IMP_SURFACE_FORMULA(product_formula)

static imp_status product_write_formula(const void *self, const imp_text_sink *to)
{
    const product_instance *s = self;
    curve_write(s->c, 'p', 'u', to);
    curve_write(s->d, 'q', 'v', to);
    imp_add_text(to, "u in [0, 1]; v in [0, 1]; center0 + k0*p0*q0; center1 + k1*p0*q1; "
                     "center2 + k2*p1");
    return IMP_STATUS_OK;
}

static const imp_surface_type product = {
    IMP_SURFACE_FIELDS_OF("product", product, product_formula, product_destroy),
    .write_formula = product_write_formula,
    .summary = "spherical product of two plane Bezier curves: a profile and an outline",
    .equation =
        "center + (k_x c_1(u) d_1(v), k_y c_1(u) d_2(v), k_z c_2(u)), c and d each sum_i B_i "
        "w_i P_i / sum_i B_i w_i over its control points P and weights w, u and v in [0,1]",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, eq. 27",
    .example = "product k=1,1,2 c=[[0,-1],[2,0],[0,1]] d=[[1,0],[1,2],[-2,2],[-2,-2],[1,-2],[1,0]]",
};

PUBLISH_SURFACE(product);
