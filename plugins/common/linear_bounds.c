/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear_internal.h"

/* Covers the rounding of everything below but the last sum with K_1: a number there is a sum of
 * terms as in linear_at, through at most 12 roundings; four more pay for `size` and second order.
 */
IMP_QUAD_INLINE imp_quad linear_noise(const linear *f, const linear_terms *c,
                                      const imp_region *region)
{
    const double u = fabs(region->c[0]) + region->d[0], w = fabs(region->c[1]) + region->d[1];
    const imp_quad size = linear_size(c, u, w, fabs(region->c[2]) + region->d[2]);
    return imp_quad_pick(linear_that_depend(f, 7),
                         imp_quad_all(16 * 0x1p-53) * size + imp_quad_all(IMP_TINY),
                         imp_quad_all(0));
}

/* At least |a + b x + c y + d x y| for x in [x_lo, x_hi], y in [y_lo, y_hi], parameters j and k of
 * the region. Six roundings at most reach a corner's value; as many more its coefficients. */
IMP_QUAD_INLINE imp_quad linear_most(imp_quad a, imp_quad b, imp_quad c, imp_quad d,
                                     const imp_region *region, int j, int k)
{
    const imp_quad q[2] = {imp_quad_all(region->lo[k]), imp_quad_all(region->hi[k])};
    const imp_quad along_y[2] = {c * q[0], c * q[1]};
    imp_quad most = imp_quad_all(0), size = imp_quad_all(0);
    for (int end = 0; end < 2; ++end) {
        const imp_quad p = imp_quad_all(end ? region->hi[j] : region->lo[j]), along_x = b * p;
        const imp_quad at = a + along_x, far = imp_quad_abs(a) + imp_quad_abs(along_x);
        for (int l = 0; l < 2; ++l) {
            const imp_quad twist = d * p * q[l];
            most = imp_quad_max(most, imp_quad_abs(at + along_y[l] + twist));
            size = imp_quad_max(size, far + imp_quad_abs(along_y[l]) + imp_quad_abs(twist));
        }
    }
    return most + imp_quad_all(16 * 0x1p-53) * size + imp_quad_all(IMP_TINY);
}

/* A rate by what a coordinate does not depend on is 0. */
IMP_QUAD_INLINE void linear_rates(const linear *f, const linear_terms *c, const imp_region *region,
                                  imp_quad rate[3])
{
    const imp_quad none = imp_quad_all(0);
    const imp_quad *k = c->k, *v = c->v;
    for (int j = 0; j < 3; ++j) rate[j] = none;
    if (imp_quad_any(linear_that_depend(f, 1)))
        rate[0] = linear_most(k[LINEAR_U], k[LINEAR_UV], v[LINEAR_U], v[LINEAR_UV], region, 1, 2);
    if (imp_quad_any(linear_that_depend(f, 2)))
        rate[1] = linear_most(k[LINEAR_V], k[LINEAR_UV], v[LINEAR_V], v[LINEAR_UV], region, 0, 2);
    if (imp_quad_any(linear_that_depend(f, 4)))
        rate[2] = linear_most(v[LINEAR_1], v[LINEAR_U], v[LINEAR_V], v[LINEAR_UV], region, 0, 1);
    for (int j = 0; j < 3; ++j)
        rate[j] = imp_quad_pick(linear_that_depend(f, 1 << j), rate[j], none);
}

static bool linear_is_late(const imp_region *region)
{
    return !(region->lo[2] >= -LINEAR_LATE && region->hi[2] <= LINEAR_LATE);
}

/* Implements imp_surface_type.rate. */
imp_status linear_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const linear *f = self;
    const linear_terms c = linear_terms_of(f);
    imp_quad rate[3];
    if (linear_is_late(region)) return IMP_STATUS_UNBOUNDED;
    linear_rates(f, &c, region, rate);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) rates->m[i][j] = rate[j][i];
    return IMP_STATUS_OK;
}

/* The models of the coordinates, side by side. */
typedef struct linear_lanes {
    imp_quad a, b[3], uv, ut, vt, e, lo, hi, rate[3];
} linear_lanes;

