/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "core/bounds/convex_line.h"
#include "core/bounds/quadratic.h"
#include "core/common/random.h"
#include "tests/support/suite.h"

typedef struct quadratic {
    double bs, br, qss, qsr, qrr;
} quadratic;

/* The judge computes in long double (64 bits of mantissa) at a grid, along the edges' vertices and
 * at the stationary point. */

static long double value(const quadratic *p, long double s, long double r)
{
    return p->bs * s + p->br * r + p->qss * s * s + p->qsr * s * r + p->qrr * r * r;
}

static long double size_of(const quadratic *p)
{
    return fabsl(p->bs) + fabsl(p->br) + fabsl(p->qss) + fabsl(p->qsr) + fabsl(p->qrr);
}

typedef struct judged {
    long double lo, hi;
} judged;

static void judge_point(const quadratic *p, long double s, long double r, judged *seen)
{
    if (!(s >= -1 && s <= 1 && r >= -1 && r <= 1)) return;
    const long double x = value(p, s, r);
    if (x < seen->lo) seen->lo = x;
    if (x > seen->hi) seen->hi = x;
}

static judged judge(const quadratic *p)
{
    judged seen = {INFINITY, -INFINITY};
    for (int i = -8; i <= 8; ++i)
        for (int j = -8; j <= 8; ++j) judge_point(p, i / 8.0L, j / 8.0L, &seen);
    for (int end = -1; end <= 1; end += 2) {
        judge_point(p, -(p->bs + p->qsr * (long double)end) / (2.0L * p->qss), end, &seen);
        judge_point(p, end, -(p->br + p->qsr * (long double)end) / (2.0L * p->qrr), &seen);
    }
    const long double d = 4.0L * p->qss * p->qrr - (long double)p->qsr * p->qsr;
    judge_point(p, ((long double)p->qsr * p->br - 2.0L * p->qrr * p->bs) / d,
                ((long double)p->qsr * p->bs - 2.0L * p->qss * p->br) / d, &seen);
    return seen;
}

static judged bounds_of(const quadratic *p)
{
    const imp_quad sign = {1, -1, 1, -1};
    const quadratics both = {p->bs * sign, p->br * sign, p->qss * sign, p->qsr * sign,
                             p->qrr * sign};
    const imp_quad least = quadratics_lower(&both);
    ck_assert(least[0] == least[2] && least[1] == least[3]);
    return (judged){least[0], -least[1]};
}

static void check_one(const quadratic *p)
{
    const judged range = bounds_of(p);
    const judged seen = judge(p);
    const long double slack =
        QUADRATIC_ROUNDING * (long double)UNIT_ROUNDOFF * size_of(p) + QUADRATIC_UNDERFLOW;
    ck_assert_msg(range.lo - slack <= seen.lo && seen.hi <= range.hi + slack,
                  "bs %a br %a qss %a qsr %a qrr %a: [%La, %La] is not within [%La, %La]", p->bs,
                  p->br, p->qss, p->qsr, p->qrr, seen.lo, seen.hi, range.lo, range.hi);
}

START_TEST(no_value_of_a_random_quadratic_is_outside_its_span)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(40000); ++k) {
        const double scale = random_power(&state, -40, 40), form = random_power(&state, -12, 4);
        const quadratic p = {scale * random_between(&state, -1, 1),
                             scale * random_between(&state, -1, 1),
                             scale * form * random_between(&state, -1, 1),
                             scale * form * random_between(&state, -1, 1),
                             scale * form * random_between(&state, -1, 1)};
        check_one(&p);
    }
}
END_TEST

/* (s m + r)^2 k plus a little: the form is singular up to rounding, either way. */
START_TEST(no_value_of_a_nearly_singular_quadratic_is_outside_its_span)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(40000); ++k) {
        const double m = random_between(&state, -2, 2), f = random_between(&state, -3, 3);
        const double tilt = random_power(&state, -60, -1) * random_between(&state, -1, 1);
        const quadratic p = {tilt * random_between(&state, -4, 4),
                             tilt * random_between(&state, -4, 4), f * m * m, 2 * f * m, f + tilt};
        check_one(&p);
    }
}
END_TEST

