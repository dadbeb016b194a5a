/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"
#include "tests/support/sphere_scenes.h"
#include "tests/support/suite.h"

#include <impinge/examine.h>

/* A missing object, text or place for an answer, and an index out of range, are IMP_ERROR_USAGE
 * from every function of the public header that answers a code, and none, zero or false from the
 * others: never a crash. */

static imp_error error;

static void expect_usage(imp_code code, const char *part)
{
    ck_assert_msg(code == IMP_ERROR_USAGE, "got code %d: %s", (int)code, error.text);
    ck_assert_msg(strstr(error.text, part) != NULL, "'%s' does not name '%s'", error.text, part);
    error = (imp_error){IMP_SUCCESS, ""};
}

static void expect_nothing(const void *made, const char *part)
{
    ck_assert_ptr_null(made);
    expect_usage(error.code, part);
}

static imp_scene *two_balls(void)
{
    static const ball a = {.radius = 1}, b = {.radius = 1, .centre = {3, 0, 0}};
    return spheres_scene(&ball_type, &a, &ball_type, &b);
}

START_TEST(registries_take_no_missing_object)
{
    imp_type_info info;
    imp_plugin_refusal refusal;
    imp_instance instance = {NULL, NULL, NULL};
    imp_registry_free(NULL);
    imp_instance_free(NULL);
    ck_assert(!imp_registry_type(NULL, 0, &info));
    ck_assert(!imp_registry_refusal(NULL, 0, &refusal));
    ck_assert(!imp_registry_warning(NULL, 0, &refusal));
    ck_assert(!imp_registry_fault(NULL, 0, &refusal));
    ck_assert_ptr_null(imp_call_read(NULL, NULL));
    ck_assert(!imp_plugin_examine(NULL, NULL, NULL));
    ck_assert_ptr_null(imp_registry_from_file(NULL));
    expect_usage(imp_registry_isolate(NULL, NULL, &error), "imp_registry_isolate");
    expect_usage(imp_registry_limit_reading(NULL, 1, 1, &error), "imp_registry_limit_reading");
    expect_usage(imp_instance_from_text(NULL, IMP_TYPE_SURFACE, "sphere", &instance, &error),
                 "imp_instance_from_text");
    expect_nothing(imp_stage_to_json(NULL, IMP_TYPE_SURFACE, "sphere", &error),
                   "imp_stage_to_json");
    imp_registry *registry = imp_registry_new("");
    ck_assert_ptr_nonnull(registry);
    ck_assert(!imp_registry_type(registry, SIZE_MAX, &info));
    ck_assert(!imp_registry_type(registry, 0, NULL));
    ck_assert(!imp_registry_refusal(registry, 0, NULL));
    ck_assert(!imp_registry_warning(registry, 0, NULL));
    ck_assert(!imp_registry_fault(registry, 0, NULL));
    ck_assert(!imp_registry_fault(registry, 0, &refusal));
    expect_usage(imp_instance_from_text(registry, IMP_TYPE_SURFACE, NULL, &instance, &error),
                 "imp_instance_from_text");
    expect_usage(imp_instance_from_text(registry, IMP_TYPE_SURFACE, "sphere", NULL, &error),
                 "imp_instance_from_text");
    expect_nothing(imp_stage_to_json(registry, IMP_TYPE_SURFACE, NULL, &error),
                   "imp_stage_to_json");
    imp_registry_free(registry);
}
END_TEST

START_TEST(scenes_are_not_made_from_nothing)
{
    imp_registry *registry = imp_registry_new("");
    ck_assert_ptr_nonnull(registry);
    expect_nothing(imp_scene_from_json(NULL, "{}", 2, "text", &error), "imp_scene_from_json");
    expect_nothing(imp_scene_from_json(registry, NULL, 2, "text", &error), "imp_scene_from_json");
    expect_nothing(imp_scene_from_file(NULL, "scene.json", &error), "imp_scene_from_file");
    expect_nothing(imp_scene_from_file(registry, NULL, &error), "imp_scene_from_file");
    expect_nothing(imp_scene_from_pair(NULL, "sphere", "sphere", &error), "imp_scene_from_pair");
    expect_nothing(imp_scene_from_pair(registry, NULL, "sphere", &error), "imp_scene_from_pair");
    expect_nothing(imp_pair_to_json(NULL, "sphere", "sphere", &error), "imp_pair_to_json");
    expect_nothing(imp_pair_to_json(registry, NULL, "sphere", &error), "imp_pair_to_json");
    expect_nothing(imp_pair_to_json(registry, "sphere", NULL, &error), "imp_pair_to_json");
    expect_nothing(imp_scene_from_pair(registry, "sphere", NULL, &error), "imp_scene_from_pair");
    imp_registry_free(registry);
    imp_scene_free(NULL);
}
END_TEST

