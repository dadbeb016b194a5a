/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/glance.h"
#include "tests/support/chain_helpers.h"

/* What a glance at two surfaces denies, no bound of a slip allows. */

typedef struct glance_tally {
    int denied, kept, refuted;
    double sharpest; /* the greatest part of a slip that a glance has shown */
} glance_tally;

/* Notes a bound of a slip, and what glances say it is at least. */
static void judge(double slip, double least, glance_tally *of)
{
    of->denied += least > 0x1p-10;
    if (!(slip < INFINITY)) return;
    of->kept += least < 0x1p-40;
    of->refuted += least > slip + 0x1p-40;
    if (slip > 0x1p-20 && least / slip > of->sharpest) of->sharpest = least / slip;
}

static void draw_closed(uint64_t *random, imp_symmetry *s)
{
    *s = draw_symmetry(random);
    s->kind = random_bits(random) % 2 ? IMP_SYMMETRY_ABOUT_POINT : IMP_SYMMETRY_ABOUT_LINE;
    s->is_closed = IMP_SYMMETRY_CLOSED;
}

/* Glances at a surface that is closed about a point or a line. */
static void glance_at(const surface *s, double from, double to, surface_glance *seen)
{
    glance_middle middle;
    ck_assert_int_eq(surface_find_middle(s, &middle), IMP_STATUS_OK);
    ck_assert(middle.is_closed);
    surface_glance_at(s, &middle, from, to, seen);
}

static double half_diagonal(const double lo[3], const double hi[3])
{
    double square = 0;
    for (int i = 0; i < 3; ++i) square += (hi[i] - lo[i]) * (hi[i] - lo[i]);
    return 0.5 * sqrt(square);
}

/* Slips along b, and of its axis, against glances times `factor`. */
static glance_tally try_all(double factor)
{
    uint64_t random = suite_seed();
    glance_tally of = {.denied = 0};
    for (int n = 0; n < suite_times(CASES); ++n) {
        imp_symmetry own, other;
        chain of_a, of_b;
        draw_closed(&random, &own);
        draw_closed(&random, &other);
        const imp_region times = draw_times(&random);
        draw_chain(&random, own.center, &of_a);
        draw_chain(&random, other.center, &of_b);
        surface *a = compose_exactly(&own, &of_a), *b = compose_exactly(&other, &of_b);
        surface_glance seen[2];
        imp_model bare[3];
        double slip, lo[3], hi[3];
        glance_at(a, times.lo[2], times.hi[2], &seen[0]);
        glance_at(b, times.lo[2], times.hi[2], &seen[1]);
        for (int i = 0; i < 3; ++i) {
            bare[i] = imp_between(own.center[i] - 1, own.center[i] + 1);
            lo[i] = random_between(&random, -4, 0), hi[i] = random_between(&random, 0, 4);
        }
        const double moment = random_between(&random, times.lo[2], times.hi[2]);
        ck_assert_int_eq(surface_slip(a, b, bare, &times, moment, 0, &slip), IMP_STATUS_OK);
        judge(slip, factor * glances_vary(&seen[0], &seen[1]), &of);
        for (int is_bare = 0; is_bare < 2; ++is_bare) {
            const carry_base base = {moment, is_bare == 1};
            ck_assert_int_eq(surface_carry_slip(b, lo, hi, &times, &base, &slip), IMP_STATUS_OK);
            judge(slip, factor * glance_turns(&seen[1]) * half_diagonal(lo, hi), &of);
        }
        surface_free(a);
        surface_free(b);
    }
    return of;
}

START_TEST(a_slip_is_no_less_than_what_glances_show)
{
    const glance_tally of = try_all(1);
    ck_assert_msg(of.refuted == 0, "%d slips are smaller than what is seen", of.refuted);
    ck_assert_msg(of.sharpest > 0.4, "%g of a slip is seen at most", of.sharpest);
    ck_assert_msg(5 * of.denied > suite_times(CASES), "%d are seen", of.denied);
    ck_assert_msg(5 * of.kept > suite_times(CASES), "%d are not denied", of.kept);
    ck_assert_int_gt(try_all(2.5).refuted, 0);
}
END_TEST

/* A ball and a torus, whose middle is `beside` from the axis of the ring that both turn about. */
static bool is_off_line(double beside, double most)
{
    imp_symmetry ring = {.kind = IMP_SYMMETRY_ABOUT_LINE, .is_closed = 1, .axis = {0, 0, 3}};
    imp_symmetry round = {.kind = IMP_SYMMETRY_ABOUT_POINT, .is_closed = 1};
    const double middle[3] = {0, 0, 0};
    motion spin = spin_about(middle, 2), *const maps[] = {&spin};
    surface_glance seen[2];
    round.center[0] = beside, round.center[2] = 5;
    surface *a = compose(&ring, maps, 1), *b = compose(&round, maps, 1);
    glance_at(a, 0, 1, &seen[0]);
    glance_at(b, 0, 1, &seen[1]);
    surface_free(a);
    surface_free(b);
    ck_assert(seen[0].has_axis && !seen[1].has_axis);
    ck_assert(!glances_part(&seen[0], &seen[1]));
    return glances_are_off_line(&seen[0], &seen[1], most);
}

START_TEST(a_middle_on_the_line_is_not_off_it)
{
    ck_assert(!is_off_line(0, 0));
    ck_assert(!is_off_line(0.5, 0.5));
    ck_assert(is_off_line(0.5, 0.49));
}
END_TEST

START_TEST(surfaces_that_drift_apart_are_told_from_those_that_turn)
{
    imp_symmetry s = ball();
    motion drift = {.way = {1, 0, 0}},
           spin = {.rate = 2}, *const moves[] = {&drift}, *const turns[] = {&spin};
    surface_glance seen[3];
    s.is_closed = 1;
    surface *of[3] = {compose(&s, moves, 1), compose(&s, turns, 1), NULL};
    s.center[1] = 3;
    of[2] = compose(&s, turns, 1);
    for (int k = 0; k < 3; ++k) glance_at(of[k], 0, 1, &seen[k]);
    ck_assert(glances_part(&seen[0], &seen[2]));
    ck_assert(!glances_part(&seen[1], &seen[2]));
    for (int k = 0; k < 3; ++k) surface_free(of[k]);
}
END_TEST

SUITE_MAIN("glances", a_slip_is_no_less_than_what_glances_show, a_middle_on_the_line_is_not_off_it,
           surfaces_that_drift_apart_are_told_from_those_that_turn)
