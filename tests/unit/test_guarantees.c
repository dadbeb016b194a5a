/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/scene_variants.h"

#include <impinge/baseline.h>

/* The promises to the letter: before t_lower nothing is nearer than gamma_clear, not even by a
 * thousandth of it, and what is called clear is that far apart throughout.
 *
 * The judge is a contact itself: its witness is two points, evaluated. A question about times
 * before t_lower with a gamma just below gamma_clear may be answered in any way but by a contact.
 */

static const double almost = 0.999;

/* Asks the same of [start, end] with gamma almost at gamma_clear that `r` proves. */
static void check_proved(imp_registry *registry, const question *asked, const imp_result *r,
                         double start, double end)
{
    question judge = *asked;
    judge.baseline = IMP_BASELINE_NONE;
    judge.t_start = start;
    judge.t_end = end;
    judge.gamma = almost * r->gamma_clear;
    judge.gamma_clear = almost * judge.gamma;
    const imp_result found = ask_in(registry, &judge);
    ck_assert_msg(found.verdict != IMP_VERDICT_CONTACT,
                  "t_lower %.17g for gamma_clear %g, but a gap of %g at %.17g", r->t_lower,
                  r->gamma_clear, found.gap, found.t);
}

static void check_before(imp_registry *registry, const question *asked, const imp_result *r)
{
    const double parts[] = {0.3, 0.9, 0.99, 0.9999, 0.999999, 1 - 1e-9};
    if (!(r->t_lower > 0)) return;
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
        check_proved(registry, asked, r, parts[k] * r->t_lower, parts[k] * r->t_lower);
    check_proved(registry, asked, r, 0, nextafter(r->t_lower, 0));
}

/* With clearances from none to almost gamma. */
static void keep_clearance(imp_registry *registry, const ladder *l)
{
    const double shares[] = {0.02, 0.5, 0.95};
    telling told = tell(l->about, &plain);
    for (int rung = -2; rung < 2; ++rung)
        for (int k = 0; k < 3; ++k) {
            question q = question_of(l->about, &plain, &told, rung);
            q.gamma_clear = shares[k] * q.gamma;
            const imp_result r = ask_in(registry, &q);
            ck_assert_int_ne(r.verdict, IMP_VERDICT_UNDECIDED);
            check_before(registry, &q, &r);
        }
    untell(&told);
}

START_TEST(before_t_lower_nothing_is_nearer_than_the_clearance)
{
    for_each_setting(keep_clearance);
}
END_TEST

START_TEST(nor_in_what_was_proved_when_a_budget_ended)
{
    imp_registry *registry = query_registry();
    const setting *s = setting_of("tori");
    telling told = tell(s, &plain);
    for (uint64_t pairs = 20; pairs < 3000; pairs *= 3) {
        question q = question_of(s, &plain, &told, 0);
        q.gamma_clear = 0.9 * q.gamma;
        q.max_pairs = pairs;
        const imp_result r = ask_in(registry, &q);
        check_before(registry, &q, &r);
    }
    untell(&told);
    imp_registry_free(registry);
}
END_TEST

START_TEST(the_papers_method_keeps_the_clearance_too)
{
    imp_registry *registry = query_registry();
    const char *const names[] = {"spheres", "patches"};
    for (int k = 0; k < 8; ++k) {
        const setting *s = setting_of(names[k / 4]);
        telling told = tell(s, &plain);
        question q = question_of(s, &plain, &told, 0);
        q.baseline = k % 2 ? IMP_BASELINE_SPHERES : IMP_BASELINE_BOXES;
        q.gamma = k / 2 % 2 ? 0.3 : 0.6;
        q.gamma_clear = 0.9 * q.gamma;
        q.max_pairs = 300000;
        const imp_result r = ask_in(registry, &q);
        ck_assert_double_gt(r.t_lower, 0.05);
        check_before(registry, &q, &r);
        untell(&told);
    }
    imp_registry_free(registry);
}
END_TEST

/* The setting "miss" comes as near as 0.01, at t = 0.5. */
START_TEST(a_near_miss_is_clear_just_below_its_gap_and_contact_just_above)
{
    imp_registry *registry = query_registry();
    telling told = tell(setting_of("miss"), &plain);
    for (double share = 1e-2; share > 1e-7; share /= 10) {
        question q = {.a = told.a, .b = told.b, .gamma = 0.01 * (1 - share)};
        q.gamma_clear = q.gamma * (1 - share);
        ck_assert_int_eq(ask_in(registry, &q).verdict, IMP_VERDICT_CLEAR);
        q.gamma_clear = 0.01 * (1 + share);
        q.gamma = q.gamma_clear * (1 + share);
        const imp_result r = ask_in(registry, &q);
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        ck_assert_double_le(r.t, 0.5);
        check_before(registry, &q, &r);
    }
    untell(&told);
    imp_registry_free(registry);
}
END_TEST

/* Boxes alone could part them: the first look, before any node is split. */
START_TEST(bodies_along_an_axis_are_passed_over_only_beyond_the_clearance)
{
    imp_registry *registry = query_registry();
    const double gamma_clear = 0.25, gamma = 0.26;
    for (int k = 0; k < 12; ++k) {
        char b[100];
        double x[3] = {0, 0, 0};
        const double gap = k / 6 ? 1.001 * gamma : 0.999 * gamma_clear;
        x[k / 2 % 3] = (k % 2 ? -1 : 1) * (2 + gap);
        snprintf(b, sizeof b, "sphere center=%.17g,%.17g,%.17g", x[0], x[1], x[2]);
        question q = {.a = "sphere", .b = b, .gamma = gamma, .gamma_clear = gamma_clear};
        const imp_result r = ask_in(registry, &q);
        ck_assert_int_eq(r.verdict, k / 6 ? IMP_VERDICT_CLEAR : IMP_VERDICT_CONTACT);
    }
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("guarantees", before_t_lower_nothing_is_nearer_than_the_clearance,
           nor_in_what_was_proved_when_a_budget_ended, the_papers_method_keeps_the_clearance_too,
           a_near_miss_is_clear_just_below_its_gap_and_contact_just_above,
           bodies_along_an_axis_are_passed_over_only_beyond_the_clearance)
