/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/carried.h"

#include "tools/simulate/values.h"

enum { PATCHES = 4, POINTS = 3 * PATCHES };

/* Parts of the size: rounding in rigid motion changes distances of points by less than the first;
 * who moves less than the second stays. */
static const double rigid_slack = 1e-9, least_motion = 1e-6;

/* Evaluates points of up to PATCHES patches spread over the body. False: it has none then. */
static bool points_at(const setup *s, const outline *o, double t, vec x[POINTS])
{
    for (size_t k = 0; k < PATCHES; ++k) {
        const imp_place place = o->patch[k * o->count / PATCHES].place;
        double lo[3], hi[3], at[9], found[9];
        imp_piece_domain(s->still, place, lo, hi);
        if (!(lo[2] <= t && t <= hi[2])) return false;
        for (int n = 0; n < 3; ++n) {
            at[3 * n] = lo[0] + (hi[0] - lo[0]) * (0.2 + 0.3 * n);
            at[3 * n + 1] = lo[1] + (hi[1] - lo[1]) * (0.7 - 0.3 * n);
            at[3 * n + 2] = t;
        }
        if (imp_piece_eval(s->still, place, 3, at, found, NULL, NULL) != IMP_SUCCESS) return false;
        for (size_t n = 0; n < 3; ++n) x[3 * k + n] = vec_of(found + 3 * n);
    }
    return true;
}

static double distance(vec a, vec b) { return vec_length(vec_sub(a, b)); }

static double size_of(const vec x[POINTS])
{
    double size = 0;
    for (int k = 1; k < POINTS; ++k) size = fmax(size, distance(x[0], x[k]));
    return size;
}

static bool keeps_distances(const vec x[POINTS], const vec y[POINTS])
{
    const double far = vec_length(x[0]) + vec_length(y[0]);
    const double slack = rigid_slack * (size_of(x) + far);
    for (int i = 0; i < POINTS; ++i)
        for (int j = 0; j < i; ++j)
            if (!(fabs(distance(x[i], x[j]) - distance(y[i], y[j])) <= slack)) return false;
    return true;
}

static bool moves(const vec x[POINTS], const vec y[POINTS])
{
    const double least = least_motion * size_of(x);
    for (int k = 0; k < POINTS; ++k)
        if (distance(x[k], y[k]) > least) return true;
    return false;
}

exit_status carried_check(const setup *s, size_t body)
{
    const actor *a = &s->actors[body];
    const double from = s->options.t_start, span = s->options.t_end - from;
    vec first[POINTS], then[POINTS];
    if (!a->moves || !a->outline.varies || a->outline.count == 0) return EXIT_ANSWERED;
    if (limits_reached(&s->limits) != IMP_REASON_NONE) return EXIT_ANSWERED;
    if (!points_at(s, &a->outline, from, first)) return EXIT_ANSWERED;
    bool any = false;
    for (int k = 1; k <= 3; ++k) { /* at times that no whole turn is likely between */
        const double t = from + span * (k == 3 ? 1 : 0.381966 * k);
        if (!points_at(s, &a->outline, t, then) || !keeps_distances(first, then))
            return EXIT_ANSWERED;
        any = any || moves(first, then);
    }
    if (!any) return EXIT_ANSWERED;
    return value_refuse((value_place){s->name, body, "maps"},
                        "found maps that move a body with a mass, whose motion \"velocity\", "
                        "\"spin\" and impacts give; leave them out, or the \"mass\"; maps may "
                        "place such a body, and change its shape with time");
}
