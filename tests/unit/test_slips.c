/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/slip_helpers.h"

/* Surfaces that turn and move along another, nearly as its symmetry permits: a point is no farther
 * than the slip from where it was, but for a motion of the symmetry. */

/* --- Trials ----------------------------------------------------------------------------------- */

typedef struct trial {
    imp_symmetry symmetry;
    motion own[2], placing, other;
    motion turn; /* of the other, before it is placed */
    size_t own_count, turns;
    bool is_placed;   /* both are, alike */
    bool moves_along; /* one moves as the symmetry permits, too */
    imp_region times;
    double stretch;       /* of the placing */
    double moment, reach; /* half the box around the points before the maps */
} trial;

/* By a small angle about a line along x through the center, after the spin. */
static void tilt(const trial *y, double angle, motion *m)
{
    memset(m->place, 0, sizeof m->place);
    m->place[0][0] = 1;
    m->place[1][1] = m->place[2][2] = cos(angle);
    m->place[2][1] = sin(angle);
    m->place[1][2] = -sin(angle);
    m->is_placed = true;
    for (int i = 0; i < 3; ++i) m->pivot[i] = m->shift[i] = y->symmetry.center[i];
}

/* The own maps: a spin about a line along z that is off the symmetry's by as much as comes out, and
 * tilted by as much. */
static trial draw_trial(uint64_t *random)
{
    const double lo[3] = {0, 0, random_between(random, -1, 0)};
    const double hi[3] = {1, 1, lo[2] + random_power(random, -8, 0)};
    const double far = random_bits(random) % 2 ? random_power(random, 0, 8) : 1;
    trial y = {.times = region_make(lo, hi), .reach = random_power(random, -3, 3)};
    y.moment = lo[2] + (hi[2] - lo[2]) * random_between(random, 0, 1);
    y.symmetry.kind = 1 + (uint32_t)(random_bits(random) % 4);
    y.symmetry.axis[2] = random_power(random, -8, 8);
    draw_vector(random, far, y.symmetry.center);
    const double off = random_bits(random) % 3 ? y.reach * random_power(random, -40, -8) : 0;
    motion *spin = &y.own[0];
    spin->rate = random_between(random, -4, 4);
    spin->swell = random_bits(random) % 4 ? 0 : random_between(random, -3e-6, 3e-6);
    for (int i = 0; i < 3; ++i) {
        spin->pivot[i] = y.symmetry.center[i] + off * random_between(random, -1, 1);
        spin->shift[i] = spin->pivot[i];
        if (y.symmetry.kind != IMP_SYMMETRY_ABOUT_POINT && i == 2) spin->pivot[i] += far;
        spin->way[i] = off * random_between(random, -1, 1);
    }
    y.turns = random_bits(random) % 2;
    y.own_count = y.turns > 0 && random_bits(random) % 2 ? 0 : 2;
    y.turn = *spin;
    y.turn.rate = random_between(random, -4, 4);
    y.moves_along = random_bits(random) % 2;
    if (y.moves_along && y.symmetry.kind == IMP_SYMMETRY_ALONG_LINE) spin->way[2] = y.reach;
    if (y.moves_along && y.symmetry.kind == IMP_SYMMETRY_ACROSS_LINE)
        spin->way[0] = spin->way[1] = y.reach;
    if (off > 0 && random_bits(random) % 2) tilt(&y, off / y.reach, &y.own[1]);
    y.is_placed = random_bits(random) % 2;
    y.stretch = random_bits(random) % 2 ? 1 : 1 + random_between(random, -7e-6, 7e-6);
    draw_place(random, y.stretch, &y.placing);
    draw_vector(random, far, y.placing.shift);
    draw_vector(random, far, y.placing.pivot);
    if (random_bits(random) % 2) draw_vector(random, 1, y.placing.way);
    return y;
}

/* Where a point of a is at a time, seen from b. */
static void seen(const trial *y, long double t, const long double from[3], long double x[3])
{
    for (int i = 0; i < 3; ++i) x[i] = from[i];
    for (size_t k = 0; k < y->own_count; ++k) apply(&y->own[k], t, x);
    if (y->is_placed) apply(&y->placing, t, x);
    if (y->is_placed) undo(&y->other, t, x);
    if (y->turns > 0) undo(&y->turn, t, x);
}

/* --- Judging ---------------------------------------------------------------------------------- */

/* What is claimed at all times of a point that is at x at the moment, after all maps. */
static long double claimed(const trial *y, const surface *b, double slip, const long double x[3])
{
    imp_model point[3], g;
    for (int i = 0; i < 3; ++i) point[i] = imp_known((double)x[i], 0x1p-52 * fabs((double)x[i]));
    const imp_status status =
        surface_distance_within(b, &y->times, y->turns + y->is_placed, point, y->moment, slip, &g);
    if (status != IMP_STATUS_OK) return 0;
    ck_assert(g.b[0] == 0 && g.b[1] == 0 && g.b[2] == 0);
    const double by_polynomial = fabs(g.a) - g.e, by_range = g.lo > -g.hi ? g.lo : -g.hi;
    return by_polynomial > by_range ? by_polynomial : by_range;
}

