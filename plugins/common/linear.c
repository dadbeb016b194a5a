/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear.h"

#include <impinge/quad.h>
#include <string.h>

#define LAST_ROUNDING (0x1p-53 * (1 + 0x1p-50)) /* of a computed sum, relative */

void linear_finish(linear *f)
{
    for (int i = 0; i < 3; ++i) {
        const double *k = f->still[i], *v = f->motion[i];
        bool cross = k[LINEAR_UV] != 0 || v[LINEAR_UV] != 0;
        bool u = cross || k[LINEAR_U] != 0 || v[LINEAR_U] != 0;
        bool w = cross || k[LINEAR_V] != 0 || v[LINEAR_V] != 0;
        bool t = v[LINEAR_1] != 0 || v[LINEAR_U] != 0 || v[LINEAR_V] != 0 || v[LINEAR_UV] != 0;
        f->depends[i] = (u ? 1u : 0) | (w ? 2u : 0) | (t ? 4u : 0);
        f->is_affine[i] = !cross && v[LINEAR_U] == 0 && v[LINEAR_V] == 0;
    }
}

/* At least sum_k |K_k + t V_k| |w_k| for |u|, |v|, |t| up to these, without K_1, but for a few
 * roundings. */
static double linear_size(const double *k, const double *v, double u, double w, double t)
{
    return t * fabs(v[LINEAR_1]) + u * (fabs(k[LINEAR_U]) + t * fabs(v[LINEAR_U])) +
           w * (fabs(k[LINEAR_V]) + t * fabs(v[LINEAR_V])) +
           u * w * (fabs(k[LINEAR_UV]) + t * fabs(v[LINEAR_UV]));
}

/* One coordinate of one point, and its error.
 *
 * Lemma. A term of the sum is K or t V times 1, u, v or u v. Its roundings: K or V once, t V once,
 * K + t V once, the products with u and v twice, sums at most three times: 8 of relative size
 * 2^-53, and two more pay for second order and for `size`. K_1 is rounded in the last sum only. */
static double linear_at(const linear *f, int i, const double p[3], double *error)
{
    const double *k = f->still[i], *v = f->motion[i], u = p[0], w = p[1], t = p[2];
    const double along_u = u * (k[LINEAR_U] + t * v[LINEAR_U]);
    const double along_v =
        w * ((k[LINEAR_V] + t * v[LINEAR_V]) + u * (k[LINEAR_UV] + t * v[LINEAR_UV]));
    const double x = k[LINEAR_1] + ((t * v[LINEAR_1] + along_u) + along_v);
    const double size = linear_size(k, v, fabs(u), fabs(w), fabs(t));
    *error = f->depends[i] ? LAST_ROUNDING * fabs(x) + 10 * 0x1p-53 * size + IMP_TINY : 0;
    return x;
}

imp_status linear_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const linear *f = self;
    for (size_t k = 0; k < n; ++k) {
        double slip[3];
        if (!(fabs(p[3 * k + 2]) <= LINEAR_LATE)) return IMP_DOMAIN;
        for (int i = 0; i < 3; ++i) x[3 * k + (size_t)i] = linear_at(f, i, p + 3 * k, &slip[i]);
        if (error != NULL) memcpy(error + 3 * k, slip, sizeof slip);
    }
    return IMP_OK;
}

/* --- Bounds over a region --- */

/* Covers the rounding of everything below but the last sum with K_1: a number there is a sum of
 * terms as above, through at most 12 roundings; four more pay for `size` and second order. */
static double linear_noise(const double *k, const double *v, const imp_region *region)
{
    const double u = fabs(region->c[0]) + region->d[0], w = fabs(region->c[1]) + region->d[1];
    return 16 * 0x1p-53 * linear_size(k, v, u, w, fabs(region->c[2]) + region->d[2]) + IMP_TINY;
}

