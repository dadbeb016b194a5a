/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "separation.h"

#include <assert.h>

#include "normal_field.h"
#include "quadratic.h"

/* --- One axis ------------------------------------------------------------------------- */

static quadratic project(const slice *s, vec3 n)
{
    return (quadratic){vec3_dot(n, vec3_from(s->bu)), vec3_dot(n, vec3_from(s->bv)),
                       vec3_dot(n, vec3_from(s->quu)), vec3_dot(n, vec3_from(s->quv)),
                       vec3_dot(n, vec3_from(s->qvv))};
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

static vec3 axis_direction(const relative *r, unsigned axis)
{
    switch (axis) {
    case AXIS_CENTRES:
        return vec3_sub(vec3_from(r->delta), vec3_from(r->drift));
    case AXIS_NORMAL_A:
        return r->a.normal;
    case AXIS_NORMAL_B:
        return r->b.normal;
    case AXIS_A_U:
        return vec3_cross(r->a.normal, vec3_from(r->a.bu));
    case AXIS_A_V:
        return vec3_cross(r->a.normal, vec3_from(r->a.bv));
    case AXIS_B_U:
        return vec3_cross(r->b.normal, vec3_from(r->b.bu));
    case AXIS_B_V:
        return vec3_cross(r->b.normal, vec3_from(r->b.bv));
    default:
        return (vec3){{axis == AXIS_X, axis == AXIS_Y, axis == AXIS_Z}};
    }
}

static bool axes_cut(const relative *r, double clearance, share *s, unsigned *best)
{
    const unsigned first = *best < AXES ? *best : 0;
    double width = s->hi - s->lo;
    for (unsigned k = 0; k <= AXES; ++k) {
        const unsigned axis = k == 0 ? first : k - 1;
        if (k > 0 && axis == first) continue;
        const bool left = axis_cut(r, axis_direction(r, axis), clearance, s);
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
        if (!axes_cut(&r, clearance, &s, axis)) return false;
        if (!normal_field_cut(&r, clearance, &s)) return false;
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
