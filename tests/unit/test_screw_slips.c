/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/carried.h"
#include "tests/support/slip_helpers.h"

/* Surfaces that move along others nearly as a screw does: a point is no farther than the slip from
 * some image of where it was under the screw motions. */

#define TWO_PI 6.283185307179586476925286766559005768L

/* --- Trials ----------------------------------------------------------------------------------- */

/* A surface is taken to where the screw's line is the z axis, moves by a screw of its own, is taken
 * back, and moves as the other one does. */
enum { TO_AXIS, SCREW, BACK, COMMON, CHAIN };
enum { TRIALS = CASES / 8 };

/* All maps are exact rotations and shifts, but for the rounding of a line's direction. */
typedef struct trial {
    imp_symmetry symmetry;
    motion own[2][CHAIN]; /* of a, of b */
    imp_region times;
    double moment, lead, reach; /* reach: half of the box of points around the center */
    double off;                 /* by what the screws are off, of `reach` */
} trial;

static double hand_of(const imp_symmetry *of)
{
    return of->kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1;
}

/* A screw motion by `rate`, off by what comes out. */
static motion draw_screw(uint64_t *random, const trial *y, double rate)
{
    motion m = {.rate = rate};
    m.way[2] = (double)(hand_of(&y->symmetry) * rate * y->lead / TWO_PI);
    for (int i = 0; i < 3; ++i) m.pivot[i] += y->off * random_between(random, -1, 1);
    for (int i = 0; i < 3; ++i) m.way[i] += y->off * random_between(random, -1, 1);
    m.rate += y->off / y->reach * random_between(random, -1, 1);
    return m;
}

/* The line lies along any direction. */
static void draw_line(uint64_t *random, trial *y)
{
    motion back = {.rate = 0}, to = {.rate = 0};
    draw_vector(random, 2, y->symmetry.center);
    draw_place(random, 1, &back);
    to.is_placed = true;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) to.place[i][j] = back.place[j][i];
        to.pivot[i] = back.shift[i] = y->symmetry.center[i];
        y->symmetry.axis[i] = back.place[i][2] * y->lead;
    }
    y->own[0][TO_AXIS] = y->own[1][TO_AXIS] = to;
    y->own[0][BACK] = y->own[1][BACK] = back;
}

static motion draw_common(uint64_t *random)
{
    motion m = {.rate = 0};
    draw_vector(random, 2, m.shift);
    if (random_bits(random) % 2) m.rate = random_between(random, -2, 2);
    if (random_bits(random) % 2) draw_vector(random, 1, m.way);
    if (random_bits(random) % 2) return m;
    m.place[0][1] = m.place[1][2] = m.place[2][0] = 1;
    m.is_placed = true;
    return m;
}

static trial draw_trial(uint64_t *random)
{
    const double from = random_between(random, -1, 1);
    trial y = {.reach = random_power(random, -3, 3)};
    y.times =
        region_make((double[3]){0, 0, from}, (double[3]){1, 1, from + random_power(random, -6, 1)});
    y.moment = from + (y.times.hi[2] - from) * random_between(random, 0, 1);
    y.symmetry.kind = random_bits(random) % 2 ? IMP_SYMMETRY_SCREW_RIGHT : IMP_SYMMETRY_SCREW_LEFT;
    y.lead = y.reach * random_power(random, -6, 2);
    draw_line(random, &y);
    y.off = random_bits(random) % 4 ? y.reach * random_power(random, -36, -12) : 0;
    y.own[0][SCREW] = draw_screw(random, &y, random_between(random, -4, 4));
    y.own[1][SCREW] =
        draw_screw(random, &y, random_bits(random) % 2 ? random_between(random, -4, 4) : 0);
    y.own[0][COMMON] = y.own[1][COMMON] = draw_common(random);
    return y;
}

static surface *compose_trial(trial *y, int side)
{
    surface *s = surface_new(&target, &y->symmetry);
    ck_assert_ptr_nonnull(s);
    for (int k = 0; k < CHAIN; ++k)
        ck_assert_int_eq(surface_add_map(s, &exactly, &y->own[side][k]), IMP_SUCCESS);
    return s;
}

/* Where a point of a is at a time, seen from b. */
static void seen(const trial *y, long double t, const long double from[3], long double x[3])
{
    for (int i = 0; i < 3; ++i) x[i] = from[i];
    for (int k = 0; k < CHAIN; ++k) apply(&y->own[0][k], t, x);
    for (int k = CHAIN; k-- > 0;) undo(&y->own[1][k], t, x);
}

