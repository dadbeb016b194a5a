/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/sampling.h"

#include "tests/support/suite.h"

static int one_of(uint64_t *random, int kinds)
{
    return (int)(random_bits(random) % (uint64_t)kinds);
}

static double clamp(double x, double lo, double hi) { return x < lo ? lo : x > hi ? hi : x; }

/* --- Regions ---------------------------------------------------------------------------------- */

static void draw_interval(uint64_t *random, double lo, double hi, double *from, double *to)
{
    double at = random_between(random, lo, hi), width = hi - lo;
    *from = lo, *to = hi;
    switch (one_of(random, 8)) {
    case 0:
        return;
    case 1:
        *to = at;
        break;
    case 2:
        *from = at;
        break;
    case 3:
        *from = *to = at;
        break;
    case 4:
        *from = at, *to = at + 1e-9 * width;
        break;
    case 5:
        *to = lo + width * random_power(random, -40, -1);
        break;
    case 6:
        *from = hi - width * random_power(random, -40, -1);
        break;
    default:
        *from = at, *to = at + width * random_power(random, -14, 0);
        break;
    }
    *to = clamp(*to, lo, hi);
    *from = clamp(*from, lo, *to);
}

static void draw_times(uint64_t *random, double lo, double hi, double *from, double *to)
{
    static const double starts[] = {0, 0, -1, 0.25, 1e6, -1e6};
    double start = starts[one_of(random, 6)];
    if (hi - lo < INFINITY) {
        draw_interval(random, lo, hi, from, to);
        return;
    }
    draw_interval(random, start, start + (one_of(random, 4) ? 1 : 10), from, to);
    *from = clamp(*from, lo, hi);
    *to = clamp(*to, *from, hi);
}

imp_region sample_region(uint64_t *random, const double lo[3], const double hi[3])
{
    double from[3], to[3];
    for (int j = 0; j < 2; ++j) draw_interval(random, lo[j], hi[j], &from[j], &to[j]);
    draw_times(random, lo[2], hi[2], &from[2], &to[2]);
    return region_make(from, to);
}

imp_box4 sample_box(uint64_t *random, double t_lo, double t_hi)
{
    imp_box4 box;
    double size = one_of(random, 3) ? 1 : random_power(random, -30, 20);
    for (int j = 0; j < 3; ++j) {
        double from = random_between(random, -2, 2) * (one_of(random, 6) ? 1 : 1e6);
        draw_interval(random, from, from + size, &box.lo[j], &box.hi[j]);
    }
    draw_times(random, t_lo, t_hi, &box.lo[3], &box.hi[3]);
    return box;
}

/* --- Points ----------------------------------------------------------------------------------- */

/* Remainders of quadratics are greatest near these. */
static double draw_extreme(uint64_t *random)
{
    static const double extremes[] = {-1,  -0.8660254037844386, -0.7071067811865476, -0.5, 0,
                                      0.5, 0.7071067811865476,  0.8660254037844386,  1};
    return extremes[one_of(random, 9)];
}

void sample_point(uint64_t *random, int n, const double *lo, const double *hi, double *p)
{
    bool anywhere = one_of(random, 3) == 0;
    for (int j = 0; j < n; ++j) {
        double s = anywhere ? random_between(random, -1, 1) : draw_extreme(random);
        double x = lo[j] + (hi[j] - lo[j]) * (0.5 + 0.5 * s);
        p[j] = s == 1 ? hi[j] : clamp(x, lo[j], hi[j]);
    }
}

void sample_partner(uint64_t *random, int n, const double *lo, const double *hi, const double *p,
                    double *partner)
{
    int only = one_of(random, n + 2); /* which number changes; beyond: all */
    double scale = one_of(random, 3) ? random_power(random, -36, 0) : 1;
    double other[4];
    sample_point(random, n, lo, hi, other);
    for (int j = 0; j < n; ++j) {
        double x = p[j] + scale * (other[j] - p[j]);
        partner[j] = only < n && only != j ? p[j] : clamp(x, lo[j], hi[j]);
    }
}

