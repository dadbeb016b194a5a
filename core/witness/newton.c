/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/newton.h"

#include <impinge/quad.h>
#include <math.h>

#include "core/bounds/tuning.h"

#define NEWTON_UNROLL _Pragma("GCC unroll 4")

/* The derivatives by the four unknowns are side by side. To add -0 changes no number. */
IMP_QUAD_INLINE void of_gap(vec3 apart, const vec3 by[NEWTON_UNKNOWNS],
                            const double second[2][2][2], double gradient[NEWTON_UNKNOWNS],
                            double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS])
{
    imp_quad row[3];
    NEWTON_UNROLL
    for (int i = 0; i < 3; ++i) row[i] = (imp_quad){by[0].x[i], by[1].x[i], by[2].x[i], by[3].x[i]};
    imp_quad_store(gradient, row[0] * imp_quad_all(apart.x[0]) + row[1] * imp_quad_all(apart.x[1]) +
                                 row[2] * imp_quad_all(apart.x[2]));
    NEWTON_UNROLL
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        const double *bend = second[k / 2][k % 2];
        const imp_quad sum = imp_quad_all(by[k].x[0]) * row[0] + imp_quad_all(by[k].x[1]) * row[1] +
                             imp_quad_all(by[k].x[2]) * row[2];
        imp_quad_store(hessian[k], sum + (k < 2 ? (imp_quad){-bend[0], -bend[1], -0.0, -0.0}
                                                : (imp_quad){-0.0, -0.0, bend[0], bend[1]}));
    }
}

IMP_QUAD_NARROW static void of_gap_narrow(vec3 apart, const vec3 by[NEWTON_UNKNOWNS],
                                          const double second[2][2][2],
                                          double gradient[NEWTON_UNKNOWNS],
                                          double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS])
{
    of_gap(apart, by, second, gradient, hessian);
}

IMP_QUAD_WIDE static void of_gap_wide(vec3 apart, const vec3 by[NEWTON_UNKNOWNS],
                                      const double second[2][2][2],
                                      double gradient[NEWTON_UNKNOWNS],
                                      double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS])
{
    of_gap(apart, by, second, gradient, hessian);
}

void newton_of_gap(vec3 apart, const vec3 by[NEWTON_UNKNOWNS], const double second[2][2][2],
                   double gradient[NEWTON_UNKNOWNS],
                   double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS])
{
    if (imp_quad_is_wide())
        of_gap_wide(apart, by, second, gradient, hessian);
    else
        of_gap_narrow(apart, by, second, gradient, hessian);
}

/* Solves h x = -g by Cholesky; false: h is not positive definite. */
IMP_QUAD_INLINE bool solve(const double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], const double *g,
                           double *x)
{
    double l[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS];
    NEWTON_UNROLL
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        NEWTON_UNROLL
        for (int m = 0; m <= k; ++m) {
            double sum = h[k][m];
            NEWTON_UNROLL
            for (int i = 0; i < m; ++i) sum -= l[k][i] * l[m][i];
            if (k != m)
                l[k][m] = sum / l[m][m];
            else if (sum > 0)
                l[k][k] = sqrt(sum);
            else
                return false;
        }
    }
    NEWTON_UNROLL
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        double sum = -g[k];
        NEWTON_UNROLL
        for (int i = 0; i < k; ++i) sum -= l[k][i] * x[i];
        x[k] = sum / l[k][k];
    }
    NEWTON_UNROLL
    for (int k = NEWTON_UNKNOWNS - 1; k >= 0; --k) {
        NEWTON_UNROLL
        for (int i = k + 1; i < NEWTON_UNKNOWNS; ++i) x[k] -= l[i][k] * x[i];
        x[k] /= l[k][k];
    }
    return true;
}

/* Removes the unknowns of the mask from the system, so that their steps are 0. */
IMP_QUAD_INLINE void hold(imp_quad_mask which, double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS],
                          double *g)
{
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        if (which[k] == 0) continue;
        for (int m = 0; m < NEWTON_UNKNOWNS; ++m) h[k][m] = h[m][k] = k == m;
        g[k] = 0;
    }
}

/* Solves for the step with `damping` added to the diagonal. False: there is none, or it
 * overflows. */
IMP_QUAD_INLINE bool step(const newton_way *way, const double *from, double damping, double *next)
{
    const imp_quad none = imp_quad_all(0), y = imp_quad_load(from);
    const imp_quad lo = imp_quad_load(way->bounds->lo), hi = imp_quad_load(way->bounds->hi);
    const imp_quad_mask low = y <= lo, high = y >= hi;
    double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], g[NEWTON_UNKNOWNS], move[NEWTON_UNKNOWNS];
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        imp_quad_store(h[k], imp_quad_load(way->hessian[k]));
        h[k][k] += damping;
    }
    const imp_quad slope = imp_quad_load(way->gradient);
    imp_quad_store(g, slope);
    imp_quad_mask more = ~(lo < hi) | (low & (slope > none)) | (high & (slope < none)), held = more;
    for (int pass = 0; pass <= NEWTON_UNKNOWNS; ++pass) {
        if (imp_quad_any(more)) hold(more, h, g);
        if (!solve((const double(*)[NEWTON_UNKNOWNS])h, g, move)) return false;
        const imp_quad by = imp_quad_load(move);
        more = ~held & ((low & (by < none)) | (high & (by > none)));
        if (!imp_quad_any(more)) break;
        held |= more;
    }
    const imp_quad to = y + imp_quad_pick(held, none, imp_quad_load(move));
    if (imp_quad_any(~(to - to == none))) return false;
    imp_quad_store(next, imp_quad_pick(to < lo, lo, imp_quad_pick(to > hi, hi, to)));
    return true;
}

/* --- The descent ------------------------------------------------------------------------------ */

/* The first damping, and that at which the search gives up; then the factors of the damping after a
 * step that reduces the distance, and after one that does not. */
static const double DAMPING = 0x1p-20, DAMPING_MAX = 0x1p10, DAMPING_LESS = 0x1p-6,
                    DAMPING_MORE = 0x1p5;

newton_way newton_begin(const newton_bounds *bounds)
{
    return (newton_way){.bounds = bounds, .damping = DAMPING};
}

IMP_QUAD_INLINE bool try_step(newton_way *way, const double *y, double *next)
{
    double scale = 0;
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k)
        if (way->hessian[k][k] > scale) scale = way->hessian[k][k];
    while (scale > 0 && way->steps < TUNING_NEWTON_STEPS && way->damping < DAMPING_MAX) {
        way->steps += 1;
        if (step(way, y, way->damping * scale, next)) return true;
        way->damping *= DAMPING_MORE;
    }
    return false;
}

IMP_QUAD_NARROW static bool try_step_narrow(newton_way *way, const double *y, double *next)
{
    return try_step(way, y, next);
}

IMP_QUAD_WIDE static bool try_step_wide(newton_way *way, const double *y, double *next)
{
    return try_step(way, y, next);
}

bool newton_try(newton_way *way, const double *y, double *next)
{
    return imp_quad_is_wide() ? try_step_wide(way, y, next) : try_step_narrow(way, y, next);
}

double newton_promise(const newton_way *way, const double *y, const double *next)
{
    double less = 0;
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        double slope = way->gradient[k];
        for (int l = 0; l < NEWTON_UNKNOWNS; ++l)
            slope += 0.5 * way->hessian[k][l] * (next[l] - y[l]);
        less -= slope * (next[k] - y[k]);
    }
    return less;
}

void newton_judge(newton_way *way, bool is_better)
{
    way->damping *= is_better ? DAMPING_LESS : DAMPING_MORE;
}
