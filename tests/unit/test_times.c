/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene.h"
#include "tests/support/compose.h"
#include "tests/support/query_helpers.h"

/* No answer claims a time that was not examined: what is defined for part of the interval only is
 * refused, unless it does not exist at other times; then the answer says what was examined. */

static const char track[] = "sphere radius=.5 ! keyframes times=0,1 positions=[[0,0,0],[1,0,0]]";
static const char falling[] = "sphere radius=.5 center=0,3,0 ! translate velocity=0.5,-1.5,0";

static imp_code code_of(const question *q, imp_result *result, imp_error *error)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = imp_scene_from_pair(registry, q->a, q->b, error);
    ck_assert_msg(scene != NULL, "%s", error->text);
    const imp_options options = query_options(scene, q);
    result->struct_size = sizeof *result;
    const imp_code code = imp_scene_solve(scene, &options, result, error);
    if (code == IMP_SUCCESS) query_check(scene, &options, result);
    imp_scene_free(scene);
    imp_registry_free(registry);
    return code;
}

static void expect_refusal(const question *q, const char *const *words)
{
    imp_result result;
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_int_eq(code_of(q, &result, &error), IMP_ERROR_SCENE);
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    for (; *words != NULL; ++words)
        ck_assert_msg(strstr(error.text, *words) != NULL, "no '%s' in: %s", *words, error.text);
}

START_TEST(times_a_map_is_not_defined_for_are_refused)
{
    static const char *const words[] = {"body 'a', surface 0", "'keyframes'", "0 to 1", "0 to 2",
                                        NULL};
    const question late = {.a = track, .b = falling, .t_end = 2};
    expect_refusal(&late, words);
    static const char *const before[] = {"body 'b', surface 0", "'map-formula'", "0.25 to 3", NULL};
    const question early = {.a = falling, .b = "sphere ! map-formula x=x+1 time=0.25,3"};
    expect_refusal(&early, before);
}
END_TEST

START_TEST(a_map_that_holds_its_ends_is_examined_throughout)
{
    const question q = {
        .a = "sphere radius=.5 ! keyframes times=0,1 positions=[[0,0,0],[1,0,0]] hold=true",
        .b = falling,
        .t_end = 2};
    const imp_result r = ask_contact(&q, 1.3675444679663242, 1e-6); /* 2 - sqrt(0.4) */
    ck_assert(r.t_examined[0] == 0 && r.t_examined[1] == 2);
}
END_TEST

START_TEST(times_within_those_of_a_map_are_answered)
{
    const question q = {.a = track, .b = falling, .t_start = 0.25, .t_end = 1};
    const imp_result r = ask_clear(&q);
    ck_assert(r.t_examined[0] == 0.25 && r.t_examined[1] == 1);
}
END_TEST

START_TEST(what_does_not_exist_at_other_times_is_examined_while_it_does)
{
    const question q = {
        .a = "formula x=u y=v z=0 time=[0.25,0.5]", .b = "point position=0.5,0.5,5", .t_end = 2};
    const imp_result r = ask_clear(&q);
    ck_assert(r.t_lower == 2 && r.t_examined[0] == 0.25 && r.t_examined[1] == 0.5);
    ck_assert(r.t_start == 0 && r.t_end == 2);
    const question both = {.a = q.a, .b = "formula x=u y=v z=5 time=[0.375,9]", .t_end = 2};
    const imp_result s = ask_clear(&both);
    ck_assert(s.t_examined[0] == 0.375 && s.t_examined[1] == 0.5);
}
END_TEST

START_TEST(a_map_must_be_defined_only_while_both_surfaces_exist)
{
    const question q = {.a = "formula x=u y=v z=5 time=[0.25,0.5] ! keyframes times=0,1"
                             " positions=[[0,0,0],[1,0,0]]",
                        .b = "sphere ! keyframes times=-1,0.75 positions=[[0,0,0],[1,0,0]]",
                        .t_end = 2};
    const imp_result r = ask_clear(&q);
    ck_assert(r.t_examined[0] == 0.25 && r.t_examined[1] == 0.5);
    static const char *const words[] = {"body 'b'", "-1 to 0.75", "0.25 to 0.9", NULL};
    const question longer = {.a = "formula x=u y=v z=5 time=[0.25,0.9]", .b = q.b, .t_end = 2};
    expect_refusal(&longer, words);
}
END_TEST

