/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/survey_helpers.h"

/* Surveys of scenes with parameters: what is said of all values holds at each. */

/* --- Closed forms ----------------------------------------------------------------------------- */

static double arms_apart(double a, double b)
{
    return hypot(2.7 - cos(b) - cos(a), -sin(b) - sin(a)) - 0.6;
}

START_TEST(balls_on_two_arms_are_as_near_as_the_law_of_cosines_says)
{
    imp_scene *scene = scene_of(ARMS("[-1,1]", "[-1,1]"));
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = 0.1;
    const answer found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_int_eq(found.near.reason, IMP_REASON_NONE);
    ck_assert_double_le(found.near.lower, 0.1);
    ck_assert_double_ge(found.near.lower, 0.09 - 1e-9);
    ck_assert_double_ge(found.near.upper, 0.1);
    ck_assert_double_ge(found.near.upper + 1e-9, arms_apart(found.values[0], found.values[1]));
    ck_assert_double_eq_tol(found.state.proved, 1, 1e-9);
    imp_scene_free(scene);
}
END_TEST

START_TEST(what_is_required_is_decided_for_all_values)
{
    imp_scene *scene = scene_of(ARMS("[-1,1]", "[-1,1]"));
    imp_clearance_options asked = imp_clearance_options_default();
    asked.decide = true;
    asked.required = 0.08;
    answer found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_int_eq(found.near.verdict, IMP_REQUIREMENT_HOLDS);
    asked.required = 0.12;
    found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_int_eq(found.near.verdict, IMP_REQUIREMENT_VIOLATED);
    ck_assert(found.has_values);
    ck_assert_double_le(arms_apart(found.values[0], found.values[1]), 0.12);
    imp_scene_free(scene);
}
END_TEST

