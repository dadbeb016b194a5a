/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/node_model.h"

#include "core/base/rounding.h"

#include <impinge/quad.h>
#include <stddef.h>

/* The first promise of imp_model that a coordinate breaks, or NULL. Infinite values come only with
 * IMP_UNBOUNDED. */
static const char *breach_of(const imp_model *m, bool may_be_infinite)
{
    const double limit = may_be_infinite ? INFINITY : 0x1.fffffffffffffp1023;
    if (!(m->e >= 0)) return "the remainder is negative or NaN";
    if (!(m->lo <= m->hi)) return "the range is inverted or NaN";
    if (m->e > limit || m->hi > limit || -m->lo > limit) return "a bound is infinite";
    double sum = fabs(m->a);
    for (int j = 0; j < 3; ++j) sum += fabs(m->b[j]);
    for (int k = 0; k < 6; ++k) sum += fabs(m->q[k]);
    if (!(sum <= limit) && !may_be_infinite) return "a coefficient is infinite or NaN";
    for (int j = 0; j < 3; ++j)
        if (!may_be_infinite && !(m->rate[j] >= 0 && m->rate[j] <= limit))
            return "a rate is negative, infinite or NaN";
    return NULL;
}

static const char *first_breach(const imp_model model[3], bool may_be_infinite)
{
    const char *breach = NULL;
    for (int i = 0; i < 3 && breach == NULL; ++i) breach = breach_of(&model[i], may_be_infinite);
    return breach;
}

/* The three coordinates' models side by side; the fourth lane is 0. */
typedef struct models {
    imp_quad a, b[3], q[6], e, lo, hi, rate[3];
} models;

IMP_QUAD_INLINE imp_quad gather(const imp_model m[3], size_t offset)
{
    const double *x = (const double *)((const char *)m + offset);
    const size_t step = sizeof *m / sizeof *x;
    return (imp_quad){x[0], x[step], x[2 * step], 0};
}

IMP_QUAD_INLINE models side_by_side(const imp_model m[3])
{
    models all = {.a = gather(m, offsetof(imp_model, a)),
                  .e = gather(m, offsetof(imp_model, e)),
                  .lo = gather(m, offsetof(imp_model, lo)),
                  .hi = gather(m, offsetof(imp_model, hi))};
    for (size_t j = 0; j < 3; ++j) all.b[j] = gather(m, offsetof(imp_model, b) + 8 * j);
    for (size_t j = 0; j < 3; ++j) all.rate[j] = gather(m, offsetof(imp_model, rate) + 8 * j);
    for (size_t k = 0; k < 6; ++k) all.q[k] = gather(m, offsetof(imp_model, q) + 8 * k);
    return all;
}

IMP_QUAD_INLINE double over_axes(imp_quad x) { return x[0] + x[1] + x[2]; }

/* How far u, v and t move each coordinate across the region, and how much of that is not linear.
 * The remainder is distributed over them in proportion to what is unexplained of each: the curved
 * part, and what the rate allows beyond the slope. Decides only what to split. A way through space
 * counts by its length, about LENGTH_OF_SUM of the sum of its coordinates; the remainder, a box,
 * counts in full; the weight of acceleration is measured. */
static const double LENGTH_OF_SUM = 0.6;

IMP_QUAD_INLINE void take_spread(node *n, const models *m)
{
    const imp_quad none = imp_quad_all(0), half = imp_quad_all(0.5),
                   infinite = imp_quad_all(INFINITY);
    const imp_quad uv = half * imp_quad_abs(m->q[IMP_UV]), ut = half * imp_quad_abs(m->q[IMP_UT]);
    const imp_quad vt = half * imp_quad_abs(m->q[IMP_VT]);
    const imp_quad curved[3] = {imp_quad_abs(m->q[IMP_UU]) + uv + ut,
                                imp_quad_abs(m->q[IMP_VV]) + uv + vt,
                                imp_quad_all(2) * imp_quad_abs(m->q[IMP_TT]) + ut + vt};
    imp_quad unexplained[3], sum = none;
    for (int j = 0; j < 3; ++j) {
        const double d = n->region.d[j];
        const imp_quad beyond =
            imp_quad_max(m->rate[j] * imp_quad_all(d) - imp_quad_abs(m->b[j]), none);
        unexplained[j] = imp_quad_pick(m->rate[j] < infinite, curved[j] + beyond,
                                       imp_quad_all(d > 0 ? 0x1p500 : 0));
        sum += unexplained[j];
    }
    const imp_quad_mask blamed = (sum > none) & (m->e < infinite);
    for (int j = 0; j < 3; ++j) {
        const imp_quad blame = imp_quad_pick(blamed, m->e * (unexplained[j] / sum), none);
        const imp_quad bend = curved[j] + blame;
        n->nonlinear_extent[j] = over_axes(bend);
        n->extent[j] =
            over_axes(imp_quad_all(LENGTH_OF_SUM) * (imp_quad_abs(m->b[j]) + curved[j]) + blame);
        if (j == PARAMETER_T)
            n->time_remainder = over_axes(imp_quad_pick(m->rate[j] < infinite, blame, none));
    }
}

