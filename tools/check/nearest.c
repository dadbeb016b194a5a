/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/nearest.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { SIDE = 8, GRID = SIDE * SIDE };

/* Least step, as a part of the domain's widths: its square is lost in a distance's 12th digit. */
#define STEP_LEAST 0x1p-20

static bool take(spot *at, const double p[3], const double x[3], const double error[3])
{
    memcpy(at->p, p, sizeof at->p);
    memcpy(at->x, x, sizeof at->x);
    at->error = error[0] + error[1] + error[2];
    return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]) && at->error >= 0 &&
           at->error < INFINITY;
}

bool spot_evaluate(const subject *s, spot *at)
{
    double p[3], x[3], error[3];
    memcpy(p, at->p, sizeof p);
    return subject_eval(s, 1, p, x, error) == IMP_STATUS_OK && take(at, p, x, error);
}

/* Rounded 9 times, by at most LDBL_EPSILON / 2 of the value each time. */
long double spot_apart_upper(const spot *at, const double x[3])
{
    long double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const long double d = (long double)x[i] - at->x[i];
        sum += d * d;
    }
    return sqrtl(sum) * (1 + 16 * LDBL_EPSILON) + at->error;
}

/* Keeps in *best the point nearest to x, of `count` points and what *best was before. */
static void keep_nearest(const subject *s, const double x[3], size_t count, const double *p,
                         spot *best, long double *apart)
{
    double y[3 * GRID], error[3 * GRID];
    if (subject_eval(s, count, p, y, error) != IMP_STATUS_OK) return;
    for (size_t k = 0; k < 3 * count; k += 3) {
        spot at;
        if (!take(&at, p + k, y + k, error + k)) continue;
        const long double here = spot_apart_upper(&at, x);
        if (!(here < *apart)) continue;
        *apart = here;
        *best = at;
    }
}

static void grid_at(const subject *s, double t, double p[3 * GRID])
{
    for (int k = 0; k < GRID; ++k, p += 3) {
        const int step[2] = {k / SIDE, k % SIDE};
        for (int j = 0; j < 2; ++j)
            p[j] = step[j] == SIDE - 1 ? s->domain.hi[j]
                                       : s->domain.lo[j] + (s->domain.hi[j] - s->domain.lo[j]) *
                                                               step[j] / (SIDE - 1);
        p[2] = t;
    }
}

/* Four steps around the best, half as wide when none is nearer. */
static void search(const subject *s, const double x[3], spot *best, long double *apart)
{
    for (double step = 0.5 / SIDE; step >= STEP_LEAST;) {
        const long double before = *apart;
        double p[12];
        for (int k = 0; k < 4; ++k) {
            const int j = k / 2;
            const double width = s->domain.hi[j] - s->domain.lo[j];
            memcpy(p + 3 * k, best->p, sizeof best->p);
            p[3 * k + j] += (k % 2 ? -step : step) * width;
            p[3 * k + j] = fmin(fmax(p[3 * k + j], s->domain.lo[j]), s->domain.hi[j]);
        }
        keep_nearest(s, x, 4, p, best, apart);
        if (!(*apart < before)) step *= 0.5;
    }
}

void spot_search(const subject *s, const double x[3], spot *at)
{
    long double apart = spot_apart_upper(at, x);
    search(s, x, at, &apart);
}

bool spot_nearest(const subject *s, const double x[3], double t, spot *at)
{
    double p[3 * GRID];
    long double apart = (long double)INFINITY;
    grid_at(s, t, p);
    keep_nearest(s, x, GRID, p, at, &apart);
    if (!(apart < (long double)INFINITY)) return false;
    search(s, x, at, &apart);
    return true;
}

bool spot_extent(const subject *s, double t, double middle[3], double *radius)
{
    double p[3 * GRID], y[3 * GRID], error[3 * GRID];
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    grid_at(s, t, p);
    if (subject_eval(s, GRID, p, y, error) != IMP_STATUS_OK) return false;
    for (int k = 0; k < 3 * GRID; ++k) {
        lo[k % 3] = fmin(lo[k % 3], y[k]);
        hi[k % 3] = fmax(hi[k % 3], y[k]);
    }
    for (int i = 0; i < 3; ++i) middle[i] = 0.5 * lo[i] + 0.5 * hi[i];
    *radius = 0.5 * sqrt((hi[0] - lo[0]) * (hi[0] - lo[0]) + (hi[1] - lo[1]) * (hi[1] - lo[1]) +
                         (hi[2] - lo[2]) * (hi[2] - lo[2]));
    return *radius < INFINITY;
}
