/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "separation.h"

#include <assert.h>

#include "quadratic.h"

/* --- Models re-centred on a window ------------------------------------------------ */

/* One surface over the window t = mid + half * w, w in [-1, 1]: the polynomial in s_u, s_v that
 * holds at its middle. */
typedef struct slice {
    double bu[3], bv[3], quu[3], quv[3], qvv[3];
} slice;

/* B - A over the window: offset delta + drift * w, plus slice b, minus slice a, give or take slack.
 */
typedef struct relative {
    slice a, b;
    double delta[3], drift[3];
    double slack[3];     /* both remainders, and what moving the centre put there */
    double magnitude[3]; /* sum of abs of everything above, before cancellation */
    double mid, half;
} relative;

/* Lemma (re-centring). In a node, s_t = (t - c) / d; over the window s_t = s0 + k w with
 * s0 = (mid - c) / d and k = half / d, abs(s0) + k <= 1 up to rounding. Substituting,
 *
 *   a + bt s_t + qtt s_t^2 = [a + bt s0 + qtt s0^2] + [k (bt + 2 qtt s0)] w + qtt k^2 w^2
 *   bu s_u + qut s_u s_t   = [bu + qut s0] s_u + qut k s_u w        (v alike)
 *
 * The terms in w^2, s_u w and s_v w have no place in the form; abs(s) <= 1 bounds them by
 * k (abs(qut) + abs(qvt) + k abs(qtt)), which goes to the slack, weighted by the window. */
static void slice_at(const node *n, double mid, double half, slice *s, double *shift, double *drift,
                     double *slack)
{
    const double d = n->region.d[PARAMETER_T], c = n->region.c[PARAMETER_T];
    const double s0 = d > 0 ? (mid - c) / d : 0, k = d > 0 ? half / d : 0;
    const quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i) {
        s->bu[i] = f->bu[i] + f->qut[i] * s0;
        s->bv[i] = f->bv[i] + f->qvt[i] * s0;
        s->quu[i] = f->quu[i];
        s->quv[i] = f->quv[i];
        s->qvv[i] = f->qvv[i];
        shift[i] = (f->bt[i] + f->qtt[i] * s0) * s0;
        drift[i] = k * (f->bt[i] + 2 * f->qtt[i] * s0);
        slack[i] = n->e[i] + k * (fabs(f->qut[i]) + fabs(f->qvt[i]) + k * fabs(f->qtt[i]));
    }
}

static void relative_at(const node *a, const node *b, const time_window *window, relative *r)
{
    double shift_a[3], shift_b[3], drift_a[3], drift_b[3], slack_a[3], slack_b[3];
    r->mid = 0.5 * window->lo + 0.5 * window->hi;
    const double reach = fmax(window->hi - r->mid, r->mid - window->lo);
    r->half = reach + reach * 0x1p-51;
    slice_at(a, r->mid, r->half, &r->a, shift_a, drift_a, slack_a);
    slice_at(b, r->mid, r->half, &r->b, shift_b, drift_b, slack_b);
    for (int i = 0; i < 3; ++i) {
        const double apart = b->f.a[i] - a->f.a[i];
        r->delta[i] = apart + (shift_b[i] - shift_a[i]);
        r->drift[i] = drift_b[i] - drift_a[i];
        r->slack[i] = slack_a[i] + slack_b[i];
        r->magnitude[i] = fabs(apart) + (a->magnitude[i] + b->magnitude[i]);
    }
}

/* --- One axis ------------------------------------------------------------------------- */

static quadratic project(const slice *s, vec3 n)
{
    return (quadratic){vec3_dot(n, vec3_from(s->bu)), vec3_dot(n, vec3_from(s->bv)),
                       vec3_dot(n, vec3_from(s->quu)), vec3_dot(n, vec3_from(s->quv)),
                       vec3_dot(n, vec3_from(s->qvv))};
}

/* Where w may be: [lo, hi] within [-1, 1]. */
typedef struct share {
    double lo, hi;
} share;

