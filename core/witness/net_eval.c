/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/net_eval.h"

#include <string.h>

/* --- Bernstein polynomials -------------------------------------------------------------------- */

/* All polynomials of one degree, and their derivatives. */
typedef struct bernstein {
    double value[IMP_NET_POINTS], first[IMP_NET_POINTS], second[IMP_NET_POINTS];
} bernstein;

/* Raises the polynomials from degree n - 1 to n, in place. */
static void raise_degree(double *b, int n, double x)
{
    b[n] = x * b[n - 1];
    for (int i = n - 1; i > 0; --i) b[i] = x * b[i - 1] + (1 - x) * b[i];
    b[0] *= 1 - x;
}

/* Computes derivatives by s, where x = (1 + s) / 2, from the polynomials of degree n - 1: n / 2
 * times their differences. */
static void differences(const double *b, int n, double *d)
{
    const double f = 0.5 * n;
    for (int i = 0; i <= n; ++i) d[i] = f * ((i > 0 ? b[i - 1] : 0) - (i < n ? b[i] : 0));
}

static void bernstein_at(int degree, double s, bernstein *of)
{
    const double x = 0.5 + 0.5 * s;
    double slopes[IMP_NET_POINTS];
    memset(of->second, 0, (size_t)(degree + 1) * sizeof *of->second);
    memset(of->first, 0, (size_t)(degree + 1) * sizeof *of->first);
    of->value[0] = 1;
    for (int n = 1; n <= degree; ++n) {
        if (n == degree - 1) differences(of->value, n, slopes);
        if (n == degree) {
            differences(of->value, n, of->first);
            if (n > 1) differences(slopes, n, of->second);
        }
        raise_degree(of->value, n, x);
    }
}

/* Values, first and second derivatives of the cubic Bernstein polynomials. */
typedef struct cubics {
    double value[4], first[4], second[4];
} cubics;

/* Computes them at four places side by side. */
IMP_QUAD_INLINE void cubics_at(const double s[4], cubics at[4])
{
    const imp_quad half = imp_quad_all(0.5), three = imp_quad_all(3), by = imp_quad_all(1.5);
    const imp_quad h = half * imp_quad_load(s), x = half + h, y = half - h;
    const imp_quad xx = x * x, xy = x * y, yy = y * y;
    imp_quad value[4] = {y * yy, three * x * yy, three * y * xx, x * xx};
    imp_quad first[4] = {-by * yy, by * yy - three * xy, three * xy - by * xx, by * xx};
    imp_quad second[4] = {by * y, by * x - three * y, by * y - three * x, by * x};
    imp_quad_transpose(value);
    imp_quad_transpose(first);
    imp_quad_transpose(second);
    for (int k = 0; k < 4; ++k) {
        imp_quad_store(at[k].value, value[k]);
        imp_quad_store(at[k].first, first[k]);
        imp_quad_store(at[k].second, second[k]);
    }
}

/* --- Points ----------------------------------------------------------------------------------- */

static const double *weights_of(const net *f)
{
    return f->numbers + (f->is_moving ? 6 : 3) * f->stride;
}

IMP_QUAD_INLINE void points_take(const net *f, double t, net_points *points)
{
    const imp_quad tau = imp_quad_all(t - f->time);
    const double *weights = weights_of(f);
    points->net = f;
    for (int k = 0, j = 0; k < f->stride; k += IMP_QUAD, ++j) {
        imp_quad w = imp_quad_all(1);
        if (f->is_weighted) w = imp_quad_load(weights + k);
        for (int i = 0; i < 3; ++i) {
            const double *x = f->numbers + i * f->stride + k;
            imp_quad p = imp_quad_load(x);
            if (f->is_moving) p += tau * imp_quad_load(x + 3 * f->stride);
            if (f->is_weighted) p *= w;
            points->x[i][j] = p;
        }
        points->x[3][j] = w;
    }
}

IMP_QUAD_WIDE static void points_take_wide(const net *f, double t, net_points *points)
{
    points_take(f, t, points);
}

void net_points_take(const net *f, double t, net_points *points)
{
    if (imp_quad_is_wide())
        points_take_wide(f, t, points);
    else
        points_take(f, t, points);
}

IMP_QUAD_INLINE void all_heights_along(const net_points *f, vec3 axis, double *height)
{
    const imp_quad n[3] = {imp_quad_all(axis.x[0]), imp_quad_all(axis.x[1]),
                           imp_quad_all(axis.x[2])};
    for (int k = 0; IMP_QUAD * k < f->net->stride; ++k) {
        imp_quad h = n[0] * f->x[0][k] + n[1] * f->x[1][k] + n[2] * f->x[2][k];
        if (f->net->is_weighted) h = h / f->x[3][k];
        imp_quad_store(height + IMP_QUAD * k, h);
    }
}