/* The slope cancels at a point of the square: a valley, whose place along itself the rounding of
 * its coefficients decides. */
START_TEST(no_value_of_a_valley_is_outside_its_span)
{
    uint64_t state = suite_seed() + 1;
    for (int k = 0; k < suite_times(40000); ++k) {
        const double m = random_between(&state, -2, 2), f = random_between(&state, 0.1, 3);
        const double tilt = random_power(&state, -56, -30) * random_between(&state, -1, 1);
        const double s = random_between(&state, -1, 1), r = random_between(&state, -1, 1);
        quadratic p = {0, 0, f * m * m, 2 * f * m, f + tilt};
        p.bs = -(2 * p.qss * s + p.qsr * r);
        p.br = -(2 * p.qrr * r + p.qsr * s);
        check_one(&p);
    }
}
END_TEST

START_TEST(the_span_of_a_quadratic_is_no_wider_than_its_values)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        const quadratic p = {random_between(&state, -1, 1), random_between(&state, -1, 1),
                             random_between(&state, -1, 1), random_between(&state, -1, 1),
                             random_between(&state, -1, 1)};
        const judged range = bounds_of(&p);
        const judged seen = judge(&p);
        const long double d = 4.0L * p.qss * p.qrr - (long double)p.qsr * p.qsr;
        const long double slack = (d > 1e-6L || d <= 0) ? 1e-9L : 1e-5L;
        ck_assert(seen.lo - range.lo <= slack && range.hi - seen.hi <= slack);
    }
}
END_TEST

START_TEST(the_spans_of_textbook_quadratics_are_exact)
{
    const quadratic bowl = {0, 0, 1, 0, 1}, saddle = {0, 0, 1, 0, -1}, off = {-1, 0, 1, 0, 0};
    const judged b = bounds_of(&bowl), s = bounds_of(&saddle), o = bounds_of(&off);
    ck_assert(b.lo == 0 && b.hi == 2);
    ck_assert(s.lo == -1 && s.hi == 1);
    ck_assert(o.lo == -0.25 && o.hi == 2);
}
END_TEST

/* --- Outward rounding ------------------------------------------------------------------------- */

static void check_neighbours(double x)
{
    const double up = sum_upper(x, 0), down = difference_lower(x, 0);
    const double above = nextafter(x, INFINITY), below = nextafter(x, -INFINITY);
    ck_assert_msg(memcmp(&up, &above, sizeof up) == 0, "above %a: %a, not %a", x, up, above);
    ck_assert_msg(memcmp(&down, &below, sizeof down) == 0, "below %a: %a, not %a", x, down, below);
}

START_TEST(sums_are_rounded_outward_to_the_next_double)
{
    const double least = 0x1p-1074, most = 0x1.fffffffffffffp1023;
    const double special[] = {0, least, 0x1p-1022, 0x1.fffffffffffffp-1023, 1, most, INFINITY};
    uint64_t random = suite_seed();
    for (size_t k = 0; k < sizeof special / sizeof *special; ++k)
        check_neighbours(special[k]), check_neighbours(-special[k]);
    for (int k = 0; k < 100000; ++k) {
        const uint64_t bits = random_bits(&random);
        double x;
        memcpy(&x, &bits, sizeof x);
        if (!isnan(x)) check_neighbours(x);
    }
    ck_assert(isnan(sum_upper(NAN, 1)) && isnan(difference_lower(INFINITY, INFINITY)));
}
END_TEST

START_TEST(forms_without_squares_are_least_at_a_corner)
{
    static const double odd[] = {0, -0.0, 1e300, 1e-310, INFINITY, NAN};
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        quadratics p = {.qss = imp_quad_all(0), .qrr = imp_quad_all(-0.0)};
        double slope[3 * IMP_QUAD];
        for (int i = 0; i < 3 * IMP_QUAD; ++i) {
            const uint64_t kind = random_bits(&state) % 64;
            slope[i] = kind < 6 ? odd[kind] : random_between(&state, -1, 1);
        }
        p.bs = imp_quad_load(slope);
        p.br = imp_quad_load(slope + IMP_QUAD);
        p.qsr = imp_quad_load(slope + 2 * IMP_QUAD);
        const imp_quad least = quadratics_lower(&p), bilinear = quadratics_bilinear_lower(&p);
        for (int i = 0; i < IMP_QUAD; ++i)
            ck_assert(least[i] == bilinear[i] || (isnan(least[i]) && isnan(bilinear[i])));
    }
}
END_TEST