/* --- Judging ---------------------------------------------------------------------------------- */

/* How far x is from where a screw motion that turns by `angle` takes `was`. */
static long double apart_by(const imp_symmetry *of, long double angle, const long double was[3],
                            const long double x[3])
{
    const long double c = cosl(angle), s = sinl(angle), turns = hand_of(of) * angle / TWO_PI;
    long double w[3], n[3], length = 0, along = 0, sum = 0;
    for (int i = 0; i < 3; ++i) length = hypotl(length, of->axis[i]);
    for (int i = 0; i < 3; ++i) {
        n[i] = of->axis[i] / length;
        w[i] = was[i] - of->center[i];
        along += n[i] * w[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const long double turned =
            c * w[i] + s * (n[j] * w[k] - n[k] * w[j]) + (1 - c) * along * n[i];
        const long double way = of->center[i] + turned + turns * of->axis[i] - x[i];
        sum += way * way;
    }
    return sqrtl(sum);
}

/* The least distance over angles near `angle`, where there is one least. */
static long double nearest(const imp_symmetry *of, long double angle, const long double was[3],
                           const long double x[3])
{
    long double lo = angle - 0.25L, hi = angle + 0.25L;
    for (int step = 0; step < 160; ++step) {
        const long double first = lo + (hi - lo) / 3, second = hi - (hi - lo) / 3;
        if (apart_by(of, first, was, x) < apart_by(of, second, was, x))
            hi = second;
        else
            lo = first;
    }
    return apart_by(of, 0.5L * lo + 0.5L * hi, was, x);
}

static void judge(const trial *y, double slip, uint64_t *random, tally *of)
{
    const long double rate = (long double)y->own[0][SCREW].rate - y->own[1][SCREW].rate;
    for (int k = 0; k < POINTS; ++k) {
        const long double t = y->times.lo[2] + (y->times.hi[2] - y->times.lo[2]) *
                                                   (long double)random_fraction(random);
        long double from[3], now[3], then[3];
        for (int i = 0; i < 3; ++i)
            from[i] = y->symmetry.center[i] + y->reach * (random_bits(random) % 2 ? 1.0L : -1.0L);
        seen(y, t, from, now);
        seen(y, y->moment, from, then);
        const long double shown = nearest(&y->symmetry, rate * (t - y->moment), then, now);
        of->judged += 1;
        of->refuted += shown > slip + 0x1p-46L * (8 + 8 * y->reach);
        if (slip > 0x1p-36 * (1 + y->reach) && shown / slip > of->sharpest)
            of->sharpest = (double)(shown / slip);
    }
}

/* Slips times `factor`. */
static tally try_all(double factor)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    for (int k = 0; k < suite_times_at_least(TRIALS); ++k) {
        trial y = draw_trial(&random);
        surface *a = compose_trial(&y, 0), *b = compose_trial(&y, 1);
        imp_model bare[3];
        double slip, enough = 4 * y.off + 0x1p-24 * y.reach;
        for (int i = 0; i < 3; ++i)
            bare[i] = imp_between(y.symmetry.center[i] - y.reach, y.symmetry.center[i] + y.reach);
        const imp_status status = surface_slip(a, b, bare, &y.times, y.moment, enough, &slip);
        ck_assert_int_eq(status, IMP_STATUS_OK);
        ck_assert(slip <= enough || slip == INFINITY);
        if (slip < INFINITY) judge(&y, factor * slip, &random, &of);
        of.known += slip < INFINITY;
        of.exact += slip < 0x1p-20 * y.reach;
        surface_free(a);
        surface_free(b);
    }
    return of;
}

