/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <string.h>

#include "plugins/expression/turned_surface.h"
#include "tests/support/formula_surface.h"

/* Formulas that are found to be surfaces of revolution: distances from them against dense samples,
 * and points that rotations have moved; and formulas that are none. */

enum { TEXTS = 48, POINTS = 8 };

typedef struct kit {
    formula_surface of;
    turned_surface turned;
    bool is_turned;
} kit;

static kit kit_of(const formula_text *of)
{
    kit k = {.of = formula_surface_of(of)};
    k.is_turned = k.of.form.kind == TEXT_TURNED;
    k.turned.form = k.of.form.turned;
    k.turned.section = k.of.section;
    if (k.is_turned) turned_surface_begin(&k.turned, k.of.lo, k.of.hi);
    return k;
}

/* The least distance of x from the circle of p, which is whole: by samples, then by steps that are
 * halved, beyond the ends on from the other one. */
static double from_circle(const kit *k, const double p[3], const double x[3])
{
    enum { SAMPLES = 64 };
    const int j = k->turned.form.around;
    const double lo = k->of.lo[j], hi = k->of.hi[j];
    double at[3] = {p[0], p[1], 0}, best = lo, least = INFINITY;
    for (int n = 0; n < SAMPLES; ++n) {
        at[j] = lo + (hi - lo) * n / SAMPLES;
        const double now = formula_apart(&k->of, at, x);
        if (now < least) least = now, best = at[j];
    }
    for (double step = (hi - lo) / SAMPLES; step > 1e-14;) {
        const double before = least;
        for (int way = -1; way <= 1; way += 2) {
            at[j] = best + way * step;
            if (at[j] < lo) at[j] += hi - lo;
            if (at[j] > hi) at[j] -= hi - lo;
            const double now = formula_apart(&k->of, at, x);
            if (now < least) least = now, best = at[j];
        }
        if (!(least < before)) step *= 0.5;
    }
    return least;
}

/* --- Random surfaces -------------------------------------------------------------------------- */

/* A line, an arc, an arc that meets the axis, one that is a little off, or a wave. */
static void draw_profile(uint64_t *random, const char *v, char radius[120], char height[120])
{
    const double a = random_between(random, 0.05, 2), b = random_between(random, -2, 2),
                 c = random_between(random, 0.2, 0.45), d = random_between(random, -1, 1);
    switch (random_bits(random) % 6) {
    case 0:
        snprintf(radius, 120, "(%.3g+%.3g*%s)", a, b, v);
        snprintf(height, 120, "%.3g*%s-0.25", d, v);
        break;
    case 1:
        snprintf(radius, 120, "(%.3g+%.3g*cos(%s))", a, c, v);
        snprintf(height, 120, "%.3g*sin(%s)+0.5", c, v);
        break;
    case 2:
        snprintf(radius, 120, "%.3g*cos(%s)", a, v);
        snprintf(height, 120, "%.3g*sin(%s)", a, v);
        break;
    case 3:
        snprintf(radius, 120, "(%.3g+%.3g*cos(%s))", a, c, v);
        snprintf(height, 120, "%.5g*sin(%s)", c * (1 + random_power(random, -14, -8)), v);
        break;
    case 4:
        snprintf(radius, 120, "%.3g", a);
        snprintf(height, 120, "%s", v);
        break;
    default:
        snprintf(radius, 120, "(%.3g+0.1*cos(3*%s))", a, v);
        snprintf(height, 120, "%s", v);
    }
}

static formula_text draw_text(uint64_t *random)
{
    const int axis = (int)(random_bits(random) % 3), around = (int)(random_bits(random) % 2);
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const char *const u = around == 0 ? "u" : "v", *const v = around == 0 ? "v" : "u";
    const bool in_turns = random_bits(random) % 2, is_swapped = random_bits(random) % 2;
    const char *const wave[2] = {is_swapped ? "-sin" : "cos", is_swapped ? "cos" : "sin"};
    char radius[120], height[120];
    formula_text of;
    draw_profile(random, v, radius, height);
    snprintf(of.text[i], sizeof of.text[i], "%s*%s(%s%s)+1.25", radius, wave[0],
             in_turns ? "2*pi*" : "", u);
    snprintf(of.text[j], sizeof of.text[j], "%s(%s%s)*%s", wave[1], in_turns ? "2*pi*" : "", u,
             radius);
    snprintf(of.text[axis], sizeof of.text[axis], "%s", height);
    const bool is_open = random_bits(random) % 4 == 0;
    of.lo[around] = 0;
    of.hi[around] = (is_open ? 0.6 : 1) * (in_turns ? 1 : 6.283185307179586);
    of.lo[1 - around] = -1 + 0.3 * random_fraction(random);
    of.hi[1 - around] = random_between(random, -0.5, 4); /* R is 0 somewhere, or not */
    return of;
}

