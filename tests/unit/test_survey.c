/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/scene/scene.h"
#include "core/surface/surface_spread.h"
#include "tests/support/query_helpers.h"
#include "tests/support/suite.h"

/* Scenes with parameters: what is said of all values holds at each. */

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

/* Single quotes stand for double ones. */
static imp_scene *try_scene(const char *quoted, imp_error *error)
{
    const size_t length = strlen(quoted);
    char *text = malloc(length + 1);
    ck_assert_ptr_nonnull(text);
    for (size_t k = 0; k <= length; ++k) text[k] = quoted[k] == '\'' ? '"' : quoted[k];
    imp_scene *scene = imp_scene_from_json(registry, text, length, "s.json", error);
    free(text);
    return scene;
}

static imp_scene *scene_of(const char *quoted)
{
    imp_error error;
    imp_scene *scene = try_scene(quoted, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

typedef struct answer {
    imp_result contact;
    imp_clearance near;
    imp_survey_state state;
    double values[8], left[16];
    bool has_values;
} answer;

/* `asked` NULL: the earliest contact. */
static answer survey(imp_scene *scene, double gamma, const imp_clearance_options *asked,
                     const imp_survey_options *how)
{
    imp_error error;
    answer found = {.contact = {.struct_size = sizeof found.contact},
                    .near = {.struct_size = sizeof found.near},
                    .state = {.struct_size = sizeof found.state}};
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    options.max_pairs = 2000000;
    imp_survey *s = imp_survey_new(scene, &options, asked, how, &error);
    ck_assert_msg(s != NULL, "%s", error.text);
    ck_assert_msg(imp_survey_step(s, 0, &error) == IMP_SUCCESS, "%s", error.text);
    const imp_code code = asked == NULL ? imp_survey_get_result(s, &found.contact, &error)
                                        : imp_survey_get_clearance(s, &found.near, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    ck_assert_int_eq(imp_survey_get_state(s, &found.state, &error), IMP_SUCCESS);
    found.has_values = imp_survey_values(s, found.values);
    imp_survey_free(s);
    return found;
}

/* --- Closed forms ----------------------------------------------------------------------------- */

/* A ball on an arm of length 1 that turns by a, one on an arm of length 1 that turns by b about a
 * point 2.7 away: their centres are nearest at a = b = 0, and 0.7 apart. */
#define ARMS(RANGE_A, RANGE_B)                                                                     \
    "{'parameters':{'a':" RANGE_A ",'b':" RANGE_B "},'bodies':["                                   \
    "{'name':'one','surfaces':[{'type':'sphere','radius':0.3,'center':[1,0,0]}],"                  \
    "'maps':[{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'a'}]},"                             \
    "{'name':'two','surfaces':[{'type':'sphere','radius':0.3,'center':[-1,0,0]}],"                 \
    "'maps':[{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'b'},"                               \
    "{'type':'translate','offset':[[2.7,0,0]]}]}]}"

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

#define FROM_8_TO_9(SURFACE, MAP)                                                                  \
    "{'parameters':{'e':[0,1]},'bodies':[{'surfaces':[" SURFACE "],'maps':[" MAP                   \
    "{'type':'translate','velocity':[1,0,0],'clock':'e'}]},"                                       \
    "{'surfaces':[{'type':'point','position':[9,0.5,0]}]}]}"

/* Returns NULL if it is refused. */
static imp_survey *survey_from(imp_scene *scene, double t_start, double t_end, imp_error *error)
{
    imp_options options = imp_options_default(scene);
    options.t_start = t_start;
    options.t_end = t_end;
    return imp_survey_new(scene, &options, NULL, NULL, error);
}

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

/* --- Random scenes against samples ------------------------------------------------------------ */

enum { BOXES = 64, PARAMETERS = 3, GRID = 6 };

typedef struct told_box {
    double lo[PARAMETERS], hi[PARAMETERS], time[2], lower;
} told_box;

typedef struct told_boxes {
    told_box at[BOXES];
    size_t count, seen;
    uint64_t *random;
} told_boxes;

/* Keeps some of the boxes, each with the same chance. */
static void keep_box(void *context, const imp_survey_box *box)
{
    told_boxes *all = context;
    if (box->verdict != IMP_VERDICT_CLEAR) return;
    const size_t seen = all->seen++;
    const size_t k =
        seen < BOXES ? seen : (size_t)(random_fraction(all->random) * (double)(seen + 1));
    if (k >= BOXES) return;
    told_box *to = &all->at[k];
    if (k == all->count) all->count += 1;
    ck_assert_uint_eq(box->count, PARAMETERS);
    memcpy(to->lo, box->lo, sizeof to->lo);
    memcpy(to->hi, box->hi, sizeof to->hi);
    to->time[0] = box->t_start, to->time[1] = box->t_end;
    to->lower = box->lower;
}

static void add_map(uint64_t *r, char *text, size_t size, bool last)
{
    static const char *const clocks[] = {"p0", "p1", "p2", "time"};
    const size_t used = strlen(text);
    const char *clock = clocks[(int)(3.999 * random_fraction(r))];
    const double kind = random_fraction(r);
    if (kind < 0.5)
        snprintf(text + used, size - used,
                 "{'type':'rotate','axis':[%g,%g,%g],'rate':%g,'center':[%g,%g,%g],'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, 0.1, 1),
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -1, 1),
                 random_between(r, -1, 1), clock, last ? "" : ",");
    else if (kind < 0.6) /* by a table: its rate jumps */
        snprintf(text + used, size - used,
                 "{'type':'rotate','axis':[%g,%g,1],'times':[-2,%g,2],'angles':[%g,0,%g],"
                 "'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -0.5, 1),
                 random_between(r, -3, 3), random_between(r, -3, 3), clock, last ? "" : ",");
    else if (kind < 0.7) /* along a parabola */
        snprintf(text + used, size - used,
                 "{'type':'translate','offset':[[0,0,0],[%g,0,%g],[%g,%g,0]],'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -1, 1),
                 random_between(r, -1, 1), clock, last ? "" : ",");
    else if (kind < 0.8)
        snprintf(text + used, size - used,
                 "{'type':'translate','velocity':[%g,%g,%g],'clock':'%s'}%s",
                 random_between(r, -1, 1), random_between(r, -1, 1), random_between(r, -1, 1),
                 clock, last ? "" : ",");
    else
        snprintf(text + used, size - used, "{'type':'twist','rate':%g,'clock':'%s'}%s",
                 random_between(r, -0.5, 0.5), clock, last ? "" : ",");
}

static void add_body(uint64_t *r, char *text, size_t size, double x)
{
    static const char *const shapes[] = {
        "'type':'sphere','radius':0.5",
        "'type':'torus','major_radius':0.5,'minor_radius':0.2",
        "'type':'capsule','radius':0.2,'from':[0,0,-0.5],'to':[0,0,0.5]",
        "'type':'box','size':[0.5,0.4,0.8]",
    };
    snprintf(text + strlen(text), size - strlen(text), "{'surfaces':[{%s}],'maps':[",
             shapes[(int)(3.999 * random_fraction(r))]);
    const int maps = 1 + (int)(2.999 * random_fraction(r));
    for (int k = 0; k < maps; ++k) add_map(r, text, size, false);
    snprintf(text + strlen(text), size - strlen(text),
             "{'type':'translate','offset':[[%g,%g,%g]]}]}", x, random_between(r, -0.5, 0.5),
             random_between(r, -0.5, 0.5));
}

/* The least distance of points of both bodies at some values and a time, on a grid. */
static double sampled(const imp_scene *scene, const double *values, double t)
{
    imp_error error;
    double point[2][GRID * GRID * 8][3], least = INFINITY;
    size_t count[2] = {0, 0};
    imp_scene *at = imp_scene_at(scene, values, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    for (size_t body = 0; body < 2; ++body)
        for (size_t k = 0; k < imp_scene_piece_count(at, body, 0) && k < 8; ++k) {
            double lo[3], hi[3];
            imp_piece_domain(at, (imp_place){body, 0, k}, lo, hi);
            for (int i = 0; i < GRID * GRID; ++i) {
                const double p[3] = {lo[0] + (hi[0] - lo[0]) * (i / GRID) / (GRID - 1),
                                     lo[1] + (hi[1] - lo[1]) * (i % GRID) / (GRID - 1), t};
                ck_assert_int_eq(imp_piece_eval(at, (imp_place){body, 0, k}, 1, p,
                                                point[body][count[body]++], NULL, NULL),
                                 IMP_SUCCESS);
            }
        }
    for (size_t i = 0; i < count[0]; ++i)
        for (size_t j = 0; j < count[1]; ++j) {
            const double d = query_distance(point[0][i], point[1][j]);
            if (d < least) least = d;
        }
    imp_scene_free(at);
    return least;
}

/* The least distance of both bodies at some values during the times of a box, from above. */
static double searched(const imp_scene *scene, const double *values, const told_box *box)
{
    imp_error error;
    imp_clearance near = {.struct_size = sizeof near};
    imp_scene *at = imp_scene_at(scene, values, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    imp_options options = imp_options_default(at);
    options.t_start = box->time[0], options.t_end = box->time[1];
    options.max_pairs = 3000;
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = 0.01;
    imp_query *query = imp_clearance_new(at, &options, &asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    ck_assert_int_eq(imp_query_step(query, 0, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_clearance_get(query, 0, &near, &error), IMP_SUCCESS);
    imp_query_free(query);
    imp_scene_free(at);
    return near.upper;
}

enum { SEARCH_EVERY = 8 }; /* boxes of which one is searched, too */

static void check_box(uint64_t *r, const imp_scene *scene, const told_box *box, const char *text)
{
    double values[PARAMETERS];
    const int corner = (int)(8 * random_fraction(r));
    const bool at_corner = random_fraction(r) < 0.5; /* the worst of a box is there, mostly */
    for (int j = 0; j < PARAMETERS; ++j)
        values[j] = at_corner ? (corner >> j & 1 ? box->hi[j] : box->lo[j])
                              : random_between(r, box->lo[j], box->hi[j]);
    const double t = random_between(r, box->time[0], box->time[1]);
    const double d = random_fraction(r) < 1. / SEARCH_EVERY ? searched(scene, values, box)
                                                            : sampled(scene, values, t);
    ck_assert_msg(d >= box->lower, "%.17g at %.17g, %.17g, %.17g, t %.17g, but %.17g is proved: %s",
                  d, values[0], values[1], values[2], t, box->lower, text);
}

/* Asks for the earliest contact, for a requirement, or for a bracket. */
static void survey_for_boxes(uint64_t *r, imp_scene *scene, int kind, told_boxes *boxes)
{
    imp_survey_options how = imp_survey_options_default();
    imp_clearance_options asked = imp_clearance_options_default();
    boxes->count = boxes->seen = 0;
    boxes->random = r;
    how.sink = keep_box;
    how.sink_context = boxes;
    how.max_boxes = 60;
    asked.tolerance = 0.2;
    asked.decide = kind == 1;
    asked.required = kind == 1 ? random_between(r, 0.01, 1) : 0;
    survey(scene, 0.02, kind == 0 ? NULL : &asked, &how);
}

/* Two bodies at random; the ranges of their parameters are in lo and hi. */
static imp_scene *random_scene(uint64_t *r, double wide, char *text, size_t size, double *lo,
                               double *hi)
{
    const double ends[PARAMETERS][2] = {
        {-wide, 0.5 * wide}, {0.7 - 0.5 * wide, 0.7 + 0.5 * wide}, {-0.4 * wide, 0.4 * wide}};
    snprintf(text, size, "{'parameters':{");
    for (int j = 0; j < PARAMETERS; ++j) {
        lo[j] = ends[j][0], hi[j] = ends[j][1];
        snprintf(text + strlen(text), size - strlen(text), "'p%d':[%.17g,%.17g]%s", j, lo[j], hi[j],
                 j < PARAMETERS - 1 ? "," : "},'bodies':[");
    }
    add_body(r, text, size, 0);
    strcat(text, ",");
    add_body(r, text, size, random_between(r, 1, 4));
    strcat(text, "]}");
    return scene_of(text);
}

START_TEST(no_sample_is_nearer_than_what_is_proved_of_its_box)
{
    uint64_t random = suite_seed() + (uint64_t)_i;
    static told_boxes boxes;
    const int scenes = suite_times(12);
    for (int n = 0; n < scenes; ++n) {
        char text[4000];
        double lo[PARAMETERS], hi[PARAMETERS];
        imp_scene *scene =
            random_scene(&random, n % 2 == 0 ? 1 : random_between(&random, 0.02, 0.3), text,
                         sizeof text, lo, hi);
        survey_for_boxes(&random, scene, n % 3, &boxes);
        for (size_t k = 0; k < boxes.count; ++k) check_box(&random, scene, &boxes.at[k], text);
        imp_scene_free(scene);
    }
}
END_TEST

/* The least distance of both bodies, from above, at the corners of the whole box and at values
 * inside. */
static double nearest_of_values(uint64_t *r, const imp_scene *scene, const double *lo,
                                const double *hi)
{
    told_box box = {.time = {0, 1}};
    double least = INFINITY;
    for (int k = 0; k < 12; ++k) {
        double values[PARAMETERS];
        for (int j = 0; j < PARAMETERS; ++j)
            values[j] = k < 8 ? (k >> j & 1 ? hi[j] : lo[j]) : random_between(r, lo[j], hi[j]);
        const double d = searched(scene, values, &box);
        if (d < least) least = d;
    }
    return least;
}

/* Where some values are known to bring the bodies nearer than what is required, all bounds of the
 * box that holds them are tried at their limit. */
START_TEST(what_some_values_violate_is_never_proved)
{
    uint64_t random = suite_seed() + 1000 + (uint64_t)_i;
    const int scenes = suite_times(20);
    for (int n = 0; n < scenes; ++n) {
        char text[4000];
        double lo[PARAMETERS], hi[PARAMETERS];
        imp_scene *scene =
            random_scene(&random, random_between(&random, 0.02, 0.6), text, sizeof text, lo, hi);
        imp_clearance_options asked = imp_clearance_options_default();
        imp_survey_options how = imp_survey_options_default();
        how.max_boxes = 10;
        asked.decide = true;
        asked.required = 1.0001 * nearest_of_values(&random, scene, lo, hi);
        if (asked.required > 0.01) {
            const answer found = survey(scene, 1e-3, &asked, &how);
            ck_assert_msg(found.near.verdict != IMP_REQUIREMENT_HOLDS, "%.17g is not kept: %s",
                          asked.required, text);
        }
        imp_scene_free(scene);
    }
}
END_TEST

/* --- What the way of a point does not tell ---------------------------------------------------- */

/* The spread of the first body, whose room is `maps`. False: nothing is known. */
static bool spread_of(const imp_scene *scene, const value_box *box, spread_map *maps,
                      surface_spread *spread)
{
    const surface *of = scene_surface(scene, 0, 0);
    surface_extent extent;
    surface_image image;
    map_reach reaches[SPREAD_MAPS_MAX];
    double shift[PARAMETERS];
    *spread = (surface_spread){.maps = maps};
    ck_assert_int_eq(surface_extent_find(of, box, &extent), IMP_STATUS_OK);
    ck_assert_int_eq(surface_shift_trace(of, &extent, 0, box, shift, &image, reaches),
                     IMP_STATUS_OK);
    return image.lo[0] > -INFINITY &&
           surface_spread_make(of, &extent, 0, box, SIZE_MAX, reaches, spread);
}

static void eval_at(const imp_scene *scene, const double *values, const double *p, double *x)
{
    imp_error error;
    imp_scene *at = imp_scene_at(scene, values, &error);
    ck_assert_msg(at != NULL, "%s", error.text);
    ck_assert_int_eq(imp_piece_eval(at, (imp_place){0, 0, 0}, 1, p, x, NULL, NULL), IMP_SUCCESS);
    imp_scene_free(at);
}

/* A point is where its way and the rest say, at any values and any time near the moment at which
 * the way of another point was asked for. */
static void check_way(uint64_t *r, const imp_scene *scene, const surface_spread *spread,
                      const value_box *box, const char *text)
{
    double lo[3], hi[3], values[PARAMETERS], part[PARAMETERS], way[PARAMETERS][4] = {{0}};
    double z[3], x[3], from[3], to[3], left[3], rest = 0;
    imp_piece_domain(scene, (imp_place){0, 0, 0}, lo, hi);
    spread_place place = {.t = random_between(r, 0, 1), .half = random_between(r, 0, 0.1)};
    const double near = random_fraction(r) < 0.5 ? 0 : 0.1;
    const double u = random_between(r, lo[0], hi[0]), v = random_between(r, lo[1], hi[1]);
    const double p[3] = {u, v, place.t},
                 q[3] = {u + near * random_fraction(r) * (hi[0] - u), v, place.t},
                 later[3] = {q[0], v, place.t + place.half * suite_end_or_inside(r)};
    for (int j = 0; j < PARAMETERS; ++j) {
        part[j] = suite_end_or_inside(r);
        values[j] = box->at[j] + part[j] * 0.5 * (box->hi[j] - box->lo[j]) * (1 - 1e-12);
    }
    eval_at(scene, box->at, p, z);
    eval_at(scene, box->at, q, x);
    eval_at(scene, box->at, later, from);
    eval_at(scene, values, later, to);
    memcpy(place.at, z, sizeof z);
    place.radius = query_distance(x, z) * (1 + 1e-12);
    if (!surface_spread_at(spread, scene_surface(scene, 0, 0), &place, 1, way, &rest)) return;
    for (int i = 0; i < 3; ++i) {
        left[i] = to[i] - from[i];
        for (int j = 0; j < PARAMETERS; ++j) left[i] -= part[j] * way[j][i];
    }
    const double off = query_distance(left, (const double[3]){0, 0, 0});
    ck_assert_msg(off <= rest + 1e-9, "off by %.17g, more than %.17g: %s", off, rest, text);
}

START_TEST(points_are_where_their_ways_say)
{
    uint64_t random = suite_seed() + 2000 + (uint64_t)_i;
    const int scenes = suite_times_at_least(60);
    int known = 0;
    for (int n = 0; n < scenes; ++n) {
        char text[4000];
        double lo[PARAMETERS], hi[PARAMETERS], at[PARAMETERS];
        spread_map maps[SPREAD_MAPS_MAX];
        surface_spread spread;
        imp_scene *scene =
            random_scene(&random, random_between(&random, 0.001, 0.6), text, sizeof text, lo, hi);
        for (int j = 0; j < PARAMETERS; ++j) at[j] = 0.5 * lo[j] + 0.5 * hi[j];
        const value_box box = {PARAMETERS, lo, hi, at, -0.1, 1.1};
        if (spread_of(scene, &box, maps, &spread)) {
            ++known;
            for (int k = 0; k < 8; ++k) check_way(&random, scene, &spread, &box, text);
        }
        imp_scene_free(scene);
    }
    ck_assert_int_gt(known, scenes / 3);
}
END_TEST

/* Scenes in which values bring the bodies nearer than the middle of the box tells to first order:
 * `nearest`, where they are so near, is at an end of p. Something follows time in nearly each, so
 * that no parameter takes its place. */
typedef struct bent_scene {
    const char *text;
    double nearest;
} bent_scene;

#define WALL(NORMAL)                                                                               \
    "{'surfaces':[{'type':'plane'," NORMAL "}],'maps':[{'type':'translate','velocity':[0,0,0.001]" \
    "}]}]}"
#define TURNED "{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'p'}"

static const bent_scene bent[] = {
    /* a ball moves across the wall's normal, on a circle: nearer by 1 - cos p */
    {"{'parameters':{'p':[-0.3,0.3]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1,"
     "'center':[1,0,0]}],'maps':[" TURNED
     "]}," WALL("'origin':[0.6,-2,-2],'edge_u':[0,4,0],'edge_v':[0,0,4]"),
     0.95533648912560598 - 0.7},
    /* a ball leaves the axis in time, so that it is moved farther later: by (1 + t) sin p */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1,"
     "'center':[1,0,0]}],'maps':[{'type':'translate','velocity':[1,0,0]}," TURNED
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4 - 2 * 0.099833416646828155},
    /* the far end of a plate is moved farther than its middle: a ball above x = 2 */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'plane','origin':[0,0,-1],"
     "'edge_u':[3,0,0],'edge_v':[0,0,2]}],'maps':[" TURNED
     "]},{'surfaces':[{'type':'sphere','radius':0.1,'center':[2,0.5,0]}],'maps':[{'type':"
     "'translate','velocity':[0,0,0.001]}]}]}",
     0.5 * 0.99500416527802576 - 2 * 0.099833416646828155 - 0.1},
    /* a ball turns in time, too, and its way with it: towards the wall at first, then along it */
    {"{'parameters':{'p':[-0.05,0.05]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1,"
     "'center':[1,0,0]}],'maps':[" TURNED ",{'type':'rotate','axis':[0,0,1],'rate':-2}"
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4 - 0.049979169270678331},
    /* a ball moves straight towards the wall: all of it is of first order */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1}],'maps':"
     "["
     "{'type':'translate','velocity':[0,1,0],'clock':'p'}"
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.3},
    /* a ball turns within itself in the middle only: elsewhere it goes round */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0.1}],'maps':"
     "["
     "{'type':'translate','velocity':[1,0,0],'clock':'p'},{'type':'rotate','axis':[0,0,1],'rate':2}"
     "]},{'surfaces':[{'type':'plane','origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]}]}]}",
     0.3},
    /* a sheet rises with the parameter by itself, not by a map */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'formula','y':'t','z':'v - "
     "0.5',"
     "'clock':'p'}],'maps':[{'type':'translate','velocity':[0.001,0,0]}"
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4},
    /* a sheet leaves the axis in time by itself, so that it is moved farther later */
    {"{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'formula','x':'1 + t',"
     "'y':'0.1*u','z':'0.1*v'}],'maps':[" TURNED
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.5 - 2 * 0.099833416646828155 - 0.1 * 0.99500416527802576},
    /* a ball leaves the axis with a parameter that takes the place of time */
    {"{'parameters':{'p':[-0.1,0.1],'q':[0,1]},'bodies':[{'surfaces':[{'type':'sphere','radius':0."
     "1,"
     "'center':[1,0,0]}],'maps':[{'type':'translate','velocity':[1,0,0],'clock':'q'}," TURNED
     "]},{'surfaces':[{'type':'plane','origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]}]}]}",
     0.4 - 2 * 0.099833416646828155},
    /* what one parameter moves off the axis the other one turns */
    {"{'parameters':{'q':[-1,1],'p':[-0.3,0.3]},'bodies':[{'surfaces':[{'type':'sphere','radius':"
     "0.1}],'maps':[{'type':'translate','velocity':[1,0,0],'clock':'q'}," TURNED
     "]}," WALL("'origin':[-4,0.5,-2],'edge_u':[8,0,0],'edge_v':[0,0,4]"),
     0.4 - 0.29552020666133957},
    /* three parameters turn a ball about one axis */
    {"{'parameters':{'q':[-0.2,0.2],'r':[-0.2,0.2],'p':[-0.2,0.2]},'bodies':[{'surfaces':[{'type':"
     "'sphere','radius':0.01,'center':[1,0,0]}],'maps':[{'type':'rotate','axis':[0,0,1],'rate':1,"
     "'clock':'q'},{'type':'rotate','axis':[0,0,1],'rate':1,'clock':'r'}," TURNED
     "]}," WALL("'origin':[0.6,-2,-2],'edge_u':[0,4,0],'edge_v':[0,0,4]"),
     0.82533561490967833 - 0.61},
};

