/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/solid_helpers.h"

/* Queries, parts of them, clearances, slices and limits about solids agree. */

/* Two balls in a solid one of planes, which come near none of its surfaces, and one outside. */
static const char crowd[] =
    "{\"name\": \"box\", \"solid\": true, \"surfaces\": [{\"type\": \"box\", \"size\": [8, 8, "
    "8]}]}, "
    "{\"name\": \"in\", \"surfaces\": [" SPHERE(
        "0.1", "1") "]}, "
                    "{\"name\": \"too\", \"surfaces\": [" SPHERE(
                        "0.1", "2") "]}, "
                                    "{\"name\": \"out\", \"surfaces\": [" SPHERE("0.1", "9") "]}";

START_TEST(excluding_a_pair_finds_the_next_one_inside)
{
    imp_scene *scene = scene_of(crowd);
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_query_new(scene, &options, NULL);
    for (size_t k = 1; k <= 2; ++k) {
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        imp_result r = imp_query_result(query);
        ck_assert(is_inside(&r) && r.a.body == 0 && r.b.body == k && isnan(r.a.u));
        ck_assert_int_eq(imp_query_refine(query, 1e-7 / (double)k, -1, NULL), IMP_SUCCESS);
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        r = imp_query_result(query);
        ck_assert(is_inside(&r) && r.b.body == k);
        ck_assert_int_eq(imp_query_exclude_pair(query, NULL), IMP_SUCCESS);
    }
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_result(query).verdict, IMP_VERDICT_CLEAR);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(parts_of_a_query_tell_who_is_inside)
{
    imp_scene *scene = scene_of(crowd);
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_query_new(scene, &options, NULL);
    size_t count, inside = 0;
    ck_assert_int_eq(imp_query_divide(query, &count, NULL), IMP_SUCCESS);
    for (size_t k = 0; k < count; ++k) {
        imp_query *part = imp_query_part(query, k, NULL);
        ck_assert_int_eq(imp_query_step(part, 0, NULL), IMP_SUCCESS);
        const imp_result r = imp_query_result(part);
        inside += is_inside(&r);
        imp_query_free(part);
    }
    ck_assert_uint_eq(inside, 2);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

static void check_clearance(imp_scene *scene, const imp_clearance_options *asked, size_t pairs,
                            size_t inside)
{
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_clearance_new(scene, &options, asked, NULL);
    size_t found = 0;
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_uint_eq(imp_clearance_count(query), pairs);
    for (size_t k = 0; k < pairs; ++k) {
        imp_clearance a = {.struct_size = sizeof a};
        ck_assert_int_eq(imp_clearance_get(query, k, &a, NULL), IMP_SUCCESS);
        if (a.kind != IMP_CONTACT_INSIDE) continue;
        found += 1;
        ck_assert(a.lower == 0 && a.upper == 0 && a.has_witness && a.reason == IMP_REASON_NONE);
        ck_assert(a.t == a.t_start);
        if (asked->required == 0) continue;
        ck_assert_int_eq(a.verdict, IMP_REQUIREMENT_VIOLATED);
        ck_assert(asked->slices > 1 || (a.t_violated == 0 && a.gap_violated == 0));
    }
    ck_assert_uint_eq(found, inside);
    imp_query_free(query);
}

START_TEST(clearances_are_zero_inside)
{
    imp_scene *scene = scene_of(crowd);
    imp_clearance_options asked = imp_clearance_options_default();
    check_clearance(scene, &asked, 1, 1);
    asked.required = 0.01;
    check_clearance(scene, &asked, 1, 1);
    asked.decide = true;
    check_clearance(scene, &asked, 1, 1);
    asked.slices = 3;
    check_clearance(scene, &asked, 3, 3);
    asked.slices = 1;
    asked.each = true;
    check_clearance(scene, &asked, 6, 2);
    asked.within = 0.01;
    check_clearance(scene, &asked, 2, 2);
    imp_scene_free(scene);
}
END_TEST

/* A ball comes from outside, and is inside during the last slices, where it touches nothing. */
START_TEST(slices_of_time_that_begin_inside_have_no_distance)
{
    imp_scene *scene =
        scene_of("{\"solid\": true, \"surfaces\": [" SPHERE("1", "0") "]}, {\"surfaces\": [" SPHERE(
            "0.1", "3") "], \"maps\": [{\"type\": \"translate\", \"velocity\": [-3, 0, 0]}]}");
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.slices = 30;
    imp_query *query = imp_clearance_new(scene, &options, &asked, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    for (size_t k = 0; k < 30; ++k) {
        imp_clearance a = {.struct_size = sizeof a};
        ck_assert_int_eq(imp_clearance_get(query, k, &a, NULL), IMP_SUCCESS);
        const bool apart = 3 - 3 * a.t_end > 1.1, inside = 3 - 3 * a.t_start < 0.89;
        ck_assert_msg(apart == (a.lower > 0.01), "slice %zu: %g", k, a.lower);
        ck_assert(!inside || a.kind == IMP_CONTACT_INSIDE);
    }
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* A box whose lid is 0.018 too high, which gamma closes: a ball passes the gap. */
START_TEST(a_slice_that_begins_behind_a_gap_begins_inside)
{
    imp_scene *scene = scene_of(
        "{\"solid\": true, \"surfaces\": ["
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,1.018], \"edge_u\": [2,0,0], \"edge_v\": "
        "[0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,0,2]}, "
        "{\"type\": \"plane\", \"origin\": [-1,1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,0,2]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [0,0,2], \"edge_v\": [0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [1,-1,-1], \"edge_u\": [0,2,0], \"edge_v\": [0,0,2]}]}, "
        "{\"surfaces\": [{\"type\": \"sphere\", \"radius\": 0.001, \"center\": [1.4, 0, 1.209]}], "
        "\"maps\": [{\"type\": \"translate\", \"velocity\": [-1.2, 0, -0.6]}]}");
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    imp_clearance a[2] = {{.struct_size = sizeof *a}, {.struct_size = sizeof *a}};
    options.gamma = 0.02;
    asked.slices = 2;
    imp_query *query = imp_clearance_new(scene, &options, &asked, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    for (size_t k = 0; k < 2; ++k)
        ck_assert_int_eq(imp_clearance_get(query, k, &a[k], NULL), IMP_SUCCESS);
    ck_assert(a[0].upper > 0 && a[0].kind != IMP_CONTACT_INSIDE);
    ck_assert(a[1].lower == 0 && a[1].kind == IMP_CONTACT_INSIDE);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_limit_of_time_ends_the_look_inside)
{
    imp_scene *scene = scene_of(crowd);
    imp_options options = imp_options_default(scene);
    options.max_seconds = 1e-9;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    const imp_result r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_SECONDS);
    ck_assert(r.t_lower == 0);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* A solid of many balls side by side, and a small ball in one of them. */
static imp_scene *many_balls(bool solid)
{
    enum { BALLS = 200 };
    char balls[60 * BALLS];
    size_t length = 0;
    for (int k = 0; k < BALLS; ++k)
        length += (size_t)snprintf(balls + length, sizeof balls - length,
                                   "%s{\"type\":\"sphere\",\"center\":[%d,0,0]}", k > 0 ? "," : "",
                                   3 * k);
    return scene_of(words("{\"surfaces\":[%s]%s},{\"surfaces\":[{\"type\":\"sphere\","
                          "\"radius\":0.1,\"center\":[30,0,0]}]}",
                          balls, solid ? ",\"solid\":true" : "")
                        .text);
}

START_TEST(a_limit_of_memory_ends_the_look_inside)
{
    uint64_t bytes[2];
    for (int solid = 0; solid < 2; ++solid) {
        imp_scene *scene = many_balls(solid);
        const imp_options options = imp_options_default(scene);
        imp_result r = {.struct_size = sizeof r};
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
        ck_assert(is_inside(&r) == solid);
        bytes[solid] = r.stats.bytes;
        imp_scene_free(scene);
    }
    ck_assert_uint_gt(bytes[1], bytes[0] + 200 * 500);
    imp_scene *scene = many_balls(true);
    imp_options options = imp_options_default(scene);
    options.max_bytes = (bytes[0] + bytes[1]) / 2;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    imp_result r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_MEMORY);
    ck_assert(r.t_lower == 0);
    imp_query_free(query);
    const imp_clearance_options asked = imp_clearance_options_default();
    query = imp_clearance_new(scene, &options, &asked, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_MEMORY);
    imp_query_free(query);
    options.max_bytes = 0;
    query = imp_clearance_new(scene, &options, &asked, NULL);
    imp_clearance found = {.struct_size = sizeof found};
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_clearance_get(query, 0, &found, NULL), IMP_SUCCESS);
    ck_assert(found.upper == 0);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        excluding_a_pair_finds_the_next_one_inside,
        parts_of_a_query_tell_who_is_inside,
        clearances_are_zero_inside,
        slices_of_time_that_begin_inside_have_no_distance,
        a_slice_that_begins_behind_a_gap_begins_inside,
        a_limit_of_time_ends_the_look_inside,
        a_limit_of_memory_ends_the_look_inside,
    };
    return suite_main_with("solid_questions", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