START_TEST(surfaces_that_never_exist_together_leave_nothing_to_examine)
{
    const question q = {.a = "formula x=u y=v z=0 time=[0,0.25]",
                        .b = "formula x=u y=v z=0 time=[0.5,1]"};
    const imp_result r = ask_clear(&q);
    ck_assert_int_eq(r.reason, IMP_REASON_NO_TIME);
    ck_assert(isnan(r.t_examined[0]) && isnan(r.t_examined[1]));
}
END_TEST

START_TEST(a_contact_and_an_undecided_answer_say_what_was_examined)
{
    const question q = {
        .a = "formula x=u y=v z=0 time=[0.25,0.5]", .b = "point position=0.5,0.5,0", .t_end = 2};
    const imp_result r = ask_contact(&q, 0.25, 0);
    ck_assert(r.t_examined[0] == 0.25 && r.t_examined[1] == 0.5);
    const question hard = {.a = "formula x=u y=v z=sin(9*u)*cos(9*v) time=[0.25,0.5]",
                           .b = "formula x=u y=v z=1+1e-7+sin(9*u)*cos(9*v)-1",
                           .gamma = 1e-9,
                           .t_end = 2,
                           .max_pairs = 50};
    const imp_result s = ask(&hard);
    ck_assert_int_eq(s.verdict, IMP_VERDICT_UNDECIDED);
    ck_assert(s.t_examined[0] == 0.25 && s.t_examined[1] == 0.5);
}
END_TEST

/* --- Scenes ----------------------------------------------------------------------------------- */

static imp_code solve_text(const char *text, imp_result *result, imp_error *error)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "scene", error);
    ck_assert_msg(scene != NULL, "%s", error->text);
    const imp_options options = imp_options_default(scene);
    result->struct_size = sizeof *result;
    const imp_code code = imp_scene_solve(scene, &options, result, error);
    imp_scene_free(scene);
    imp_registry_free(registry);
    return code;
}

#define BODY(NAME, TYPE, MORE)                                                                     \
    "{\"name\": \"" NAME "\", \"surfaces\": [{\"type\": " TYPE "}], \"maps\": [" MORE "]}"
#define FORMULA(Z, FROM, TO)                                                                       \
    "\"formula\", \"x\": \"u\", \"y\": \"v\", \"z\": \"" Z "\", \"time\": [" FROM "," TO "]"
#define SHORT_TRACK                                                                                \
    "{\"type\": \"keyframes\", \"times\": [0,0.5], \"positions\": [[0,0,9],[0,0,8]]}"

START_TEST(a_scene_examines_from_the_first_to_the_last_time_that_two_bodies_exist)
{
    imp_result r = {.struct_size = sizeof r};
    imp_error error = {IMP_SUCCESS, ""};
    static const char text[] =
        "{\"time\": [0,3], \"bodies\": [" BODY("a", FORMULA("0", "0.5", "1"), "") "," BODY(
            "b", FORMULA("1", "2", "2.5"), "") "," BODY("c", "\"sphere\", \"center\": [0,0,9]",
                                                        "") "]}";
    ck_assert_msg(solve_text(text, &r, &error) == IMP_SUCCESS, "%s", error.text);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.t_examined[0] == 0.5 && r.t_examined[1] == 2.5);
}
END_TEST

START_TEST(a_body_that_is_tested_with_none_may_be_defined_for_any_times)
{
    imp_result r = {.struct_size = sizeof r};
    imp_error error = {IMP_SUCCESS, ""};
    static const char tested[] =
        "{\"time\": [0,1], \"bodies\": [" BODY("a", "\"sphere\"", SHORT_TRACK) "," BODY(
            "b", "\"sphere\"", "") "," BODY("c", "\"sphere\", \"center\": [4,0,0]", "") "]}";
    static const char ignored[] =
        "{\"time\": [0,1], \"bodies\": [" BODY("a", "\"sphere\"", SHORT_TRACK) "," BODY(
            "b", "\"sphere\"", "") "," BODY("c", "\"sphere\", \"center\": [4,0,0]",
                                            "") "], \"ignore\": [[\"a\",\"b\"],[\"a\",\"c\"]]}";
    ck_assert_int_eq(solve_text(tested, &r, &error), IMP_ERROR_SCENE);
    ck_assert_ptr_nonnull(strstr(error.text, "body 'a', surface 0"));
    ck_assert_int_eq(solve_text(ignored, &r, &error), IMP_SUCCESS);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.t_examined[0] == 0 && r.t_examined[1] == 1);
}
END_TEST