/* Keeps the w with low + drift w <= limit. The division and the difference are each off by 2^-53; a
 * w of abs(w) <= 1 is moved outward by 2^-50. NaN keeps everything. */
static bool share_cut(share *s, double low, double drift, double limit)
{
    if (low - fabs(drift) > limit) return false;
    const double w = (limit - low) / drift;
    if (drift > 0 && w + 0x1p-50 < s->hi) s->hi = w + 0x1p-50;
    if (drift < 0 && w - 0x1p-50 > s->lo) s->lo = w - 0x1p-50;
    return !(s->lo > s->hi);
}

/* Lemma (one axis). For every w in the window and all points x of A, y of B at that time,
 *
 *   n.(y - x) in n.delta + n.drift w + [min Qb - max Qa, max Qb - min Qa] -+ sum_i |n_i| slack_i
 *
 * and |n.(y - x)| <= |n| |y - x|. So where the interval leaves [-g, g], g = |n| clearance, the
 * nodes are farther apart than the clearance. Rounding, in units of u = 2^-53 and R = sum_i |n_i|
 * magnitude_i: re-centring 20 R (each coefficient takes at most 6 operations on terms that
 * magnitude counts, at most three times), the dots 6 R, quadratic_span 128 R (2^-46 R for the two),
 * the sums 6 R, the slack's own sums 8 R: below 2^-45 R. The last term outweighs underflow. */
static bool axis_cut(const relative *r, vec3 n, double clearance, share *s)
{
    const double longest = fmax(fabs(n.x[0]), fmax(fabs(n.x[1]), fabs(n.x[2])));
    if (!(longest > 0x1p-400 && longest < 0x1p400)) return true;
    n = vec3_scale(n, 1 / longest);
    const quadratic qa = project(&r->a, n), qb = project(&r->b, n);
    const span ra = quadratic_span(&qa), rb = quadratic_span(&qb);
    double slack = 0x1p-490, size = 0;
    for (int i = 0; i < 3; ++i) {
        slack += fabs(n.x[i]) * r->slack[i];
        size += fabs(n.x[i]) * r->magnitude[i];
    }
    if (!(size < 0x1p400)) return true;
    slack += size * 0x1p-45;
    const double offset = vec3_dot(n, vec3_from(r->delta));
    const double drift = vec3_dot(n, vec3_from(r->drift));
    const double limit = vec3_norm(n) * clearance * (1 + 0x1p-49);
    return share_cut(s, offset + (rb.lo - ra.hi) - slack, drift, limit) &&
           share_cut(s, -offset - (rb.hi - ra.lo) - slack, -drift, limit);
}

/* --- All axes ------------------------------------------------------------------------ */

/* Axes in the order tried after the one that served the parent: the line of centres at the
 * window's start (it decides when the earliest contact can be), both normals, the
 * coordinate axes, and in each tangent plane the directions across u and v. */
enum {
    AXIS_CENTRES,
    AXIS_NORMAL_A,
    AXIS_NORMAL_B,
    AXIS_X,
    AXIS_Y,
    AXIS_Z,
    AXIS_A_U,
    AXIS_A_V,
    AXIS_B_U,
    AXIS_B_V,
    AXES
};

static vec3 axis_direction(const relative *r, const node *a, const node *b, unsigned axis)
{
    switch (axis) {
    case AXIS_CENTRES:
        return vec3_sub(vec3_from(r->delta), vec3_from(r->drift));
    case AXIS_NORMAL_A:
        return a->normal;
    case AXIS_NORMAL_B:
        return b->normal;
    case AXIS_A_U:
        return vec3_cross(a->normal, vec3_from(a->f.bu));
    case AXIS_A_V:
        return vec3_cross(a->normal, vec3_from(a->f.bv));
    case AXIS_B_U:
        return vec3_cross(b->normal, vec3_from(b->f.bu));
    case AXIS_B_V:
        return vec3_cross(b->normal, vec3_from(b->f.bv));
    default:
        return (vec3){{axis == AXIS_X, axis == AXIS_Y, axis == AXIS_Z}};
    }
}

