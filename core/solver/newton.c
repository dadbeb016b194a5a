/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/newton.h"

#include <math.h>
#include <string.h>

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

/* Solves h x = -g by Cholesky, where `held` unknowns stay put; false: h is not positive definite. */
static bool solve(double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], const double *g, const bool *held,
                  double *x)
{
    double l[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS] = {{0}};
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k)
        for (int m = 0; m <= k; ++m) {
            double sum = held[k] || held[m] ? (k == m) : h[k][m];
            for (int i = 0; i < m; ++i) sum -= l[k][i] * l[m][i];
            if (k != m)
                l[k][m] = sum / l[m][m];
            else if (sum > 0)
                l[k][k] = sqrt(sum);
            else
                return false;
        }
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        double sum = held[k] ? 0 : -g[k];
        for (int i = 0; i < k; ++i) sum -= l[k][i] * x[i];
        x[k] = sum / l[k][k];
    }
    for (int k = NEWTON_UNKNOWNS - 1; k >= 0; --k) {
        for (int i = k + 1; i < NEWTON_UNKNOWNS; ++i) x[k] -= l[i][k] * x[i];
        x[k] /= l[k][k];
    }
    return true;
}

bool newton_step(const newton_bounds *g, const double *y, const double *gradient,
                 double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], double damping, double *next)
{
    bool held[NEWTON_UNKNOWNS];
    double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], move[NEWTON_UNKNOWNS];
    memcpy(h, hessian, sizeof h);
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        h[k][k] += damping;
        held[k] = !(g->lo[k] < g->hi[k]);
    }
    for (int pass = 0; pass <= NEWTON_UNKNOWNS; ++pass) {
        if (!solve(h, gradient, held, move)) return false;
        bool more = false;
        for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
            const bool out = (y[k] <= g->lo[k] && move[k] < 0) || (y[k] >= g->hi[k] && move[k] > 0);
            if (out && !held[k]) held[k] = more = true;
        }
        if (!more) break;
    }
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        const double to = y[k] + (held[k] ? 0 : move[k]);
        if (!(to - to == 0)) return false;
        next[k] = to < g->lo[k] ? g->lo[k] : to > g->hi[k] ? g->hi[k] : to;
    }
    return true;
}

double newton_scale(double h[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS])
{
    double top = 0;
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) top = h[k][k] > top ? h[k][k] : top;
    return top;
}
