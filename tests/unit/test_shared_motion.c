/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tests/support/query_helpers.h"

/* Bodies that move together are searched in the frame that moves with them, and bodies that only
 * turn within themselves at one moment. */

#define BOX(X, Y, Z, H)                                                                            \
    "{'type':'mesh','points':[[" #X "," #Y "," #Z "],[" #X "," #Y "," H "],[" #X ",1," #Z "],[" #X \
    ",1," H "],[1," #Y "," #Z "],[1," #Y "," H "],[1,1," #Z "],[1,1," H                            \
    "]],'faces':[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]}"
#define TUMBLE                                                                                     \
    "{'type':'rotate','axis':[1,2,3],'rate':20},{'type':'rotate','axis':[0,1,0],'rate':1.5,"       \
    "'center':[3,0,0]},{'type':'translate','velocity':[5,1,0]}"

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

/* Single quotes stand for double ones. */
static imp_scene *scene_of(const char *quoted)
{
    imp_error error;
    const size_t length = strlen(quoted);
    char *text = malloc(length + 1);
    ck_assert_ptr_nonnull(text);
    for (size_t k = 0; k <= length; ++k) text[k] = quoted[k] == '\'' ? '"' : quoted[k];
    imp_scene *scene = imp_scene_from_json(registry, text, length, "s.json", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    free(text);
    return scene;
}

static imp_result solve(imp_scene *scene, double gamma)
{
    imp_error error;
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    options.max_pairs = 100000;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s", error.text);
    query_check(scene, &options, &r);
    return r;
}

static imp_clearance clearance(imp_scene *scene)
{
    imp_error error;
    imp_options options = imp_options_default(scene);
    options.max_pairs = 100000;
    imp_query *query = imp_clearance_new(scene, &options, NULL, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    ck_assert_msg(imp_query_step(query, 0, &error) == IMP_SUCCESS, "%s", error.text);
    imp_clearance found = {.struct_size = sizeof found};
    ck_assert_int_eq(imp_clearance_get(query, 0, &found, &error), IMP_SUCCESS);
    imp_query_free(query);
    return found;
}

/* Two boxes 0.001 apart, the upper one carried by the lower one, and the same maps written
 * twice. */
static const char *const carried[] = {
    "{'bodies':[{'name':'hand','surfaces':[" BOX(
        -1, -1, -1, "0") "],'maps':[" TUMBLE "]},"
                         "{'name':'part','parent':'hand','surfaces':[" BOX(0, 0, 0.001, "2") "]}]}",
    "{'bodies':[{'surfaces':[" BOX(
        -1, -1, -1, "0") "],'maps':[" TUMBLE "]},"
                         "{'surfaces':[" BOX(0, 0, 0.001, "2") "],'maps':[" TUMBLE "]}]}"};

START_TEST(parts_that_are_carried_cost_what_they_cost_at_rest)
{
    imp_scene *rest = scene_of("{'bodies':[{'surfaces':[" BOX(
        -1, -1, -1, "0") "]},{'surfaces':[" BOX(0, 0, 0.001, "2") "]}]}");
    imp_scene *moved = scene_of(carried[_i]);
    const imp_result of_rest = solve(rest, 1e-4), of_moved = solve(moved, 1e-4);
    ck_assert_int_eq(of_moved.verdict, IMP_VERDICT_CLEAR);
    ck_assert_uint_le(of_moved.stats.pairs, of_rest.stats.pairs);
    const imp_clearance near_rest = clearance(rest), near_moved = clearance(moved);
    ck_assert_double_eq(near_moved.lower, near_rest.lower);
    ck_assert_double_eq(near_moved.upper, near_rest.upper);
    ck_assert_uint_le(near_moved.stats.pairs, near_rest.stats.pairs);
    imp_scene_free(rest);
    imp_scene_free(moved);
}
END_TEST

/* The points told are those of the surfaces in the world, and the normal points from one to the
 * other. */
static void assert_in_world(const imp_scene *scene, const imp_side *a, const imp_side *b, double t,
                            double gap, const double normal[3])
{
    const imp_side *sides[2] = {a, b};
    double x[2][3], along = 0;
    for (int k = 0; k < 2; ++k) {
        const double p[3] = {sides[k]->u, sides[k]->v, t};
        const imp_place at = {sides[k]->body, sides[k]->surface, sides[k]->piece};
        ck_assert_int_eq(imp_piece_eval(scene, at, 1, p, x[k], NULL, NULL), IMP_SUCCESS);
        ck_assert_double_eq(query_distance(x[k], sides[k]->point), 0);
    }
    for (int i = 0; i < 3; ++i) along += normal[i] * (x[1][i] - x[0][i]);
    ck_assert_double_le(fabs(along - gap), 1e-12);
    ck_assert_double_le(fabs(query_distance(x[0], x[1]) - gap), 1e-12);
}

START_TEST(answers_are_told_in_the_world)
{
    imp_scene *scene = scene_of(carried[0]);
    const imp_clearance near = clearance(scene);
    ck_assert(near.has_witness && near.has_normal);
    assert_in_world(scene, &near.a, &near.b, near.t, near.upper, near.normal);
    imp_scene_free(scene);
    scene = scene_of("{'time':[0.25,1],'bodies':[{'name':'hand','surfaces':[{'type':'plane',"
                     "'origin':[-1,-1,0],'edge_u':[2,0,0],'edge_v':[0,2,0]}],'maps':[" TUMBLE
                     "]},{'parent':'hand','surfaces':[{'type':'sphere',"
                     "'radius':0.5,'center':[0,0,1]}],'maps':[{'type':'translate',"
                     "'velocity':[0,0,-1]}]}]}");
    const imp_result r = solve(scene, 1e-3);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(r.t <= 0.5 && r.t >= 0.499 - 1e-6 && r.has_normal && !r.at_rest);
    assert_in_world(scene, &r.a, &r.b, r.t, r.gap, r.normal);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_part_that_touches_what_carries_it_is_not_at_rest)
{
    imp_scene *scene = scene_of("{'bodies':[{'name':'hand','surfaces':[{'type':'plane'}],'maps':["
                                "{'type':'translate','velocity':[1,0,0]}]},{'parent':'hand',"
                                "'surfaces':[{'type':'sphere','center':[0.5,0.5,1]}]}]}");
    const imp_result r = solve(scene, 1e-6);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(!r.at_rest);
    imp_scene_free(scene);
}
END_TEST

/* A map that is not rigid is in the way of those before it. */
START_TEST(only_motion_after_the_last_map_that_is_not_rigid_is_shared)
{
    imp_scene *scene = scene_of(
        "{'bodies':[{'surfaces':[{'type':'sphere'}],'maps':[{'type':'scale','factor':[1,1,3]},"
        "{'type':'rotate','axis':[0,1,0],'rate':9}]},{'surfaces':[{'type':'sphere',"
        "'center':[0,0,2.5]}],'maps':[{'type':'scale','factor':[1,1,3]},{'type':'rotate',"
        "'axis':[0,1,0],'rate':9}]}]}");
    const imp_clearance near = clearance(scene);
    ck_assert_double_le(near.lower, 1.5); /* 3 times half a unit */
    ck_assert_double_ge(near.upper, 1.5);
    assert_in_world(scene, &near.a, &near.b, near.t, near.upper, near.normal);
    imp_scene_free(scene);
}
END_TEST

/* Three bodies on one carrier, of which one is carried by another. */
START_TEST(one_surface_may_be_in_several_frames)
{
    imp_scene *scene = scene_of(
        "{'bodies':[{'name':'arm','surfaces':[{'type':'cylinder','radius':0.2,'height':2}],'maps':["
        "{'type':'rotate','axis':[1,0,0],'rate':3}]},{'name':'hand','parent':'arm','surfaces':[{"
        "'type':'sphere','radius':0.3,'center':[0,0,2.4]}],'maps':[{'type':'rotate','axis':[0,0,1],"
        "'rate':5,'center':[0,0,0]}]},{'name':'part','parent':'hand','surfaces':[{'type':'sphere',"
        "'radius':0.1,'center':[0,0,2.9]}]},{'name':'post','surfaces':[{'type':'sphere','radius':"
        "0.1,'center':[9,0,0]}]}]}");
    const imp_clearance near = clearance(scene);
    ck_assert_double_le(near.lower, 0.1);
    ck_assert_double_ge(near.upper, 0.1);
    ck_assert_double_le(near.upper - near.lower, 0.001);
    ck_assert_uint_le(near.stats.pairs, 100);
    imp_scene_free(scene);
}
END_TEST

/* While hand and part meet in their own frame, contact with what stands still is found in the
 * world. */
START_TEST(the_earliest_contact_of_several_frames_is_told)
{
    imp_scene *scene = scene_of(
        "{'gamma':1e-6,'bodies':[{'name':'hand','surfaces':[{'type':'sphere','radius':1}],'maps':["
        "{'type':'translate','velocity':[4,0,0]}]},{'name':'part','parent':'hand','surfaces':[{"
        "'type':'sphere','radius':1,'center':[0,0,3]}],'maps':[{'type':'translate','velocity':"
        "[0,0,-2]}]},{'name':'wall','surfaces':[{'type':'sphere','radius':1,'center':[4,0,0]}]}]}");
    imp_result r = solve(scene, 1e-6); /* hand and part at 0.5, hand and wall too */
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(r.t <= 0.5 && r.t > 0.5 - 1e-6);
    imp_scene_free(scene);
}
END_TEST

/* --- Turning within themselves ---------------------------------------------------------------- */

typedef struct turning {
    const char *a, *b;
    double gap, gamma;
    uint64_t pairs; /* at most */
} turning;

static const turning turnings[] = {
    {"cylinder height=4 ! rotate rate=20",
     "cylinder height=4 center=2.001,0,0 ! rotate rate=-20 center=2.001,0,0", 1e-3, 1e-4, 50},
    {"torus ! rotate rate=100", "sphere radius=.5 center=1.755,0,0", 5e-3, 5e-4, 50},
    {"torus ! rotate rate=100 ! rotate axis=1,0,0 angle=[1]",
     "sphere radius=.5 center=1.755,0,0 ! rotate axis=1,0,0 angle=[1]", 5e-3, 5e-4, 50},
    {"cylinder height=2 ! rotate rate=100", "plane origin=-1,1.001,-1 edge_u=2,0,0 edge_v=0,0,2",
     1e-3, 1e-4, 50},
    {"sphere radius=.2 center=1,0,0 ! rotate rate=5 axis=0,1,0 center=1,0,0 ! rotate rate=1",
     "torus minor_radius=.201", 1e-3, 1e-4, 2000},
    {"cylinder radius=.2 height=1 center=.799,0,0 ! rotate rate=5 center=.799,0,0 ! rotate rate=1",
     "cylinder height=3", 1e-3, 1e-7, 100},
    {"mesh points=[[-.6,-.6,0],[.6,-.6,0],[0,.8,0],[0,0,.5]] "
     "faces=[[0,2,1],[0,1,3],[1,2,3],[2,0,3]]"
     " ! rotate rate=30",
     "cylinder height=3 radius=.849", 4.7e-4, 1e-5, 200}};

enum { TURNINGS = sizeof turnings / sizeof turnings[0] };

START_TEST(what_turns_within_itself_costs_no_time)
{
    const turning *x = &turnings[_i];
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, x->a, x->b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = x->gamma;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_SUCCESS);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CLEAR);
    ck_assert_double_eq(r.t_lower, 1);
    ck_assert_double_eq(r.gamma_clear, 0.5 * x->gamma);
    ck_assert_msg(r.stats.pairs <= x->pairs, "%llu pairs", (unsigned long long)r.stats.pairs);
    const imp_clearance near = clearance(scene);
    ck_assert_double_le(near.lower, x->gap * 1.01);
    ck_assert_double_ge(near.upper, x->gap * 0.99);
    imp_scene_free(scene);
}
END_TEST