/* Least and greatest value at the region's corners: u and v at either end of time. */
IMP_QUAD_INLINE void linear_range(const linear_terms *c, const imp_region *region, imp_quad noise,
                                  linear_lanes *g)
{
    const double *l = region->lo, *h = region->hi;
    imp_quad lo = imp_quad_all(INFINITY), hi = imp_quad_all(-INFINITY);
    for (int end = 0; end < 2; ++end) {
        const imp_quad t = imp_quad_all(end ? h[2] : l[2]);
        const imp_quad along_u = c->k[LINEAR_U] + t * c->v[LINEAR_U];
        const imp_quad along_v = c->k[LINEAR_V] + t * c->v[LINEAR_V];
        const imp_quad twist = c->k[LINEAR_UV] + t * c->v[LINEAR_UV];
        for (int side = 0; side < 2; ++side) {
            const imp_quad u = imp_quad_all(side ? h[0] : l[0]);
            const imp_quad at = t * c->v[LINEAR_1] + u * along_u, slope = along_v + u * twist;
            const imp_quad x = at + imp_quad_all(l[1]) * slope, y = at + imp_quad_all(h[1]) * slope;
            lo = imp_quad_min(imp_quad_min(lo, x), y);
            hi = imp_quad_max(imp_quad_max(hi, x), y);
        }
    }
    g->lo = c->k[LINEAR_1] + (lo - noise);
    g->hi = c->k[LINEAR_1] + (hi + noise);
}

/* Bounds the range of models without products, from the model: `noise` and e have room for its
 * three sums. */
IMP_QUAD_INLINE void linear_affine_range(imp_quad noise, imp_quad_mask affine, linear_lanes *g)
{
    const imp_quad reach =
        imp_quad_abs(g->b[0]) + imp_quad_abs(g->b[1]) + imp_quad_abs(g->b[2]) + g->e + noise;
    g->lo = imp_quad_pick(affine, g->a - reach, g->lo);
    g->hi = imp_quad_pick(affine, g->a + reach, g->hi);
}

/* imp_sum_down and imp_sum_up of the ends. */
IMP_QUAD_INLINE void round_outward(linear_lanes *g)
{
    g->lo -= imp_quad_abs(g->lo) * imp_quad_all(0x1p-52);
    g->hi += imp_quad_abs(g->hi) * imp_quad_all(0x1p-52);
}

/* With p = c + d s substituted, K_k + t V_k = (K_k + c_t V_k) + d_t V_k s_t. */
IMP_QUAD_INLINE void linear_polynomial(const linear *f, const linear_terms *c,
                                       const imp_region *region, imp_quad noise, linear_lanes *g)
{
    const imp_quad *k = c->k, *v = c->v;
    const double du = region->d[0], dv = region->d[1], dt = region->d[2];
    const imp_quad cu = imp_quad_all(region->c[0]), cv = imp_quad_all(region->c[1]),
                   ct = imp_quad_all(region->c[2]);
    const imp_quad along_u = k[LINEAR_U] + ct * v[LINEAR_U],
                   along_v = k[LINEAR_V] + ct * v[LINEAR_V];
    const imp_quad twist = k[LINEAR_UV] + ct * v[LINEAR_UV];
    const imp_quad turn_u = v[LINEAR_U] + cv * v[LINEAR_UV],
                   turn_v = v[LINEAR_V] + cu * v[LINEAR_UV];
    g->a = k[LINEAR_1] + ((ct * v[LINEAR_1] + cu * along_u) + cv * (along_v + cu * twist));
    g->b[0] = imp_quad_all(du) * (along_u + cv * twist);
    g->b[1] = imp_quad_all(dv) * (along_v + cu * twist);
    g->b[2] = imp_quad_all(dt) * (v[LINEAR_1] + cu * v[LINEAR_U] + cv * turn_v);
    g->uv = imp_quad_all(du * dv) * twist;
    g->ut = imp_quad_all(du * dt) * turn_u;
    g->vt = imp_quad_all(dv * dt) * turn_v;
    g->e = imp_quad_abs(imp_quad_all(du * dv * dt) * v[LINEAR_UV]) + noise;
    g->e += imp_quad_pick(linear_that_depend(f, 7),
                          imp_quad_all(LINEAR_LAST_ROUNDING) * imp_quad_abs(g->a), imp_quad_all(0));
}

_Static_assert(offsetof(imp_model, q) == 32 && offsetof(imp_model, e) == 80 &&
                   offsetof(imp_model, hi) == 96 && offsetof(imp_model, depends) == 128,
               "sixteen numbers in a row");

