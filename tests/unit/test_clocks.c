/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/survey_helpers.h"

/* Surfaces and maps that follow a parameter or a clock of their own instead of time. */

/* --- Parameters that nobody names ------------------------------------------------------------- */

START_TEST(equal_maps_of_two_bodies_have_two_parameters_of_their_own)
{
    imp_scene *scene =
        scene_of("{'parameters':{'translate#2':[0,1]},'bodies':["
                 "{'surfaces':[{'type':'sphere','radius':0.3}],"
                 "'maps':[{'type':'translate','velocity':[1,0,0],'clock':[-0.1,0.1]}]},"
                 "{'surfaces':[{'type':'sphere','radius':0.3,'center':[0.9,0,0]}],"
                 "'maps':[{'type':'translate','velocity':[1,0,0],'clock':[-0.1,0.1]}]}]}");
    imp_scene_parameter_info info;
    imp_clearance_options asked = imp_clearance_options_default();
    ck_assert_uint_eq(imp_scene_parameter_count(scene), 3);
    ck_assert(imp_scene_parameter(scene, 1, &info));
    ck_assert_str_eq(info.name, "translate#1");
    ck_assert_double_eq(info.hi, 0.1);
    ck_assert(imp_scene_parameter(scene, 2, &info));
    ck_assert_str_eq(info.name, "translate#3"); /* another has the name translate#2 */
    const answer found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_double_le(found.near.lower, 0.1); /* 0.9 - 0.6 - 0.1 - 0.1 */
    ck_assert_double_ge(found.near.lower, 0.1 - 1e-3);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_clock_that_is_no_range_is_refused)
{
    static const char *const wrong[] = {"[1]", "[1,0]", "[0,'a']", "3", "[0,1,2]"};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        char text[300];
        imp_error error;
        snprintf(text, sizeof text,
                 "{'bodies':[{'surfaces':[{'type':'sphere'}],'maps':[{'type':'translate',"
                 "'velocity':[1,0,0],'clock':%s}]}]}",
                 wrong[k]);
        ck_assert_ptr_null(try_scene(text, &error));
        ck_assert_msg(strstr(error.text, "/bodies/0/maps/0/clock: got ") != NULL, "%s", error.text);
    }
}
END_TEST

/* --- Going on --------------------------------------------------------------------------------- */

/* What follows time keeps time where a query takes a parameter for its time, though it rests at the
 * times asked about: it would move at the parameter's values. The balls are 0.5 apart at e = 5. */
START_TEST(what_rests_for_a_while_keeps_time)
{
    imp_scene *scene =
        scene_of("{'time':[0,1],'parameters':{'e':[0,5]},'bodies':["
                 "{'surfaces':[{'type':'sphere','radius':0.5}],'maps':["
                 "{'type':'map-formula','x':'x - max(t - 2, 0)'},"
                 "{'type':'translate','velocity':[1,0,0],'clock':'e'}]},"
                 "{'surfaces':[{'type':'sphere','radius':0.5,'center':[6.5,0,0]}]}]}");
    const imp_clearance_options asked = imp_clearance_options_default();
    const answer found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_double_le(found.near.lower, 0.5);
    ck_assert_double_ge(found.near.upper, 0.5);
    ck_assert_double_le(found.near.upper, 0.51);
    imp_scene_free(scene);
}
END_TEST

