/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/sampling.h"

#include <math.h>
#include <string.h>

/* FNV-1a over the names, mixed by the first draw. */
static uint64_t hash(uint64_t state, const char *name)
{
    for (; *name != '\0'; ++name) state = (state ^ (unsigned char)*name) * 0x100000001b3u;
    return (state ^ 0xffu) * 0x100000001b3u;
}

uint64_t draw_stream(uint64_t seed, const char *name, const char *other_name)
{
    uint64_t state = 0xcbf29ce484222325u ^ random_bits(&seed);
    return hash(hash(state, name), other_name);
}

size_t draw_index(uint64_t *random, size_t count) { return (size_t)(random_bits(random) % count); }

/* The additive recurrence with the powers of 1/g, where g^(n+1) = g + 1 (M. Roberts, 2018): the
 * golden ratio's way of filling an interval, in n dimensions. With n = 3 the first two powers leave
 * gaps in their plane (12000 points miss every fourth square of 0.04 %), the first and the third
 * none: these are for u and v, where errors occur at all times. */
void draw_spread(const double shift[BOX_DIMS], uint64_t k, int n, double at[BOX_DIMS])
{
    static const int three[BOX_DIMS] = {1, 3, 2, 0}, four[BOX_DIMS] = {1, 2, 3, 4};
    const double g = n == 3 ? 1.2207440846057596 : 1.1673039782614187;
    for (int j = 0; j < BOX_DIMS; ++j) {
        const double x = shift[j] + (double)k * pow(g, -(n == 3 ? three : four)[j]);
        at[j] = j < n ? x - floor(x) : 0;
    }
}

static double clamp(double x, double lo, double hi) { return x < lo ? lo : x > hi ? hi : x; }

box draw_around(const box *all, int n, const double at[BOX_DIMS], double fraction)
{
    box b = {.lo = {0}};
    for (int j = 0; j < n; ++j) {
        const double width = all->hi[j] - all->lo[j], c = all->lo[j] + at[j] * width;
        b.lo[j] = clamp(c - 0.5 * fraction * width, all->lo[j], all->hi[j]);
        b.hi[j] = clamp(c + 0.5 * fraction * width, b.lo[j], all->hi[j]);
    }
    return b;
}

static void draw_interval(uint64_t *random, double lo, double hi, double *from, double *to)
{
    const double at = random_between(random, lo, hi), width = hi - lo;
    *from = lo, *to = hi;
    switch (draw_index(random, 8)) {
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
        *to = lo + width * random_power(random, -40, -1);
        break;
    case 5:
        *from = hi - width * random_power(random, -40, -1);
        break;
    default:
        *from = at, *to = at + width * random_power(random, -14, 0);
        break;
    }
    *to = clamp(*to, lo, hi);
    *from = clamp(*from, lo, *to);
}

box draw_box(uint64_t *random, const box *all, int n)
{
    box b = {.lo = {0}};
    for (int j = 0; j < n; ++j) draw_interval(random, all->lo[j], all->hi[j], &b.lo[j], &b.hi[j]);
    return b;
}

/* Ends and middle; +-sqrt(1/2) and +-sqrt(3)/2, where remainders peak. */
static double draw_extreme(uint64_t *random)
{
    static const double extremes[] = {-1,  -0.8660254037844386, -0.7071067811865476, -0.5, 0,
                                      0.5, 0.7071067811865476,  0.8660254037844386,  1};
    return extremes[draw_index(random, 9)];
}

void draw_point(uint64_t *random, const box *from, int n, double *p)
{
    const size_t anywhere = draw_index(random, 3);
    for (int j = 0; j < n; ++j) {
        const double s = anywhere == 0 ? random_between(random, -1, 1) : draw_extreme(random);
        const double x = from->lo[j] + (from->hi[j] - from->lo[j]) * (0.5 + 0.5 * s);
        p[j] = s == 1 ? from->hi[j] : clamp(x, from->lo[j], from->hi[j]);
    }
}

void draw_partner(uint64_t *random, const box *from, int n, const double *p, double *partner)
{
    const int only = (int)draw_index(random, (size_t)n + 2); /* beyond n: all change */
    const double scale = draw_index(random, 3) > 0 ? random_power(random, -36, 0) : 1;
    double other[BOX_DIMS];
    draw_point(random, from, n, other);
    for (int j = 0; j < n; ++j) {
        const double x = p[j] + scale * (other[j] - p[j]);
        partner[j] = only < n && only != j ? p[j] : clamp(x, from->lo[j], from->hi[j]);
    }
}

double draw_normalized(uint64_t *random)
{
    const double s =
        draw_index(random, 2) > 0 ? draw_extreme(random) : random_between(random, -1, 1);
    return nearbyint(s * 0x1p10) * 0x1p-10;
}

static int add_multiples(double step, int per, double lo, double hi, double *value, int count)
{
    const double first = ceil(lo * per / step), last = floor(hi * per / step);
    if (!(last - first < 80)) return count;
    for (double k = first; k <= last && count < SPECIAL_MAX; ++k) {
        const double x = k * step / per;
        if (x >= lo && x <= hi) value[count++] = x;
    }
    return count;
}

int special_values(double lo, double hi, double value[SPECIAL_MAX])
{
    int count = 0;
    for (int k = 0; k <= 12; ++k) {
        const double x = lo + (hi - lo) * k / 12;
        if (x >= lo && x <= hi) value[count++] = x;
    }
    count = add_multiples(1, 10, lo, hi, value, count);
    count = add_multiples(1, 8, lo, hi, value, count);
    return add_multiples(3.141592653589793, 12, lo, hi, value, count);
}
