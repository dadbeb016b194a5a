/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/common/random.h"
#include "core/scene/scene_change.h"
#include "core/scene/scene_internal.h"
#include "tests/support/alloc_failure.h"
#include "tests/support/query_helpers.h"

/* Scenes whose numbers change: each answer is that of a scene that is built with these numbers. */

static imp_registry *registry;
static imp_error error;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

static void good(imp_code code) { ck_assert_msg(code == IMP_SUCCESS, "%s", error.text); }

static void refused(imp_code code, imp_code expected, const char *message)
{
    ck_assert_int_eq(code, expected);
    ck_assert_msg(strstr(error.text, message) != NULL, "found: %s\nexpected: %s", error.text,
                  message);
}

/* --- A scene of numbers ----------------------------------------------------------------------- */

/* A hand that turns and moves carries a part, a ball under a map of its own; a patch comes near. */
enum { HAND, PART, PATCH };
typedef struct numbers {
    double radius[2], rate, velocity[3], by[3], points[4][3], patch_velocity[3];
} numbers;

enum { STAGES = 6 };
typedef struct stage {
    size_t body, surface, map;
    const char *type;
    imp_argument argument[2];
    size_t count;
} stage;

static void list_stages(const numbers *x, stage to[STAGES])
{
    static const double degree[2] = {1, 1}, axis[3] = {0, 0, 1};
    const stage all[STAGES] = {
        {HAND, 0, SIZE_MAX, "sphere", {imp_argument_number("radius", x->radius[0])}, 1},
        {HAND,
         SIZE_MAX,
         0,
         "rotate",
         {imp_argument_list("axis", axis, 3), imp_argument_number("rate", x->rate)},
         2},
        {HAND, SIZE_MAX, 1, "translate", {imp_argument_list("velocity", x->velocity, 3)}, 1},
        {PART, 0, SIZE_MAX, "sphere", {imp_argument_number("radius", x->radius[1])}, 1},
        {PART, 0, 0, "translate", {imp_argument_list("velocity", x->by, 3)}, 1},
        {PATCH,
         0,
         SIZE_MAX,
         "bezier",
         {imp_argument_list("degree", degree, 2), imp_argument_rows("points", x->points[0], 4, 3)},
         2},
    };
    memcpy(to, all, sizeof all);
}