/* Nothing is proved of times at which a map is undefined, though the bodies are far apart. */
START_TEST(times_at_which_a_map_is_undefined_are_refused)
{
    imp_error error;
    imp_scene *scene = scene_of(FROM_8_TO_9(
        "{'type':'sphere'}", "{'type':'keyframes','times':[8,9],'positions':[[0,0,0],[1,0,0]]},"));
    ck_assert_ptr_null(survey_from(scene, 7, 9, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_ptr_nonnull(strstr(error.text, "is defined from t = 8 to 9 only"));
    imp_survey *s = survey_from(scene, 8, 9, &error);
    ck_assert_msg(s != NULL, "%s", error.text);
    imp_survey_free(s);
    imp_scene_free(scene);
}
END_TEST

/* --- Clocks ----------------------------------------------------------------------------------- */

START_TEST(the_clock_time_changes_no_bit)
{
    static const char *const clocks[2] = {"", ",'clock':'time'"};
    imp_result found[2];
    for (int k = 0; k < 2; ++k) {
        char text[600];
        snprintf(text, sizeof text,
                 "{'bodies':[{'surfaces':[{'type':'torus','major_radius':1,'minor_radius':0.3%s}],"
                 "'maps':[{'type':'rotate','axis':[1,0,0],'rate':2%s}]},{'surfaces':[{'type':"
                 "'sphere','radius':0.4,'center':[2,0,0]}],'maps':[{'type':'translate','velocity':"
                 "[-2,0,0]%s}]}]}",
                 clocks[k], clocks[k], clocks[k]);
        imp_scene *scene = scene_of(text);
        imp_error error;
        const imp_options options = imp_options_default(scene);
        found[k] = (imp_result){.struct_size = sizeof found[k]};
        ck_assert_int_eq(imp_scene_solve(scene, &options, &found[k], &error), IMP_SUCCESS);
        imp_scene_free(scene);
    }
    /* By member: a struct's padding has any bits. */
    const imp_result *x = &found[0], *y = &found[1];
    ck_assert_int_eq(x->verdict, IMP_VERDICT_CONTACT);
    ck_assert_int_eq(y->verdict, IMP_VERDICT_CONTACT);
    ck_assert(x->t == y->t && x->t_lower == y->t_lower && x->gap == y->gap);
    ck_assert_mem_eq(&x->a, &y->a, sizeof x->a);
    ck_assert_mem_eq(&x->b, &y->b, sizeof x->b);
    ck_assert_mem_eq(x->normal, y->normal, sizeof x->normal);
    ck_assert_uint_eq(x->stats.pairs, y->stats.pairs);
    ck_assert_uint_eq(x->stats.nodes, y->stats.nodes);
    ck_assert_uint_eq(x->stats.peak_heap, y->stats.peak_heap);
    ck_assert_uint_eq(x->stats.witness_searches, y->stats.witness_searches);
}
END_TEST

/* Any type under a clock, of any capabilities, stands where the type stands at that time. */
START_TEST(a_scene_at_values_stands_where_time_would_put_it)
{
    static const char *const of_time =
        "{'bodies':[{'surfaces':[{'type':'bezier','degree':[1,1],'points':[[0,0,0],[0,1,0],"
        "[1,0,0],[1,1,0.5]],'velocities':[[0,0,1],[0,0,1],[0,0,1],[0,1,1]]}],'maps':["
        "{'type':'twist','rate':1},{'type':'rotate','axis':[1,0,1],'rate':2}]}]}";
    static const char *const of_clock =
        "{'parameters':{'p':[0,2]},'bodies':[{'surfaces':[{'type':'bezier','clock':'p',"
        "'degree':[1,1],'points':[[0,0,0],[0,1,0],[1,0,0],[1,1,0.5]],"
        "'velocities':[[0,0,1],[0,0,1],[0,0,1],[0,1,1]]}],'maps':["
        "{'type':'twist','rate':1,'clock':'p'},"
        "{'type':'rotate','axis':[1,0,1],'rate':2,'clock':'p'}]}]}";
    imp_error error;
    imp_scene *time = scene_of(of_time), *clock = scene_of(of_clock);
    const double value = 0.7, p[3] = {0.3, 0.6, value}, q[3] = {0.3, 0.6, -5};
    imp_scene *at = imp_scene_at(clock, &value, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    double x[3], y[3];
    ck_assert_int_eq(imp_scene_eval(time, 0, 0, 1, p, x, NULL, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_scene_eval(at, 0, 0, 1, q, y, NULL, NULL), IMP_SUCCESS);
    ck_assert_mem_eq(x, y, sizeof x);
    imp_model model[3];
    const double lo[3] = {0, 0, -1}, hi[3] = {1, 1, 3};
    ck_assert_int_eq(imp_scene_include(at, 0, 0, lo, hi, model, NULL), IMP_SUCCESS);
    for (int i = 0; i < 3; ++i) {
        ck_assert_double_eq(model[i].rate[2], 0);
        ck_assert_double_le(model[i].lo, x[i]);
        ck_assert_double_ge(model[i].hi, x[i]);
    }
    imp_scene_free(at);
    imp_scene_free(clock);
    imp_scene_free(time);
}
END_TEST

/* --- What is wrong ---------------------------------------------------------------------------- */

typedef struct wrong_scene {
    const char *text, *words;
} wrong_scene;

#define BALL(CLOCK)                                                                                \
    "'bodies':[{'surfaces':[{'type':'sphere'}],'maps':[{'type':'rotate','axis':[0,0,1],'rate':1,"  \
    "'clock':" CLOCK "}]}]}"

static const wrong_scene wrong[] = {
    {"{" BALL("'a'"), "/bodies/0/maps/0/clock: got \"a\", which is not a parameter"},
    {"{'parameters':{'angle':[0,1]}," BALL("'angel'"), "did you mean 'angle'"},
    {"{'parameters':{'a':[0,1]}," BALL("3"), "must be the name of one of the scene's"},
    {"{'parameters':{'a':[1,0]}," BALL("'a'"), "/parameters/a: got the range [1, 0]"},
    {"{'parameters':{'a':[0]}," BALL("'a'"), "/parameters/a"},
    {"{'parameters':{'time':[0,1]}," BALL("'time'"), "other than \"time\""},
    {"{'parameters':[0,1]," BALL("'a'"), "/parameters: got"},
    {"{'parameters':{'a':[0,1]},'bodies':[{'surfaces':[{'type':'sphere'}],'maps':[{'type':"
     "'rotate','axis':[0,0,1],'rate':1,'clok':'a'}]}]}",
     "unknown parameter"}};

START_TEST(wrong_clocks_and_parameters_are_refused)
{
    imp_error error;
    imp_scene *scene = try_scene(wrong[_i].text, &error);
    ck_assert_msg(scene == NULL, "%s is accepted", wrong[_i].text);
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_msg(strstr(error.text, wrong[_i].words) != NULL, "%s", error.text);
}
END_TEST

START_TEST(more_parameters_than_a_search_can_handle_are_refused)
{
    imp_error error;
    char name[16];
    imp_builder *builder = imp_builder_new(registry);
    imp_code code = IMP_SUCCESS;
    int count = 0;
    for (; code == IMP_SUCCESS && count < 100; ++count) {
        snprintf(name, sizeof name, "p%d", count);
        code = imp_builder_parameter(builder, name, 0, 1, &error);
    }
    ck_assert_int_eq(code, IMP_ERROR_SCENE);
    ck_assert_int_eq(count, 33);
    ck_assert_ptr_nonnull(strstr(error.text, "more than 32 parameters"));
    ck_assert_int_eq(imp_builder_parameter(builder, "p0", 0, 1, &error), IMP_ERROR_SCENE);
    ck_assert_ptr_nonnull(strstr(error.text, "'p0' is given twice"));
    imp_builder_free(builder);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {
        {a_clock_that_is_no_range_is_refused, 1},
        {equal_maps_of_two_bodies_have_two_parameters_of_their_own, 1},
        {what_rests_for_a_while_keeps_time, 1},
        {times_at_which_a_map_is_undefined_are_refused, 1},
        {the_clock_time_changes_no_bit, 1},
        {a_scene_at_values_stands_where_time_would_put_it, 1},
        {wrong_clocks_and_parameters_are_refused, (int)(sizeof wrong / sizeof *wrong)},
        {more_parameters_than_a_search_can_handle_are_refused, 1},
    };
    return suite_main_loops("clocks", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