START_TEST(scenes_tell_nothing_of_what_is_not_there)
{
    double lo[3], hi[3], x[3];
    const double p[3] = {0, 0, 0};
    imp_model model[3];
    ck_assert_uint_eq(imp_scene_body_count(NULL), 0);
    ck_assert_uint_eq(imp_scene_surface_count(NULL, 0), 0);
    ck_assert_ptr_null(imp_scene_body_name(NULL, 0));
    expect_usage(imp_scene_eval(NULL, 0, 0, 1, p, x, NULL, &error), "imp_scene_eval");
    expect_usage(imp_scene_include(NULL, 0, 0, p, p, model, &error), "imp_scene_include");
    imp_scene_domain(NULL, 0, 0, lo, hi);
    ck_assert(lo[2] > hi[2]);
    imp_scene *scene = two_balls();
    ck_assert_uint_eq(imp_scene_surface_count(scene, 2), 0);
    ck_assert_ptr_null(imp_scene_body_name(scene, SIZE_MAX));
    expect_usage(imp_scene_eval(scene, 2, 0, 1, p, x, NULL, &error), "body 2");
    expect_usage(imp_scene_eval(scene, 0, 7, 1, p, x, NULL, &error), "surface 7");
    expect_usage(imp_scene_eval(scene, 0, 0, 1, NULL, x, NULL, &error), "imp_scene_eval");
    expect_usage(imp_scene_eval(scene, 0, 0, 1, p, NULL, NULL, &error), "imp_scene_eval");
    expect_usage(imp_scene_include(scene, 0, 0, NULL, p, model, &error), "imp_scene_include");
    expect_usage(imp_scene_include(scene, 0, 0, p, NULL, model, &error), "imp_scene_include");
    expect_usage(imp_scene_include(scene, 0, 0, p, p, NULL, &error), "imp_scene_include");
    imp_scene_domain(scene, 5, 0, lo, hi);
    ck_assert(lo[0] > hi[0] && lo[1] > hi[1] && lo[2] > hi[2]);
    imp_scene_domain(scene, 0, 0, NULL, NULL);
    imp_scene_free(scene);
}
END_TEST

/* x = sqrt(t) has no points before t = 0. */
START_TEST(points_outside_of_a_domain_are_refused_with_the_type)
{
    imp_registry *registry = query_registry();
    imp_scene *scene =
        imp_scene_from_pair(registry, "formula x=sqrt(t) time=0,1", "sphere", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    double x[3];
    expect_usage(imp_scene_eval(scene, 0, 0, 1, (const double[3]){0.5, 0.5, -1}, x, NULL, &error),
                 "type 'formula x='sqrt(t)' time=0,1': got (u, v, t) = (0.5, 0.5, -1), must be in "
                 "its domain, "
                 "u in [0, 1], v in [0, 1], t in [0, 1]");
    ck_assert_int_eq(
        imp_scene_eval(scene, 0, 0, 1, (const double[3]){0.5, 0.5, 0.25}, x, NULL, &error),
        IMP_SUCCESS);
    ck_assert(fabs(x[0] - 0.5) < 1e-15);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(queries_take_no_missing_object)
{
    imp_scene *scene = two_balls();
    imp_options options = imp_options_default(scene);
    imp_result result = {.struct_size = (uint32_t)sizeof result};
    imp_pending pending;
    expect_usage(imp_options_get_default(NULL, &options, &error), "imp_options_get_default");
    expect_usage(imp_options_get_default(scene, NULL, &error), "imp_options");
    expect_nothing(imp_query_new(NULL, &options, &error), "imp_query_new");
    expect_nothing(imp_query_new(scene, NULL, &error), "imp_query_new");
    expect_usage(imp_query_step(NULL, 0, &error), "imp_query_step");
    expect_usage(imp_query_get_result(NULL, &result, &error), "imp_query_get_result");
    expect_usage(imp_query_refine(NULL, 1e-9, -1, &error), "imp_query_refine");
    expect_usage(imp_scene_solve(NULL, &options, &result, &error), "imp_query_new");
    expect_usage(imp_scene_solve(scene, NULL, &result, &error), "imp_query_new");
    expect_usage(imp_scene_solve(scene, &options, NULL, &error), "imp_result");
    ck_assert(!imp_query_pending(NULL, 0, &pending));
    imp_query_cancel(NULL);
    imp_query_free(NULL);
    imp_query *query = imp_query_new(scene, &options, &error);
    ck_assert_ptr_nonnull(query);
    expect_usage(imp_query_get_result(query, NULL, &error), "imp_result");
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS); /* errors need no place */
    ck_assert(!imp_query_pending(query, 0, NULL));
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(clearance_queries_take_no_missing_object)
{
    imp_scene *scene = two_balls();
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    expect_usage(imp_clearance_options_get_default(NULL, &error), "imp_clearance_options");
    expect_nothing(imp_clearance_new(NULL, &options, &asked, &error), "imp_query_new");
    expect_nothing(imp_clearance_new(scene, NULL, &asked, &error), "imp_query_new");
    ck_assert_uint_eq(imp_clearance_count(NULL), 0);
    expect_usage(imp_clearance_get(NULL, 0, &answer, &error), "imp_clearance_get");
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    ck_assert_ptr_nonnull(query);
    expect_usage(imp_clearance_get(query, SIZE_MAX, &answer, &error), "answer: got");
    expect_usage(imp_clearance_get(query, 0, NULL, &error), "imp_clearance");
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

SUITE_MAIN("misuse", registries_take_no_missing_object, scenes_are_not_made_from_nothing,
           scenes_tell_nothing_of_what_is_not_there,
           points_outside_of_a_domain_are_refused_with_the_type, queries_take_no_missing_object,
           clearance_queries_take_no_missing_object)