IMP_QUAD_WIDE static void all_heights_along_wide(const net_points *f, vec3 axis, double *height)
{
    all_heights_along(f, axis, height);
}

void net_heights_along(const net_points *f, vec3 axis, double height[IMP_QUAD * QUADS_MAX])
{
    if (imp_quad_is_wide())
        all_heights_along_wide(f, axis, height);
    else
        all_heights_along(f, axis, height);
}

/* Returns the sums of four quads' numbers. */
IMP_QUAD_INLINE imp_quad totals(imp_quad a, imp_quad b, imp_quad c, imp_quad d)
{
    const imp_quad ab = (imp_quad){a[0], b[0], a[2], b[2]} + (imp_quad){a[1], b[1], a[3], b[3]};
    const imp_quad cd = (imp_quad){c[0], d[0], c[2], d[2]} + (imp_quad){c[1], d[1], c[3], d[3]};
    return (imp_quad){ab[0], ab[1], cd[0], cd[1]} + (imp_quad){ab[2], ab[3], cd[2], cd[3]};
}

/* Computes the sum of four rows, each times its number, for each coordinate of a net's points. */
IMP_QUAD_INLINE void rows_by(const net_points *of, bool is_weighted, const double f[4],
                             imp_quad sum[4])
{
    const imp_quad f0 = imp_quad_all(f[0]), f1 = imp_quad_all(f[1]), f2 = imp_quad_all(f[2]),
                   f3 = imp_quad_all(f[3]);
    for (int i = 0; i < (is_weighted ? 4 : 3); ++i) {
        const imp_quad *x = of->x[i];
        sum[i] = (f0 * x[0] + f1 * x[1]) + (f2 * x[2] + f3 * x[3]);
    }
}

/* Returns the sums over v of each row of a bicubic patch times four numbers. */
IMP_QUAD_INLINE imp_quad columns_by(const imp_quad x[4], imp_quad f, bool is_weighted)
{
    imp_quad last = imp_quad_all(0);
    if (is_weighted) last = f * x[3];
    return totals(f * x[0], f * x[1], f * x[2], last);
}

/* Evaluates a bicubic patch: along u row by row, then along v. */
IMP_QUAD_INLINE void bicubic_sums(const net_points *f, bool is_weighted, const cubics at[2],
                                  imp_quad sum[NET_DERIVATIVES])
{
    const cubics *u = &at[0], *v = &at[1];
    imp_quad x[4], xu[4], xuu[4];
    rows_by(f, is_weighted, u->value, x);
    rows_by(f, is_weighted, u->first, xu);
    rows_by(f, is_weighted, u->second, xuu);
    const imp_quad value = imp_quad_load(v->value), first = imp_quad_load(v->first);
    sum[NET_VALUE] = columns_by(x, value, is_weighted);
    sum[NET_U] = columns_by(xu, value, is_weighted);
    sum[NET_V] = columns_by(x, first, is_weighted);
    sum[NET_UU] = columns_by(xuu, value, is_weighted);
    sum[NET_UV] = columns_by(xu, first, is_weighted);
    sum[NET_VV] = columns_by(x, imp_quad_load(v->second), is_weighted);
}

/* Evaluates any patch, point by point. */
static void any_sums(const net_points *f, const double s[2], imp_quad sum[NET_DERIVATIVES])
{
    const int n = f->net->degree[0], m = f->net->degree[1];
    bernstein u, v;
    bernstein_at(n, s[0], &u);
    bernstein_at(m, s[1], &v);
    for (int d = 0; d < NET_DERIVATIVES; ++d) sum[d] = imp_quad_all(0);
    for (int k = 0, i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j, ++k) {
            imp_quad x;
            for (int c = 0; c < 4; ++c) x[c] = f->x[c][k / IMP_QUAD][k % IMP_QUAD];
            sum[NET_VALUE] += imp_quad_all(u.value[i] * v.value[j]) * x;
            sum[NET_U] += imp_quad_all(u.first[i] * v.value[j]) * x;
            sum[NET_V] += imp_quad_all(u.value[i] * v.first[j]) * x;
            sum[NET_UU] += imp_quad_all(u.second[i] * v.value[j]) * x;
            sum[NET_UV] += imp_quad_all(u.first[i] * v.first[j]) * x;
            sum[NET_VV] += imp_quad_all(u.value[i] * v.second[j]) * x;
        }
}