/* Four numbers of each model from `first` on: w, x, y and z. */
IMP_QUAD_INLINE void take_four(imp_model m[3], size_t first, imp_quad w, imp_quad x, imp_quad y,
                               imp_quad z)
{
    imp_quad row[4] = {w, x, y, z};
    imp_quad_transpose(row);
    for (int i = 0; i < 3; ++i) imp_quad_store((double *)(void *)&m[i] + first, row[i]);
}

IMP_QUAD_INLINE void take_models(const linear *f, const linear_lanes *g, imp_model m[3])
{
    const imp_quad none = imp_quad_all(0);
    take_four(m, 0, g->a, g->b[0], g->b[1], g->b[2]);
    take_four(m, 4, none, g->uv, g->ut, none);
    take_four(m, 8, g->vt, none, g->e, g->lo);
    take_four(m, 12, g->hi, g->rate[0], g->rate[1], g->rate[2]);
    for (int i = 0; i < 3; ++i) m[i].depends = (uint32_t)f->depends[i], m[i].reserved = 0;
}

IMP_QUAD_INLINE void linear_models(const linear *f, const imp_region *region, imp_model model[3])
{
    const linear_terms c = linear_terms_of(f);
    const imp_quad noise = linear_noise(f, &c, region);
    imp_quad_mask affine;
    linear_lanes g;
    memcpy(&affine, f->is_affine, sizeof affine);
    linear_polynomial(f, &c, region, noise, &g);
    g.lo = g.hi = g.a;
    if (imp_quad_any(~affine)) linear_range(&c, region, noise, &g);
    linear_affine_range(noise, affine, &g);
    round_outward(&g);
    linear_rates(f, &c, region, g.rate);
    take_models(f, &g, model);
}

IMP_QUAD_NARROW static void models_narrow(const linear *f, const imp_region *region,
                                          imp_model model[3])
{
    linear_models(f, region, model);
}

IMP_QUAD_WIDE static void models_wide(const linear *f, const imp_region *region, imp_model model[3])
{
    linear_models(f, region, model);
}

/* Implements imp_surface_type.include. */
imp_status linear_include(const void *self, const imp_region *region, imp_model model[3])
{
    const linear *f = self;
    if (linear_is_late(region)) {
        for (int i = 0; i < 3; ++i) model[i] = imp_unbounded((uint32_t)f->depends[i]);
        return IMP_STATUS_UNBOUNDED;
    }
    if (imp_quad_is_wide())
        models_wide(f, region, model);
    else
        models_narrow(f, region, model);
    return IMP_STATUS_OK;
}

/* --- The net over a region -------------------------------------------------------------------- */

static double at_corner(const double k[LINEAR_TERMS][4], int i, double u, double w)
{
    return u * k[LINEAR_U][i] + w * (k[LINEAR_V][i] + u * k[LINEAR_UV][i]);
}

/* Lemma. Being linear in u and in v, the surface is the bilinear patch of its values at the corners
 * of the region. A number of point + tau velocity is a sum as in linear_at, but that the time is
 * split in two: through at most 12 roundings each, which linear_noise covers. The place is what was
 * given. */
imp_status linear_net(const void *self, const imp_region *region, imp_net *net)
{
    const linear *f = self;
    const linear_terms c = linear_terms_of(f);
    const double middle = region->c[2];
    if (linear_is_late(region)) return IMP_STATUS_UNBOUNDED;
    for (int i = 0; i < 3; ++i) {
        if (f->depends[i] & 1) net->degree[0] = 1;
        if (f->depends[i] & 2) net->degree[1] = 1;
        if (f->depends[i] & 4) net->is_moving = 1;
    }
    const int n = (int)net->degree[0], m = (int)net->degree[1];
    const imp_quad noise = linear_noise(f, &c, region);
    for (int i = 0; i < 3; ++i) {
        for (int corner = 0; corner < (n + 1) * (m + 1); ++corner) {
            const double u = corner / (m + 1) == 0 ? region->lo[0] : region->hi[0];
            const double w = corner % (m + 1) == 0 ? region->lo[1] : region->hi[1];
            const double speed = f->motion[LINEAR_1][i] + at_corner(f->motion, i, u, w);
            net->velocity[i][corner] = speed;
            net->point[i][corner] = at_corner(f->still, i, u, w) + middle * speed;
        }
        net->place[i] = f->still[LINEAR_1][i];
        net->error[i] = noise[i];
    }
    return IMP_STATUS_OK;
}