START_TEST(slices_of_time_know_of_what_turns)
{
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, turnings[0].a, turnings[0].b, &error);
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.slices = 3;
    asked.tolerance = 0.5;
    options.t_end = 0.01;
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    ck_assert_int_eq(imp_query_step(query, 0, &error), IMP_SUCCESS);
    for (size_t k = 0; k < 3; ++k) {
        imp_clearance found = {.struct_size = sizeof found};
        ck_assert_int_eq(imp_clearance_get(query, k, &found, &error), IMP_SUCCESS);
        ck_assert(found.has_witness && found.upper < 0.0021 && found.lower > 0);
    }
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* Off its axis by a little more than gamma, a roller comes near and goes away again. */
START_TEST(what_turns_beside_its_axis_is_searched_in_time)
{
    const question q = {.a = "cylinder height=4 ! rotate rate=6.4 center=0.01,0,0",
                        .b = "cylinder height=4 center=-2.005,0,0",
                        .gamma = 1e-4};
    ask_clear(&(question){.a = q.a, .b = q.b, .gamma = 1e-4, .t_end = 0.4, .t_start = 0.1});
    const question mirrored = {.a = q.a, .b = "cylinder height=4 center=2.015,0,0", .gamma = 1e-4};
    const imp_result r = ask(&mirrored);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(r.t > 0.1 && r.t < 0.5);
}
END_TEST

