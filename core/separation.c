/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "separation.h"

#include "axes.h"
#include "normal_field.h"

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
                          vec3 *axis)
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
        if (!(s.hi - s.lo < 0.5)) break; /* not even quartered: a new centre would not help much */
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