void sample_normalized(const imp_region *region, const double p[3], number s[3])
{
    for (int j = 0; j < 3; ++j) {
        number off = num_sub(num(p[j]), num(region->c[j]));
        s[j] = region->d[j] > 0 ? num_div(off, num(region->d[j])) : num(0);
    }
}

/* --- Arguments of maps ------------------------------------------------------------------------ */

/* The two parameters that coefficient q[k] multiplies. */
static const int first[6] = {0, 0, 0, 1, 1, 2}, second[6] = {0, 1, 2, 1, 2, 2};

static bool varies(const sample_models *models, int i, int j)
{
    return models->in[i].depends >> j & 1 && models->region.d[j] > 0;
}

/* Multiples of 2^-30, so that few sums are rounded at all. */
static double draw_coefficient(uint64_t *random, double size)
{
    return size * floor(random_between(random, -1, 1) * 0x1p30) * 0x1p-30;
}

static void draw_model(uint64_t *random, sample_models *models, int i)
{
    imp_model *g = &models->in[i];
    const imp_region *region = &models->region;
    double size = one_of(random, 4) ? 1 : random_power(random, -30, 4), sum;
    *g = (imp_model){.depends = (uint32_t)one_of(random, 8)};
    if (one_of(random, 2)) g->depends = 7;
    g->a = draw_coefficient(random, 2);
    for (int j = 0; j < 3; ++j)
        if (varies(models, i, j)) g->b[j] = draw_coefficient(random, size);
    for (int k = 0; k < 6; ++k)
        if (varies(models, i, first[k]) && varies(models, i, second[k]))
            g->q[k] = draw_coefficient(random, size * size);
    bool moves = varies(models, i, 0) || varies(models, i, 1) || varies(models, i, 2);
    models->rest[i] = moves ? draw_coefficient(random, size * size * size) : 0;
    g->e = sum = fabs(models->rest[i]);
    for (int j = 0; j < 3; ++j) sum += fabs(g->b[j]);
    for (int k = 0; k < 6; ++k) sum += fabs(g->q[k]);
    g->lo = g->a - sum * (1 + 1e-12) - 1e-15 * fabs(g->a);
    g->hi = g->a + sum * (1 + 1e-12) + 1e-15 * fabs(g->a);
    for (int j = 0; j < 3; ++j) {
        double slope = fabs(g->b[j]) + g->e;
        for (int k = 0; k < 6; ++k) slope += ((first[k] == j) + (second[k] == j)) * fabs(g->q[k]);
        g->rate[j] = varies(models, i, j) ? slope / region->d[j] * (1 + 1e-12) : 0;
    }
}

sample_models sample_map_arguments(uint64_t *random, double t_lo, double t_hi)
{
    const double lo[3] = {0, -2, t_lo}, hi[3] = {1, 2, t_hi};
    sample_models models = {.region = sample_region(random, lo, hi)};
    const imp_region *region = &models.region;
    for (int i = 0; i < 3; ++i) draw_model(random, &models, i);
    models.in[3] = (imp_model){.a = region->c[2],
                               .b = {0, 0, region->d[2]},
                               .lo = region->lo[2],
                               .hi = region->hi[2],
                               .rate = {0, 0, 1},
                               .depends = 4};
    return models;
}

void sample_value(const sample_models *models, const double p[3], number x[4])
{
    number s[3];
    sample_normalized(&models->region, p, s);
    for (int i = 0; i < 3; ++i) {
        const imp_model *g = &models->in[i];
        number rest = num(models->rest[i]);
        x[i] = num(g->a);
        for (int j = 0; j < 3; ++j) {
            x[i] = num_add(x[i], num_mul(num(g->b[j]), s[j]));
            if (varies(models, i, j)) rest = num_mul(rest, s[j]);
        }
        for (int k = 0; k < 6; ++k)
            x[i] = num_add(x[i], num_mul(num(g->q[k]), num_mul(s[first[k]], s[second[k]])));
        x[i] = num_add(x[i], rest);
    }
    x[3] = num(p[2]);
}
