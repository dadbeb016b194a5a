/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/clearance_helpers.h"

/* Whether a distance is kept: verdicts beside brackets, and the effort until they are known. */

/* --- Something is required -------------------------------------------------------------------- */

START_TEST(a_distance_that_is_kept_holds)
{
    imp_registry *registry = query_registry();
    const double kept[] = {1e-9, 0.1, 0.4999, 0.5 * (1 - 1e-7)};
    for (int k = 0; k < 4; ++k) {
        const imp_clearance r = measure_pair(registry, still, passing, 1e-3, kept[k]);
        ck_assert_msg(r.verdict == IMP_REQUIREMENT_HOLDS && isnan(r.t_violated) &&
                          r.lower >= kept[k] * (1 - 1e-6),
                      "%.17g: verdict %d, [%g, %g]", kept[k], (int)r.verdict, r.lower, r.upper);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(a_violation_is_the_earliest)
{
    imp_registry *registry = query_registry();
    const double required[] = {0.5001, 0.6, 1, 1.5};
    for (int k = 0; k < 4; ++k) {
        const double d = required[k];
        const imp_clearance r = measure_pair(registry, still, passing, 1e-3, d);
        const double t = (3 - sqrt((d + 1.5) * (d + 1.5) - 4)) / 6;
        ck_assert_int_eq(r.verdict, IMP_REQUIREMENT_VIOLATED);
        ck_assert_msg(r.t_violated <= t + 1e-4 && r.t_violated >= t - 1e-12,
                      "%g: at %.17g, not %.17g", d, r.t_violated, t);
        ck_assert(r.gap_violated > d * (1 - 1e-3) && r.upper - r.lower <= 1e-3 * r.upper);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(in_the_band_both_answers_are_right)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    for (int k = 0; k <= 10; ++k) {
        const double d = 0.5 * (1 + 1e-7 * k);
        imp_clearance r[2];
        decide(scene, &options, d, &r[0], &r[1]);
        for (int n = 0; n < 2; ++n)
            if (r[n].verdict == IMP_REQUIREMENT_VIOLATED)
                ck_assert(r[n].upper <= d && r[n].t_violated <= r[n].t);
            else
                ck_assert(r[n].verdict == IMP_REQUIREMENT_HOLDS && r[n].lower >= d * (1 - 1e-6) &&
                          r[n].lower <= 0.5);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(contact_violates_what_is_smaller_than_gamma)
{
    imp_registry *registry = query_registry();
    const imp_clearance r = measure_pair(
        registry, "sphere", "sphere center=3,0,0 ! translate velocity=-2,0,0", 1e-3, 1e-7);
    ck_assert(r.verdict == IMP_REQUIREMENT_VIOLATED && r.upper <= 1e-7);
    ck_assert_double_le(fabs(r.t_violated - 0.5), 1e-6);
    imp_registry_free(registry);
}
END_TEST

/* --- The search ends as soon as it is decided ------------------------------------------------- */

START_TEST(what_is_decided_is_what_a_narrow_bracket_decides)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    const double required[] = {1e-9, 0.1, 0.25, 0.45, 0.4999, 0.5001, 0.6, 1, 1.5, 3};
    for (int k = 0; k < 10; ++k) {
        const double d = required[k];
        imp_clearance narrow, decided;
        decide(scene, &options, d, &narrow, &decided);
        ck_assert_int_eq(decided.verdict,
                         d < 0.5 ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_VIOLATED);
        ck_assert_int_eq(narrow.verdict, decided.verdict);
        ck_assert(decided.lower <= 0.5 && decided.upper >= 0.5 * (1 - 1e-15));
        if (d < 0.5)
            ck_assert(decided.lower >= d * (1 - 1e-6) && isnan(decided.t_violated));
        else
            ck_assert(decided.upper <= d && decided.t_violated == narrow.t_violated);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* Close to what the scene keeps: decided the same way, by as many pairs, about. */
static void decide_beside(imp_registry *registry, const ladder *l)
{
    imp_scene *scene = scene_told(registry, l->about);
    const imp_options options = before_contact(scene, l);
    const imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance known = measure(scene, &options, &asked);
    const double part[] = {0.5, 0.9, 0.99, 1.01, 1.1, 2};
    for (int k = 0; k < 6; ++k) {
        imp_clearance narrow, decided;
        const double required = part[k] * (part[k] < 1 ? known.lower : known.upper);
        decide(scene, &options, required, &narrow, &decided);
        ck_assert_msg(decided.verdict == narrow.verdict &&
                          narrow.verdict ==
                              (part[k] < 1 ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_VIOLATED),
                      "%s: %g", l->about->name, required);
        ck_assert(decided.lower <= known.upper && decided.upper >= known.lower);
        ck_assert_uint_le(decided.stats.pairs, 2 * narrow.stats.pairs + 64);
    }
    imp_scene_free(scene);
}

START_TEST(every_shape_is_decided_the_same_way) { for_each_setting(decide_beside); }
END_TEST

/* Where surfaces slide close to what is required the earliest time takes long, the verdict does
 * not. */
START_TEST(a_budget_that_a_narrow_bracket_fits_in_is_enough_to_decide)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, "cylinder radius=1 height=2 ! translate velocity=0,0,0.5",
                                "cylinder radius=1.01 height=2 ! taper start=1 end=[1,-0.0003]");
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance known = measure(scene, &options, &asked);
    options.max_pairs = 20000;
    ck_assert_uint_lt(known.stats.pairs, options.max_pairs / 4);
    asked.decide = true;
    asked.required = 1.0001 * known.upper;
    const imp_clearance decided = measure(scene, &options, &asked);
    ck_assert_int_eq(decided.verdict, IMP_REQUIREMENT_VIOLATED);
    ck_assert_double_le(decided.upper, asked.required);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* A millionth of it is less than double precision tells apart: no earliest time, but the same
 * verdict. */
START_TEST(contact_decides_what_is_too_small_to_be_timed)
{
    static const char through[] = "sphere center=3,0,0 ! translate velocity=-4,0,0";
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, "sphere", through);
    const imp_options options = imp_options_default(scene);
    const double required[] = {1e-8, 1e-9, 1e-12};
    for (int k = 0; k < 3; ++k) {
        imp_clearance narrow, decided;
        decide(scene, &options, required[k], &narrow, &decided);
        ck_assert(narrow.verdict == IMP_REQUIREMENT_VIOLATED && isnan(narrow.t_violated));
        ck_assert(decided.verdict == IMP_REQUIREMENT_VIOLATED && isnan(decided.t_violated));
        ck_assert(decided.reason == IMP_REASON_RESOLUTION && decided.upper <= required[k]);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(programs_that_know_nothing_of_deciding_get_a_narrow_bracket)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.struct_size = (uint32_t)offsetof(imp_clearance_options, decide);
    asked.required = 0.1;
    asked.decide = true; /* beyond its size */
    const imp_clearance r = measure(scene, &options, &asked);
    ck_assert(r.reason == IMP_REASON_NONE && r.verdict == IMP_REQUIREMENT_HOLDS);
    asked.decide = false;
    ck_assert_int_eq(imp_clearance_options_get_default(&asked, NULL), IMP_SUCCESS);
    ck_assert(asked.required == 0 && !asked.decide);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("clearance_required", a_distance_that_is_kept_holds, a_violation_is_the_earliest,
           in_the_band_both_answers_are_right, contact_violates_what_is_smaller_than_gamma,
           what_is_decided_is_what_a_narrow_bracket_decides, every_shape_is_decided_the_same_way,
           a_budget_that_a_narrow_bracket_fits_in_is_enough_to_decide,
           contact_decides_what_is_too_small_to_be_timed,
           programs_that_know_nothing_of_deciding_get_a_narrow_bracket)
