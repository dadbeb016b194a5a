/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/random.h"
#include "tests/support/alloc_failure.h"
#include "tests/support/query_helpers.h"
#include "tools/check/malloc_watch.h"

/* The loop of a simulation: change numbers, ask for contact and distance, read the answers. Once it
 * has run for a while, it allocates nothing: neither core (alloc_failure.h) nor plugins and libc
 * (malloc_watch.h). */

static imp_registry *registry;
static imp_error error;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

/* A ck_assert that holds allocates, too. */
static void good(imp_code code)
{
    if (code != IMP_SUCCESS) ck_abort_msg("%s", error.text);
}

/* --- Two bodies ------------------------------------------------------------------------------- */

enum { NUMBERS_MAX = 64, STEADY = 13, WAYS = STEADY + 1 }; /* the last one allocates */

/* A type whose arguments change, and what meets it. */
typedef struct way {
    const char *type, *other;
    double moves[3];    /* velocity of the other */
    imp_argument fixed; /* of the type; without a name: there is none */
    const char *name;   /* of the argument that changes */
    uint32_t rank;
    size_t extent[2];
    double number[NUMBERS_MAX]; /* around which it changes */
} way;

static const double degree_3[2] = {3, 3};
static const double knots[2][7] = {{0, 0, 0, 1, 2, 2, 2}, {0, 0, 0, 1, 2, 2, 2}};

static way patch_of_16(void)
{
    way w = {.type = "bezier",
             .other = "sphere radius=0.3 center=0.5,0.5,1",
             .moves = {0, 0, -2},
             .fixed = imp_argument_list("degree", degree_3, 2),
             .name = "points",
             .rank = 2,
             .extent = {16, 3}};
    for (int k = 0; k < 16; ++k) {
        const double place[3] = {(k / 4) / 3.0, (k % 4) / 3.0, k % 3 == 0 ? 0.2 : 0};
        memcpy(w.number + 3 * k, place, sizeof place);
    }
    return w;
}

static way nurbs_of_16(void)
{
    way w = patch_of_16();
    w.type = "nurbs";
    w.other = "triangle points=[[1.3,1.4,1.5],[1.7,1.5,1.6],[1.5,1.8,1.7]]";
    w.fixed = (imp_argument){.name = NULL};
    for (int k = 0; k < 16; ++k)
        for (int i = 0; i < 2; ++i) w.number[3 * k + i] *= 3;
    return w;
}

/* Four points, whose faces are triangles, or a polygon and one that is not plane. */
static const double corner_triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
static const double corner_polygons[2][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}};

static way mesh_of(imp_argument faces)
{
    return (way){.type = "mesh",
                 .other = "sphere radius=0.5 center=3,0.2,0.1",
                 .fixed = faces,
                 .name = "points",
                 .rank = 2,
                 .extent = {4, 3},
                 .number = {0, -1, -1, 0, 1, -1, 0, 0, 1, 1, 0.1, 0.2}};
}

static const way *list_ways(void)
{
    static const char ball[] = "sphere radius=0.5 center=3,0.2,0.1";
    static const char patch[] = "bezier degree=1,1 points=[[2,-1,-1],[2,-1,1],[2,1,-1],[2.2,1,1]]";
    static way all[WAYS];
    all[0] = patch_of_16();
    all[1] = (way){.type = "sphere", .other = patch, .name = "radius", .number = {0.5}};
    all[2] = (way){.type = "torus", .other = ball, .name = "major_radius", .number = {1}};
    all[3] = (way){.type = "box",
                   .other = ball,
                   .name = "size",
                   .rank = 1,
                   .extent = {3},
                   .number = {1, 1.1, 1.2}};
    all[4] = (way){.type = "capsule",
                   .other = ball,
                   .name = "to",
                   .fixed = imp_argument_number("radius", 0.25),
                   .rank = 1,
                   .extent = {3},
                   .number = {0.1, 0.2, 1}};
    all[5] = (way){.type = "cylinder", .other = ball, .name = "height", .number = {1}};
    all[6] = (way){.type = "cone", .other = patch, .name = "height", .number = {1}};
    all[7] = (way){.type = "disc", .other = ball, .name = "radius", .number = {1}};
    all[8] = (way){.type = "triangle",
                   .other = ball,
                   .name = "points",
                   .rank = 2,
                   .extent = {3, 3},
                   .number = {0, -1, -1, 0, 1, -1, 0, 0, 1}};
    all[9] = (way){.type = "ellipsoid",
                   .other = ball,
                   .name = "radii",
                   .rank = 1,
                   .extent = {3},
                   .number = {1, 0.5, 0.7}};
    all[10] = mesh_of(imp_argument_rows("faces", corner_triangles[0], 4, 3));
    all[STEADY] = mesh_of(imp_argument_rows("faces", corner_polygons[0], 2, 4)); /* cut, by ears */
    for (int k = 1; k < WAYS; ++k) all[k].moves[0] = -4;
    all[11] = nurbs_of_16();
    all[12] = nurbs_of_16();
    all[12].fixed = imp_argument_rows("knots", knots[0], 2, 7);
    return all;
}