/* --- Lines below convex quadratics ------------------------------------------------------------ */

/* The square of a distance: a sum of squares of linear forms, of one to three; or any quadratic. */
static imp_model draw_squares(uint64_t *state)
{
    imp_model g = {.a = random_between(state, -1, 1)};
    const size_t kind = random_bits(state) % 4;
    for (size_t k = 0; k < kind; ++k) {
        double l[3], c = random_between(state, -2, 2);
        for (int j = 0; j < 3; ++j)
            l[j] = random_bits(state) % 3 ? random_between(state, -2, 2) : 0;
        g.a += c * c;
        for (int i = 0, n = 0; i < 3; ++i) {
            g.b[i] += 2 * c * l[i];
            for (int j = i; j < 3; ++j, ++n) g.q[n] += (i == j ? 1 : 2) * l[i] * l[j];
        }
    }
    for (int n = 0; n < 6 && kind == 0; ++n) g.q[n] = random_between(state, -1, 1);
    return g;
}

static long double value_of(const imp_model *g, const long double s[3])
{
    long double sum = g->a;
    for (int i = 0, n = 0; i < 3; ++i) {
        sum += g->b[i] * s[i];
        for (int j = i; j < 3; ++j, ++n) sum += g->q[n] * s[i] * s[j];
    }
    return sum;
}

/* Along a grid: how far the values stay above the line, at least; the least value. */
static long double room_above(const imp_model *g, double sign, double middle, double reach,
                              const convex_line *line, long double *least)
{
    long double room = INFINITY;
    *least = INFINITY;
    for (int i = 0; i < 13 * 13 * 13; ++i) {
        const long double w = i % 13 / 6.0L - 1;
        const long double s[3] = {i / 13 % 13 / 6.0L - 1, i / 169 / 6.0L - 1, middle + reach * w};
        const long double x = sign * value_of(g, s), above = x - (line->low + line->drift * w);
        if (above < room) room = above;
        if (x < *least) *least = x;
    }
    return room;
}

START_TEST(no_value_of_a_quadratic_is_below_its_line)
{
    uint64_t state = suite_seed();
    int close = 0, convex = 0;
    for (int k = 0; k < suite_times(400); ++k) {
        const imp_model g = draw_squares(&state);
        const double reach = random_power(&state, -8, 0),
                     middle = random_between(&state, reach - 1, 1 - reach),
                     sign = random_bits(&state) % 4 ? 1 : -1;
        double size = fabs(g.a);
        long double least;
        for (int j = 0; j < 3; ++j) size += fabs(g.b[j]);
        for (int n = 0; n < 6; ++n) size += fabs(g.q[n]);
        const convex_line line = convex_line_below(&g, sign, middle, reach, size);
        const long double room = room_above(&g, sign, middle, reach, &line, &least);
        ck_assert_msg(room >= 0, "%Lg below the line", -room);
        convex += sign > 0;
        close += sign > 0 && line.low - fabs(line.drift) > least - 0.1L * size;
    }
    ck_assert_msg(2 * close > convex, "%d of %d lines are close", close, convex);
}
END_TEST

SUITE_MAIN("quadratic", no_value_of_a_quadratic_is_below_its_line,
           sums_are_rounded_outward_to_the_next_double,
           no_value_of_a_random_quadratic_is_outside_its_span,
           no_value_of_a_nearly_singular_quadratic_is_outside_its_span,
           no_value_of_a_valley_is_outside_its_span,
           the_span_of_a_quadratic_is_no_wider_than_its_values,
           the_spans_of_textbook_quadratics_are_exact, forms_without_squares_are_least_at_a_corner)
