/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/net_march.h"

#include <string.h>

#include "core/solver/net_hull.h"
#include "core/solver/newton.h"
#include "core/solver/tuning.h"

/* --- Bernstein polynomials ------------------------------------------------------------------------ */

/* All of one degree, and their derivatives, at s in [-1, 1] or beyond. */
typedef struct bernstein {
    double value[IMP_NET_POINTS], first[IMP_NET_POINTS], second[IMP_NET_POINTS];
} bernstein;

/* From degree n - 1 to n, in place. */
static void raise_degree(double *b, int n, double x)
{
    b[n] = x * b[n - 1];
    for (int i = n - 1; i > 0; --i) b[i] = x * b[i - 1] + (1 - x) * b[i];
    b[0] *= 1 - x;
}

/* Derivatives by s, of which x is half and something, from those of degree n - 1: n / 2 times their
 * differences. */
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

IMP_QUAD_INLINE void cubic_at(double s, imp_quad *value, imp_quad *first, imp_quad *second)
{
    const double x = 0.5 + 0.5 * s, y = 0.5 - 0.5 * s, xx = x * x, xy = x * y, yy = y * y;
    *value = (imp_quad){y * yy, 3 * x * yy, 3 * y * xx, x * xx};
    *first = imp_quad_all(1.5) * (imp_quad){-yy, yy - 2 * xy, 2 * xy - xx, xx};
    *second = imp_quad_all(1.5) * (imp_quad){y, x - 2 * y, y - 2 * x, x};
}

/* --- A patch at one place --------------------------------------------------------------------------- */

/* Of what is summed up over control points: value, derivatives along u, v, uu, uv, vv. */
enum { JET_VALUE, JET_U, JET_V, JET_UU, JET_UV, JET_VV, JETS };

typedef struct jet {
    vec3 by[JETS];
} jet;

typedef struct shares {
    double of[JETS][IMP_QUAD * QUADS_MAX];
} shares;

/* Of a bicubic patch, row by row. */
IMP_QUAD_INLINE void shares_of_bicubic(const double s[2], shares *z)
{
    imp_quad u[3], v[3];
    cubic_at(s[0], &u[0], &u[1], &u[2]);
    cubic_at(s[1], &v[0], &v[1], &v[2]);
    for (int i = 0; i < 4; ++i) {
        const imp_quad a = imp_quad_all(u[0][i]), b = imp_quad_all(u[1][i]),
                       c = imp_quad_all(u[2][i]);
        imp_quad_store(z->of[JET_VALUE] + 4 * i, a * v[0]);
        imp_quad_store(z->of[JET_U] + 4 * i, b * v[0]);
        imp_quad_store(z->of[JET_V] + 4 * i, a * v[1]);
        imp_quad_store(z->of[JET_UU] + 4 * i, c * v[0]);
        imp_quad_store(z->of[JET_UV] + 4 * i, b * v[1]);
        imp_quad_store(z->of[JET_VV] + 4 * i, a * v[2]);
    }
}

static void shares_of_any(const net *f, const double s[2], shares *z)
{
    const int m = f->degree[1] + 1, points = (f->degree[0] + 1) * m;
    bernstein u, v;
    bernstein_at(f->degree[0], s[0], &u);
    bernstein_at(f->degree[1], s[1], &v);
    for (int k = 0, i = 0; i <= f->degree[0]; ++i)
        for (int j = 0; j < m; ++j, ++k) {
            z->of[JET_VALUE][k] = u.value[i] * v.value[j];
            z->of[JET_U][k] = u.first[i] * v.value[j];
            z->of[JET_V][k] = u.value[i] * v.first[j];
            z->of[JET_UU][k] = u.second[i] * v.value[j];
            z->of[JET_UV][k] = u.first[i] * v.first[j];
            z->of[JET_VV][k] = u.value[i] * v.second[j];
        }
    for (int k = points; k < f->stride; ++k)
        for (int d = 0; d < JETS; ++d) z->of[d][k] = 0;
}

IMP_QUAD_INLINE void shares_at(const net *f, const double s[2], shares *z)
{
    if (f->degree[0] == 3 && f->degree[1] == 3)
        shares_of_bicubic(s, z);
    else
        shares_of_any(f, s, z);
}

IMP_QUAD_INLINE double total(imp_quad x) { return (x[0] + x[1]) + (x[2] + x[3]); }

