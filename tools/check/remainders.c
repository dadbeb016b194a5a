/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/remainders.h"

#include <impinge/formula.h>
#include <math.h>
#include <string.h>

#include "tools/check/moving_point.h"
#include "tools/check/nearest.h"

/* Points of a grid of 4 along each parameter, and the terms of a quadratic in three. */
enum { GRID = 4, POINTS = GRID * GRID * GRID, TERMS = 10 };

static void terms_at(const double s[3], double term[TERMS])
{
    int k = 0;
    term[k++] = 1;
    for (int j = 0; j < 3; ++j) term[k++] = s[j];
    for (int j = 0; j < 3; ++j)
        for (int l = j; l < 3; ++l) term[k++] = s[j] * s[l];
}

/* Gauss-Jordan elimination of the normal equations; a parameter without width makes pivots of 0,
 * whose terms are left out. */
static void solve(double matrix[TERMS][TERMS + 1], double x[TERMS])
{
    bool used[TERMS] = {false};
    for (int k = 0; k < TERMS; ++k) {
        if (!(fabs(matrix[k][k]) > 1e-9)) continue;
        used[k] = true;
        for (int i = 0; i < TERMS; ++i) {
            const double factor = i == k ? 0 : matrix[i][k] / matrix[k][k];
            for (int j = k; factor != 0 && j <= TERMS; ++j) matrix[i][j] -= factor * matrix[k][j];
        }
    }
    for (int k = 0; k < TERMS; ++k) x[k] = used[k] ? matrix[k][TERMS] / matrix[k][k] : 0;
}

/* Returns what the values are off their best quadratic at most. */
static double residual(const double term[POINTS][TERMS], const double x[3 * POINTS], int i)
{
    double matrix[TERMS][TERMS + 1] = {{0}}, fit[TERMS], most = 0;
    for (int p = 0; p < POINTS; ++p)
        for (int a = 0; a < TERMS; ++a) {
            for (int b = 0; b < TERMS; ++b) matrix[a][b] += term[p][a] * term[p][b];
            matrix[a][TERMS] += term[p][a] * (x[3 * p + i] - x[i]);
        }
    solve(matrix, fit);
    for (int p = 0; p < POINTS; ++p) {
        double value = 0;
        for (int a = 0; a < TERMS; ++a) value += fit[a] * term[p][a];
        most = fmax(most, fabs(x[3 * p + i] - x[i] - value));
    }
    return most;
}

/* The remainders that include claims, or that the host makes of rates where there is no include. */
static bool claimed_over(const subject *s, const box *where, double claimed[3])
{
    const imp_region region = imp_region_between(where->lo, where->hi);
    imp_model model[3];
    double rate[3][BOX_DIMS];
    if (s->instance->surface->include != NULL) {
        if (subject_include(s, &region, model) != IMP_STATUS_OK) return false;
        for (int i = 0; i < 3; ++i) claimed[i] = model[i].e;
        return true;
    }
    if (subject_rate(s, where, rate) != IMP_STATUS_OK) return false;
    for (int i = 0; i < 3; ++i) {
        claimed[i] = 0;
        for (int j = 0; j < 3; ++j) claimed[i] += rate[i][j] * region.d[j];
    }
    return true;
}

bool remainder_measure(const subject *s, const box *where, double claimed[3], double needed[3])
{
    double p[3 * POINTS], x[3 * POINTS], error[3 * POINTS], term[POINTS][TERMS];
    for (int k = 0; k < POINTS; ++k) {
        const int at[3] = {k % GRID, k / GRID % GRID, k / GRID / GRID};
        double place[3];
        for (int j = 0; j < 3; ++j) {
            place[j] = where->lo[j] < where->hi[j] ? -1 + 2.0 * at[j] / (GRID - 1) : 0;
            p[3 * k + j] = at[j] == GRID - 1 ? where->hi[j]
                                             : where->lo[j] + (where->hi[j] - where->lo[j]) *
                                                                  (0.5 + 0.5 * place[j]);
        }
        terms_at(place, term[k]);
    }
    if (subject_eval(s, POINTS, p, x, error) != IMP_STATUS_OK || !claimed_over(s, where, claimed))
        return false;
    for (int i = 0; i < 3; ++i) {
        double rounding = 0;
        for (int k = 0; k < POINTS; ++k) rounding = fmax(rounding, error[3 * k + i]);
        needed[i] = residual(term, x, i) + rounding;
    }
    return true;
}

bool distance_measure(const subject *s, uint64_t *random, const box *where, double *ratio)
{
    spot on, found;
    double middle[3], radius, n[3], x[3], square = 0;
    imp_model point[4], g;
    draw_point(random, where, 3, on.p);
    if (!spot_evaluate(s, &on) || !spot_extent(s, on.p[2], middle, &radius)) return false;
    for (int i = 0; i < 3; ++i) {
        n[i] = random_between(random, -1, 1);
        square += n[i] * n[i];
    }
    for (int i = 0; i < 3; ++i) {
        x[i] = on.x[i] + 0.1 * radius * n[i] / sqrt(square);
        point[i] = imp_num(x[i]);
    }
    point[3] = imp_num(on.p[2]);
    if (subject_distance(s, point, &g) != IMP_STATUS_OK || !spot_nearest(s, x, on.p[2], &found))
        return false;
    const double claimed = (double)distance_claimed(&g, (double[3]){0, 0, 0});
    *ratio = (double)spot_apart_upper(&found, x) / claimed;
    return claimed > 0;
}