/* A contact that is there from the start is told at the start, wherever both are then. */
START_TEST(what_touches_while_it_turns_touches_at_the_start)
{
    const question q = {.a = "cylinder height=4 ! rotate rate=20",
                        .b = "torus center=2.2,0,0 ! rotate rate=3 center=2.2,0,0",
                        .t_start = 0.25,
                        .t_end = 0.75};
    const imp_result r = ask(&q);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq(r.t, 0.25);
}
END_TEST

/* --- Sliding along faces ---------------------------------------------------------------------- */

/* The x, y and z axes of a table that is inclined, in whole numbers: (2,-1,2), (2,2,-1), (-1,2,2),
 * a third each. */
static void inclined(const double p[3], double x[3])
{
    static const double axis[3][3] = {{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}};
    for (int i = 0; i < 3; ++i)
        x[i] = (axis[0][i] * p[0] + axis[1][i] * p[1] + axis[2][i] * p[2]) / 3;
}

/* A box from lo to hi in the table's axes, as a mesh. */
static void print_box(char *text, size_t size, const double lo[3], const double hi[3])
{
    size_t used = (size_t)snprintf(text, size, "mesh points=[");
    for (int k = 0; k < 8; ++k) {
        double x[3];
        inclined((double[3]){k & 4 ? hi[0] : lo[0], k & 2 ? hi[1] : lo[1], k & 1 ? hi[2] : lo[2]},
                 x);
        used += (size_t)snprintf(text + used, size - used, "%s[%.17g,%.17g,%.17g]", k ? "," : "",
                                 x[0], x[1], x[2]);
    }
    snprintf(text + used, size - used,
             "] faces=[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]");
}