/* At least |a + b x + c y + d x y| for x in [x_lo, x_hi], y in [y_lo, y_hi]; `x`, `y` are those
 * pairs. Six roundings at most reach a corner's value; as many more its coefficients. */
static double linear_most(double a, double b, double c, double d, const double x[2],
                          const double y[2])
{
    if (b == 0 && c == 0 && d == 0)
        return a == 0 ? 0 : fabs(a) + 16 * 0x1p-53 * fabs(a) + IMP_TINY;
    const imp_quad p = {x[0], x[1], x[0], x[1]}, q = {y[0], y[0], y[1], y[1]};
    const imp_quad along_x = b * p, along_y = c * q, twist = d * p * q;
    const imp_quad value = imp_quad_abs(a + along_x + along_y + twist);
    const imp_quad sum =
        fabs(a) + imp_quad_abs(along_x) + imp_quad_abs(along_y) + imp_quad_abs(twist);
    double most = 0, size = 0;
    for (int corner = 0; corner < 4; ++corner) {
        most = imp_larger(most, value[corner]);
        size = imp_larger(size, sum[corner]);
    }
    return most + 16 * 0x1p-53 * size + IMP_TINY;
}

static void linear_rates(const double *k, const double *v, const imp_region *region, double rate[3])
{
    const double u[2] = {region->lo[0], region->hi[0]}, w[2] = {region->lo[1], region->hi[1]};
    const double t[2] = {region->lo[2], region->hi[2]};
    rate[0] = linear_most(k[LINEAR_U], k[LINEAR_UV], v[LINEAR_U], v[LINEAR_UV], w, t);
    rate[1] = linear_most(k[LINEAR_V], k[LINEAR_UV], v[LINEAR_V], v[LINEAR_UV], u, t);
    rate[2] = linear_most(v[LINEAR_1], v[LINEAR_U], v[LINEAR_V], v[LINEAR_UV], u, w);
}

static bool linear_is_late(const imp_region *region)
{
    return !(region->lo[2] >= -LINEAR_LATE && region->hi[2] <= LINEAR_LATE);
}

/* As imp_surface_type.rate. */
imp_status linear_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const linear *f = self;
    if (linear_is_late(region)) return IMP_UNBOUNDED;
    for (int i = 0; i < 3; ++i) linear_rates(f->still[i], f->motion[i], region, rates->m[i]);
    return IMP_OK;
}

/* Least and greatest value at the region's corners: u and v at either end of time. */
static void linear_range(const double *k, const double *v, const imp_region *region, double noise,
                         imp_model *g)
{
    const double *l = region->lo, *h = region->hi;
    const imp_quad u = {l[0], l[0], h[0], h[0]}, w = {l[1], h[1], l[1], h[1]};
    double lo = INFINITY, hi = -INFINITY;
    for (int end = 0; end < 2; ++end) {
        const double t = end ? h[2] : l[2], c = k[LINEAR_V] + t * v[LINEAR_V];
        const double b = k[LINEAR_U] + t * v[LINEAR_U], d = k[LINEAR_UV] + t * v[LINEAR_UV];
        const imp_quad x = (t * v[LINEAR_1] + u * b) + w * (c + u * d);
        for (int corner = 0; corner < 4; ++corner) {
            lo = imp_smaller(lo, x[corner]);
            hi = imp_larger(hi, x[corner]);
        }
    }
    g->lo = imp_sum_down(k[LINEAR_1] + (lo - noise));
    g->hi = imp_sum_up(k[LINEAR_1] + (hi + noise));
}

/* The same without products, from the model: `noise` and e have room for its three sums. */
static void linear_affine_range(double noise, imp_model *g)
{
    const double reach = fabs(g->b[0]) + fabs(g->b[1]) + fabs(g->b[2]) + g->e + noise;
    g->lo = imp_sum_down(g->a - reach);
    g->hi = imp_sum_up(g->a + reach);
}