static void turn(const imp_symmetry *of, double angle, double x[3])
{
    const int axis = of->axis[0] != 0 ? 0 : of->axis[1] != 0 ? 1 : 2;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const long double c = cosl(angle), s = sinl(angle);
    const long double w[2] = {(long double)x[i] - of->center[i], (long double)x[j] - of->center[j]};
    x[i] = (double)(of->center[i] + c * w[0] - s * w[1]);
    x[j] = (double)(of->center[j] + s * w[0] + c * w[1]);
}

static double claimed(const kit *k, const double x[3])
{
    const imp_model at[3] = {imp_num(x[0]), imp_num(x[1]), imp_num(x[2])};
    if (!turned_surface_is_round(&k->turned)) return 0;
    const imp_model g = turned_surface_gap(&k->turned, at);
    return fabs(g.a) - g.e;
}

typedef struct tally {
    int judged, refuted, round, turned, closed;
    double sharpest, off; /* of a distance, and of what rotations take off the surface */
} tally;

static void judge(const kit *k, uint64_t *random, double factor, tally *of)
{
    imp_symmetry symmetry = {0};
    ck_assert_int_eq(turned_surface_symmetry(&k->turned, &symmetry), IMP_STATUS_OK);
    const bool is_closed = (symmetry.is_closed & IMP_SYMMETRY_CLOSED) != 0;
    of->closed += is_closed;
    for (int n = 0; n < POINTS; ++n) {
        const double p[3] = {random_between(random, k->of.lo[0], k->of.hi[0]),
                             random_between(random, k->of.lo[1], k->of.hi[1]), 0};
        double x[3];
        ck_assert_int_eq(expression_point(k->of.program, p, x, NULL), IMP_STATUS_OK);
        if (is_closed) turn(&symmetry, random_between(random, -4, 4), x);
        const double left = is_closed ? from_circle(k, p, x) : 0;
        if (left > of->off) of->off = left;
        const double off = random_power(random, -16, 1);
        for (int i = 0; i < 3; ++i) x[i] += off * random_between(random, -1, 1);
        const double claim = factor * claimed(k, x), most = formula_nearest(&k->of, x, 0x1p-34);
        if (claim / most > of->sharpest) of->sharpest = claim / most;
        of->refuted += claim > most * (1 + 1e-9) + 1e-12;
        of->judged += 1;
    }
}

/* Claims that are wrong by the factor end it where the first is refuted. */
static tally try_all(double factor)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    const int times = suite_times_at_least(TEXTS);
    for (int n = 0; n < times && (factor == 1 || of.refuted == 0); ++n) {
        const formula_text text = draw_text(&random);
        kit k = kit_of(&text);
        ck_assert_msg(k.is_turned, "%s | %s | %s", text.text[0], text.text[1], text.text[2]);
        of.turned += 1;
        of.round += turned_surface_is_round(&k.turned);
        judge(&k, &random, factor, &of);
        formula_surface_free(&k.of);
    }
    return of;
}

