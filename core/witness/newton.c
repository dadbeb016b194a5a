/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/newton.h"

#include <math.h>
#include <string.h>

#include "core/bounds/tuning.h"

#define NEWTON_UNROLL _Pragma("GCC unroll 4")

void newton_of_gap(vec3 apart, const vec3 by[NEWTON_UNKNOWNS], const double second[2][2][2],
                   double gradient[NEWTON_UNKNOWNS],
                   double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS])
{
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        gradient[k] = vec3_dot(by[k], apart);
        for (int l = 0; l <= k; ++l) {
            double sum = vec3_dot(by[k], by[l]);
            if (k / 2 == l / 2)
                sum += k / 2 == 0 ? -second[0][k % 2][l % 2] : second[1][k % 2][l % 2];
            hessian[k][l] = hessian[l][k] = sum;
        }
    }
}

/* Solves h x = -g by Cholesky; false: h is not positive definite. */
static bool solve(const double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], const double *g, double *x)
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

/* Removes unknown k from the system, so that its step is 0. */
static void hold(double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], double *g, int k)
{
    for (int m = 0; m < NEWTON_UNKNOWNS; ++m) h[k][m] = h[m][k] = k == m;
    g[k] = 0;
}

/* Solves for the step with `damping` added to the diagonal. False: there is none, or it
 * overflows. */
static bool step(const newton_way *way, const double *y, double damping, double *next)
{
    const newton_bounds *b = way->bounds;
    double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], g[NEWTON_UNKNOWNS], move[NEWTON_UNKNOWNS];
    bool held[NEWTON_UNKNOWNS];
    memcpy(h, way->hessian, sizeof h);
    memcpy(g, way->gradient, sizeof g);
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        h[k][k] += damping;
        held[k] = !(b->lo[k] < b->hi[k]) || (y[k] <= b->lo[k] && g[k] > 0) ||
                  (y[k] >= b->hi[k] && g[k] < 0);
        if (held[k]) hold(h, g, k);
    }
    for (int pass = 0; pass <= NEWTON_UNKNOWNS; ++pass) {
        if (!solve((const double(*)[NEWTON_UNKNOWNS])h, g, move)) return false;
        bool more = false;
        for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
            if (held[k] ||
                !((y[k] <= b->lo[k] && move[k] < 0) || (y[k] >= b->hi[k] && move[k] > 0)))
                continue;
            held[k] = more = true;
            hold(h, g, k);
        }
        if (!more) break;
    }
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        const double to = y[k] + (held[k] ? 0 : move[k]);
        if (!(to - to == 0)) return false;
        next[k] = to < b->lo[k] ? b->lo[k] : to > b->hi[k] ? b->hi[k] : to;
    }
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

bool newton_try(newton_way *way, const double *y, double *next)
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