/* With p = c + d s substituted, K_k + t V_k = (K_k + c_t V_k) + d_t V_k s_t. */
static void linear_model(const linear *f, int i, const imp_region *region, imp_model *g)
{
    const double *k = f->still[i], *v = f->motion[i];
    const double cu = region->c[0], cv = region->c[1], ct = region->c[2];
    const double du = region->d[0], dv = region->d[1], dt = region->d[2];
    const double b = k[LINEAR_U] + ct * v[LINEAR_U], c = k[LINEAR_V] + ct * v[LINEAR_V];
    const double d = k[LINEAR_UV] + ct * v[LINEAR_UV];
    const double noise = f->depends[i] ? linear_noise(k, v, region) : 0;
    *g = (imp_model){.depends = f->depends[i]};
    g->a = k[LINEAR_1] + ((ct * v[LINEAR_1] + cu * b) + cv * (c + cu * d));
    g->b[0] = du * (b + cv * d);
    g->b[1] = dv * (c + cu * d);
    g->b[2] = dt * (v[LINEAR_1] + cu * v[LINEAR_U] + cv * (v[LINEAR_V] + cu * v[LINEAR_UV]));
    g->q[IMP_UV] = du * dv * d;
    g->q[IMP_UT] = du * dt * (v[LINEAR_U] + cv * v[LINEAR_UV]);
    g->q[IMP_VT] = dv * dt * (v[LINEAR_V] + cu * v[LINEAR_UV]);
    g->e = fabs(du * dv * dt * v[LINEAR_UV]) + noise;
    if (g->depends) g->e += LAST_ROUNDING * fabs(g->a);
    if (f->is_affine[i])
        linear_affine_range(noise, g);
    else
        linear_range(k, v, region, noise, g);
    linear_rates(k, v, region, g->rate);
}

/* As imp_surface_type.include. */
imp_status linear_include(const void *self, const imp_region *region, imp_model model[3])
{
    const linear *f = self;
    const bool late = linear_is_late(region);
    for (int i = 0; i < 3; ++i)
        if (late)
            model[i] = imp_unbounded(f->depends[i]);
        else
            linear_model(f, i, region, &model[i]);
    return late ? IMP_UNBOUNDED : IMP_OK;
}

/* --- The net over a region --- */

static double at_corner(const double *k, double u, double w)
{
    return u * k[LINEAR_U] + w * (k[LINEAR_V] + u * k[LINEAR_UV]);
}

/* Lemma. Being linear in u and in v, the surface is the bilinear patch of its values at the corners of
 * the region. A number of point + tau velocity is a sum as in linear_at, but that the time is split in two:
 * through at most 12 roundings each, which linear_noise covers. The place is what was given. */
imp_status linear_net(const void *self, const imp_region *region, imp_net *net)
{
    const linear *f = self;
    const double middle = region->c[2];
    if (linear_is_late(region)) return IMP_UNBOUNDED;
    for (int i = 0; i < 3; ++i) {
        if (f->depends[i] & 1) net->degree[0] = 1;
        if (f->depends[i] & 2) net->degree[1] = 1;
        if (f->depends[i] & 4) net->is_moving = 1;
    }
    const int n = (int)net->degree[0], m = (int)net->degree[1];
    for (int i = 0; i < 3; ++i) {
        const double *k = f->still[i], *v = f->motion[i];
        for (int corner = 0; corner < (n + 1) * (m + 1); ++corner) {
            const double u = corner / (m + 1) == 0 ? region->lo[0] : region->hi[0];
            const double w = corner % (m + 1) == 0 ? region->lo[1] : region->hi[1];
            const double speed = v[LINEAR_1] + at_corner(v, u, w);
            net->velocity[i][corner] = speed;
            net->point[i][corner] = at_corner(k, u, w) + middle * speed;
        }
        net->place[i] = k[LINEAR_1];
        net->error[i] = f->depends[i] ? linear_noise(k, v, region) : 0;
    }
    return IMP_OK;
}