START_TEST(no_point_is_nearer_than_is_claimed)
{
    const tally of = try_all(1);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(of.round > TEXTS / 3 && of.round < of.turned, "%d of %d", of.round, of.turned);
    ck_assert_msg(of.closed > TEXTS / 3 && of.closed < of.turned, "%d are closed", of.closed);
    ck_assert_msg(of.sharpest > 0.99, "%g of a distance is claimed at most", of.sharpest);
    ck_assert_msg(of.off < 1e-8, "rotations take a point off the surface by %g", of.off);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(distances_that_are_too_large_are_found) { ck_assert(try_all(1.01).refuted > 0); }
END_TEST

/* --- What is known, and what is not ----------------------------------------------------------- */

typedef struct known {
    formula_text of;
    round_kind kind;
    bool is_closed, is_nearly;
} known;

#define TURN 6.283185307179586
#define UPTO(U, V)                                                                                 \
    {0, 0}, { U, V }

START_TEST(profiles_and_turns_are_known)
{
    static const known row[] = {
        {{{"cos(u)", "sin(u)", "v"}, UPTO(TURN, 1)}, ROUND_CYLINDER, true, true},
        {{{"cos(2*pi*u)", "-sin(2*pi*u)", "v"}, UPTO(1.5, 1)}, ROUND_CYLINDER, true, false},
        {{{"cos(u)", "sin(u)", "v"}, UPTO(0.99 * TURN, 1)}, ROUND_CYLINDER, false, false},
        {{{"cos(u)", "sin(u)", "v"}, UPTO((1 - 0x1p-36) * TURN, 1)}, ROUND_CYLINDER, false, false},
        {{{"v*cos(u)", "v*sin(u)", "0"}, UPTO(TURN, 1)}, ROUND_PLANE, true, true},
        {{{"v*cos(u)", "2*v", "-v*sin(u)"}, UPTO(TURN, 1)}, ROUND_CONE, true, true},
        {{{"cos(u)*cos(v)", "cos(u)*sin(v)", "sin(u)"}, UPTO(1, TURN)}, ROUND_CIRCLE, true, true},
        {{{"(2+cos(v))*cos(u)", "(2+cos(v))*sin(u)", "sin(v)"}, UPTO(3, TURN)},
         ROUND_CIRCLE,
         false,
         false},
        {{{"(2+v^3)*cos(u)", "(2+v^3)*sin(u)", "v"}, UPTO(TURN, 1)}, ROUND_NONE, true, true},
        {{{"(2+v)*cos(3*u^2)", "(2+v)*sin(3*u^2)", "v"}, UPTO(2, 1)}, ROUND_CONE, true, false},
        /* the angle jumps */
        {{{"(2+v)*cos(3*atan2(u-1,-1))", "(2+v)*sin(3*atan2(u-1,-1))", "v"}, UPTO(2, 1)},
         ROUND_CONE,
         false,
         false}};
    for (size_t n = 0; n < sizeof row / sizeof *row; ++n) {
        kit k = kit_of(&row[n].of);
        ck_assert_msg(k.is_turned, "text %zu: %s", n, row[n].of.text[0]);
        const uint32_t is = k.turned.is_closed;
        ck_assert_msg(k.turned.round.kind == row[n].kind &&
                          ((is & IMP_SYMMETRY_CLOSED) != 0) == row[n].is_closed &&
                          ((is & IMP_SYMMETRY_NEARLY) != 0) == row[n].is_nearly,
                      "text %zu: kind %d, closed %x: %s", n, (int)k.turned.round.kind, is,
                      row[n].of.text[0]);
        formula_surface_free(&k.of);
    }
}
END_TEST

START_TEST(what_is_not_turned_is_not_taken_for_it)
{
    static const formula_text none[] = {
        {{"(2+v)*cos(u)", "(2.01+v)*sin(u)", "v"}, UPTO(TURN, 1)},
        {{"(2+v)*cos(u)", "(2+v)*sin(2*u)", "v"}, UPTO(TURN, 1)},
        {{"(2+v)*cos(u)", "(2+v)*cos(u)", "v"}, UPTO(TURN, 1)},
        {{"(2+v+t)*cos(u)", "(2+v+t)*sin(u)", "v"}, UPTO(TURN, 1)},
        {{"(2+u)*cos(u)", "(2+u)*sin(u)", "v"}, UPTO(TURN, 1)},
        {{"(2+v)*cos(u)", "(2+v)*sin(u)", "v+0.1*u"}, UPTO(TURN, 1)},
        {{"(2+v)*cos(u)", "(2+v)*sin(u)", "v+t"}, UPTO(TURN, 1)},
        {{"(2+v)*cos(u+v)", "(2+v)*sin(u+v)", "v"}, UPTO(TURN, 1)},
        {{"(2+v)*cos(u)+v", "(2+v)*sin(u)", "v"}, UPTO(TURN, 1)},
        {{"(2+v)*cos(u+t)", "(2+v)*sin(u+t)", "v"}, UPTO(TURN, 1)}};
    for (size_t n = 0; n < sizeof none / sizeof *none; ++n) {
        kit k = kit_of(&none[n]);
        ck_assert_msg(!k.is_turned, "text %zu: %s", n, none[n].text[0]);
        formula_surface_free(&k.of);
    }
}
END_TEST

SUITE_MAIN("turned", no_point_is_nearer_than_is_claimed, distances_that_are_too_large_are_found,
           profiles_and_turns_are_known, what_is_not_turned_is_not_taken_for_it)
