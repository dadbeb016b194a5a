/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/slip_helpers.h"

/* Two surfaces that both move: no pair of points comes nearer than the slip of the pair says. */

enum { CHAIN = 4 };

/* A point or a ball, and a torus. Each turns about itself, or the first about the axis of the
 * other, and both are placed and turned alike; but each may swell by itself. */
typedef struct pair_trial {
    imp_symmetry symmetry[2];
    motion map[2][CHAIN];
    size_t count[2];
    double reach; /* half the box of the first: 1 of a ball */
    imp_region times;
} pair_trial;

static void draw_pair(uint64_t *random, pair_trial *y)
{
    const double lo[3] = {0, 0, random_between(random, -1, 0)};
    const double hi[3] = {1, 1, lo[2] + random_power(random, -4, 0)};
    const bool is_ball = random_bits(random) % 2;
    double place[3];
    motion alike = {.rate = 0}, spun;
    *y = (pair_trial){.times = region_make(lo, hi), .count = {0, 0}};
    y->reach = is_ball ? 1 : random_power(random, -10, 0);
    y->symmetry[0].kind = IMP_SYMMETRY_ABOUT_POINT;
    y->symmetry[0].is_closed = is_ball;
    y->symmetry[1] = (imp_symmetry){.kind = IMP_SYMMETRY_ABOUT_LINE, .is_closed = 1};
    y->symmetry[1].axis[2] = 1;
    draw_vector(random, 1, y->symmetry[1].center);
    draw_vector(random, is_ball ? 4 : y->reach, y->symmetry[0].center);
    for (int i = 0; i < 3; ++i) y->symmetry[0].center[i] += y->symmetry[1].center[i];
    draw_place(random, 1, &alike);
    draw_vector(random, 1, alike.shift);
    draw_vector(random, 1, place);
    spun = spin_about(random_bits(random) % 2 ? alike.shift : place, random_between(random, -3, 3));
    memcpy(alike.pivot, y->symmetry[1].center, sizeof alike.pivot);
    for (int k = 0; k < 2; ++k) {
        motion *m = y->map[k];
        size_t n = 0;
        if (is_ball || k == 1)
            m[n++] = spin_about(y->symmetry[k].center, random_between(random, -3, 3));
        if (k == 0 && random_bits(random) % 2)
            m[n++] = spin_about(y->symmetry[1].center, random_between(random, -3, 3));
        m[n++] = alike;
        m[n] = spun;
        if (random_bits(random) % 2) m[n].swell = random_between(random, -3e-6, 3e-6);
        y->count[k] = n + 1;
    }
}

/* The distance in the world at a time: all that a map does beside turning is to stretch. */
static long double distance_at(const pair_trial *y, long double t)
{
    long double x[3], stretch[2] = {1, 1};
    for (int i = 0; i < 3; ++i) x[i] = y->symmetry[0].center[i];
    for (size_t k = 0; k < y->count[0]; ++k) apply(&y->map[0][k], t, x);
    for (size_t k = y->count[1]; k-- > 0;) undo(&y->map[1][k], t, x);
    for (int k = 0; k < 2; ++k)
        for (size_t j = 0; j < y->count[k]; ++j) stretch[k] *= 1 + y->map[k][j].swell * t * t;
    const orbit at = orbit_of(&y->symmetry[1], x);
    const long double from_center = stretch[1] * off(&y->symmetry[1], &at);
    return y->symmetry[0].is_closed ? from_center - stretch[0] : from_center;
}

static void judge_pair(const pair_trial *y, double slip, double factor, uint64_t *random, tally *of)
{
    const long double then = distance_at(y, y->times.lo[2]);
    if (!(slip < INFINITY)) return;
    of->known += 1;
    of->exact += slip < 0x1p-36;
    for (int k = 0; k < POINTS; ++k) {
        const double t = random_between(random, y->times.lo[2], y->times.hi[2]);
        const long double shown = fabsl(distance_at(y, t) - then);
        of->judged += 1;
        of->refuted += shown > factor * slip + 0x1p-46L;
        if (slip > 0x1p-30 && shown / slip > of->sharpest) of->sharpest = (double)(shown / slip);
    }
}

static tally try_pairs(double factor)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    for (int n = 0; n < suite_times(CASES); ++n) {
        pair_trial y;
        surface *s[2];
        imp_model bare[2][3];
        double slip;
        int asked;
        draw_pair(&random, &y);
        for (int k = 0; k < 2; ++k) {
            motion *maps[CHAIN];
            for (size_t j = 0; j < y.count[k]; ++j) maps[j] = &y.map[k][j];
            s[k] = compose(&y.symmetry[k], maps, y.count[k]);
            for (int i = 0; i < 3; ++i) {
                const double c = y.symmetry[k].center[i], r = k == 0 ? y.reach : i < 2 ? 3 : 1;
                bare[k][i] = imp_between(c - r, c + r);
            }
        }
        const surface *const both[2] = {s[0], s[1]};
        ck_assert_int_eq(
            surface_pair_slip(both, true, bare, &y.times, y.times.lo[2], &slip, &asked),
            IMP_STATUS_OK);
        judge_pair(&y, slip, factor, &random, &of);
        surface_free(s[0]);
        surface_free(s[1]);
    }
    return of;
}