static const char *const tables[] = {
    NULL, /* a mesh */
    "plane origin=-4,-1,-1 edge_u=4,-2,4 edge_v=4,4,-2",
    "bezier degree=[1,1] points=[[-4,-1,-1],[0,3,-3],[0,-3,3],[4,1,1]]",
};

enum { TABLES = sizeof tables / sizeof tables[0] };

START_TEST(a_box_that_turns_on_an_inclined_table_costs_no_time)
{
    for (double gap = 1e-2; gap >= 1e-6; gap /= 100) {
        char box[1000], table[800], moving[1200];
        print_box(box, sizeof box, (double[3]){-0.2, -0.4, gap}, (double[3]){0.8, 0.4, 1});
        print_box(table, sizeof table, (double[3]){-3, -3, -1}, (double[3]){3, 3, 0});
        snprintf(moving, sizeof moving, "%s ! rotate axis=-1,2,2 rate=2", box);
        const question q = {.a = moving,
                            .b = tables[_i] != NULL ? tables[_i] : table,
                            .gamma = gap / 10,
                            .max_pairs = 2000};
        imp_error error;
        imp_scene *scene = imp_scene_from_pair(registry, q.a, q.b, &error);
        ck_assert_msg(scene != NULL, "%s", error.text);
        const imp_options options = query_options(scene, &q);
        imp_result r = {.struct_size = sizeof r};
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_SUCCESS);
        ck_assert_msg(r.verdict == IMP_VERDICT_CLEAR, "gap %g: %llu pairs", gap,
                      (unsigned long long)r.stats.pairs);
        const imp_clearance near = clearance(scene);
        ck_assert_double_le(near.lower, gap * (1 + 1e-9));
        ck_assert_double_ge(near.upper, gap * (1 - 1e-9));
        ck_assert_double_le(near.upper - near.lower, 2e-3 * gap);
        imp_scene_free(scene);
    }
}
END_TEST

/* An axis that leans by a thousandth takes an edge of the box into the table. */
START_TEST(a_box_whose_axis_leans_touches_the_table)
{
    char box[1000], moving[1200];
    print_box(box, sizeof box, (double[3]){-0.8, -0.4, 1e-4}, (double[3]){0.8, 0.4, 1});
    snprintf(moving, sizeof moving, "%s ! rotate axis=-1,2.003,2 rate=3", box);
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, moving, tables[1], &error);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-6;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_SUCCESS);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(r.t > 0 && r.t < 1);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {
        {parts_that_are_carried_cost_what_they_cost_at_rest, 2},
        {answers_are_told_in_the_world, 1},
        {a_part_that_touches_what_carries_it_is_not_at_rest, 1},
        {only_motion_after_the_last_map_that_is_not_rigid_is_shared, 1},
        {one_surface_may_be_in_several_frames, 1},
        {the_earliest_contact_of_several_frames_is_told, 1},
        {what_turns_within_itself_costs_no_time, TURNINGS},
        {slices_of_time_know_of_what_turns, 1},
        {what_turns_beside_its_axis_is_searched_in_time, 1},
        {what_touches_while_it_turns_touches_at_the_start, 1},
        {a_box_that_turns_on_an_inclined_table_costs_no_time, TABLES},
        {a_box_whose_axis_leans_touches_the_table, 1},
    };
    return suite_main_loops("shared motion", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
