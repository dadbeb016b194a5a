/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/scene_text.h"

/* Scenes that a program builds: the same as those from text, and the same care. */

static imp_builder *begin(void)
{
    if (registry == NULL) registry = kit_registry();
    imp_builder *b = imp_builder_new(registry);
    ck_assert_ptr_nonnull(b);
    error = (imp_error){IMP_SUCCESS, ""};
    return b;
}

static void good(imp_code code) { ck_assert_msg(code == IMP_SUCCESS, "%s", error.text); }

static void refused(imp_code code, imp_code expected, const char *message)
{
    ck_assert_int_eq(code, expected);
    ck_assert_int_eq(error.code, expected);
    ck_assert_msg(strstr(error.text, message) != NULL, "found: %s\nexpected: %s", error.text,
                  message);
}

/* A body of a kit of radius 1. */
static size_t add_body(imp_builder *b, const char *name)
{
    size_t body = 99;
    const imp_argument radius = imp_argument_number("radius", 1);
    good(imp_builder_body(b, name, &body, &error));
    good(imp_builder_surface(b, body, "kit", &radius, 1, &error));
    return body;
}

static imp_scene *finish(imp_builder *b)
{
    imp_scene *scene = imp_builder_finish(b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_builder_free(b);
    return scene;
}

static const double by[3] = {1, 0, 0}, up[3] = {0, 0, 2}, center[3] = {1, 2, 3};

START_TEST(a_scene_built_is_the_scene_that_is_written)
{
    imp_builder *b = begin();
    const imp_argument kit[] = {imp_argument_number("radius", 1),
                                imp_argument_list("center", center, 3)};
    const imp_argument sideways = imp_argument_list("by", by, 3);
    const imp_argument upwards = imp_argument_list("by", up, 3);
    size_t arm = 9, hand = 9;
    good(imp_builder_time(b, -1, 2, &error));
    good(imp_builder_gamma(b, 0.25, 0.125, &error));
    good(imp_builder_body(b, "arm", &arm, &error));
    good(imp_builder_body(b, NULL, &hand, &error));
    ck_assert(arm == 0 && hand == 1);
    good(imp_builder_surface(b, arm, "kit", kit, 2, &error));
    good(imp_builder_surface(b, hand, "kit", kit, 2, &error));
    good(imp_builder_map(b, arm, "nudge", &upwards, 1, &error));
    good(imp_builder_surface_map(b, hand, 0, "nudge", &sideways, 1, &error));
    good(imp_builder_parent(b, hand, arm, &error));
    good(imp_builder_group(b, arm, "robot", &error));
    good(imp_builder_group(b, hand, "robot", &error));
    good(imp_builder_ignore(b, "robot", "robot", &error));
    imp_scene *scene = finish(b);
    const imp_options o = imp_options_default(scene);
    ck_assert(o.t_start == -1 && o.t_end == 2 && o.gamma == 0.25 && o.gamma_clear == 0.125);
    ck_assert_str_eq(imp_scene_body_name(scene, 1), "body1");
    assert_point(scene, 0, 0, 1, 2, 5);
    assert_point(scene, 1, 0, 2, 2, 5);
    ck_assert(scene_ignores(scene, 0, 1));
    imp_scene_free(scene);
}
END_TEST

START_TEST(values_of_every_kind_are_taken)
{
    const char *const names[] = {"a", "b"};
    const double rows[] = {1, 2, 3, 4, 5, 6}, weights[] = {0.5, 1}, constants[] = {1, 2};
    imp_argument count = imp_argument_number("count", 3),
                 table = imp_argument_of("constants", IMP_KIND_TABLE, 0);
    count.kind = IMP_KIND_INTEGER;
    table.extent[0] = 2, table.string = names, table.number = constants;
    const imp_argument all[] = {imp_argument_number("radius", 1),
                                imp_argument_rows("points", rows, 2, 3),
                                imp_argument_list("weights", weights, 2),
                                imp_argument_text("label", "x"),
                                imp_argument_boolean("closed", true),
                                count,
                                table};
    imp_builder *b = begin();
    good(imp_builder_body(b, "a", NULL, &error));
    good(imp_builder_surface(b, 0, "kit", all, sizeof all / sizeof *all, &error));
    imp_scene_free(finish(b));
}
END_TEST

static void surface_refused(imp_argument argument, imp_code code, const char *message)
{
    imp_builder *b = begin();
    good(imp_builder_body(b, "pot", NULL, &error));
    const imp_argument all[] = {imp_argument_number("radius", 1), argument};
    const bool again = argument.name != NULL && strcmp(argument.name, "radius") == 0;
    refused(imp_builder_surface(b, 0, "kit", all + again, (size_t)2 - again, &error), code,
            message);
    imp_builder_free(b);
}

/* Arguments that are all numbers take a way of their own, on which no object is made. */
START_TEST(numbers_make_the_instance_that_an_object_makes)
{
    const double far[3] = {0.1, -0.0, -3e20};
    const imp_argument numbers[] = {imp_argument_number("radius", 1),
                                    imp_argument_list("center", far, 3)};
    imp_builder *b = begin();
    good(imp_builder_body(b, "a", NULL, &error));
    good(imp_builder_surface(b, 0, "kit", numbers, 2, &error));
    imp_scene *built = finish(b);
    imp_scene *read = read_scene("{'bodies': [{'name': 'a', 'surfaces': ["
                                 "{'type': 'kit', 'radius': 1, 'center': [0.1, -0.0, -3e20]}]}]}");
    ck_assert_uint_eq(scene_bytes(built), scene_bytes(read));
    shared_instance *x = surface_share(scene_surface(built, 0, 0));
    shared_instance *y = surface_share(scene_surface(read, 0, 0));
    char label[2][INSTANCE_LABEL_MAX];
    instance_label(x, label[0]), instance_label(y, label[1]);
    ck_assert_str_eq(label[0], label[1]);
    ck_assert_str_eq(label[0], "kit radius=1 center=0.1,-0,-3e+20");
    ck_assert_uint_eq(x->given, y->given);
    instance_release(x);
    instance_release(y);
    imp_scene_free(built);
    imp_scene_free(read);
}
END_TEST

START_TEST(errors_name_body_and_parameter)
{
    const double bad[] = {1, 2, NAN}, none = 0;
    imp_argument strange = imp_argument_of("center", 9, 0);
    surface_refused(imp_argument_number("radius", -1), IMP_ERROR_SCENE,
                    "body 'pot': surface 0: radius: got -1, must be > 0");
    surface_refused(imp_argument_number("radius", INFINITY), IMP_ERROR_SCENE,
                    "body 'pot': surface 0: radius: got inf at element 0");
    surface_refused(imp_argument_list("center", bad, 2), IMP_ERROR_SCENE,
                    "body 'pot': surface 0: center: got an array of 2");
    surface_refused(imp_argument_list("center", bad, 3), IMP_ERROR_SCENE,
                    "body 'pot': surface 0: center: got nan at element 2");
    surface_refused(imp_argument_list("center", &none, 0), IMP_ERROR_SCENE,
                    "body 'pot': surface 0: center: extent 0 is 0, must be from 1");
    surface_refused(imp_argument_list("center", NULL, 3), IMP_ERROR_USAGE, "the array is NULL");
    surface_refused(imp_argument_rows("points", bad, SIZE_MAX / 2, 3), IMP_ERROR_SCENE,
                    "points: extent 1 is 3");
    surface_refused(imp_argument_number("radios", 1), IMP_ERROR_SCENE, "did you mean 'radius'?");
    surface_refused(imp_argument_text("label", "\xFF"), IMP_ERROR_SCENE, "not UTF-8");
    surface_refused(imp_argument_text("label", NULL), IMP_ERROR_SCENE, "is NULL");
    surface_refused(imp_argument_text("type", "x"), IMP_ERROR_SCENE, "type: is given twice");
    surface_refused(strange, IMP_ERROR_USAGE, "kind 9 of rank 0 does not exist");
}
END_TEST

START_TEST(tables_and_names_that_cannot_be_are_refused)
{
    const char *names[] = {"q", NULL};
    const double numbers[] = {1, 2};
    imp_argument a = imp_argument_of("constants", IMP_KIND_TABLE, 0);
    a.string = names, a.number = numbers, a.extent[0] = 2;
    surface_refused(a, IMP_ERROR_SCENE, "constants: element 1 has no name of UTF-8");
    names[1] = "\xC0";
    surface_refused(a, IMP_ERROR_SCENE, "constants: element 1 has no name of UTF-8");
    const double infinite[] = {INFINITY, 2};
    a.number = infinite;
    surface_refused(a, IMP_ERROR_SCENE, "constants: element 0 has no name of UTF-8 or no finite");
    a.number = NULL;
    surface_refused(a, IMP_ERROR_USAGE, "constants: the array is NULL");
    surface_refused(imp_argument_number(NULL, 1), IMP_ERROR_USAGE, "an argument has no name");
    surface_refused(imp_argument_number("\xFF", 1), IMP_ERROR_USAGE, "an argument has no name");
    imp_builder *b = begin();
    good(imp_builder_body(b, NULL, NULL, &error));
    refused(imp_builder_surface(b, 0, "\xFF", NULL, 0, &error), IMP_ERROR_USAGE, "not UTF-8");
    imp_builder_free(b);
}
END_TEST

START_TEST(calls_out_of_order_are_refused)
{
    imp_builder *b = begin();
    refused(imp_builder_surface(b, 0, "kit", NULL, 0, &error), IMP_ERROR_USAGE,
            "body 0: there are only 0 bodies so far");
    ck_assert_ptr_null(imp_builder_finish(b, &error));
    refused(error.code, IMP_ERROR_SCENE, "the scene has no bodies");
    good(imp_builder_body(b, "empty", NULL, &error));
    imp_scene *frames = imp_builder_finish(b, &error); /* a lone frame is a scene */
    ck_assert_ptr_nonnull(frames);
    ck_assert_uint_eq(imp_scene_surface_count(frames, 0), 0);
    imp_scene_free(frames);
    imp_builder_free(b);
    b = begin();
    const size_t arm = add_body(b, "arm"), hand = add_body(b, "hand");
    refused(imp_builder_body(b, "arm", NULL, &error), IMP_ERROR_SCENE, "which body 0 has");
    refused(imp_builder_surface(b, arm, "kti", NULL, 0, &error), IMP_ERROR_SCENE,
            "body 'arm': surface 1: unknown surface type 'kti', did you mean 'kit'?");
    refused(imp_builder_map(b, arm, "nudge", NULL, 0, &error), IMP_ERROR_SCENE,
            "body 'arm': map 0: 'by' is missing");
    refused(imp_builder_surface_map(b, arm, 7, "nudge", NULL, 0, &error), IMP_ERROR_USAGE,
            "body 'arm' has no surface 7");
    refused(imp_builder_ignore(b, "arm", "amr", &error), IMP_ERROR_SCENE, "did you mean 'arm'?");
    refused(imp_builder_time(b, 1, 0, &error), IMP_ERROR_USAGE, "time: got [1, 0]");
    refused(imp_builder_gamma(b, 0, -1, &error), IMP_ERROR_USAGE, "gamma: got 0");
    refused(imp_builder_gamma(b, 1, 2, &error), IMP_ERROR_USAGE, "gamma_clear: got 2");
    good(imp_builder_parent(b, hand, arm, &error));
    good(imp_builder_parent(b, arm, hand, &error));
    ck_assert_ptr_null(imp_builder_finish(b, &error));
    refused(error.code, IMP_ERROR_SCENE, "body 'arm': parent: got a circle of parents");
    imp_builder_free(b);
}
END_TEST

START_TEST(a_builder_that_is_done_takes_nothing_more)
{
    imp_builder *b = begin();
    add_body(b, "a");
    imp_scene *scene = imp_builder_finish(b, &error);
    ck_assert_ptr_nonnull(scene);
    refused(imp_builder_body(b, "b", NULL, &error), IMP_ERROR_USAGE, "has made its scene already");
    ck_assert_ptr_null(imp_builder_finish(b, &error));
    imp_builder_free(b);
    imp_scene_free(scene);
    refused(imp_builder_body(NULL, "b", NULL, &error), IMP_ERROR_USAGE, "the builder is NULL");
    ck_assert_ptr_null(imp_builder_new(NULL));
    imp_builder_free(NULL);
}
END_TEST

START_TEST(a_surface_of_another_scene_is_shared)
{
    imp_builder *b = begin();
    const imp_argument kit[] = {imp_argument_number("radius", 1),
                                imp_argument_list("center", center, 3)};
    const imp_argument sideways = imp_argument_list("by", by, 3);
    size_t body;
    good(imp_builder_body(b, "part", &body, &error));
    good(imp_builder_surface(b, body, "kit", kit, 2, &error));
    good(imp_builder_map(b, body, "nudge", &sideways, 1, &error));
    imp_scene *part = finish(b);
    b = begin();
    good(imp_builder_body(b, "first", &body, &error));
    refused(imp_builder_surface_of(b, 7, part, 0, 0, &error), IMP_ERROR_USAGE, "body 7");
    refused(imp_builder_surface_of(b, body, NULL, 0, 0, &error), IMP_ERROR_USAGE, "is NULL");
    refused(imp_builder_surface_of(b, body, part, 1, 0, &error), IMP_ERROR_USAGE, "no surface 0");
    refused(imp_builder_surface_of(b, body, part, 0, 1, &error), IMP_ERROR_USAGE, "no surface 1");
    good(imp_builder_surface_of(b, body, part, 0, 0, &error));
    good(imp_builder_body(b, "second", &body, &error));
    good(imp_builder_surface_of(b, body, part, 0, 0, &error));
    good(imp_builder_surface_map(b, body, 0, "nudge", &sideways, 1, &error));
    imp_scene *scene = finish(b);
    const surface *own[] = {scene_surface(part, 0, 0), scene_surface(scene, 0, 0),
                            scene_surface(scene, 1, 0)};
    ck_assert_ptr_eq(surface_origin(own[0], 0), surface_origin(own[1], 0));
    ck_assert_ptr_eq(surface_origin(own[0], 0), surface_origin(own[2], 0));
    imp_scene_free(part);
    assert_point(scene, 0, 0, 1, 2, 3); /* the maps are not shared */
    assert_point(scene, 1, 0, 2, 2, 3);
    imp_scene_free(scene);
}
END_TEST

/* Two bodies of a group, of which the second moves with the first. */
static imp_scene *template_scene(void)
{
    imp_builder *b = begin();
    const imp_argument kit[] = {imp_argument_number("radius", 1),
                                imp_argument_list("center", center, 3)};
    const imp_argument sideways = imp_argument_list("by", by, 3);
    for (size_t body = 0; body < 2; ++body) {
        good(imp_builder_body(b, body == 0 ? "first" : "second", NULL, &error));
        good(imp_builder_surface(b, body, "kit", kit, 2, &error));
        good(imp_builder_surface_map(b, body, 0, "nudge", &sideways, 1, &error));
        good(imp_builder_map(b, body, "nudge", &sideways, 1, &error));
        good(imp_builder_group(b, body, "both", &error));
    }
    good(imp_builder_parent(b, 1, 0, &error));
    good(imp_builder_solid(b, 1, true, &error));
    good(imp_builder_ignore(b, "both", "both", &error));
    return finish(b);
}

START_TEST(bodies_of_another_scene_are_as_they_are_there)
{
    const imp_argument sideways = imp_argument_list("by", by, 3);
    imp_scene *whole = template_scene();
    imp_builder *b = begin();
    refused(imp_builder_bodies_of(b, NULL, &error), IMP_ERROR_USAGE, "is NULL");
    good(imp_builder_bodies_of(b, whole, &error));
    refused(imp_builder_bodies_of(b, whole, &error), IMP_ERROR_USAGE, "has bodies");
    refused(imp_builder_body(b, "second", NULL, &error), IMP_ERROR_SCENE, "which body 1 has");
    refused(imp_builder_body(b, "both", NULL, &error), IMP_ERROR_SCENE, "which a group has");
    add_body(b, "third");
    good(imp_builder_group(b, 2, "both", &error));
    good(imp_builder_map(b, 0, "nudge", &sideways, 1, &error));
    imp_scene *scene = finish(b);
    for (size_t body = 0; body < 2; ++body)
        for (size_t k = 0; k < 3; ++k)
            ck_assert_ptr_eq(surface_origin(scene_surface(scene, body, 0), k),
                             surface_origin(scene_surface(whole, body, 0), k));
    ck_assert(imp_scene_ignores(scene, 0, 1) && imp_scene_ignores(scene, 1, 2));
    ck_assert(!imp_scene_is_solid(scene, 0) && imp_scene_is_solid(scene, 1));
    imp_scene_free(whole);
    assert_point(scene, 0, 0, 4, 2, 3);
    assert_point(scene, 1, 0, 5, 2, 3);
    imp_scene_free(scene);
}
END_TEST

START_TEST(bodies_of_a_scene_of_another_registry_are_refused)
{
    sandbox box = sandbox_new();
    imp_registry *other = imp_registry_new(box.path);
    imp_scene *scene = template_scene();
    imp_builder *b = imp_builder_new(other);
    refused(imp_builder_bodies_of(b, scene, &error), IMP_ERROR_USAGE, "of another registry");
    imp_builder_free(b);
    b = begin();
    good(imp_builder_parameter(b, "p", 0, 1, &error));
    refused(imp_builder_bodies_of(b, scene, &error), IMP_ERROR_USAGE, "or parameters already");
    imp_builder_free(b);
    imp_scene_free(scene);
    imp_registry_free(other);
    sandbox_remove(&box);
}
END_TEST

START_TEST(a_surface_of_a_type_that_the_registry_lacks_is_refused)
{
    imp_builder *b = begin();
    add_body(b, "a");
    imp_scene *scene = finish(b);
    sandbox box = sandbox_new();
    imp_registry *other = imp_registry_new(box.path); /* a folder without plugins */
    b = imp_builder_new(other);
    size_t body;
    good(imp_builder_body(b, "b", &body, &error));
    refused(imp_builder_surface_of(b, body, scene, 0, 0, &error), IMP_ERROR_USAGE,
            "is of a type 'kit' that the builder's registry does not have");
    imp_builder_free(b);
    imp_scene_free(scene);
    imp_registry_free(other);
    sandbox_remove(&box);
}
END_TEST

START_TEST(time_left_is_the_papers_h)
{
    imp_result r = {.verdict = IMP_VERDICT_CONTACT, .t = 0.75, .t_lower = 0.75};
    ck_assert(imp_time_left(&r, 0.5) == 0.25 && imp_time_left(&r, 1) == -0.25);
    r.verdict = IMP_VERDICT_CLEAR;
    ck_assert(imp_time_left(&r, 0.5) == INFINITY);
    r.verdict = IMP_VERDICT_UNDECIDED;
    ck_assert(imp_time_left(&r, 0.25) == 0.5);
}
END_TEST

SUITE_MAIN("builder", a_scene_built_is_the_scene_that_is_written, values_of_every_kind_are_taken,
           numbers_make_the_instance_that_an_object_makes, errors_name_body_and_parameter,
           tables_and_names_that_cannot_be_are_refused, calls_out_of_order_are_refused,
           a_builder_that_is_done_takes_nothing_more, a_surface_of_another_scene_is_shared,
           bodies_of_another_scene_are_as_they_are_there,
           bodies_of_a_scene_of_another_registry_are_refused,
           a_surface_of_a_type_that_the_registry_lacks_is_refused, time_left_is_the_papers_h)