/* A ball falls on a ball on an arm, whose top is highest at an angle of 0. */
START_TEST(the_earliest_contact_is_that_of_the_worst_values)
{
    imp_scene *scene = scene_of(
        "{'parameters':{'a':[-0.5,1],'b':[-0.1,0.1]},'bodies':["
        "{'surfaces':[{'type':'sphere','radius':0.25,'center':[0,0,1]}],"
        "'maps':[{'type':'rotate','axis':[1,0,0],'rate':1,'clock':'a'}]},"
        "{'surfaces':[{'type':'plane','origin':[-2,-2,2],'edge_u':[4,0,0],'edge_v':[0,4,0]}],"
        "'maps':[{'type':'translate','velocity':[0,0,1],'clock':'b'},"
        "{'type':'translate','velocity':[0,0,-1]}]}]}");
    const answer found = survey(scene, 1e-3, NULL, NULL);
    ck_assert_int_eq(found.contact.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq(found.contact.t, found.contact.t_lower);
    /* the plane is at 2 + b - t, the ball's top at cos a + 0.25 */
    ck_assert_double_le(found.contact.t, 0.65);
    ck_assert_double_ge(found.contact.t, 0.65 - 1e-3);
    ck_assert_double_eq_tol(found.values[0], 0, 0.05);
    ck_assert_double_eq_tol(found.values[1], -0.1, 0.002);
    imp_scene_free(scene);
}
END_TEST

/* --- Parameters that nobody names ------------------------------------------------------------- */

#define OFF(ANGLE, OFFSET)                                                                         \
    "{'type':'rotate','axis':[1,0,0],'rate':1,'clock':" ANGLE "},"                                 \
    "{'type':'rotate','axis':[0,1,0],'rate':1,'clock':" ANGLE "},"                                 \
    "{'type':'rotate','axis':[0,0,1],'rate':1,'clock':" ANGLE "},"                                 \
    "{'type':'translate','velocity':[1,0,0],'clock':" OFFSET "},"                                  \
    "{'type':'translate','velocity':[0,1,0],'clock':" OFFSET "},"                                  \
    "{'type':'translate','velocity':[0,0,1],'clock':" OFFSET "}"

/* A ball at height 2 above the centre: a rotation by an angle of at most A and an offset of length
 * at most d bring its centre to x = 2 sin A + d at most. The maps bring it to
 * 2 (cos a sin b cos c + sin a sin c) + d, no farther than 2 (sin A + sin A sin A) + d. */
START_TEST(six_maps_hold_all_displacements_of_a_tolerance)
{
    imp_scene *scene = scene_of(
        "{'bodies':[{'surfaces':[{'type':'sphere','radius':0.25,'center':[0,0,2]}],"
        "'maps':[" OFF(
            "[-0.1,0.1]",
            "[-0.05,0.05]") "]},"
                            "{'surfaces':[{'type':'plane','origin':[1,-4,-4],'edge_u':[0,8,0],"
                            "'edge_v':[0,0,8]}]}]}");
    imp_clearance_options asked = imp_clearance_options_default();
    asked.decide = true;
    asked.required = 1 - 0.25 - 0.05 - 2 * (sin(0.1) + sin(0.1) * sin(0.1)) - 0.05;
    ck_assert_int_eq(survey(scene, 1e-3, &asked, NULL).near.verdict, IMP_REQUIREMENT_HOLDS);
    asked.required = 1 - 0.25 - 0.05 - 2 * sin(0.1) + 1e-9;
    ck_assert_int_eq(survey(scene, 1e-3, &asked, NULL).near.verdict, IMP_REQUIREMENT_VIOLATED);
    imp_scene_free(scene);
}
END_TEST

/* --- Going on --------------------------------------------------------------------------------- */

/* What both hang on moves neither relative to the other. */
START_TEST(a_common_parent_takes_no_part)
{
    imp_scene *scene = scene_of(
        "{'parameters':{'a':[-3,3]},'bodies':["
        "{'name':'base','maps':[{'type':'rotate','axis':[1,2,3],'rate':1,'clock':'a'}]},"
        "{'name':'one','parent':'base','surfaces':[{'type':'sphere','radius':1}]},"
        "{'name':'two','parent':'base','surfaces':[{'type':'sphere','center':[2.1,0,0]}]}]}");
    const answer found = survey(scene, 1e-3, NULL, NULL);
    ck_assert_int_eq(found.contact.verdict, IMP_VERDICT_CLEAR);
    ck_assert_uint_eq(found.state.boxes, 1);
    imp_scene_free(scene);
}
END_TEST

/* A surface that does not exist yet is not asked for its place. */
START_TEST(a_surface_that_does_not_exist_touches_nothing)
{
    static const double times[2][2] = {{0, 5}, {9.5, 11}};
    imp_scene *scene =
        scene_of(FROM_8_TO_9("{'type':'formula','time':[8,9],'x':'u + log(t - 7.9)'}", ""));
    imp_error error;
    imp_result result = {.struct_size = sizeof result};
    imp_survey *s = survey_from(scene, times[_i][0], times[_i][1], &error);
    ck_assert_msg(s != NULL, "%s", error.text);
    ck_assert_int_eq(imp_survey_step(s, 8, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_survey_get_result(s, &result, &error), IMP_SUCCESS);
    ck_assert_int_eq(result.verdict, IMP_VERDICT_CLEAR);
    ck_assert(isnan(result.t_examined[0]) && isnan(result.t_examined[1]));
    imp_survey_free(s);
    imp_scene_free(scene);
}
END_TEST

/* --- What is wrong ---------------------------------------------------------------------------- */

START_TEST(a_query_about_one_pose_is_refused)
{
    imp_error error;
    imp_scene *scene = scene_of(ARMS("[-1,1]", "[-1,1]"));
    const imp_options options = imp_options_default(scene);
    ck_assert_ptr_null(imp_query_new(scene, &options, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
    const double outside[2] = {0, 1.5};
    ck_assert_ptr_null(imp_scene_at(scene, outside, &error));
    ck_assert_ptr_nonnull(strstr(error.text, "parameter 'b': got 1.5"));
    imp_scene_free(scene);
}
END_TEST

START_TEST(bodies_that_cannot_touch_are_refused)
{
    imp_error error;
    imp_scene *scene = scene_of("{'bodies':[{'surfaces':[{'type':'sphere'}]},{'name':'frame'},"
                                "{'surfaces':[{'type':'sphere','center':[1,0,0]}]}]}");
    const imp_options options = imp_options_default(scene);
    imp_survey_options how = imp_survey_options_default();
    how.body[0] = 0;
    for (how.body[1] = 0; how.body[1] < 4; how.body[1] += how.body[1] == 1 ? 2 : 1) {
        ck_assert_ptr_null(imp_survey_new(scene, &options, NULL, &how, &error));
        ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
        ck_assert_ptr_nonnull(strstr(error.text, "body: got "));
    }
    how.body[1] = 2;
    imp_survey *survey = imp_survey_new(scene, &options, NULL, &how, &error);
    ck_assert_msg(survey != NULL, "%s", error.text);
    imp_survey_free(survey);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {
        {balls_on_two_arms_are_as_near_as_the_law_of_cosines_says, 1},
        {what_is_required_is_decided_for_all_values, 1},
        {the_earliest_contact_is_that_of_the_worst_values, 1},
        {six_maps_hold_all_displacements_of_a_tolerance, 1},
        {a_common_parent_takes_no_part, 1},
        {a_surface_that_does_not_exist_touches_nothing, 2},
        {a_query_about_one_pose_is_refused, 1},
        {bodies_that_cannot_touch_are_refused, 1},
    };
    return suite_main_loops("survey", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
