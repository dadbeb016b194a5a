/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear_internal.h"

IMP_QUAD_INLINE void finish(linear *f)
{
    const linear_terms c = linear_terms_of(f);
    const imp_quad none = imp_quad_all(0);
    const imp_quad_mask cross = (c.k[LINEAR_UV] != none) | (c.v[LINEAR_UV] != none);
    const imp_quad_mask turn = (c.v[LINEAR_U] != none) | (c.v[LINEAR_V] != none);
    const imp_quad_mask u = cross | (c.k[LINEAR_U] != none) | (c.v[LINEAR_U] != none);
    const imp_quad_mask w = cross | (c.k[LINEAR_V] != none) | (c.v[LINEAR_V] != none);
    const imp_quad_mask t = turn | (c.v[LINEAR_1] != none) | (c.v[LINEAR_UV] != none);
    const imp_quad_mask depends = (u & 1) | (w & 2) | (t & 4), is_affine = ~(cross | turn);
    memcpy(f->depends, &depends, sizeof f->depends);
    memcpy(f->is_affine, &is_affine, sizeof f->is_affine);
}

IMP_QUAD_WIDE static void finish_wide(linear *f) { finish(f); }

void linear_finish(linear *f)
{
    if (imp_quad_is_wide())
        finish_wide(f);
    else
        finish(f);
}

/* --- Points ----------------------------------------------------------------------------------- */

/* One point.
 *
 * Lemma. A term of the sum is K or t V times 1, u, v or u v. Its roundings: K or V once, t V once,
 * K + t V once, the products with u and v twice, sums at most three times: 8 of relative size
 * 2^-53, and two more pay for second order and for `size`. K_1 is rounded in the last sum only. */
IMP_QUAD_INLINE imp_quad linear_at(const linear_terms *c, const double p[3])
{
    const imp_quad u = imp_quad_all(p[0]), w = imp_quad_all(p[1]), t = imp_quad_all(p[2]);
    const imp_quad along_u = u * (c->k[LINEAR_U] + t * c->v[LINEAR_U]);
    const imp_quad along_v =
        w * ((c->k[LINEAR_V] + t * c->v[LINEAR_V]) + u * (c->k[LINEAR_UV] + t * c->v[LINEAR_UV]));
    return c->k[LINEAR_1] + ((t * c->v[LINEAR_1] + along_u) + along_v);
}

IMP_QUAD_INLINE imp_quad linear_error(const linear *f, const linear_terms *c, const double p[3],
                                      imp_quad x)
{
    const imp_quad size = linear_size(c, fabs(p[0]), fabs(p[1]), fabs(p[2]));
    const imp_quad error = imp_quad_all(LINEAR_LAST_ROUNDING) * imp_quad_abs(x) +
                           imp_quad_all(10 * 0x1p-53) * size + imp_quad_all(IMP_TINY);
    return imp_quad_pick(linear_that_depend(f, 7), error, imp_quad_all(0));
}

IMP_QUAD_INLINE void take_three(double *to, imp_quad x)
{
    for (int i = 0; i < 3; ++i) to[i] = x[i];
}

IMP_QUAD_INLINE imp_status linear_points(const linear *f, size_t n, const double *p, double *x,
                                         double *error)
{
    const linear_terms c = linear_terms_of(f);
    for (size_t k = 0; k < n; ++k, p += 3, x += 3) {
        if (!(fabs(p[2]) <= LINEAR_LATE)) return IMP_STATUS_DOMAIN;
        const imp_quad at = linear_at(&c, p);
        take_three(x, at);
        if (error != NULL) take_three(error + 3 * k, linear_error(f, &c, p, at));
    }
    return IMP_STATUS_OK;
}

IMP_QUAD_NARROW static imp_status points_narrow(const linear *f, size_t n, const double *p,
                                                double *x, double *error)
{
    return linear_points(f, n, p, x, error);
}

IMP_QUAD_WIDE static imp_status points_wide(const linear *f, size_t n, const double *p, double *x,
                                            double *error)
{
    return linear_points(f, n, p, x, error);
}

imp_status linear_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    return imp_quad_is_wide() ? points_wide(self, n, p, x, error)
                              : points_narrow(self, n, p, x, error);
}