/* Derivatives of a quotient N / W from those of both. */
static void divide(jet *of, const double w[JETS])
{
    vec3 *n = of->by;
    for (int i = 0; i < 3; ++i) {
        const double x = n[JET_VALUE].x[i] / w[JET_VALUE];
        const double xu = (n[JET_U].x[i] - w[JET_U] * x) / w[JET_VALUE];
        const double xv = (n[JET_V].x[i] - w[JET_V] * x) / w[JET_VALUE];
        n[JET_UU].x[i] = (n[JET_UU].x[i] - 2 * w[JET_U] * xu - w[JET_UU] * x) / w[JET_VALUE];
        n[JET_UV].x[i] =
            (n[JET_UV].x[i] - w[JET_U] * xv - w[JET_V] * xu - w[JET_UV] * x) / w[JET_VALUE];
        n[JET_VV].x[i] = (n[JET_VV].x[i] - 2 * w[JET_V] * xv - w[JET_VV] * x) / w[JET_VALUE];
        n[JET_VALUE].x[i] = x;
        n[JET_U].x[i] = xu;
        n[JET_V].x[i] = xv;
    }
}

/* Of a net's points at one time, without its place. */
IMP_QUAD_INLINE void jet_of(const net *f, const cloud *x, int quads, const double s[2], jet *out)
{
    shares z;
    double w[JETS] = {1};
    const double *weights = f->numbers + (f->is_moving ? 6 : 3) * f->stride;
    shares_at(f, s, &z);
    for (int d = 0; d < JETS && f->is_weighted; ++d) {
        imp_quad sum = imp_quad_all(0);
        for (int k = 0; k < f->stride; k += IMP_QUAD) {
            const imp_quad share = imp_quad_load(z.of[d] + k) * imp_quad_load(weights + k);
            imp_quad_store(z.of[d] + k, share);
            sum += share;
        }
        w[d] = total(sum);
    }
    for (int i = 0; i < 3; ++i)
        for (int d = 0; d < JETS; ++d) {
            imp_quad sum = imp_quad_all(0);
            for (int k = 0; k < quads; ++k)
                sum += x->x[i][k] * imp_quad_load(z.of[d] + IMP_QUAD * k);
            out->by[d].x[i] = total(sum);
        }
    if (f->is_weighted) divide(out, w);
}

IMP_QUAD_INLINE void jet_at(const net *f, const cloud *x, const double s[2], jet *out)
{
    if (f->stride == 16)
        jet_of(f, x, 4, s, out);
    else
        jet_of(f, x, f->stride / IMP_QUAD, s, out);
}

IMP_QUAD_WIDE static void jet_at_wide(const net *f, const cloud *x, const double s[2], jet *out)
{
    jet_at(f, x, s, out);
}

/* How fast the point moves. */
static vec3 velocity_at(const net *f, const double s[2])
{
    shares z;
    vec3 v = vec3_from(f->drift);
    const double *weights = f->numbers + 6 * f->stride;
    double all = 0, sum[3] = {0, 0, 0};
    if (!f->is_moving) return v;
    shares_at(f, s, &z);
    for (int k = 0; k < f->stride; ++k) {
        const double share = z.of[JET_VALUE][k] * (f->is_weighted ? weights[k] : 1);
        all += share;
        for (int i = 0; i < 3; ++i) sum[i] += share * f->numbers[(3 + i) * f->stride + k];
    }
    for (int i = 0; i < 3; ++i) v.x[i] += sum[i] / all;
    return v;
}

/* --- The distance --------------------------------------------------------------------------------------- */

typedef struct marcher {
    const net *nets[2];
    newton_bounds bounds;
    double t;
    cloud points[2];
    vec3 places; /* of b, from a */
} marcher;

typedef struct stand {
    double y[NEWTON_UNKNOWNS];
    jet side[2];
    vec3 apart;
    double gap;
} stand;

static void marcher_go(marcher *m, double t)
{
    m->t = t;
    for (int side = 0; side < 2; ++side) cloud_at(m->nets[side], t, &m->points[side]);
    m->places = places_apart(m->nets[0], m->nets[1], t);
}

static void stand_at(const marcher *m, const double *y, stand *s)
{
    memcpy(s->y, y, sizeof s->y);
    for (int side = 0; side < 2; ++side)
        if (imp_quad_is_wide())
            jet_at_wide(m->nets[side], &m->points[side], y + 2 * side, &s->side[side]);
        else
            jet_at(m->nets[side], &m->points[side], y + 2 * side, &s->side[side]);
    for (int i = 0; i < 3; ++i)
        s->apart.x[i] =
            s->side[1].by[JET_VALUE].x[i] - s->side[0].by[JET_VALUE].x[i] + m->places.x[i];
    s->gap = vec3_norm(s->apart);
}

