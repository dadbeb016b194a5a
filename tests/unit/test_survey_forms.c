/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/survey_helpers.h"

/* Least distances over all values of parameters, against closed forms. */

/* Brackets the least distance, which is `exact`, to one part in 50. */
static void brackets(const char *text, double exact)
{
    imp_scene *scene = scene_of(text);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = 0.02;
    const answer found = survey(scene, 1e-6, &asked, NULL);
    ck_assert_int_eq(found.near.reason, IMP_REASON_NONE);
    ck_assert_double_le(found.near.lower, exact + 1e-12);
    ck_assert_double_ge(found.near.upper, exact - 1e-12);
    ck_assert_double_ge(found.near.lower, (1 - 0.021) * found.near.upper);
    imp_scene_free(scene);
}

/* A cone whose apex is in the origin, of base radius 1/2 at height 1, in a bore of radius 1 about
 * the z axis. Tilts a about x and b about y turn its axis by the angle c with cos c = cos a cos b;
 * a point of its rim comes as far out as sqrt(5/4) sin(atan(1/2) + c). */
START_TEST(a_cone_with_two_tilts_comes_as_near_to_its_bore_as_its_rim)
{
    const double tilt = acos(cos(0.2) * cos(0.1));
    brackets("{'parameters':{'a':[-0.2,0.2],'b':[-0.1,0.1]},'bodies':["
             "{'surfaces':[{'type':'cone','radius':0.5,'height':-1,'center':[0,0,1]}],"
             "'maps':[{'type':'rotate','axis':[1,0,0],'rate':1,'clock':'a'},"
             "{'type':'rotate','axis':[0,1,0],'rate':1,'clock':'b'}]},"
             "{'surfaces':[{'type':'cylinder','radius':1,'height':8}]}]}",
             1 - sqrt(1.25) * sin(atan(0.5) + tilt));
}
END_TEST

/* A ball of radius 1/4 above the origin, at height 2 + e, and a plane through the origin that is
 * tilted by p about x and then by q about y: their distance is (2 + e) cos p cos q - 1/4. */
START_TEST(a_ball_and_a_plane_under_three_errors_are_as_near_as_the_worst_of_them)
{
    brackets(
        "{'parameters':{'e':[-0.1,0.05],'p':[-0.2,0.1],'q':[-0.1,0.3]},'bodies':["
        "{'surfaces':[{'type':'sphere','radius':0.25,'center':[0,0,2]}],"
        "'maps':[{'type':'translate','velocity':[0,0,1],'clock':'e'}]},"
        "{'surfaces':[{'type':'plane','origin':[-9,-9,0],'edge_u':[18,0,0],'edge_v':[0,18,0]}],"
        "'maps':[{'type':'rotate','axis':[1,0,0],'rate':1,'clock':'p'},"
        "{'type':'rotate','axis':[0,1,0],'rate':1,'clock':'q'}]}]}",
        1.9 * cos(0.2) * cos(0.3) - 0.25);
}
END_TEST

/* An arm of lengths 1 and 0.7 whose elbow turns by b, and whose shoulder by a: its hand is sqrt(1 +
 * 0.49 + 1.4 cos b) from the shoulder at any a, by the law of cosines. */
START_TEST(a_hand_is_as_far_from_its_shoulder_as_the_law_of_cosines_says)
{
    brackets("{'parameters':{'a':[-3,3],'b':[-2.5,1]},'bodies':["
             "{'surfaces':[{'type':'sphere','radius':0.05,'center':[1.7,0,0]}],"
             "'maps':[{'type':'rotate','axis':[0,0,1],'center':[1,0,0],'rate':1,'clock':'b'},"
             "{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'a'}]},"
             "{'surfaces':[{'type':'sphere','radius':0.1}]}]}",
             sqrt(1.49 + 1.4 * cos(2.5)) - 0.15);
}
END_TEST

