/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_LINEAR_INTERNAL_H
#define PLUGINS_COMMON_LINEAR_INTERNAL_H

#include "plugins/common/linear.h"

#include <impinge/quad.h>
#include <string.h>

/* What linear.c (points) and linear_bounds.c (bounds over a region) share. x, y and z are computed
 * side by side, in the lanes of quads. */

#define LINEAR_LAST_ROUNDING (0x1p-53 * (1 + 0x1p-50)) /* of a computed sum, difference */

/* The coefficients in registers. */
typedef struct linear_terms {
    imp_quad k[LINEAR_TERMS], v[LINEAR_TERMS];
} linear_terms;

IMP_QUAD_INLINE linear_terms linear_terms_of(const linear *f)
{
    linear_terms c;
    for (int k = 0; k < LINEAR_TERMS; ++k) {
        c.k[k] = imp_quad_load(f->still[k]);
        c.v[k] = imp_quad_load(f->motion[k]);
    }
    return c;
}

/* Lanes that depend on u (1), v (2), t (4) or any of them. */
IMP_QUAD_INLINE imp_quad_mask linear_that_depend(const linear *f, int64_t on)
{
    imp_quad_mask depends;
    memcpy(&depends, f->depends, sizeof depends);
    return (depends & on) != 0;
}

/* At least sum_k |K_k + t V_k| |w_k| for |u|, |v|, |t| up to these, without K_1, but for a few
 * roundings. */
IMP_QUAD_INLINE imp_quad linear_size(const linear_terms *c, double u, double w, double t)
{
    const imp_quad at = imp_quad_all(t);
    imp_quad part[LINEAR_TERMS];
    for (int k = LINEAR_U; k < LINEAR_TERMS; ++k)
        part[k] = imp_quad_abs(c->k[k]) + at * imp_quad_abs(c->v[k]);
    return at * imp_quad_abs(c->v[LINEAR_1]) + imp_quad_all(u) * part[LINEAR_U] +
           imp_quad_all(w) * part[LINEAR_V] + imp_quad_all(u * w) * part[LINEAR_UV];
}

#endif
