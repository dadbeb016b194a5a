/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/chart.h"

#include <string.h>

/* --- The domain ------------------------------------------------------------------------------- */

enum { SAMPLES = 5 };
#define SAME 1e-9 /* part of the patch's size within which points are the same */

/* Computes the points of one end of a parameter, along the other. */
static imp_code read_end(const chart *c, int k, int end, vec x[SAMPLES], imp_error *why)
{
    double p[SAMPLES][2];
    for (int i = 0; i < SAMPLES; ++i) {
        p[i][k] = end == 0 ? c->lo[k] : c->hi[k];
        p[i][1 - k] = i == SAMPLES - 1
                          ? c->hi[1 - k]
                          : c->lo[1 - k] + (c->hi[1 - k] - c->lo[1 - k]) * i / (SAMPLES - 1);
    }
    return placed_eval(c->at, c->place, SAMPLES, p, x, why);
}

static double distance(vec a, vec b) { return vec_length(vec_sub(a, b)); }

static bool is_single(const vec x[SAMPLES], double slack)
{
    for (int i = 1; i < SAMPLES; ++i)
        if (!(distance(x[i], x[0]) <= slack)) return false;
    return true;
}

imp_code chart_make(chart *c, const placed *at, imp_place place, imp_error *why)
{
    double lo[3], hi[3], size = 0;
    vec x[2][2][SAMPLES];
    *c = (chart){.at = at, .place = place};
    imp_piece_domain(at->still, place, lo, hi);
    memcpy(c->lo, lo, sizeof c->lo);
    memcpy(c->hi, hi, sizeof c->hi);
    for (int k = 0; k < 2; ++k)
        for (int end = 0; end < 2; ++end) {
            const imp_code code = read_end(c, k, end, x[k][end], why);
            if (code != IMP_SUCCESS) return code;
            for (int i = 0; i < SAMPLES; ++i) size = fmax(size, distance(x[k][end][i], x[0][0][0]));
        }
    for (int k = 0; k < 2; ++k) {
        c->closed[k] = size > 0 && c->hi[k] > c->lo[k];
        for (int i = 0; i < SAMPLES; ++i)
            c->closed[k] &= distance(x[k][0][i], x[k][1][i]) <= SAME * size;
    }
    for (int k = 0; k < 2; ++k)
        for (int end = 0; end < 2; ++end)
            c->pole[k][end] = c->closed[1 - k] && is_single(x[k][end], SAME * size);
    return IMP_SUCCESS;
}

/* --- Coordinates ------------------------------------------------------------------------------ */

#define TURN (2 * 3.141592653589793)
#define POLAR_PART 0.25 /* of a parameter's width, from the pole on */

static double width_of(const chart *c, int k) { return c->hi[k] - c->lo[k]; }

spot chart_spot(const chart *c, const double p[2])
{
    spot s = {.p = {p[0], p[1]}, .q = {p[0], p[1]}, .polar = -1};
    for (int k = 0; k < 2; ++k)
        for (int end = 0; end < 2; ++end) {
            const double away = end == 0 ? p[k] - c->lo[k] : c->hi[k] - p[k];
            if (!c->pole[k][end] || away > POLAR_PART * width_of(c, k)) continue;
            const double angle = TURN * (p[1 - k] - c->lo[1 - k]) / width_of(c, 1 - k);
            s.polar = k, s.end = end;
            s.q[0] = away * cos(angle);
            s.q[1] = away * sin(angle);
        }
    return s;
}

/* Within the ends; round and round if it is closed. */
static double limited(const chart *c, int k, double x)
{
    if (c->closed[k]) {
        x = c->lo[k] + fmod(x - c->lo[k], width_of(c, k));
        if (x < c->lo[k]) x += width_of(c, k);
    }
    return fmin(fmax(x, c->lo[k]), c->hi[k]);
}