START_TEST(no_pair_comes_nearer_than_by_its_slip)
{
    const tally of = try_pairs(1);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(4 * of.known > suite_times(CASES), "%d are known", of.known);
    ck_assert_msg(100 * of.exact > suite_times(CASES), "%d are exact", of.exact);
    ck_assert_int_gt(try_pairs(of.sharpest / 2).refuted, 0);
}
END_TEST

static size_t two(const void *self)
{
    (void)self;
    return 2;
}

static const void *piece_of(const void *self, size_t k) { return (const imp_symmetry *)self + k; }

/* The slip of a surface of two pieces and one that has no closed symmetry, of which one turns about
 * the z axis: the first, or else the second. */
static double slip_of_turn(const imp_symmetry pieces[2], bool is_first)
{
    imp_surface_type many = target;
    imp_symmetry open = ball();
    motion spin = {.rate = 1}, *const none[] = {&spin};
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    imp_model bare[2][3];
    double slip;
    int asked;
    many.piece_count = two;
    many.piece = piece_of;
    for (int i = 0; i < 3; ++i) bare[0][i] = bare[1][i] = imp_between(-12, 12);
    surface *closed = surface_new(&many, (void *)(uintptr_t)pieces);
    surface *other = compose(&open, none, 0);
    const surface *const both[2] = {other, closed};
    ck_assert_int_eq(surface_add_map(is_first ? closed : other, &exactly, &spin), IMP_SUCCESS);
    ck_assert_int_eq(surface_divide(closed), IMP_SUCCESS);
    ck_assert_int_eq(surface_pair_slip(both, true, bare, &times, 0, &slip, &asked), IMP_STATUS_OK);
    surface_free(closed);
    surface_free(other);
    return slip;
}

static double slip_of_two(const imp_symmetry pieces[2]) { return slip_of_turn(pieces, true); }

START_TEST(a_surface_of_pieces_turns_within_itself_if_all_of_them_do)
{
    const imp_symmetry wheel = {.kind = IMP_SYMMETRY_ABOUT_LINE, .is_closed = 1, .axis = {0, 0, 1}};
    imp_symmetry higher = wheel, across = wheel, globe = {.kind = IMP_SYMMETRY_ABOUT_POINT};
    imp_symmetry beside = wheel, oblique = wheel, open = wheel, screw = wheel, far_globe;
    higher.center[2] = 9;
    across.kind = IMP_SYMMETRY_ACROSS_LINE;
    globe.is_closed = 1;
    globe.center[2] = -2;
    beside.center[0] = 0x1p-60;
    oblique.axis[0] = 0x1p-60;
    open.is_closed = 0;
    screw.kind = IMP_SYMMETRY_SCREW_RIGHT;
    far_globe = globe;
    far_globe.center[1] = 1;
    const imp_symmetry *const within[] = {&wheel, &higher, &across, &globe}, *const beyond[] = {
                                                                                 &beside, &oblique,
                                                                                 &open, &screw,
                                                                                 &far_globe};
    for (int k = 0; k < 4; ++k) {
        ck_assert_double_lt(slip_of_two((imp_symmetry[2]){wheel, *within[k]}), 1e-12);
        ck_assert_double_lt(slip_of_two((imp_symmetry[2]){*within[k], wheel}), 1e-12);
    }
    for (int k = 0; k < 5; ++k) {
        ck_assert(slip_of_two((imp_symmetry[2]){wheel, *beyond[k]}) == INFINITY);
        ck_assert(slip_of_two((imp_symmetry[2]){*beyond[k], wheel}) == INFINITY);
    }
    ck_assert(slip_of_two((imp_symmetry[2]){globe, far_globe}) == INFINITY);
}
END_TEST

START_TEST(what_is_closed_but_for_a_slack_slips_by_it)
{
    const imp_symmetry wheel = {.kind = IMP_SYMMETRY_ABOUT_LINE, .is_closed = 1, .axis = {0, 0, 1}};
    imp_symmetry loose = wheel;
    loose.is_closed |= IMP_SYMMETRY_NEARLY;
    const imp_symmetry some[3][2] = {{loose, wheel}, {wheel, loose}, {loose, loose}};
    const imp_symmetry none[2] = {wheel, wheel};
    const double slack = IMP_NEARLY_SLACK * 41.56; /* 24 3^(1/2): the diagonal of the box */
    for (int k = 0; k < 2; ++k) {
        const double exact = slip_of_turn(none, k == 0);
        ck_assert_double_lt(exact, 1e-12);
        for (int j = 0; j < 3; ++j) {
            ck_assert_double_ge(slip_of_turn(some[j], k == 0), exact + slack);
            ck_assert_double_lt(slip_of_turn(some[j], k == 0), exact + 1.001 * slack);
        }
    }
}
END_TEST

SUITE_MAIN("slip_pairs", no_pair_comes_nearer_than_by_its_slip,
           a_surface_of_pieces_turns_within_itself_if_all_of_them_do,
           what_is_closed_but_for_a_slack_slips_by_it)
