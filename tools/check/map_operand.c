/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/map_operand.h"

#include <math.h>
#include <stdbool.h>

/* The two parameters that coefficient q[k] multiplies. */
static const int first[6] = {0, 0, 0, 1, 1, 2}, second[6] = {0, 1, 2, 1, 2, 2};

long double under_quadratic(const imp_model *g, const long double s[3], long double *size)
{
    long double sum = g->a;
    *size = fabsl(sum);
    for (int j = 0; j < 3; ++j) {
        const long double term = g->b[j] * s[j];
        sum += term;
        *size += fabsl(term);
    }
    for (int k = 0; k < 6; ++k) {
        const long double term = g->q[k] * s[first[k]] * s[second[k]];
        sum += term;
        *size += fabsl(term);
    }
    return sum;
}

/* --- The region ------------------------------------------------------------------------------- */

/* Computes an interval of [lo, hi] with its middle a multiple of 2^-12 and its half-width a power
 * of two from 2^-12 on, or a single such value; a single value also if no interval fits. */
static void draw_short_interval(uint64_t *random, imp_region *r, int j, double lo, double hi)
{
    const double half = exp2(-(double)draw_index(random, 13));
    const double c = nearbyint(random_between(random, lo, hi) * 0x1p12) * 0x1p-12;
    const double d = draw_index(random, 8) > 0 && c - half >= lo && c + half <= hi ? half : 0;
    r->c[j] = c;
    r->d[j] = d;
    r->lo[j] = c - d;
    r->hi[j] = c + d;
}

/* --- The models ------------------------------------------------------------------------------- */

/* size in [-1, 1], times a multiple of 2^-12. */
static double draw_coefficient(uint64_t *random, double size)
{
    return size * nearbyint(random_between(random, -1, 1) * 0x1p12) * 0x1p-12;
}

static bool varies(const under *surface, int i, int j)
{
    return (surface->in[i].depends >> j & 1) != 0 && surface->region.d[j] > 0;
}

/* The polynomial's slope along j in s is at most its part of all terms; the remainder's is |rest|.
 * Sums of a few short numbers, exact; the quotient by a power of two is, too. */
static void bound(under *surface, int i)
{
    imp_model *g = &surface->in[i];
    double sum = fabs(surface->rest[i]);
    g->e = sum;
    for (int j = 0; j < 3; ++j) sum += fabs(g->b[j]);
    for (int k = 0; k < 6; ++k) sum += fabs(g->q[k]);
    g->lo = g->a - sum;
    g->hi = g->a + sum;
    for (int j = 0; j < 3; ++j) {
        double slope = fabs(g->b[j]) + g->e;
        for (int k = 0; k < 6; ++k) slope += ((first[k] == j) + (second[k] == j)) * fabs(g->q[k]);
        g->rate[j] = varies(surface, i, j) ? slope / surface->region.d[j] : 0;
    }
}

static void draw_model(uint64_t *random, under *surface, int i)
{
    static const uint32_t depends[] = {7, 7, 7, 3, 5, 4, 0};
    const double size = exp2(-(double)draw_index(random, 8)); /* 2^-7 ... 1 */
    imp_model *g = &surface->in[i];
    *g = (imp_model){.depends = depends[draw_index(random, 7)]};
    g->a = draw_coefficient(random, 2);
    for (int j = 0; j < 3; ++j)
        if (varies(surface, i, j)) g->b[j] = draw_coefficient(random, size);
    for (int k = 0; k < 6; ++k)
        if (varies(surface, i, first[k]) && varies(surface, i, second[k]))
            g->q[k] = draw_coefficient(random, size);
    const bool whole = varies(surface, i, 0) && varies(surface, i, 1) && varies(surface, i, 2);
    surface->rest[i] = whole ? nearbyint(random_between(random, -1, 1) * 0x1p10) * 0x1p-18 : 0;
    bound(surface, i);
}

under under_draw(uint64_t *random, double t_lo, double t_hi)
{
    under surface = {.rest = {0}};
    imp_region *r = &surface.region;
    for (int j = 0; j < 2; ++j) draw_short_interval(random, r, j, -2, 2);
    draw_short_interval(random, r, 2, t_lo, t_hi);
    if (r->lo[2] < t_lo || r->hi[2] > t_hi) r->lo[2] = r->hi[2] = r->c[2] = t_lo;
    for (int i = 0; i < 3; ++i) draw_model(random, &surface, i);
    surface.in[3] = (imp_model){.a = r->c[2], .b = {0, 0, r->d[2]}, .lo = r->lo[2], .hi = r->hi[2]};
    surface.in[3].rate[2] = r->d[2] > 0;
    surface.in[3].depends = r->d[2] > 0 ? 4 : 0;
    return surface;
}

void under_value(const under *surface, const double s[3], double x[4])
{
    const long double exact[3] = {s[0], s[1], s[2]};
    long double size;
    for (int i = 0; i < 3; ++i) {
        const double rest = surface->rest[i] * s[0] * s[1] * s[2];
        x[i] = (double)(under_quadratic(&surface->in[i], exact, &size) + rest);
    }
    x[3] = surface->region.c[2] + surface->region.d[2] * s[2];
}