static size_t arguments_of(const way *w, const double *numbers, imp_argument to[2])
{
    to[0] = w->rank == 0   ? imp_argument_number(w->name, numbers[0])
            : w->rank == 1 ? imp_argument_list(w->name, numbers, w->extent[0])
                           : imp_argument_rows(w->name, numbers, w->extent[0], w->extent[1]);
    to[1] = w->fixed;
    return w->fixed.name != NULL ? 2 : 1;
}

static void draw(const way *w, uint64_t *random, double to[NUMBERS_MAX])
{
    size_t count = 1;
    for (uint32_t k = 0; k < w->rank; ++k) count *= w->extent[k];
    for (size_t k = 0; k < count; ++k) to[k] = w->number[k] + random_between(random, -0.1, 0.1);
}

static imp_scene *build(const way *w, const double *numbers, const double *velocity)
{
    imp_argument arguments[2];
    const size_t count = arguments_of(w, numbers, arguments);
    const imp_argument moves = imp_argument_list("velocity", velocity, 3);
    const imp_argument comes = imp_argument_list("velocity", w->moves, 3);
    imp_scene *pair = imp_scene_from_pair(registry, "sphere", w->other, &error);
    ck_assert_msg(pair != NULL, "%s", error.text);
    imp_builder *b = imp_builder_new(registry);
    good(imp_builder_time(b, 0, 1, &error));
    good(imp_builder_body(b, "changed", NULL, &error));
    good(imp_builder_surface(b, 0, w->type, arguments, count, &error));
    good(imp_builder_map(b, 0, "translate", &moves, 1, &error));
    good(imp_builder_body(b, "other", NULL, &error));
    good(imp_builder_surface_of(b, 1, pair, 1, 0, &error));
    good(imp_builder_map(b, 1, "translate", &comes, 1, &error));
    imp_scene *scene = imp_builder_finish(b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_builder_free(b);
    imp_scene_free(pair);
    return scene;
}

/* --- One step --------------------------------------------------------------------------------- */

static void change(imp_scene *scene, const way *w, const double *numbers, const double *velocity)
{
    imp_argument arguments[2];
    const size_t count = arguments_of(w, numbers, arguments);
    const imp_argument moves = imp_argument_list("velocity", velocity, 3);
    good(imp_scene_set_values(scene, 0, 0, SIZE_MAX, arguments, count, &error));
    good(imp_scene_set_values(scene, 0, SIZE_MAX, 0, &moves, 1, &error));
}

static imp_result answer_of(imp_scene *scene)
{
    const imp_options options = imp_options_default(scene);
    imp_result result = {.struct_size = sizeof result};
    good(imp_scene_solve(scene, &options, &result, &error));
    return result;
}

static imp_clearance distance_of(imp_scene *scene)
{
    const imp_options options = imp_options_default(scene);
    const imp_clearance_options asked = imp_clearance_options_default();
    imp_clearance answer = {.struct_size = sizeof answer};
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    if (query == NULL) ck_abort_msg("%s", error.text);
    good(imp_query_step(query, 0, &error));
    good(imp_clearance_get(query, 0, &answer, &error));
    imp_query_free(query);
    return answer;
}

static void check_same(const imp_result *x, const imp_result *y)
{
    ck_assert(x->verdict == y->verdict && x->stats.pairs == y->stats.pairs);
    ck_assert(x->verdict != IMP_VERDICT_CONTACT || x->t == y->t);
    ck_assert(x->t_lower == y->t_lower);
    ck_assert(memcmp(&x->gap, &y->gap, sizeof x->gap) == 0);
    ck_assert(memcmp(x->a.point, y->a.point, sizeof x->a.point) == 0);
}

/* --- Tests ------------------------------------------------------------------------------------ */

/* A few steps are repeated: heaps and blocks of nodes grow as far as these need. */
enum { STEPS = 8, ROUNDS = 4, WARM_UP = 2 };

START_TEST(a_step_of_a_simulation_allocates_nothing)
{
    uint64_t random = suite_seed();
    const way *all = list_ways();
    ck_assert(malloc_watch_begin());
    for (int k = 0; k < STEADY; ++k) {
        double numbers[NUMBERS_MAX], velocity[3] = {0};
        imp_scene *scene = build(&all[k], all[k].number, velocity);
        unsigned contacts = 0;
        const uint64_t first = random;
        for (int step = 0; step < ROUNDS * STEPS; ++step) {
            if (step % STEPS == 0) random = first;
            draw(&all[k], &random, numbers);
            for (int i = 0; i < 3; ++i) velocity[i] = random_between(&random, -0.1, 0.1);
            alloc_failure_begin(0);
            malloc_watch_start();
            change(scene, &all[k], numbers, velocity);
            const imp_result result = answer_of(scene);
            const imp_clearance distance = distance_of(scene);
            const char *called = malloc_watch_stop();
            if (step >= WARM_UP * STEPS)
                ck_assert_msg(called == NULL && alloc_failure_calls() == 0,
                              "%s, step %d: %s, and core %zu times", all[k].type, step,
                              called != NULL ? called : "plugins: nothing", alloc_failure_calls());
            ck_assert(distance.lower <= distance.upper && distance.upper < 10);
            contacts += result.verdict == IMP_VERDICT_CONTACT;
        }
        ck_assert_msg(contacts > STEPS / 2, "%s: %u contacts", all[k].type, contacts);
        imp_scene_free(scene);
    }
}
END_TEST

/* A ball that goes through the positions of three keys, and turns. */
typedef struct motion {
    const char *first; /* its stage before the first change */
    imp_argument fixed[3];
    size_t count;
} motion;

static const double key_times[3] = {0, 0.5, 1};
static const double key_turns[12] = {1, 0, 0, 0, 0.8, 0.6, 0, 0, 0.8, 0, 0.6, 0};
static const double half_turns[12] = {1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0};
static const double key_spins[6] = {0, 0, 6.283185307179586, 0, 0, 6.283185307179586};

static void change_keys(imp_scene *scene, const motion *m, const double *positions)
{
    imp_argument keys[4] = {imp_argument_rows("positions", positions, 3, 3)};
    for (size_t k = 0; k < m->count; ++k) keys[k + 1] = m->fixed[k];
    good(imp_scene_set_values(scene, 0, 0, 0, keys, m->count + 1, &error));
}

static imp_scene *moving(const motion *m)
{
    char pipeline[300];
    snprintf(pipeline, sizeof pipeline,
             "ellipsoid radii=0.5,0.4,0.3 ! %s times=0,0.5,1 positions=[[0,0,0],[1,0,0],[2,0,0]]",
             m->first);
    imp_scene *scene =
        imp_scene_from_pair(registry, pipeline, "sphere radius=0.5 center=3,0.1,0.1", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static void check_motion(const motion *m)
{
    uint64_t random = suite_seed();
    imp_scene *const scene = moving(m);
    const uint64_t first = random;
    for (int step = 0; step < ROUNDS * STEPS; ++step) {
        double positions[9] = {0, 0, 0, 1, 0, 0, 2.5, 0, 0};
        if (step % STEPS == 0) random = first;
        for (int i = 0; i < 9; ++i) positions[i] += random_between(&random, -0.1, 0.1);
        alloc_failure_begin(0);
        malloc_watch_start();
        change_keys(scene, m, positions);
        const imp_result result = answer_of(scene);
        const imp_clearance distance = distance_of(scene);
        const char *called = malloc_watch_stop();
        if (step >= WARM_UP * STEPS)
            ck_assert_msg(called == NULL && alloc_failure_calls() == 0,
                          "%s, step %d: %s, and core %zu times", m->first, step,
                          called != NULL ? called : "plugins: nothing", alloc_failure_calls());
        ck_assert(distance.lower <= distance.upper);
        ck_assert_int_eq(result.verdict, IMP_VERDICT_CONTACT);
        imp_scene *anew = moving(m);
        change_keys(anew, m, positions); /* creates, without a spare instance */
        const imp_result same = answer_of(anew);
        check_same(&result, &same);
        imp_scene_free(anew);
    }
    imp_scene_free(scene);
}

START_TEST(keys_of_a_motion_change_without_an_allocation)
{
    const imp_argument times = imp_argument_list("times", key_times, 3);
    const motion all[] = {
        {"keyframes", {times, imp_argument_rows("rotations", key_turns, 3, 4)}, 2},
        {"trajectory", {times}, 1},
        {"trajectory",
         {times, imp_argument_rows("rotations", half_turns, 3, 4),
          imp_argument_rows("spins", key_spins, 2, 3)},
         3},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) check_motion(&all[k]);
}
END_TEST

START_TEST(a_refilled_instance_answers_like_a_new_one)
{
    uint64_t random = suite_seed();
    const way *all = list_ways();
    for (int k = 0; k < WAYS; ++k) {
        double numbers[NUMBERS_MAX], velocity[3] = {0};
        imp_scene *scene = build(&all[k], all[k].number, velocity);
        for (int step = 0; step < 6; ++step) {
            draw(&all[k], &random, numbers);
            velocity[0] = random_between(&random, -0.1, 0.1);
            change(scene, &all[k], numbers, velocity);
            imp_scene *built = build(&all[k], numbers, velocity);
            const imp_result x = answer_of(scene), y = answer_of(built);
            const imp_clearance near[2] = {distance_of(scene), distance_of(built)};
            check_same(&x, &y);
            ck_assert(near[0].lower == near[1].lower && near[0].upper == near[1].upper);
            imp_scene_free(built);
        }
        imp_scene_free(scene);
    }
}
END_TEST

/* The degree changes to and fro: what is spare never has the room, or has it by chance. */
START_TEST(values_of_another_shape_make_a_new_instance)
{
    static const double flat[2] = {1, 1};
    const double corners[4][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0.1}, {1, 1, 0}};
    const imp_argument small[2] = {imp_argument_rows("points", corners[0], 4, 3),
                                   imp_argument_list("degree", flat, 2)};
    const way w = patch_of_16();
    double velocity[3] = {0};
    imp_scene *scene = build(&w, w.number, velocity), *built = build(&w, w.number, velocity);
    const imp_result expected = answer_of(built);
    for (int step = 0; step < 4; ++step) {
        good(imp_scene_set_values(scene, 0, 0, SIZE_MAX, small, 2, &error));
        answer_of(scene);
        change(scene, &w, w.number, velocity);
        const imp_result result = answer_of(scene);
        check_same(&result, &expected);
    }
    imp_scene_free(built);
    imp_scene_free(scene);
}
END_TEST

/* Numbers that create refuses reach the spare instance first. */
START_TEST(a_refused_change_leaves_the_scene_and_tells_why)
{
    static const double flat[2] = {3, 2};
    const way w = patch_of_16();
    double velocity[3] = {0}, numbers[NUMBERS_MAX];
    imp_scene *scene = build(&w, w.number, velocity);
    memcpy(numbers, w.number, sizeof numbers);
    for (int step = 0; step < 3; ++step) change(scene, &w, w.number, velocity);
    const imp_result before = answer_of(scene);
    const imp_argument wrong[2] = {imp_argument_rows("points", numbers, 16, 3),
                                   imp_argument_list("degree", flat, 2)};
    for (int step = 0; step < 3; ++step) {
        ck_assert_int_eq(imp_scene_set_values(scene, 0, 0, SIZE_MAX, wrong, 2, &error),
                         IMP_ERROR_SCENE);
        ck_assert_msg(strstr(error.text, "points: 16 given, but a patch of degree [3,2]") != NULL,
                      "%s", error.text);
        const imp_result after = answer_of(scene);
        check_same(&before, &after);
    }
    imp_scene_free(scene);
}
END_TEST

static imp_result answer_after_change(imp_registry *of)
{
    static const double corners[4][3] = {{0, -1, -1}, {0.1, -1, 1}, {0, 1, -1}, {0.2, 1, 1}};
    static const double flat[2] = {1, 1}, velocity[3] = {1, 0.1, 0};
    const imp_argument patch[2] = {imp_argument_rows("points", corners[0], 4, 3),
                                   imp_argument_list("degree", flat, 2)};
    const imp_argument moves = imp_argument_list("velocity", velocity, 3);
    imp_scene *scene = imp_scene_from_pair(
        of, "bezier degree=1,1 points=[[0,0,0],[0,0,1],[0,1,0],[0,1,1]] ! translate velocity=0,0,0",
        "sphere radius=0.3 center=1,0,0", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    for (int step = 0; step < 3; ++step) {
        good(imp_scene_set_values(scene, 0, 0, SIZE_MAX, patch, 2, &error));
        good(imp_scene_set_values(scene, 0, 0, 0, &moves, 1, &error));
    }
    const imp_result result = answer_of(scene);
    imp_scene_free(scene);
    return result;
}

START_TEST(isolated_types_are_created_anew)
{
    const imp_result x = answer_after_change(registry);
    imp_registry *apart = query_registry();
    good(imp_registry_isolate(apart, NULL, &error));
    const imp_result y = answer_after_change(apart);
    ck_assert_int_eq(x.verdict, IMP_VERDICT_CONTACT);
    check_same(&x, &y);
    imp_registry_free(apart);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_refilled_instance_answers_like_a_new_one,
                                  values_of_another_shape_make_a_new_instance,
                                  a_refused_change_leaves_the_scene_and_tells_why,
                                  isolated_types_are_created_anew,
                                  a_step_of_a_simulation_allocates_nothing,
                                  keys_of_a_motion_change_without_an_allocation};
    return suite_main_with("steady_state", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
