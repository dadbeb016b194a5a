/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/survey_helpers.h"

/* Surveys that end early, are saved, and go on. */

/* --- Going on --------------------------------------------------------------------------------- */

/* Asks in steps of a few boxes, each by a survey that goes on from the text of the one before. */
static answer survey_in_parts(imp_scene *scene, const imp_clearance_options *asked, size_t *parts)
{
    char *text = NULL;
    for (*parts = 1;; ++*parts) {
        imp_error error;
        imp_survey_options how = imp_survey_options_default();
        imp_options options = imp_options_default(scene);
        answer found = {.contact = {.struct_size = sizeof found.contact},
                        .near = {.struct_size = sizeof found.near},
                        .state = {.struct_size = sizeof found.state}};
        options.gamma = 1e-3;
        how.resume = text;
        imp_survey *s = imp_survey_new(scene, &options, asked, &how, &error);
        ck_assert_msg(s != NULL, "%s", error.text);
        free(text);
        ck_assert_int_eq(imp_survey_step(s, 7, &error), IMP_SUCCESS);
        text = imp_survey_save(s, &error);
        ck_assert_ptr_nonnull(text);
        ck_assert_int_eq(imp_survey_get_state(s, &found.state, &error), IMP_SUCCESS);
        found.has_values = imp_survey_values(s, found.values);
        ck_assert_int_eq(asked == NULL ? imp_survey_get_result(s, &found.contact, &error)
                                       : imp_survey_get_clearance(s, &found.near, &error),
                         IMP_SUCCESS);
        imp_survey_free(s);
        if (found.state.reason == IMP_REASON_RUNNING) continue;
        free(text);
        return found;
    }
}

START_TEST(a_survey_goes_on_from_a_saved_one_to_the_same_bits)
{
    imp_scene *scene = scene_of(ARMS("[-1,1]", "[-1,0.9]"));
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = 0.1;
    size_t parts;
    const answer whole = survey(scene, 1e-3, &asked, NULL);
    const answer found = survey_in_parts(scene, &asked, &parts);
    ck_assert_uint_gt(parts, 2);
    ck_assert_uint_eq(found.state.boxes, whole.state.boxes);
    ck_assert_double_eq(found.near.lower, whole.near.lower);
    ck_assert_double_eq(found.near.upper, whole.near.upper);
    ck_assert_double_eq(found.near.a.u, whole.near.a.u);
    ck_assert_mem_eq(found.near.b.point, whole.near.b.point, sizeof whole.near.b.point);
    ck_assert_mem_eq(found.values, whole.values, 2 * sizeof(double));
    imp_scene_free(scene);
}
END_TEST

/* Each text differs from a saved one in one place. */
START_TEST(a_text_that_no_survey_saved_is_refused)
{
    static const char *const wrong[][2] = {
        {"{", ""}, /* no JSON */
        {"\"question\":[", "\"question\":[0,"},
        {"\"made\":", "\"made\":-"},
        {"\"boxes\":", "\"boxes\":-1,\"x\":"},
        {"\"waiting\":[[", "\"waiting\":[["
                           "null,0,9,1,0,0,0,0],["},             /* a pair that is not there */
        {"\"waiting\":[[", "\"waiting\":[[0,0,0,1,-2,0,0,0],["}, /* outside the ranges */
        {"\"waiting\":[[", "\"waiting\":[[0,0,0,2,0,0,0,0],["},  /* more than all */
        {"\"waiting\":[[", "\"waiting\":[7,["},
        {"\"known\":{", "\"known\":{\"x\":"}};
    imp_scene *scene = scene_of(ARMS("[-1,1]", "[-1,1]"));
    imp_clearance_options asked = imp_clearance_options_default();
    imp_options options = imp_options_default(scene);
    imp_survey_options how = imp_survey_options_default();
    imp_error error;
    imp_survey *s = imp_survey_new(scene, &options, &asked, &how, &error);
    ck_assert_int_eq(imp_survey_step(s, 3, &error), IMP_SUCCESS);
    char *text = imp_survey_save(s, &error);
    imp_survey_free(s);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        const char *at = strstr(text, wrong[k][0]);
        ck_assert_msg(at != NULL, "%s in %s", wrong[k][0], text);
        char *other = NULL;
        ck_assert_int_gt(asprintf(&other, "%.*s%s%s", (int)(at - text), text, wrong[k][1],
                                  at + strlen(wrong[k][0])),
                         0);
        how.resume = other;
        ck_assert_msg(imp_survey_new(scene, &options, &asked, &how, &error) == NULL, "%s", other);
        ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
        ck_assert_msg(strncmp(error.text, "resume: ", 8) == 0, "%s", error.text);
        free(other);
    }
    free(text);
    imp_scene_free(scene);
}
END_TEST

/* --- What is wrong ---------------------------------------------------------------------------- */

/* What is proved of an ended survey holds, and it goes on where it ended. */
START_TEST(a_survey_ends_at_a_limit_of_pairs)
{
    imp_error error;
    imp_scene *scene = scene_of(ARMS("[-1,1]", "[-1,1]"));
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    for (uint64_t pairs = 1; pairs < 2000; pairs += 1 + pairs / 2) {
        imp_clearance found = {.struct_size = sizeof found};
        options.max_pairs = pairs;
        imp_survey *s = imp_survey_new(scene, &options, &asked, NULL, &error);
        ck_assert_msg(s != NULL, "%s", error.text);
        ck_assert_int_eq(imp_survey_step(s, 0, &error), IMP_SUCCESS);
        ck_assert_int_eq(imp_survey_get_clearance(s, &found, &error), IMP_SUCCESS);
        ck_assert_int_eq(found.reason, IMP_REASON_PAIRS);
        ck_assert_uint_ge(found.stats.pairs, pairs);
        ck_assert_uint_le(found.stats.pairs, pairs + 100);
        ck_assert_double_le(found.lower, 0.1);
        ck_assert_double_ge(found.upper, 0.1);
        imp_survey_free(s);
    }
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_survey_that_is_cancelled_goes_on)
{
    imp_error error;
    imp_scene *scene = scene_of(ARMS("[-1,1]", "[-1,1]"));
    const imp_options options = imp_options_default(scene);
    imp_result found = {.struct_size = sizeof found};
    imp_survey *s = imp_survey_new(scene, &options, NULL, NULL, &error);
    ck_assert_msg(s != NULL, "%s", error.text);
    imp_survey_cancel(s);
    ck_assert_int_eq(imp_survey_step(s, 0, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_survey_get_result(s, &found, &error), IMP_SUCCESS);
    ck_assert_int_eq(found.reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(imp_survey_step(s, 0, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_survey_get_result(s, &found, &error), IMP_SUCCESS);
    ck_assert_int_eq(found.verdict, IMP_VERDICT_CLEAR);
    imp_survey_free(s);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_text_that_no_survey_saved_is_refused,
        a_survey_goes_on_from_a_saved_one_to_the_same_bits,
        a_survey_ends_at_a_limit_of_pairs,
        a_survey_that_is_cancelled_goes_on,
    };
    return suite_main_with("survey_state", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