/* A map that stays at one angle has rates in time that are not 0, but as small as underflow. */
START_TEST(one_query_covers_a_parameter_though_another_map_stays_at_an_angle)
{
    imp_scene *scene = scene_of("{'parameters':{'a':[-3,3]},'bodies':["
                                "{'surfaces':[{'type':'sphere','radius':0.1,'center':[1,0,0]}],"
                                "'maps':[{'type':'rotate','axis':[1,2,3],'angle':[0.5]},"
                                "{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'a'}]},"
                                "{'surfaces':[{'type':'sphere','radius':0.5}],"
                                "'maps':[{'type':'rotate','axis':[1,1,0],'angle':[1]}]}]}");
    const answer found = survey(scene, 1e-6, NULL, NULL);
    ck_assert_int_eq(found.contact.verdict, IMP_VERDICT_CLEAR);
    ck_assert_uint_eq(found.state.boxes, 1);
    imp_scene_free(scene);
}
END_TEST

/* Compares what is proved of a box with the distance at some of its values. */
static void judge_box(void *context, const imp_survey_box *box)
{
    size_t *count = context;
    if (box->verdict != IMP_VERDICT_CLEAR) return;
    *count += 1;
    for (int i = 0; i <= 100; ++i)
        for (int j = 0; j <= 4; ++j) {
            const double a = box->lo[0] + (box->hi[0] - box->lo[0]) * i / 100;
            const double b = box->lo[1] + (box->hi[1] - box->lo[1]) * j / 4;
            const double d = hypot(2.7 - cos(b) - cos(a), sin(b) + sin(a)) - 0.6;
            ck_assert_msg(d >= box->lower, "%.17g at %.17g, %.17g, but %.17g is proved", d, a, b,
                          box->lower);
        }
}

/* The least distance, 0.1, is inside of the ranges, so that no corner and no first middle shows
 * it: boxes are closed at an upper bound that is too high, which must not make the lower one so.
 * The third parameter has next to no range, and is there to be moved to its ends. */
START_TEST(a_least_distance_inside_of_the_ranges_is_not_missed)
{
    uint64_t random = suite_seed();
    const int draws = suite_times(12);
    for (int k = 0; k < draws; ++k) {
        char text[1024];
        const double lo[2] = {random_between(&random, -1, 0), random_between(&random, -1, 0)};
        snprintf(text, sizeof text,
                 "{'parameters':{'a':[%.17g,%.17g],'b':[%.17g,%.17g],'c':[-1e-3,1e-3]},'bodies':["
                 "{'surfaces':[{'type':'sphere','radius':0.3,'center':[1,0,0]}],'maps':["
                 "{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'a'}]},"
                 "{'surfaces':[{'type':'sphere','radius':0.3,'center':[-1,0,0]}],'maps':["
                 "{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'b'},"
                 "{'type':'translate','offset':[[2.7,0,0]]},"
                 "{'type':'translate','velocity':[0,0,1],'clock':'c'}]}]}",
                 lo[0], lo[0] + 1, lo[1], lo[1] + 1);
        imp_scene *scene = scene_of(text);
        imp_clearance_options asked = imp_clearance_options_default();
        imp_survey_options how = imp_survey_options_default();
        asked.tolerance = k % 2 == 0 ? 1e-4 : 0.02;
        size_t told = 0;
        how.max_boxes = 150;
        how.sink = judge_box;
        how.sink_context = &told;
        const answer found = survey(scene, 1e-3, &asked, &how);
        if (k % 2 == 1) ck_assert_int_eq(found.near.reason, IMP_REASON_NONE);
        ck_assert_uint_gt(told, 3);
        ck_assert_msg(found.near.lower <= 0.1, "%.17g: %s", found.near.lower, text);
        if (k % 2 == 1) ck_assert_double_ge(found.near.lower, 0.098 - 1e-9);
        ck_assert_double_ge(found.near.upper, 0.1 - 1e-12);
        imp_scene_free(scene);
    }
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {
        {a_least_distance_inside_of_the_ranges_is_not_missed, 1},
        {a_cone_with_two_tilts_comes_as_near_to_its_bore_as_its_rim, 1},
        {a_ball_and_a_plane_under_three_errors_are_as_near_as_the_worst_of_them, 1},
        {a_hand_is_as_far_from_its_shoulder_as_the_law_of_cosines_says, 1},
        {one_query_covers_a_parameter_though_another_map_stays_at_an_angle, 1}};
    return suite_main_loops("survey_forms", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