static void derive(const stand *s, double gradient[NEWTON_UNKNOWNS],
                   double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS])
{
    vec3 by[NEWTON_UNKNOWNS];
    double second[2][2][2];
    for (int side = 0; side < 2; ++side) {
        const vec3 *x = s->side[side].by;
        for (int j = 0; j < 2; ++j)
            by[2 * side + j] = side == 0 ? vec3_scale(x[JET_U + j], -1) : x[JET_U + j];
        second[side][0][0] = vec3_dot(s->apart, x[JET_UU]);
        second[side][0][1] = second[side][1][0] = vec3_dot(s->apart, x[JET_UV]);
        second[side][1][1] = vec3_dot(s->apart, x[JET_VV]);
    }
    newton_of_gap(s->apart, by, second, gradient, hessian);
}

/* To the nearest points at one time, as far as a step gains `gain` of the gap. */
static void descend(const marcher *m, double gain, stand *s)
{
    double damping = NEWTON_DAMPING;
    for (int k = 0; k < TUNING_NEWTON_STEPS && s->gap > 0;) {
        double gradient[NEWTON_UNKNOWNS], hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS];
        derive(s, gradient, hessian);
        const double scale = newton_scale(hessian);
        if (!(scale > 0)) return;
        stand trial;
        bool better = false;
        for (; k < TUNING_NEWTON_STEPS && damping < NEWTON_DAMPING_MAX && !better; ++k) {
            double next[NEWTON_UNKNOWNS];
            if (newton_step(&m->bounds, s->y, gradient, hessian, damping * scale, next)) {
                stand_at(m, next, &trial);
                better = trial.gap < s->gap;
            }
            damping *= better ? NEWTON_DAMPING_LESS : NEWTON_DAMPING_MORE;
        }
        if (!better) return;
        const bool last = s->gap - trial.gap < gain * s->gap;
        *s = trial;
        if (last) return;
    }
}

static double closing_speed(const marcher *m, const stand *s)
{
    const vec3 v = vec3_sub(velocity_at(m->nets[1], s->y + 2), velocity_at(m->nets[0], s->y));
    return -vec3_dot(v, s->apart) / s->gap;
}

/* --- In time -------------------------------------------------------------------------------------------- */

/* How far the surface goes on around a node, in units of its half-widths. */
static void bounds_of(const node *n, double *lo, double *hi)
{
    const node *whole = n;
    while (whole->parent != NULL && whole->parent->many == NULL) whole = whole->parent;
    for (int j = 0; j < 2; ++j) {
        const double d = n->region.d[j], c = n->region.c[j];
        lo[j] = d > 0 ? (whole->region.lo[j] - c) / d : 0;
        hi[j] = d > 0 ? (whole->region.hi[j] - c) / d : 0;
    }
}

/* How far to go, of the time it would take until the gap is `gap` at its speed: it may shrink faster than it
 * does at first, and behind the contact no nearest points tell how far. */
static double wait_of(const stand *s, double gap, double speed)
{
    const double wait = (s->gap - gap) / speed;
    return s->gap > TUNING_MARCH_NEAR * gap ? TUNING_MARCH_STRIDE * wait : wait;
}

/* Beside the gap that is sought, what is near enough. */
static const double ENOUGH = 1.125;

bool net_march(const node *a, const node *b, const time_window *window, double gap,
               net_meeting *found)
{
    marcher m = {.nets = {node_net_made(a), node_net_made(b)}};
    stand s;
    bounds_of(a, m.bounds.lo, m.bounds.hi);
    bounds_of(b, m.bounds.lo + 2, m.bounds.hi + 2);
    marcher_go(&m, window->lo);
    stand_at(&m, (double[NEWTON_UNKNOWNS]){0, 0, 0, 0}, &s);
    for (int k = 0; k < TUNING_MARCH_STEPS; ++k) {
        descend(&m, s.gap > TUNING_MARCH_NEAR * gap ? TUNING_MARCH_GAIN : TUNING_NEWTON_GAIN, &s);
        const double speed = closing_speed(&m, &s);
        if (s.gap < ENOUGH * gap) {
            *found = (net_meeting){.t = m.t, .speed = speed};
            memcpy(found->y, s.y, sizeof found->y);
            return true;
        }
        const double next = m.t + wait_of(&s, gap, speed);
        if (!(speed > 0 && next > m.t && next <= window->hi)) return false;
        marcher_go(&m, next);
        const stand here = s;
        stand_at(&m, here.y, &s);
    }
    return false;
}