void chart_parameters(const chart *c, const spot *s, const double q[2], double p[2])
{
    if (s->polar < 0) {
        for (int k = 0; k < 2; ++k) p[k] = limited(c, k, q[k]);
        return;
    }
    const int k = s->polar;
    const double away = fmin(hypot(q[0], q[1]), width_of(c, k)), angle = atan2(q[1], q[0]) / TURN;
    p[k] = s->end == 0 ? c->lo[k] + away : c->hi[k] - away;
    p[1 - k] =
        limited(c, 1 - k, c->lo[1 - k] + (angle < 0 ? 1 + angle : angle) * width_of(c, 1 - k));
}

void chart_range(const chart *c, const spot *s, int k, double *lo, double *hi)
{
    const bool open = s->polar >= 0 || c->closed[k];
    *lo = open ? -INFINITY : c->lo[k];
    *hi = open ? INFINITY : c->hi[k];
}

double chart_width(const chart *c, const spot *s, int k)
{
    return width_of(c, s->polar >= 0 ? s->polar : k);
}

/* --- Derivatives ------------------------------------------------------------------------------ */

/* Steps of differences, in parts of the width: second derivatives lose 2^-52 / STEP^2 of the size.
 * Near an end they are half the way to it; at it, whole again. */
#define STEP 1e-4
#define AT_END 1e-7

static double difference(const chart *c, const spot *s, int k)
{
    double lo, hi;
    chart_range(c, s, k, &lo, &hi);
    const double width = chart_width(c, s, k), way = fmin(s->q[k] - lo, hi - s->q[k]);
    return way > AT_END * width ? fmin(STEP * width, way / 2) : STEP * width;
}

/* Computes derivatives at the middle of nine points, then those at `d` from it of the quadratic
 * through them. */
static void differentiate(const vec grid[9], const double h[2], const double d[2], jet *j)
{
    const double a = h[0] > 0 ? 1 / h[0] : 0, b = h[1] > 0 ? 1 / h[1] : 0;
    for (int i = 0; i < 3; ++i) {
        const double mid = grid[4].x[i];
        const double aa = ((grid[7].x[i] - mid) - (mid - grid[1].x[i])) * a * a;
        const double bb = ((grid[5].x[i] - mid) - (mid - grid[3].x[i])) * b * b;
        const double ab =
            ((grid[8].x[i] - grid[6].x[i]) - (grid[2].x[i] - grid[0].x[i])) * a * b / 4;
        j->by[0].x[i] = (grid[7].x[i] - grid[1].x[i]) * a / 2 + aa * d[0] + ab * d[1];
        j->by[1].x[i] = (grid[5].x[i] - grid[3].x[i]) * b / 2 + bb * d[1] + ab * d[0];
        j->second[0].x[i] = aa, j->second[1].x[i] = ab, j->second[2].x[i] = bb;
    }
}

/* Nine points around one that keeps away from the ends. */
imp_code chart_jet(const chart *c, const spot *s, jet *j, imp_error *why)
{
    double h[2], middle[2], p[9][2], d[2];
    vec grid[9];
    for (int k = 0; k < 2; ++k) {
        double lo, hi;
        chart_range(c, s, k, &lo, &hi);
        h[k] = difference(c, s, k);
        middle[k] = fmin(fmax(s->q[k], lo + h[k]), hi - h[k]);
        d[k] = s->q[k] - middle[k];
    }
    for (int i = 0; i < 9; ++i) {
        const double q[2] = {middle[0] + (i / 3 - 1) * h[0], middle[1] + (i % 3 - 1) * h[1]};
        chart_parameters(c, s, q, p[i]);
    }
    const double(*points)[2] = (const double(*)[2])p, (*own)[2] = (const double(*)[2]) & s->p;
    imp_code code = placed_eval(c->at, c->place, 9, points, grid, why);
    if (code != IMP_SUCCESS) return code;
    differentiate(grid, h, d, j);
    return placed_eval(c->at, c->place, 1, own, &j->x, why);
}