/* Computes derivatives of a quotient N / W from those of both, W being the fourth coordinate. */
IMP_QUAD_INLINE void divide(imp_quad n[NET_DERIVATIVES])
{
    imp_quad w[NET_DERIVATIVES];
    for (int d = 0; d < NET_DERIVATIVES; ++d) w[d] = imp_quad_all(n[d][3]);
    const imp_quad two = imp_quad_all(2), x = n[NET_VALUE] / w[NET_VALUE];
    const imp_quad xu = (n[NET_U] - w[NET_U] * x) / w[NET_VALUE];
    const imp_quad xv = (n[NET_V] - w[NET_V] * x) / w[NET_VALUE];
    n[NET_UU] = (n[NET_UU] - two * w[NET_U] * xu - w[NET_UU] * x) / w[NET_VALUE];
    n[NET_UV] = (n[NET_UV] - w[NET_U] * xv - w[NET_V] * xu - w[NET_UV] * x) / w[NET_VALUE];
    n[NET_VV] = (n[NET_VV] - two * w[NET_V] * xv - w[NET_VV] * x) / w[NET_VALUE];
    n[NET_VALUE] = x;
    n[NET_U] = xu;
    n[NET_V] = xv;
}

IMP_QUAD_INLINE void bicubic_jet(const net_points *f, bool is_weighted, const cubics at[2],
                                 net_derivatives *out)
{
    bicubic_sums(f, is_weighted, at, out->by);
    if (is_weighted) divide(out->by);
}

static void any_jet(const net_points *f, const double s[2], net_derivatives *out)
{
    any_sums(f, s, out->by);
    if (f->net->is_weighted) divide(out->by);
}

static bool is_bicubic(const net *f) { return f->degree[0] == 3 && f->degree[1] == 3; }

IMP_QUAD_INLINE void jets_at(const net_points of[2], const double y[4], net_derivatives out[2])
{
    cubics at[4];
    if (is_bicubic(of[0].net) || is_bicubic(of[1].net)) cubics_at(y, at);
    for (int side = 0; side < 2; ++side) {
        const net_points *f = &of[side];
        if (!is_bicubic(f->net))
            any_jet(f, y + 2 * side, &out[side]);
        else if (f->net->is_weighted)
            bicubic_jet(f, true, at + 2 * side, &out[side]);
        else
            bicubic_jet(f, false, at + 2 * side, &out[side]);
    }
}

IMP_QUAD_WIDE static void jets_at_wide(const net_points of[2], const double y[4],
                                       net_derivatives out[2])
{
    jets_at(of, y, out);
}

void net_eval_at(const net_points of[2], const double y[4], net_derivatives out[2])
{
    if (imp_quad_is_wide())
        jets_at_wide(of, y, out);
    else
        jets_at(of, y, out);
}

/* --- Velocities ------------------------------------------------------------------------------- */

/* Returns the weighted sum of velocities, and the sum of the weights in the fourth lane. */
static imp_quad bicubic_velocity(const net *f, const double s[2])
{
    const double *weights = weights_of(f), places[4] = {s[0], s[1], s[0], s[1]};
    cubics at[4];
    cubics_at(places, at);
    const cubics u = at[0], v = at[1];
    imp_quad sum[4], share[4];
    for (int k = 0; k < 4; ++k) {
        share[k] = imp_quad_all(u.value[k]) * imp_quad_load(v.value);
        if (f->is_weighted) share[k] *= imp_quad_load(weights + 4 * k);
    }
    for (int i = 0; i < 3; ++i) {
        const double *x = f->numbers + (3 + i) * 16;
        sum[i] = (share[0] * imp_quad_load(x) + share[1] * imp_quad_load(x + 4)) +
                 (share[2] * imp_quad_load(x + 8) + share[3] * imp_quad_load(x + 12));
    }
    sum[3] = (share[0] + share[1]) + (share[2] + share[3]);
    return totals(sum[0], sum[1], sum[2], sum[3]);
}

static imp_quad any_velocity(const net *f, const double s[2])
{
    const int n = f->degree[0], m = f->degree[1];
    const double *weights = weights_of(f);
    bernstein u, v;
    imp_quad sum = imp_quad_all(0);
    bernstein_at(n, s[0], &u);
    bernstein_at(m, s[1], &v);
    for (int k = 0, i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j, ++k) {
            const double share = u.value[i] * v.value[j] * (f->is_weighted ? weights[k] : 1);
            const double *x = f->numbers + 3 * f->stride + k;
            sum += imp_quad_all(share) * (imp_quad){x[0], x[f->stride], x[2 * f->stride], 1};
        }
    return sum;
}

vec3 net_velocity_at(const net *f, const double s[2])
{
    vec3 velocity = vec3_from(f->drift);
    if (!f->is_moving) return velocity;
    const imp_quad sum = is_bicubic(f) ? bicubic_velocity(f, s) : any_velocity(f, s);
    for (int i = 0; i < 3; ++i) velocity.x[i] += sum[i] / sum[3];
    return velocity;
}