/* --- Where nobody says which times ------------------------------------------------------------ */

START_TEST(a_scene_whose_tables_share_no_time_is_refused_until_somebody_says)
{
    imp_result r = {.struct_size = sizeof r};
    imp_error error = {IMP_SUCCESS, ""};
    imp_registry *registry = query_registry();
    imp_scene *scene = imp_scene_from_pair(
        registry, track, "sphere center=9,0,0 ! keyframes times=2,3 positions=[[0,0,0],[1,0,0]]",
        &error);
    imp_options options = {.struct_size = sizeof options};
    ck_assert_int_eq(imp_options_get_default(scene, &options, &error), IMP_ERROR_SCENE);
    ck_assert_ptr_nonnull(strstr(error.text, "up to t = 1;"));
    ck_assert(isnan(options.t_start) && isnan(options.t_end) && options.gamma == 1e-6);
    error.text[0] = '\0';
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_ERROR_SCENE);
    ck_assert_ptr_nonnull(strstr(error.text, "up to t = 1;"));
    options.t_start = 2;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_ERROR_USAGE);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

typedef struct some_times {
    double start, end;
} some_times;

static void some_domain(const void *self, double lo[3], double hi[3])
{
    const some_times *at = self;
    lo[0] = lo[1] = 0, hi[0] = hi[1] = 1;
    lo[2] = at->start, hi[2] = at->end;
}

static void keep(void *self) { (void)self; }

static const imp_surface_type plain = {
    .struct_size = sizeof plain, .name = "plain", .domain = some_domain, .destroy = keep};

/* The default times of a scene of two surfaces that are defined at these times. */
static imp_options times_of(some_times a, some_times b)
{
    some_times of[2] = {a, b};
    imp_scene *scene = scene_new();
    for (size_t k = 0; k < 2; ++k) {
        ck_assert_int_eq(scene_add_body(scene, "one"), IMP_SUCCESS);
        ck_assert_int_eq(scene_add_surface(scene, k, surface_new(&plain, &of[k])), IMP_SUCCESS);
    }
    scene_complete(scene);
    const imp_options options = imp_options_default(scene);
    imp_scene_free(scene);
    return options;
}

START_TEST(domains_without_an_end_leave_the_interval_where_it_is_if_that_is_possible)
{
    const struct {
        some_times a, b, expected;
    } cases[] = {
        {{-INFINITY, INFINITY}, {-INFINITY, INFINITY}, {0, 1}},
        {{0, INFINITY}, {-INFINITY, INFINITY}, {0, 1}},
        {{5, INFINITY}, {-INFINITY, INFINITY}, {5, 6}},
        {{-INFINITY, 0.5}, {-INFINITY, INFINITY}, {-0.5, 0.5}},
        {{5, INFINITY}, {-INFINITY, 8}, {5, 8}},
        {{5, INFINITY}, {0, 8}, {5, 8}},
        {{0, 4}, {2, 8}, {2, 4}},
        {{0, 4}, {4, 8}, {4, 4}},
        {{-INFINITY, INFINITY}, {2, 8}, {2, 8}},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
        for (int swap = 0; swap < 2; ++swap) {
            const imp_options o =
                swap ? times_of(cases[k].b, cases[k].a) : times_of(cases[k].a, cases[k].b);
            ck_assert_msg(o.t_start == cases[k].expected.start && o.t_end == cases[k].expected.end,
                          "case %zu: [%g, %g]", k, o.t_start, o.t_end);
        }
}
END_TEST

SUITE_MAIN("times", times_a_map_is_not_defined_for_are_refused,
           a_map_that_holds_its_ends_is_examined_throughout,
           times_within_those_of_a_map_are_answered,
           what_does_not_exist_at_other_times_is_examined_while_it_does,
           a_map_must_be_defined_only_while_both_surfaces_exist,
           surfaces_that_never_exist_together_leave_nothing_to_examine,
           a_contact_and_an_undecided_answer_say_what_was_examined,
           a_scene_examines_from_the_first_to_the_last_time_that_two_bodies_exist,
           a_body_that_is_tested_with_none_may_be_defined_for_any_times,
           a_scene_whose_tables_share_no_time_is_refused_until_somebody_says,
           domains_without_an_end_leave_the_interval_where_it_is_if_that_is_possible)
