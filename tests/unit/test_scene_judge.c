/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/fuzz/scene_judge.h"
#include "tests/support/built_plugins.h"
#include "tests/support/suite.h"

#include <signal.h>

/* The judge of the fuzz target `scene` ends the process when an answer is false: each false answer
 * here does, the true ones do not. */

static const char *const ball = "sphere radius=0.5 ! translate velocity=1,0,0";
static const char *const wall = "sphere radius=0.5 center=1.5,0,0";

static imp_registry *registry;
static imp_scene *scene;
static imp_options options;

static imp_result solved(const char *a, const char *b)
{
    imp_error error;
    registry = built_registry();
    scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    options = imp_options_default(scene);
    options.gamma = 1e-3;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_SUCCESS);
    return r;
}

static void judge(const imp_result *r)
{
    scene_judge(scene, &options, r, 1);
    scene_judge_by_clearance(scene, &options, r);
}

static void close_scene(void)
{
    imp_scene_free(scene);
    imp_registry_free(registry);
}

START_TEST(true_answers_pass)
{
    const imp_result contact = solved(ball, wall);
    ck_assert_int_eq(contact.verdict, IMP_VERDICT_CONTACT);
    judge(&contact);
    close_scene();
    const imp_result clear = solved("sphere", "sphere center=0,0,3");
    ck_assert_int_eq(clear.verdict, IMP_VERDICT_CLEAR);
    judge(&clear);
    close_scene();
}
END_TEST

START_TEST(contact_called_clear_is_found_by_sampling)
{
    imp_result r = solved("sphere", "sphere center=1,0,0");
    r.verdict = IMP_VERDICT_CLEAR, r.t_lower = r.t_end, r.t = r.gap = NAN;
    r.gamma = 0.2, r.gamma_clear = 0.1;
    scene_judge(scene, &options, &r, 1);
}
END_TEST

START_TEST(contact_called_clear_is_found_by_another_search)
{
    imp_result r = solved(ball, wall);
    r.verdict = IMP_VERDICT_CLEAR, r.t_lower = r.t_end, r.t = r.gap = NAN;
    scene_judge_by_clearance(scene, &options, &r);
}
END_TEST

START_TEST(clear_called_contact_is_found)
{
    imp_result r = solved("sphere", "sphere center=0,0,3");
    r.verdict = IMP_VERDICT_CONTACT, r.gap = 0;
    scene_judge_by_clearance(scene, &options, &r);
}
END_TEST

START_TEST(a_witness_elsewhere_is_found)
{
    imp_result r = solved(ball, wall);
    r.b.point[1] += 1e-9;
    scene_judge(scene, &options, &r, 1);
}
END_TEST

START_TEST(a_gap_that_is_not_the_witness_s_is_found)
{
    imp_result r = solved(ball, wall);
    r.gap /= 2;
    scene_judge(scene, &options, &r, 1);
}
END_TEST

START_TEST(a_witness_before_t_lower_is_found)
{
    imp_result r = solved(ball, wall);
    r.t_lower = r.t_end;
    scene_judge(scene, &options, &r, 1);
}
END_TEST

START_TEST(a_normal_that_points_backwards_is_found)
{
    imp_result r = solved(ball, wall);
    for (int k = 0; k < 3; ++k) r.normal[k] = -r.normal[k];
    scene_judge(scene, &options, &r, 1);
}
END_TEST

START_TEST(a_reason_that_does_not_fit_is_found)
{
    imp_result r = solved("sphere", "sphere center=0,0,3");
    r.reason = IMP_REASON_PAIRS;
    scene_judge(scene, &options, &r, 1);
}
END_TEST

int main(void)
{
    const TTest *const found[] = {
        contact_called_clear_is_found_by_sampling,
        contact_called_clear_is_found_by_another_search,
        clear_called_contact_is_found,
        a_witness_elsewhere_is_found,
        a_gap_that_is_not_the_witness_s_is_found,
        a_witness_before_t_lower_is_found,
        a_normal_that_points_backwards_is_found,
        a_reason_that_does_not_fit_is_found,
    };
    Suite *suite = suite_create("scene_judge");
    TCase *answers = tcase_create("answers");
    tcase_add_test(answers, true_answers_pass);
    for (size_t k = 0; k < sizeof found / sizeof *found; ++k)
        tcase_add_test_raise_signal(answers, found[k], SIGABRT);
    suite_add_tcase(suite, answers);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