START_TEST(what_bends_the_ways_of_points_is_counted)
{
    const double nearest = bent[_i].nearest;
    imp_scene *scene = scene_of(bent[_i].text);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.decide = true;
    asked.required = nearest * 1.001;
    answer found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_int_eq(found.near.verdict, IMP_REQUIREMENT_VIOLATED);
    asked.required = nearest * 0.99;
    found = survey(scene, 1e-3, &asked, NULL);
    ck_assert_int_eq(found.near.verdict, IMP_REQUIREMENT_HOLDS);
    imp_scene_free(scene);
}
END_TEST

/* Whether something is known of a ball under maps that p moves. */
static bool knows_ways(const char *maps)
{
    char text[1000];
    const double lo = -0.1, hi = 0.1, at = 0;
    spread_map room[SPREAD_MAPS_MAX];
    surface_spread spread;
    snprintf(text, sizeof text,
             "{'parameters':{'p':[-0.1,0.1]},'bodies':[{'surfaces':[{'type':'sphere'}],"
             "'maps':[%s]}]}",
             maps);
    imp_scene *scene = scene_of(text);
    const bool known = spread_of(scene, &(value_box){1, &lo, &hi, &at, 0, 1}, room, &spread);
    imp_scene_free(scene);
    return known;
}

/* A trajectory is rigid, but does not say that it turns exactly. */
START_TEST(no_ways_are_known_of_maps_that_do_not_turn_exactly)
{
    static const char path[] =
        "{'type':'trajectory','times':[-2,2],'positions':[[0,0,0],[1,0,0]]%s}";
    char still[300], moving[300];
    snprintf(moving, sizeof moving, path, ",'clock':'p'");
    snprintf(still, sizeof still, "%s,", TURNED);
    snprintf(still + strlen(still), sizeof still - strlen(still), path, "");
    ck_assert(knows_ways(TURNED));
    ck_assert(!knows_ways(moving));
    ck_assert(!knows_ways(still));
    ck_assert(!knows_ways(TURNED ",{'type':'scale','factor':2}"));
    ck_assert(knows_ways("{'type':'scale','factor':2}," TURNED));
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

static const char TITLE[] = "survey";

int main(void)
{
    TCase *tcase = tcase_create(TITLE);
    Suite *suite = suite_create(TITLE);
    tcase_set_timeout(tcase, 300);
    tcase_add_checked_fixture(tcase, open_registry, close_registry);
    tcase_add_test(tcase, balls_on_two_arms_are_as_near_as_the_law_of_cosines_says);
    tcase_add_test(tcase, what_is_required_is_decided_for_all_values);
    tcase_add_test(tcase, the_earliest_contact_is_that_of_the_worst_values);
    tcase_add_test(tcase, a_text_that_no_survey_saved_is_refused);
    tcase_add_test(tcase, a_clock_that_is_no_range_is_refused);
    tcase_add_test(tcase, six_maps_hold_all_displacements_of_a_tolerance);
    tcase_add_test(tcase, equal_maps_of_two_bodies_have_two_parameters_of_their_own);
    tcase_add_test(tcase, a_survey_goes_on_from_a_saved_one_to_the_same_bits);
    tcase_add_test(tcase, a_common_parent_takes_no_part);
    tcase_add_test(tcase, what_rests_for_a_while_keeps_time);
    tcase_add_test(tcase, times_at_which_a_map_is_undefined_are_refused);
    tcase_add_loop_test(tcase, a_surface_that_does_not_exist_touches_nothing, 0, 2);
    tcase_add_test(tcase, the_clock_time_changes_no_bit);
    tcase_add_test(tcase, a_scene_at_values_stands_where_time_would_put_it);
    tcase_add_loop_test(tcase, no_sample_is_nearer_than_what_is_proved_of_its_box, 0, 4);
    tcase_add_loop_test(tcase, what_some_values_violate_is_never_proved, 0, 4);
    tcase_add_loop_test(tcase, points_are_where_their_ways_say, 0, 2);
    tcase_add_loop_test(tcase, what_bends_the_ways_of_points_is_counted, 0,
                        (int)(sizeof bent / sizeof *bent));
    tcase_add_test(tcase, no_ways_are_known_of_maps_that_do_not_turn_exactly);
    tcase_add_loop_test(tcase, wrong_clocks_and_parameters_are_refused, 0,
                        (int)(sizeof wrong / sizeof *wrong));
    tcase_add_test(tcase, more_parameters_than_a_search_can_handle_are_refused);
    tcase_add_test(tcase, a_survey_ends_at_a_limit_of_pairs);
    tcase_add_test(tcase, a_survey_that_is_cancelled_goes_on);
    tcase_add_test(tcase, a_query_about_one_pose_is_refused);
    tcase_add_test(tcase, bodies_that_cannot_touch_are_refused);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