IMP_QUAD_INLINE void take_polynomial(quadratic3 *f, const models *m)
{
    imp_quad_store(f->a, m->a);
    imp_quad_store(f->bu, m->b[0]);
    imp_quad_store(f->bv, m->b[1]);
    imp_quad_store(f->bt, m->b[2]);
    imp_quad_store(f->quu, m->q[IMP_UU]);
    imp_quad_store(f->quv, m->q[IMP_UV]);
    imp_quad_store(f->qut, m->q[IMP_UT]);
    imp_quad_store(f->qvv, m->q[IMP_VV]);
    imp_quad_store(f->qvt, m->q[IMP_VT]);
    imp_quad_store(f->qtt, m->q[IMP_TT]);
}

/* Whether polynomial, remainder and range are finite. */
IMP_QUAD_INLINE bool are_bounded(const models *m)
{
    imp_quad sum = imp_quad_abs(m->a) + m->e;
    for (int j = 0; j < 3; ++j) sum += imp_quad_abs(m->b[j]);
    for (int k = 0; k < 6; ++k) sum += imp_quad_abs(m->q[k]);
    const imp_quad infinite = imp_quad_all(INFINITY);
    const imp_quad_mask fine = (sum < infinite) & (m->lo > -infinite) & (m->hi < infinite);
    return !imp_quad_any(~fine);
}

/* The conditions of breach_of that hold for bounded models too. */
IMP_QUAD_INLINE bool are_sound(const models *m)
{
    const imp_quad none = imp_quad_all(0), infinite = imp_quad_all(INFINITY);
    imp_quad_mask fine = (m->e >= none) & (m->lo <= m->hi);
    for (int j = 0; j < 3; ++j) fine &= (m->rate[j] >= none) & (m->rate[j] < infinite);
    return !imp_quad_any(~fine);
}

IMP_QUAD_INLINE const char *take(node *n, const imp_model model[3], bool may_be_infinite)
{
    const models m = side_by_side(model);
    n->bounded = are_bounded(&m);
    if (!n->bounded || !are_sound(&m)) {
        const char *breach = first_breach(model, may_be_infinite);
        if (breach != NULL) return breach;
    }
    take_polynomial(&n->f, &m);
    imp_quad_store(n->e, m.e);
    memcpy(n->lo, &m.lo, sizeof n->lo);
    memcpy(n->hi, &m.hi, sizeof n->hi);
    const imp_quad motion = imp_quad_abs(m.b[2]) + imp_quad_all(2) * imp_quad_abs(m.q[IMP_TT]) +
                            imp_quad_abs(m.q[IMP_UT]) + imp_quad_abs(m.q[IMP_VT]);
    PAD_COVERS(8, 3); /* three sums */
    imp_quad_store(n->motion, quad_padded_upper(motion, 8));
    take_spread(n, &m);
    if (n->bounded) {
        n->normal = vec3_cross(vec3_from(n->f.bu), vec3_from(n->f.bv));
    } else {
        memcpy(n->extent, n->region.d, sizeof n->extent);
        memcpy(n->nonlinear_extent, n->region.d, sizeof n->nonlinear_extent);
    }
    return NULL;
}

IMP_QUAD_WIDE static const char *take_wide(node *n, const imp_model model[3], bool may_be_infinite)
{
    return take(n, model, may_be_infinite);
}

const char *node_take_model(node *n, const imp_model model[3], bool may_be_infinite)
{
    return imp_quad_is_wide() ? take_wide(n, model, may_be_infinite)
                              : take(n, model, may_be_infinite);
}
