/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/walk.h"

#include <impinge/interval.h>

/* Adds what the points are off by, for steps once and twice as large. */
static void set_steps(const corner_net *n, int g, imp_quad most, double steps[CORNER_LANES])
{
    most += 2 * ROUGH_SLOPE * imp_quad_load(n->slip + g * IMP_QUAD) +
            (4 * CORNER_REFLECTION + 0x1p-51) * imp_quad_load(n->most + g * IMP_QUAD);
    imp_quad_store(steps + g * IMP_QUAD, most);
}

/* The greatest step along u (side 0) or v between control points of a quad, but that at (-1,-1). */
static void quad_steps(const corner_net *n, int side, double steps[CORNER_LANES])
{
    for (int g = 0; g < n->groups; ++g) {
        imp_quad most = {0};
        for (int x = 0; x < CORNER_FINE - (side == 0); ++x)
            for (int y = x == 0; y < CORNER_FINE - (side == 1); ++y)
                most = imp_quad_max(
                    imp_quad_abs(n->grid[x + (side == 0)][y + (side == 1)][g] - n->grid[x][y][g]),
                    most);
        set_steps(n, g, most, steps);
    }
}

/* Steps of a triangle's net between points that are used for its children: along u in the
 * directions of two sides from the corner; along v in that of the third, times up to 2, as u
 * 2^level runs from 1 to 2. */
static void triangle_steps(const corner_net *n, int side, double steps[CORNER_LANES])
{
    static const int along[3][2] = {{1, 0}, {0, 1}, {-1, 1}};
    for (int g = 0; g < n->groups; ++g) {
        imp_quad most = {0};
        for (int d = side == 0 ? 0 : 2; d < (side == 0 ? 2 : 3); ++d)
            for (int x = -1; x < CORNER_FINE - 1; ++x)
                for (int y = -1; y < CORNER_FINE - 1; ++y) {
                    const int p = x + along[d][0], q = y + along[d][1];
                    if (x + y < 0 || p + q > 3 || p < -1 || p > 3 || q > 3) continue;
                    most = imp_quad_max(
                        imp_quad_abs(n->grid[p + 1][q + 1][g] - n->grid[x + 1][y + 1][g]), most);
                }
        set_steps(n, g, (side == 0 ? 1.0 : 2.0) * most, steps);
    }
}

static bool is_small(const corner_net *n, const corner_net *first)
{
    for (int lane = 0; lane < n->groups * IMP_QUAD; ++lane)
        if (n->most[lane] > 0x1p-50 * first->most[lane]) return false;
    return true;
}

/* Bounds of |df/du| or |df/dv| over the ring of a level. Its grid spans cells of side 2^-level, in
 * which splines change by no more than their control points do from one to the next; but v of a
 * triangle does not shrink with the level. */
static void ring_rates(const walk *w, int side, double rates[CORNER_LANES])
{
    if (w->now->is_loop)
        triangle_steps(w->now, side, rates);
    else
        quad_steps(w->now, side, rates);
    for (int lane = 0; lane < w->now->groups * IMP_QUAD && !(w->now->is_loop && side == 1); ++lane)
        rates[lane] = ldexp(rates[lane] + IMP_TINY, w->level); /* what underflowed, too */
}

/* Lemma (the last square). Let w = max(u, v), h its side, q(u, v) the surface on w = h less the
 * limit point, |q| <= r. There the surface is replaced by limit + (w / h) q(u h / w, v h / w).
 * Where u >= v its derivative by v is that of q along the border u = h, and by u it is q / h - (v /
 * u) times that: at most r / h + rate_v. Likewise where v >= u. Of a triangle it is limit + (u / h)
 * q(h, v), whose derivatives are q / h and (u / h) times that of q. */
static double with_last_square(const walk *w, int side, const double own[2], double r)
{
    double last = ldexp(r + IMP_TINY, w->level) + own[!side];
    if (w->now->is_loop) last = side == 0 ? ldexp(r + IMP_TINY, w->level) : 0;
    return imp_larger(own[side], last) * SLACK + IMP_TINY;
}

void face_measure(const face *q, face_gauge *gauge)
{
    walk w;
    double rate[CORNER_LANES][2] = {{0}};
    walk_begin(q, &w);
    while (w.level < FACE_DEPTH_MAX && !is_small(w.now, &w.first)) {
        walk_step(&w);
        for (int side = 0; side < 2; ++side) {
            double rates[CORNER_LANES];
            ring_rates(&w, side, rates);
            for (int lane = 0; lane < w.now->groups * IMP_QUAD; ++lane)
                rate[lane][side] = imp_larger(rate[lane][side], rates[lane]);
        }
    }
    gauge->depth = w.level;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 3; ++i) {
            const int m = IMP_QUAD + i;
            const double r = w.now->most[i] + w.now->slip[i] + w.error.place[i];
            gauge->rate[side][i] = with_last_square(&w, side, rate[i], r);
            gauge->rate_motion[side][i] = 0;
            if (w.now->groups == 1) continue;
            const double r_motion = w.now->most[m] + w.now->slip[m] + w.error.drift[i];
            gauge->rate_motion[side][i] = with_last_square(&w, side, rate[m], r_motion);
        }
}