static void judge(const trial *y, const surface *b, double slip, uint64_t *random, tally *of)
{
    const long double size = 64 * (1 + y->reach) * 256, stretch = y->is_placed ? y->stretch : 1;
    for (int k = 0; k < POINTS; ++k) {
        const long double t = y->times.lo[2] + (y->times.hi[2] - y->times.lo[2]) *
                                                   (long double)random_fraction(random);
        long double from[3], now[3], then[3], world[3];
        for (int i = 0; i < 3; ++i) {
            const uint64_t end = random_bits(random) % 3;
            from[i] = end == 0   ? y->reach
                      : end == 1 ? -y->reach
                                 : y->reach * random_between(random, -1, 1);
            from[i] += y->symmetry.center[i];
        }
        seen(y, t, from, now);
        seen(y, y->moment, from, then);
        const orbit at = orbit_of(&y->symmetry, now), was = orbit_of(&y->symmetry, then);
        const long double shown = apart(&at, &was);
        for (int i = 0; i < 3; ++i) world[i] = then[i];
        if (y->turns > 0) apply(&y->turn, y->moment, world);
        if (y->is_placed) apply(&y->other, y->moment, world);
        of->judged += 1;
        of->refuted += shown > slip + 0x1p-58L * size;
        of->too_far +=
            claimed(y, b, slip, world) > stretch * off(&y->symmetry, &at) + 0x1p-58L * size;
        if (slip > 0x1p-30 * y->reach && shown / slip > of->sharpest)
            of->sharpest = (double)(shown / slip);
    }
}

/* Slips times `factor`, of so many cases. */
static tally try_all(double factor, int cases)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    for (int k = 0; k < cases; ++k) {
        trial y = draw_trial(&random);
        y.other = y.placing;
        motion *const of_a[] = {&y.own[0], &y.own[1], &y.placing}, *const of_b[] = {&y.turn,
                                                                                    &y.other};
        surface *a = compose(&y.symmetry, of_a + 2 - y.own_count, y.own_count + y.is_placed);
        surface *b = compose(&y.symmetry, of_b + 1 - y.turns, y.turns + y.is_placed);
        imp_model bare[3];
        double slip;
        for (int i = 0; i < 3; ++i)
            bare[i] = imp_between(y.symmetry.center[i] - y.reach, y.symmetry.center[i] + y.reach);
        ck_assert_int_eq(surface_slip(a, b, bare, &y.times, y.moment, 0, &slip), IMP_STATUS_OK);
        if (slip < INFINITY) judge(&y, b, factor * slip, &random, &of);
        of.known += slip < INFINITY;
        of.exact += slip < 0x1p-36 * (y.reach + 256);
        surface_free(a);
        surface_free(b);
    }
    return of;
}

START_TEST(no_point_slips_farther_than_is_claimed)
{
    const tally of = try_all(1, suite_times(CASES));
    ck_assert_msg(of.refuted == 0 && of.too_far == 0, "of %d %d are refuted, and %d distances",
                  of.judged, of.refuted, of.too_far);
    ck_assert_msg(of.sharpest > 0.8, "%g of the slip is shown at most", of.sharpest);
    ck_assert_msg(4 * of.known > suite_times(CASES), "%d are known", of.known);
    ck_assert_msg(10 * of.exact > suite_times(CASES), "%d are exact", of.exact);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(slips_that_are_too_small_are_found)
{
    const tally of = try_all(0.75, suite_times_at_least(CASES));
    ck_assert(of.refuted > 0 && of.too_far > 0);
}
END_TEST

/* The slip of a surface with one map along one without, over t in [0, 1]. */
static imp_status slip_of(motion *m, imp_symmetry *symmetry, double *slip)
{
    motion *const maps[] = {m};
    surface *a = compose(symmetry, maps, 1), *b = compose(symmetry, maps, 0);
    imp_model bare[3];
    for (int i = 0; i < 3; ++i) bare[i] = imp_between(-1, 1);
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    const imp_status status = surface_slip(a, b, bare, &times, 0.5, 0, slip);
    surface_free(a);
    surface_free(b);
    return status;
}

START_TEST(motions_within_the_symmetry_do_not_slip)
{
    double slip;
    motion m = {.rate = 3};
    imp_symmetry s = ball();
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip < 0x1p-48);
    m.way[2] = 1;
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip == INFINITY);
    s = (imp_symmetry){.kind = IMP_SYMMETRY_ALONG_LINE, .axis = {0, 0, 2}};
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip < 0x1p-48);
    s.kind = IMP_SYMMETRY_ACROSS_LINE;
    ck_assert_int_eq(slip_of(&m, &s, &slip), IMP_STATUS_OK);
    ck_assert(slip == INFINITY);
}
END_TEST

START_TEST(symmetries_that_are_none_are_refused)
{
    motion m = {.rate = 3};
    double slip;
    imp_symmetry bad[4] = {{.kind = 0}, {.kind = 7}, {.kind = IMP_SYMMETRY_ABOUT_LINE}, ball()};
    bad[3].center[1] = NAN;
    for (int k = 0; k < 4; ++k) ck_assert_int_eq(slip_of(&m, &bad[k], &slip), SURFACE_BAD_SYMMETRY);
}
END_TEST

SUITE_MAIN("slips", no_point_slips_farther_than_is_claimed, slips_that_are_too_small_are_found,
           motions_within_the_symmetry_do_not_slip, symmetries_that_are_none_are_refused)