static bool axes_cut(const relative *r, const node *a, const node *b, double clearance, share *s,
                     unsigned *best)
{
    const unsigned first = *best < AXES ? *best : 0;
    double width = s->hi - s->lo;
    for (unsigned k = 0; k <= AXES; ++k) {
        const unsigned axis = k == 0 ? first : k - 1;
        if (k > 0 && axis == first) continue;
        const bool left = axis_cut(r, axis_direction(r, a, b, axis), clearance, s);
        if (!left || s->hi - s->lo < width) *best = axis;
        if (!left) return false;
        width = s->hi - s->lo;
    }
    return true;
}

/* The part of the window that `s` says, rounded outward: half w is off by u half, the sum by
 * u (abs(mid) + half). */
static void window_take(time_window *window, const relative *r, const share *s)
{
    const double slack = (fabs(r->mid) + r->half) * 0x1p-51;
    const double lo = r->mid + r->half * s->lo - slack, hi = r->mid + r->half * s->hi + slack;
    if (s->lo > -1 && lo > window->lo) window->lo = lo < window->hi ? lo : window->hi;
    if (s->hi < 1 && hi < window->hi) window->hi = hi > window->lo ? hi : window->lo;
}

enum { ROUNDS = 3 };

bool separation_by_models(const node *a, const node *b, double clearance, time_window *window,
                          unsigned *axis)
{
    if (!a->bounded || !b->bounded) return true;
    if (separation_of_boxes(a, b, clearance)) return false;
    for (int round = 0; round < ROUNDS; ++round) {
        relative r;
        share s = {-1, 1};
        relative_at(a, b, window, &r);
        if (!axes_cut(&r, a, b, clearance, &s, axis)) return false;
        window_take(window, &r, &s);
        if (!(s.hi - s.lo < 1.0)) break; /* not even halved: a new centre would not help much */
    }
    return true;
}

/* Both tests: a difference is off by 2^-53 of itself, squares, sums and root by less than 2^-50.
 * Written so that a NaN is never apart. */
bool separation_of_boxes(const node *a, const node *b, double clearance)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double above = b->lo[i] - a->hi[i], below = a->lo[i] - b->hi[i];
        const double gap = above > below ? above : below;
        if (gap > 0) sum += gap * gap;
    }
    return sqrt(sum) * (1 - 0x1p-49) > clearance;
}

bool separation_of_balls(const node *a, const node *b, double clearance)
{
    if (!a->bounded || !b->bounded) return false;
    const vec3 apart = vec3_sub(vec3_from(b->f.a), vec3_from(a->f.a));
    const double reach = a->radius + b->radius;
    return vec3_norm(apart) * (1 - 0x1p-49) - reach * (1 + 0x1p-50) > clearance;
}

double separation_farthest_of_boxes(const node *a, const node *b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double above = b->hi[i] - a->lo[i], below = a->hi[i] - b->lo[i];
        const double far = above > below ? above : below;
        sum += far * far;
    }
    return sqrt(sum);
}

double separation_farthest_of_balls(const node *a, const node *b)
{
    return vec3_norm(vec3_sub(vec3_from(b->f.a), vec3_from(a->f.a))) + a->radius + b->radius;
}

double separation_centres(const node *a, const node *b, double t)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        double x[2];
        const node *both[2] = {a, b};
        for (int k = 0; k < 2; ++k) {
            const imp_region *g = &both[k]->region;
            const quadratic3 *f = &both[k]->f;
            const double s = g->d[2] > 0 ? (t - g->c[2]) / g->d[2] : 0;
            x[k] = f->a[i] + (f->bt[i] + f->qtt[i] * s) * s;
        }
        sum += (x[1] - x[0]) * (x[1] - x[0]);
    }
    return sum;
}