static imp_scene *build(const numbers *x)
{
    static const char *const names[] = {"hand", "part", "patch"};
    const imp_argument patch_velocity = imp_argument_list("velocity", x->patch_velocity, 3);
    stage all[STAGES];
    list_stages(x, all);
    imp_builder *b = imp_builder_new(registry);
    good(imp_builder_time(b, 0, 1, &error));
    for (size_t k = 0; k < 3; ++k) good(imp_builder_body(b, names[k], NULL, &error));
    good(imp_builder_parent(b, PART, HAND, &error));
    good(imp_builder_ignore(b, names[HAND], names[PART], &error));
    for (size_t k = 0; k < STAGES; ++k) {
        const stage *s = &all[k];
        if (s->map == SIZE_MAX)
            good(imp_builder_surface(b, s->body, s->type, s->argument, s->count, &error));
        else if (s->surface == SIZE_MAX)
            good(imp_builder_map(b, s->body, s->type, s->argument, s->count, &error));
        else
            good(imp_builder_surface_map(b, s->body, s->surface, s->type, s->argument, s->count,
                                         &error));
    }
    good(imp_builder_map(b, PATCH, "translate", &patch_velocity, 1, &error));
    imp_scene *scene = imp_builder_finish(b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_builder_free(b);
    return scene;
}

static imp_code set(imp_scene *scene, const stage *s)
{
    return imp_scene_set_values(scene, s->body, s->surface, s->map, s->argument, s->count, &error);
}

static void set_all(imp_scene *scene, const numbers *x)
{
    const imp_argument patch_velocity = imp_argument_list("velocity", x->patch_velocity, 3);
    stage all[STAGES];
    list_stages(x, all);
    for (size_t k = 0; k < STAGES; ++k) good(set(scene, &all[k]));
    good(imp_scene_set_values(scene, PATCH, SIZE_MAX, 0, &patch_velocity, 1, &error));
}

static numbers draw_numbers(uint64_t *random)
{
    numbers x = {.rate = random_between(random, -2, 2)};
    for (int i = 0; i < 2; ++i) x.radius[i] = random_between(random, 0.2, 0.6);
    for (int i = 0; i < 3; ++i) {
        x.velocity[i] = random_between(random, -0.2, 0.2);
        x.by[i] = random_between(random, -1, 1);
        x.patch_velocity[i] = random_between(random, -1, 1);
        for (int k = 0; k < 4; ++k)
            x.points[k][i] = random_between(random, -0.1, 0.1) + (i == 0 ? 2 : (k >> (i - 1)) % 2);
    }
    x.patch_velocity[0] = random_between(random, -2, -0.5);
    return x;
}

/* --- Comparing answers ------------------------------------------------------------------------ */

static imp_result solve(imp_scene *scene)
{
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-4;
    imp_result r = {.struct_size = sizeof r};
    good(imp_scene_solve(scene, &options, &r, &error));
    return r;
}

static imp_result limited(imp_scene *scene, const imp_options *options)
{
    imp_result r = {.struct_size = sizeof r};
    good(imp_scene_solve(scene, options, &r, &error));
    return r;
}

static imp_clearance measure(imp_scene *scene)
{
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_clearance_new(scene, &options, NULL, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    good(imp_query_step(query, 0, &error));
    imp_clearance found = {.struct_size = sizeof found};
    good(imp_clearance_get(query, 0, &found, &error));
    imp_query_free(query);
    return found;
}

/* Bit for bit, with NAN like NAN. */
static bool is_same(double x, double y) { return x == y || (isnan(x) && isnan(y)); }

static void check_same_side(const imp_side *x, const imp_side *y)
{
    ck_assert(x->body == y->body && x->surface == y->surface && x->piece == y->piece);
    ck_assert(is_same(x->u, y->u) && is_same(x->v, y->v));
    for (int i = 0; i < 3; ++i) ck_assert(is_same(x->point[i], y->point[i]));
}

static void check_same_result(const imp_result *x, const imp_result *y)
{
    ck_assert(x->verdict == y->verdict && x->reason == y->reason);
    ck_assert(is_same(x->t, y->t) && is_same(x->t_lower, y->t_lower) && is_same(x->gap, y->gap));
    ck_assert(x->t_start == y->t_start && x->t_end == y->t_end);
    ck_assert_uint_eq(x->stats.pairs, y->stats.pairs);
    if (x->verdict != IMP_VERDICT_CONTACT) return;
    check_same_side(&x->a, &y->a);
    check_same_side(&x->b, &y->b);
}

/* Bytes of the instances that a scene keeps to refill them. */
static uint64_t spare_bytes(const imp_scene *scene)
{
    uint64_t bytes = 0;
    for (size_t k = 0; k < scene->spare_count; ++k) bytes += instance_bytes(scene->spare[k]);
    return bytes;
}

/* A scene that was changed holds more than one that is built so by what it keeps to refill. */
static void check_same(imp_scene *x, imp_scene *y)
{
    const imp_result of_x = solve(x), of_y = solve(y);
    check_same_result(&of_x, &of_y);
    const imp_clearance near_x = measure(x), near_y = measure(y);
    ck_assert(near_x.lower == near_y.lower && near_x.upper == near_y.upper);
    ck_assert_uint_eq(near_x.stats.pairs, near_y.stats.pairs);
    ck_assert_uint_eq(scene_bytes(x) - spare_bytes(x), scene_bytes(y) - spare_bytes(y));
    ck_assert(is_same(x->t_from, y->t_from) && is_same(x->t_to, y->t_to));
}

/* --- Tests ------------------------------------------------------------------------------------ */

START_TEST(a_changed_scene_answers_like_one_that_is_built_so)
{
    uint64_t random = suite_seed();
    numbers x = draw_numbers(&random);
    imp_scene *scene = build(&x);
    unsigned contacts = 0;
    enum { DRAWS = 40 };
    for (int k = 0; k < DRAWS; ++k) {
        x = draw_numbers(&random);
        set_all(scene, &x);
        imp_scene *built = build(&x);
        check_same(scene, built);
        contacts += solve(scene).verdict == IMP_VERDICT_CONTACT;
        imp_scene_free(built);
    }
    ck_assert(contacts > 0 && contacts < DRAWS);
    imp_scene_free(scene);
}
END_TEST

START_TEST(each_number_can_be_changed_alone)
{
    uint64_t random = suite_seed();
    numbers x = draw_numbers(&random), y = x;
    imp_scene *scene = build(&x);
    solve(scene);
    y.velocity[1] += 0.1; /* of the hand, which moves the part, too */
    stage all[STAGES];
    list_stages(&y, all);
    good(set(scene, &all[2]));
    imp_scene *built = build(&y);
    check_same(scene, built);
    imp_scene_free(built);
    y.by[2] -= 0.1;
    list_stages(&y, all);
    good(set(scene, &all[4]));
    built = build(&y);
    check_same(scene, built);
    imp_scene_free(built);
    imp_scene_free(scene);
}
END_TEST

/* A limit of bytes ends a query of a changed scene whose kept instances do not fit. */
START_TEST(what_is_kept_to_be_refilled_counts)
{
    uint64_t random = suite_seed();
    const numbers before = draw_numbers(&random), after = draw_numbers(&random);
    imp_scene *scene = build(&before), *built = build(&after);
    const uint64_t begun = scene_bytes(scene);
    stage all[STAGES];
    list_stages(&after, all);
    ck_assert_uint_eq(spare_bytes(scene), 0);
    good(set(scene, &all[0]));
    const uint64_t kept = spare_bytes(scene);
    ck_assert_uint_gt(kept, 0);
    ck_assert_uint_eq(scene_bytes(scene), begun + kept);
    good(set(scene, &all[0])); /* refills the one, and keeps the other */
    ck_assert_uint_eq(scene_bytes(scene), begun + kept);
    set_all(scene, &after);
    ck_assert_uint_eq(scene_bytes(scene), scene_bytes(built) + spare_bytes(scene));
    imp_options options = imp_options_default(scene);
    options.max_bytes = solve(built).stats.bytes;
    ck_assert(limited(built, &options).reason == IMP_REASON_NONE);
    ck_assert(limited(scene, &options).reason == IMP_REASON_MEMORY);
    imp_scene_free(built);
    imp_scene_free(scene);
}
END_TEST

START_TEST(trees_of_other_surfaces_stay)
{
    uint64_t random = suite_seed();
    const numbers x = draw_numbers(&random), y = draw_numbers(&random);
    imp_scene *scene = build(&x);
    stage old[STAGES], all[STAGES];
    list_stages(&x, old);
    list_stages(&y, all);
    solve(scene);
    const tree *hand = scene->bodies[HAND].members[0].trees;
    const tree *patch = scene->bodies[PATCH].members[0].trees;
    ck_assert(hand != NULL && patch != NULL);
    good(set(scene, &old[1])); /* the same numbers: nothing changes */
    ck_assert_ptr_eq(scene->bodies[HAND].members[0].trees, hand);
    good(set(scene, &all[3]));
    ck_assert_ptr_null(scene->bodies[PART].members[0].trees);
    ck_assert_ptr_eq(scene->bodies[HAND].members[0].trees, hand);
    good(set(scene, &all[1])); /* the hand's map */
    ck_assert_ptr_null(scene->bodies[HAND].members[0].trees);
    ck_assert_ptr_eq(scene->bodies[PATCH].members[0].trees, patch);
    imp_scene_free(scene);
}
END_TEST

/* Balls apart, each moved by one of a few velocities: equal ones are one map. */
enum { MANY = 60, VELOCITIES = 8 };

static imp_argument velocity_number(size_t k, double to[3])
{
    for (size_t i = 0; i < 3; ++i) to[i] = k == 0 ? 0 : (double)(k * (i + 1) % 7) / 7 - 0.5;
    return imp_argument_list("velocity", to, 3);
}

static imp_scene *build_many(const size_t velocity[MANY])
{
    imp_builder *b = imp_builder_new(registry);
    good(imp_builder_time(b, 0, 1, &error));
    for (size_t k = 0; k < MANY; ++k) {
        double by[3];
        const double center[3] = {3 * (double)k, 0, 0};
        const imp_argument at = imp_argument_list("center", center, 3);
        const imp_argument moves = velocity_number(velocity[k], by);
        good(imp_builder_body(b, NULL, NULL, &error));
        good(imp_builder_surface(b, k, "sphere", &at, 1, &error));
        if (k % 2 == 0)
            good(imp_builder_map(b, k, "translate", &moves, 1, &error));
        else
            good(imp_builder_surface_map(b, k, 0, "translate", &moves, 1, &error));
    }
    imp_scene *scene = imp_builder_finish(b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_builder_free(b);
    return scene;
}

static scene_stage stage_of_many(size_t k)
{
    return k % 2 == 0 ? (scene_stage){k, SIZE_MAX, 0} : (scene_stage){k, 0, 0};
}

START_TEST(maps_of_many_bodies_are_one_where_they_are_equal)
{
    uint64_t random = suite_seed();
    size_t velocity[MANY];
    for (size_t k = 0; k < MANY; ++k)
        velocity[k] = (size_t)(random_bits(&random) >> 8) % VELOCITIES;
    imp_scene *scene = build_many(velocity);
    for (int change = 0; change < 300; ++change) {
        const size_t body = (size_t)(random_bits(&random) >> 8) % MANY,
                     to = (size_t)(random_bits(&random) >> 8) % VELOCITIES;
        const scene_stage at = stage_of_many(body);
        double by[3];
        const imp_argument moves = velocity_number(to, by);
        velocity[body] = to;
        good(imp_scene_set_values(scene, body, at.surface, 0, &moves, 1, &error));
        const shared_instance *own = scene_stage_at(scene, at);
        for (size_t k = 0; k < MANY; ++k)
            if ((scene_stage_at(scene, stage_of_many(k)) == own) != (velocity[k] == to))
                ck_abort_msg("change %d: body %zu and body %zu", change, body, k);
        size_t distinct = 0;
        for (size_t v = 0; v < VELOCITIES; ++v) {
            bool is_there = false;
            for (size_t k = 0; k < MANY; ++k) is_there = is_there || velocity[k] == v;
            distinct += is_there;
        }
        ck_assert_uint_eq(scene->maps.count, distinct);
    }
    imp_scene *built = build_many(velocity);
    ck_assert_uint_eq(scene_bytes(scene) - spare_bytes(scene) - map_index_bytes(&scene->maps),
                      scene_bytes(built));
    imp_scene_free(built);
    imp_scene_free(scene);
}
END_TEST

/* Two balls that turn together, near each other: in the frame that they share they are at rest. */
static void check_that_equal_maps_are_one(void)
{
    static const char *const pair[2] = {
        "sphere radius=0.5 ! rotate axis=0,0,1 rate=1",
        "sphere radius=0.5 center=1.01,0,0 ! rotate axis=0,0,1 rate=2"};
    static const char *const both[2] = {
        "sphere radius=0.5 ! rotate axis=0,0,1 rate=3",
        "sphere radius=0.5 center=1.01,0,0 ! rotate axis=0,0,1 rate=3"};
    const double axis[3] = {0, 0, 1};
    const imp_argument spin[2] = {imp_argument_number("rate", 3),
                                  imp_argument_list("axis", axis, 3)};
    imp_scene *scene = imp_scene_from_pair(registry, pair[0], pair[1], &error);
    imp_scene *built = imp_scene_from_pair(registry, both[0], both[1], &error);
    solve(scene);
    for (size_t body = 0; body < 2; ++body)
        good(imp_scene_set_values(scene, body, 0, 0, spin, 2, &error));
    ck_assert_uint_eq(surface_common_maps(scene_surface(scene, 0, 0), scene_surface(scene, 1, 0)),
                      1);
    check_same(scene, built);
    const imp_argument other = imp_argument_number("rate", 2);
    const imp_argument differs[2] = {other, spin[1]};
    good(imp_scene_set_values(scene, 1, 0, 0, differs, 2, &error));
    ck_assert_uint_eq(surface_common_maps(scene_surface(scene, 0, 0), scene_surface(scene, 1, 0)),
                      0);
    imp_scene_free(scene);
    imp_scene_free(built);
}

START_TEST(maps_that_become_equal_are_one_map) { check_that_equal_maps_are_one(); }
END_TEST

START_TEST(isolated_maps_that_become_equal_are_one_map)
{
    good(imp_registry_isolate(registry, NULL, &error));
    check_that_equal_maps_are_one();
}
END_TEST

START_TEST(times_to_examine_follow_tables)
{
    static const char table[] = "sphere ! translate times=0,%g positions=[[5,0,0],[3,0,0]]";
    const double times[2] = {0, 3}, positions[2][3] = {{5, 0, 0}, {3, 0, 0}};
    const imp_argument longer[2] = {imp_argument_list("times", times, 2),
                                    imp_argument_rows("positions", positions[0], 2, 3)};
    char line[2][200];
    snprintf(line[0], sizeof line[0], table, 2.0);
    snprintf(line[1], sizeof line[1], table, 3.0);
    imp_scene *scene = imp_scene_from_pair(registry, "sphere", line[0], &error);
    imp_scene *built = imp_scene_from_pair(registry, "sphere", line[1], &error);
    ck_assert_msg(scene != NULL && built != NULL, "%s", error.text);
    ck_assert_double_eq(imp_options_default(scene).t_end, 2);
    good(imp_scene_set_values(scene, 1, 0, 0, longer, 2, &error));
    ck_assert_double_eq(imp_options_default(scene).t_end, 3);
    check_same(scene, built);
    imp_scene_free(scene);
    imp_scene_free(built);
}
END_TEST

START_TEST(remarks_are_those_of_the_values_there_are)
{
    /* a face that is not convex is cut, which is told */
    static const double points[4][3] = {{0, 0, 0}, {2, 0, 0}, {0.2, 0.2, 0}, {0, 2, 0}};
    static const double faces[2][4] = {{0, 1, 2, 3}, {0, 1, 3, 3}};
    imp_argument mesh[2] = {imp_argument_rows("points", points[0], 4, 3),
                            imp_argument_rows("faces", faces[0], 1, 4)};
    imp_builder *b = imp_builder_new(registry);
    imp_remark remark = {.struct_size = sizeof remark};
    good(imp_builder_body(b, "a", NULL, &error));
    good(imp_builder_surface(b, 0, "mesh", mesh, 2, &error));
    imp_scene *scene = imp_builder_finish(b, &error);
    imp_builder_free(b);
    const bool had = imp_scene_remark(scene, 0, &remark);
    mesh[1] = imp_argument_rows("faces", faces[1], 1, 3);
    good(imp_scene_set_values(scene, 0, 0, SIZE_MAX, mesh, 2, &error));
    const bool has = imp_scene_remark(scene, 0, &remark);
    ck_assert(had && !has);
    mesh[1] = imp_argument_rows("faces", faces[0], 1, 4);
    good(imp_scene_set_values(scene, 0, 0, SIZE_MAX, mesh, 2, &error));
    ck_assert(imp_scene_remark(scene, 0, &remark) && strstr(remark.text, "faces") != NULL);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_scene_in_use_is_not_changed)
{
    uint64_t random = suite_seed();
    numbers x = draw_numbers(&random);
    memcpy(x.patch_velocity, (double[3]){-2, 0, 0}, sizeof x.patch_velocity); /* to the hand */
    imp_scene *scene = build(&x);
    stage all[STAGES];
    list_stages(&x, all);
    const imp_options options = imp_options_default(scene);
    size_t parts;
    imp_query *query = imp_query_new(scene, &options, &error);
    refused(set(scene, &all[0]), IMP_ERROR_USAGE, "has 1 queries or surveys");
    good(imp_query_divide(query, &parts, &error));
    ck_assert_uint_gt(parts, 0);
    imp_query *part = imp_query_part(query, 0, &error);
    refused(set(scene, &all[0]), IMP_ERROR_USAGE, "has 2 queries or surveys");
    imp_query_free(part);
    imp_query_free(query);
    query = imp_clearance_new(scene, &options, NULL, &error);
    imp_survey *survey = imp_survey_new(scene, &options, NULL, NULL, &error);
    ck_assert(query != NULL && survey != NULL);
    refused(set(scene, &all[0]), IMP_ERROR_USAGE, "has 2 queries or surveys");
    imp_query_free(query);
    refused(set(scene, &all[0]), IMP_ERROR_USAGE, "has 1 queries or surveys");
    imp_survey_free(survey);
    good(set(scene, &all[0]));
    imp_scene_free(scene);
}
END_TEST

START_TEST(what_is_refused_changes_nothing)
{
    uint64_t random = suite_seed();
    const numbers x = draw_numbers(&random);
    imp_scene *scene = build(&x), *same = build(&x);
    const imp_argument radius = imp_argument_number("radius", 2);
    const imp_argument negative = imp_argument_number("radius", -2);
    const imp_argument unknown = imp_argument_number("radios", 2);
    const imp_argument text = imp_argument_text("radius", "wide");
    const imp_argument clock = imp_argument_text("clock", "j6");
    const imp_argument degree = imp_argument_list("degree", x.points[0], 1);
    const imp_argument nan = imp_argument_number("radius", NAN);
    const size_t none = SIZE_MAX;
    const struct {
        size_t body, surface, map;
        const imp_argument *argument;
        imp_code code;
        const char *message;
    } wrong[] = {
        {3, 0, none, &radius, IMP_ERROR_USAGE, "body 3: the scene has 3 bodies"},
        {none, none, none, &radius, IMP_ERROR_USAGE, "the scene has 3 bodies"},
        {HAND, none, none, &radius, IMP_ERROR_USAGE, "neither a surface nor a map"},
        {HAND, 1, none, &radius, IMP_ERROR_USAGE, "body 'hand' has no surface 1, but 1"},
        {HAND, none, 2, &radius, IMP_ERROR_USAGE, "body 'hand' has no map 2 of its own"},
        {HAND, 0, 0, &radius, IMP_ERROR_USAGE, "body 'hand': surface 0 has no map 0 of its own"},
        {PART, 0, 1, &radius, IMP_ERROR_USAGE, "body 'part': surface 0 has no map 1 of its own"},
        {PART, none, 0, &radius, IMP_ERROR_USAGE, "body 'part' has no map 0 of its own"},
        {HAND, 0, none, &negative, IMP_ERROR_SCENE, "got -2, must be > 0"},
        {HAND, 0, none, &unknown, IMP_ERROR_SCENE, "unknown parameter, did you mean 'radius'"},
        {HAND, 0, none, &text, IMP_ERROR_SCENE, "must be a number"},
        {HAND, 0, none, &nan, IMP_ERROR_SCENE, "must be finite"},
        {HAND, 0, none, &clock, IMP_ERROR_SCENE, "the scene has no parameters"},
        {HAND, none, 1, &radius, IMP_ERROR_SCENE, "body 'hand': map 1"},
        {PATCH, 0, none, &degree, IMP_ERROR_SCENE, "body 'patch': surface 0"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k)
        refused(imp_scene_set_values(scene, wrong[k].body, wrong[k].surface, wrong[k].map,
                                     wrong[k].argument, 1, &error),
                wrong[k].code, wrong[k].message);
    refused(imp_scene_set_values(scene, HAND, 0, none, NULL, 1, &error), IMP_ERROR_USAGE, "NULL");
    refused(imp_scene_set_values(NULL, HAND, 0, none, &radius, 1, &error), IMP_ERROR_USAGE,
            "imp_scene_set_values");
    /* create says no */
    const imp_argument file = imp_argument_text("file", "/none/such.off");
    imp_scene *mesh = imp_scene_from_pair(
        registry, "mesh points=[[0,0,0],[1,0,0],[0,1,0]] faces=[[0,1,2]]", "sphere", &error);
    refused(imp_scene_set_values(mesh, 0, 0, none, &file, 1, &error), IMP_ERROR_SCENE, "none/such");
    ck_assert_uint_eq(imp_scene_piece_count(mesh, 0, 0), 1);
    check_same(scene, same);
    imp_scene_free(mesh);
    imp_scene_free(scene);
    imp_scene_free(same);
}
END_TEST

START_TEST(scenes_with_parameters_are_not_changed)
{
    static const char text[] = "{\"parameters\":{\"q\":[0,1]},\"bodies\":[{\"surfaces\":[{\"type\":"
                               "\"sphere\"}],\"maps\":[{\"type\":\"rotate\",\"axis\":[0,0,1],"
                               "\"rate\":1,\"clock\":\"q\"}]}]}";
    const imp_argument radius = imp_argument_number("radius", 2);
    const double q = 0.5;
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "s", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_scene *at = imp_scene_at(scene, &q, &error);
    refused(imp_scene_set_values(scene, 0, 0, SIZE_MAX, &radius, 1, &error), IMP_ERROR_USAGE,
            "has parameters");
    refused(imp_scene_set_values(at, 0, 0, SIZE_MAX, &radius, 1, &error), IMP_ERROR_USAGE,
            "imp_scene_at");
    imp_scene_free(at);
    imp_scene_free(scene);
}
END_TEST

/* Blocks that live, but for those that the registry's store keeps. */
static size_t live_blocks(const arena_store *store)
{
    return alloc_failure_live() - arena_store_count(store);
}

/* Blocks of an instance that a change replaced, and that the scene keeps to refill it. */
enum { KEPT = 4 };

START_TEST(a_change_is_whole_or_not_there)
{
    uint64_t random = suite_seed();
    const numbers before = draw_numbers(&random), after = draw_numbers(&random);
    imp_scene *old = build(&before);
    const arena_store *store = scene_store(old);
    check_same(old, old);
    const size_t begun = live_blocks(store);
    imp_scene *scene = build(&before);
    stage all[STAGES];
    list_stages(&after, all);
    solve(scene);
    for (size_t k = 1; k < 3; ++k) { /* maps that two bodies have */
        imp_code code = IMP_ERROR_MEMORY;
        size_t n = 1;
        for (bool failed = true; failed; ++n) {
            const size_t live = live_blocks(store);
            alloc_failure_begin(n);
            code = set(scene, &all[k]);
            failed = alloc_failure_end();
            if (!failed) break;
            ck_assert_int_eq(code, IMP_ERROR_MEMORY);
            ck_assert_uint_le(live_blocks(store), live + KEPT);
            if (k == 1 && n % 8 == 1) check_same(scene, old);
        }
        good(code);
        ck_assert_uint_gt(n, 4);
    }
    set_all(scene, &after);
    imp_scene *built = build(&after);
    check_same(scene, built);
    imp_scene_free(built);
    imp_scene_free(scene);
    ck_assert_uint_eq(live_blocks(store), begun);
    imp_scene_free(old);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_changed_scene_answers_like_one_that_is_built_so,
                                  each_number_can_be_changed_alone,
                                  what_is_kept_to_be_refilled_counts,
                                  maps_of_many_bodies_are_one_where_they_are_equal,
                                  trees_of_other_surfaces_stay,
                                  maps_that_become_equal_are_one_map,
                                  isolated_maps_that_become_equal_are_one_map,
                                  times_to_examine_follow_tables,
                                  remarks_are_those_of_the_values_there_are,
                                  a_scene_in_use_is_not_changed,
                                  what_is_refused_changes_nothing,
                                  scenes_with_parameters_are_not_changed,
                                  a_change_is_whole_or_not_there};
    return suite_main_with("set_values", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
