/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "node_model.h"

#include <stddef.h>

#include "lanes.h"

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
    lanes a, b[3], q[6], e, lo, hi, rate[3];
} models;

LANES_INLINE lanes gather(const imp_model m[3], size_t offset)
{
    const double *x = (const double *)((const char *)m + offset);
    const size_t step = sizeof *m / sizeof *x;
    return (lanes){x[0], x[step], x[2 * step], 0};
}

LANES_INLINE models side_by_side(const imp_model m[3])
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

LANES_INLINE double over_axes(lanes x) { return x[0] + x[1] + x[2]; }

/* How far u, v and t move each coordinate across the region, and how much of that is not linear.
 * The remainder is laid to their charge in proportion to what is unexplained of each: the curved
 * part, and what the rate allows beyond the slope. Decides only what to split. A way through space
 * counts by its length, 0.6 of the sum of its coordinates or so; the remainder, a box, counts in
 * full; the weight of acceleration is measured. */
LANES_INLINE void take_spread(node *n, const models *m)
{
    const lanes none = lanes_all(0), half = lanes_all(0.5), infinite = lanes_all(INFINITY);
    const lanes uv = half * lanes_abs(m->q[IMP_UV]), ut = half * lanes_abs(m->q[IMP_UT]);
    const lanes vt = half * lanes_abs(m->q[IMP_VT]);
    const lanes curved[3] = {lanes_abs(m->q[IMP_UU]) + uv + ut, lanes_abs(m->q[IMP_VV]) + uv + vt,
                             lanes_all(2) * lanes_abs(m->q[IMP_TT]) + ut + vt};
    lanes unexplained[3], sum = none;
    for (int j = 0; j < 3; ++j) {
        const double d = n->region.d[j];
        const lanes beyond = lanes_max(m->rate[j] * lanes_all(d) - lanes_abs(m->b[j]), none);
        unexplained[j] =
            lanes_pick(m->rate[j] < infinite, curved[j] + beyond, lanes_all(d > 0 ? 0x1p500 : 0));
        sum += unexplained[j];
    }
    const lanes_mask blamed = (sum > none) & (m->e < infinite);
    for (int j = 0; j < 3; ++j) {
        const lanes blame = lanes_pick(blamed, m->e * (unexplained[j] / sum), none);
        const lanes bend = curved[j] + blame;
        n->bend[j] = over_axes(bend);
        n->spread[j] = over_axes(lanes_all(0.6) * (lanes_abs(m->b[j]) + curved[j]) + blame);
        if (j == PARAMETER_T)
            n->unsteady = over_axes(lanes_pick(m->rate[j] < infinite, blame, none));
    }
}

LANES_INLINE void take_polynomial(quadratic3 *f, const models *m)
{
    lanes_store(f->a, m->a);
    lanes_store(f->bu, m->b[0]);
    lanes_store(f->bv, m->b[1]);
    lanes_store(f->bt, m->b[2]);
    lanes_store(f->quu, m->q[IMP_UU]);
    lanes_store(f->quv, m->q[IMP_UV]);
    lanes_store(f->qut, m->q[IMP_UT]);
    lanes_store(f->qvv, m->q[IMP_VV]);
    lanes_store(f->qvt, m->q[IMP_VT]);
    lanes_store(f->qtt, m->q[IMP_TT]);
}

/* Whether polynomial, remainder and range are finite. */
LANES_INLINE bool are_bounded(const models *m)
{
    lanes sum = lanes_abs(m->a) + m->e;
    for (int j = 0; j < 3; ++j) sum += lanes_abs(m->b[j]);
    for (int k = 0; k < 6; ++k) sum += lanes_abs(m->q[k]);
    const lanes infinite = lanes_all(INFINITY);
    const lanes_mask fine = (sum < infinite) & (m->lo > -infinite) & (m->hi < infinite);
    return !lanes_any(~fine);
}

/* Whether all is as breach_of asks even of what is bounded. */
LANES_INLINE bool are_sound(const models *m)
{
    const lanes none = lanes_all(0), infinite = lanes_all(INFINITY);
    lanes_mask fine = (m->e >= none) & (m->lo <= m->hi);
    for (int j = 0; j < 3; ++j) fine &= (m->rate[j] >= none) & (m->rate[j] < infinite);
    return !lanes_any(~fine);
}

LANES_INLINE const char *take(node *n, const imp_model model[3], bool may_be_infinite)
{
    const models m = side_by_side(model);
    n->bounded = are_bounded(&m);
    if (!n->bounded || !are_sound(&m)) {
        const char *breach = first_breach(model, may_be_infinite);
        if (breach != NULL) return breach;
    }
    take_polynomial(&n->f, &m);
    lanes_store(n->e, m.e);
    memcpy(n->lo, &m.lo, sizeof n->lo);
    memcpy(n->hi, &m.hi, sizeof n->hi);
    const lanes motion = lanes_abs(m.b[2]) + lanes_all(2) * lanes_abs(m.q[IMP_TT]) +
                         lanes_abs(m.q[IMP_UT]) + lanes_abs(m.q[IMP_VT]);
    lanes_store(n->motion, motion + motion * lanes_all(0x1p-50));
    take_spread(n, &m);
    if (n->bounded) {
        n->normal = vec3_cross(vec3_from(n->f.bu), vec3_from(n->f.bv));
    } else {
        memcpy(n->spread, n->region.d, sizeof n->spread);
        memcpy(n->bend, n->region.d, sizeof n->bend);
    }
    return NULL;
}

LANES_WIDE static const char *take_wide(node *n, const imp_model model[3], bool may_be_infinite)
{
    return take(n, model, may_be_infinite);
}

const char *node_take_model(node *n, const imp_model model[3], bool may_be_infinite)
{
    return lanes_are_wide() ? take_wide(n, model, may_be_infinite)
                            : take(n, model, may_be_infinite);
}