START_TEST(no_point_slips_farther_than_is_claimed)
{
    const tally of = try_all(1);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(of.sharpest > 0.2, "%g of the slip is shown at most", of.sharpest);
    ck_assert_msg(4 * of.known > suite_times_at_least(TRIALS), "%d are known", of.known);
    ck_assert_msg(10 * of.exact > suite_times_at_least(TRIALS), "%d are exact", of.exact);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(slips_that_are_too_small_are_found)
{
    const tally of = try_all(0.125);
    ck_assert(of.refuted > 0);
}
END_TEST

/* --- Motions that are no screws --------------------------------------------------------------- */

static imp_symmetry screw_of(double lead)
{
    return (imp_symmetry){.kind = IMP_SYMMETRY_SCREW_RIGHT, .axis = {0, 0, lead}};
}

/* The slip of a surface that turns by `rate` and moves by `way` along z over t in [0, 1], along one
 * at rest. */
static double slip_within(const imp_symmetry *symmetry, double rate, double way, double enough)
{
    imp_symmetry of = *symmetry;
    motion m = {.rate = rate, .way = {0, 0, way}};
    surface *a = surface_new(&target, &of), *b = surface_new(&target, &of);
    ck_assert(a != NULL && b != NULL && surface_add_map(a, &exactly, &m) == IMP_SUCCESS);
    imp_model bare[3];
    for (int i = 0; i < 3; ++i) bare[i] = imp_between(-1, 1);
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    double slip;
    ck_assert_int_eq(surface_slip(a, b, bare, &times, 0.5, enough, &slip), IMP_STATUS_OK);
    surface_free(a);
    surface_free(b);
    return slip;
}

static double slip_of(const imp_symmetry *symmetry, double rate, double way)
{
    return slip_within(symmetry, rate, way, 1e-9);
}

START_TEST(only_screw_motions_of_this_lead_and_hand_do_not_slip)
{
    const double turn = (double)TWO_PI;
    imp_symmetry s = screw_of(0.5);
    ck_assert(slip_of(&s, 3, 3 * 0.5 / turn) <= 1e-9);
    ck_assert(slip_of(&s, -3, -3 * 0.5 / turn) <= 1e-9);
    ck_assert(slip_of(&s, 3, -3 * 0.5 / turn) == INFINITY);
    ck_assert(slip_of(&s, 3, 0) == INFINITY);
    ck_assert(slip_of(&s, 0, 0.5) == INFINITY);
    ck_assert(slip_of(&s, 3, 3 * 0.501 / turn) == INFINITY);
    s.kind = IMP_SYMMETRY_SCREW_LEFT;
    ck_assert(slip_of(&s, 3, -3 * 0.5 / turn) <= 1e-9);
    ck_assert(slip_of(&s, 3, 3 * 0.5 / turn) == INFINITY);
    s.is_closed = IMP_SYMMETRY_CLOSED;
    ck_assert(symmetry_is_sane(&s));
    s.is_closed = IMP_SYMMETRY_ORBIT_U;
    ck_assert(!symmetry_is_sane(&s));
}
END_TEST

START_TEST(no_slip_of_a_screw_is_known_where_none_is_enough)
{
    const imp_symmetry s = screw_of(0.5);
    ck_assert(slip_within(&s, 0, 0, 1e-9) <= 1e-9);
    ck_assert(slip_within(&s, 0, 0, 0) == INFINITY);
}
END_TEST

/* Turns beyond IMP_SCREW_TURNS are not claimed. */
START_TEST(turns_beyond_what_is_claimed_are_not_known)
{
    const double lead = 0x1p-20, turns = 2 * IMP_SCREW_TURNS;
    const imp_symmetry s = screw_of(lead);
    ck_assert(slip_of(&s, (double)TWO_PI * turns, lead * turns) == INFINITY);
}
END_TEST

/* What a rotation alone leaves as it is, a screw does not. */
START_TEST(rotations_alone_are_no_motions_of_a_screw)
{
    imp_symmetry screw = screw_of(1), round = {.kind = IMP_SYMMETRY_ABOUT_LINE, .axis = {0, 0, 1}};
    round.is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    const double lo[3] = {-1, -1, -1}, hi[3] = {1, 1, 1};
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    const carry_base base = {0.5, false};
    motion spin = {.rate = 1};
    double slip;
    unsigned held;
    surface *a = surface_new(&target, &round), *b = surface_new(&target, &screw);
    ck_assert(a != NULL && b != NULL && surface_add_map(b, &exactly, &spin) == IMP_SUCCESS);
    ck_assert_int_eq(surface_carry_slip(b, lo, hi, &times, &base, &slip), IMP_STATUS_OK);
    ck_assert(slip == INFINITY);
    ck_assert_int_eq(surface_orbit_slip(a, b, lo, hi, &times, &held, &slip), IMP_STATUS_OK);
    ck_assert(slip == INFINITY && held == 0);
    surface_free(a);
    surface_free(b);
}
END_TEST

SUITE_MAIN("screw slips", no_point_slips_farther_than_is_claimed,
           slips_that_are_too_small_are_found, only_screw_motions_of_this_lead_and_hand_do_not_slip,
           no_slip_of_a_screw_is_known_where_none_is_enough,
           turns_beyond_what_is_claimed_are_not_known, rotations_alone_are_no_motions_of_a_screw)
