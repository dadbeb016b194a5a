/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/clearance_helpers.h"

/* Brackets of the minimum distance: closed forms, sampled points, searches for contact; slices of
 * time and pairs of bodies. */

/* --- Closed forms ----------------------------------------------------------------------------- */

typedef struct closed_form {
    const char *a, *b;
    double distance, t; /* t < 0: at any time */
    double finest;      /* tolerance */
} closed_form;

static const closed_form closed_forms[] = {
    {"sphere", "sphere radius=0.5 center=3,4,0", 3.5, -1, 1e-9},
    {"sphere", "sphere radius=0.5 center=-3,2,0 ! translate velocity=6,0,0", 0.5, 0.5, 1e-9},
    {"sphere", "sphere radius=0.5 center=3,0,0 ! translate velocity=-1,0,0", 0.5, 1, 1e-9},
    {"sphere", "sphere radius=0.5 center=1.75,0,0 ! translate velocity=1,0,0", 0.25, 0, 1e-9},
    {"sphere radius=2", "sphere radius=0.25 center=0.5,0,0", 1.25, -1, 1e-9},
    {"sphere radius=0.5 center=0,0,-3 ! translate velocity=0,0,6", /* least along a circle */
     "torus major_radius=1 minor_radius=0.25", 0.25, 0.5, 1e-3},
    {"plane origin=-2,-2,0 edge_u=4,0,0 edge_v=0,4,0",
     "sphere radius=0.5 center=0.3,0.1,2 ! translate offset=[[0,0,0],[0,0,-4],[0,0,4]]", 0.5, 0.5,
     1e-9},
    {"segment points=[[-1,0,0],[1,0,0]]", "segment points=[[0,-1,0.125],[0,1,0.125]]", 0.125, -1,
     1e-9},
    {"point position=0,0,2", "cylinder radius=0.5 height=6", 0.5, -1, 1e-6},
    /* along areas: a shaft in its bore, one off its axis, a piston, a ball in its socket and one in
     * a race */
    {"cylinder radius=0.99 ! rotate rate=3", "cylinder", 0.01, -1, 1e-2},
    {"cylinder radius=0.98 center=0.01,0,0 ! rotate rate=3", "cylinder", 0.01, -1, 1e-4},
    {"cylinder radius=0.99 height=1 ! translate velocity=0,0,0.5",
     "cylinder height=4 center=3,0,0 ! translate offset=[[-3,0,0]]", 0.01, -1, 1e-6},
    {"sphere radius=0.75 center=0.03125,0,0 ! rotate axis=1,2,3 rate=2", "sphere", 0.21875, -1,
     1e-2},
    {"sphere radius=0.125 center=1,0,0 ! rotate rate=1", "torus", 0.125, -1, 1e-2},
    {"point position=3,0,0 ! rotate axis=0,0,1 rate=1.5707963267948966", "point position=0,4,0", 1,
     1, 1e-9},
};

static void check_closed_form(imp_registry *registry, const closed_form *c, double tolerance)
{
    const imp_clearance r = measure_pair(registry, c->a, c->b, tolerance, 0);
    ck_assert_msg(r.reason == IMP_REASON_NONE && r.verdict == IMP_REQUIREMENT_NONE &&
                      r.lower <= c->distance * (1 + 1e-15) && c->distance * (1 - 1e-15) <= r.upper,
                  "%s | %s: [%.17g, %.17g], reason %d", c->a, c->b, r.lower, r.upper,
                  (int)r.reason);
    /* the gap may grow like the square of the time from the least */
    if (c->t >= 0) ck_assert_double_le(fabs(r.t - c->t), sqrt(tolerance));
}

START_TEST(closed_forms_lie_within_the_bracket)
{
    imp_registry *registry = query_registry();
    for (size_t k = 0; k < sizeof closed_forms / sizeof *closed_forms; ++k) {
        check_closed_form(registry, &closed_forms[k], 1e-3);
        check_closed_form(registry, &closed_forms[k], closed_forms[k].finest);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(what_meets_is_no_farther_apart_than_gamma)
{
    imp_registry *registry = query_registry();
    const char *const other[] = {"sphere center=3,0,0 ! translate velocity=-2,0,0",
                                 "torus major_radius=1 minor_radius=0.3",
                                 ("plane origin=-2,-2,-3 edge_u=4,0,0 edge_v=0,4,0 ! translate "
                                  "velocity=0,0,4")};
    for (int k = 0; k < 3; ++k) {
        const imp_clearance r = measure_pair(registry, "sphere", other[k], 1e-3, 0);
        ck_assert(r.reason == IMP_REASON_NONE && r.lower <= r.upper && r.upper <= 1e-6);
    }
    imp_registry_free(registry);
}
END_TEST

/* --- Points sampled, and contact -------------------------------------------------------------- */

enum { SIDE = 10, TIMES = 7 };

static void sample_surface(const imp_scene *scene, size_t body, double t, double x[][3])
{
    double lo[3], hi[3], p[SIDE * SIDE][3];
    imp_scene_domain(scene, body, 0, lo, hi);
    for (int k = 0; k < SIDE * SIDE; ++k) {
        p[k][0] = lo[0] + (hi[0] - lo[0]) * (k / SIDE) / (SIDE - 1);
        p[k][1] = lo[1] + (hi[1] - lo[1]) * (k % SIDE) / (SIDE - 1);
        p[k][2] = t;
    }
    ck_assert_int_eq(imp_scene_eval(scene, body, 0, SIDE * SIDE, p[0], x[0], NULL, NULL),
                     IMP_SUCCESS);
}

static double sampled_distance(const imp_scene *scene, double t_start, double t_end)
{
    double least = INFINITY, x[2][SIDE * SIDE][3];
    for (int n = 0; n < TIMES; ++n) {
        const double share = (double)n / (TIMES - 1);
        for (size_t body = 0; body < 2; ++body)
            sample_surface(scene, body, (1 - share) * t_start + share * t_end, x[body]);
        for (int k = 0; k < SIDE * SIDE; ++k)
            for (int l = 0; l < SIDE * SIDE; ++l)
                least = fmin(least, query_distance(x[0][k], x[1][l]));
    }
    return least;
}

/* No sample is nearer than lower, and upper is not much above the nearest. */
static void compare_with_samples(imp_registry *registry, const ladder *l)
{
    imp_scene *scene = scene_told(registry, l->about);
    const imp_options options = before_contact(scene, l);
    imp_clearance_options asked = imp_clearance_options_default();
    for (asked.tolerance = 0.25; asked.tolerance > 1e-5; asked.tolerance *= 0.125) {
        const imp_clearance r = measure(scene, &options, &asked);
        ck_assert_int_eq(r.reason, IMP_REASON_NONE);
        const double sampled = sampled_distance(scene, options.t_start, options.t_end);
        ck_assert_msg(r.lower <= sampled && r.upper * (1 - asked.tolerance) <= sampled,
                      "%s: [%g, %g], a sample at %g", l->about->name, r.lower, r.upper, sampled);
    }
    imp_scene_free(scene);
}

START_TEST(no_sample_is_nearer_than_the_lower_bound) { for_each_setting(compare_with_samples); }
END_TEST

/* Clear at 0.99 of what was found, contact at 1.01. */
static void compare_with_contact(imp_registry *registry, const ladder *l)
{
    imp_scene *scene = scene_told(registry, l->about);
    imp_options options = before_contact(scene, l);
    const imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance r = measure(scene, &options, &asked);
    imp_result contact = {.struct_size = sizeof contact};
    options.gamma = 0.995 * r.lower;
    options.gamma_clear = 0.99 * r.lower;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &contact, NULL), IMP_SUCCESS);
    ck_assert_int_eq(contact.verdict, IMP_VERDICT_CLEAR);
    options.gamma = 1.01 * r.upper;
    options.gamma_clear = 1.005 * r.upper;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &contact, NULL), IMP_SUCCESS);
    ck_assert_int_eq(contact.verdict, IMP_VERDICT_CONTACT);
    ck_assert(contact.t <= r.t);
    imp_scene_free(scene);
}

START_TEST(contact_at_other_distances_agrees) { for_each_setting(compare_with_contact); }
END_TEST

/* --- What was asked before -------------------------------------------------------------------- */

enum { TEXT = 4000 };

/* Nine vectors near (x, y, z), x and y 0, `spread` or twice that. */
static size_t add_vectors(uint64_t *state, char *text, double spread, double z, double by)
{
    size_t used = 0;
    for (int k = 0; k < 9; ++k)
        used += (size_t)snprintf(
            text + used, TEXT / 2 - used, "%s[%.3f,%.3f,%.3f]", k > 0 ? "," : "",
            spread * (k / 3) + random_between(state, -by, by),
            spread * (k % 3) + random_between(state, -by, by), z + random_between(state, -by, by));
    return used;
}

/* A patch of degrees 2 and 2 that bends and deforms. */
static void draw_deforming(uint64_t *state, double z, char text[TEXT])
{
    size_t used = (size_t)snprintf(text, TEXT, "bezier degree=2,2 points=[");
    used += add_vectors(state, text + used, 0.75, z, 0.3);
    used += (size_t)snprintf(text + used, TEXT - used, "] velocities=[");
    used += add_vectors(state, text + used, 0, 0, 2);
    snprintf(text + used, TEXT - used, "]");
}

/* A search for contact makes nets, which a minimum distance does not ask for. */
START_TEST(nets_that_others_made_change_no_minimum_distance)
{
    imp_registry *registry = query_registry();
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(100); ++k) {
        char a[TEXT], b[TEXT];
        imp_result met = {.struct_size = sizeof met};
        draw_deforming(&state, 0, a);
        draw_deforming(&state, 2.5, b);
        imp_scene *scene = scene_of(registry, a, b);
        const imp_options options = imp_options_default(scene);
        ck_assert_int_eq(imp_scene_solve(scene, &options, &met, NULL), IMP_SUCCESS);
        const imp_clearance_options asked = imp_clearance_options_default();
        const imp_clearance after = measure(scene, &options, &asked);
        const imp_clearance alone = measure_pair(registry, a, b, asked.tolerance, 0);
        ck_assert_uint_eq(after.stats.pairs, alone.stats.pairs);
        ck_assert_double_eq(after.lower, alone.lower);
        ck_assert_double_eq(after.upper, alone.upper);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(slices_have_brackets_of_their_own)
{
    enum { SLICES = 12 };
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.slices = SLICES;
    asked.required = 1;
    imp_query *query = begin(scene, &options, &asked);
    ck_assert_uint_eq(imp_clearance_count(query), SLICES);
    while (step(query, 10) == IMP_REASON_RUNNING) {
    }
    for (size_t k = 0; k < SLICES; ++k) {
        const imp_clearance r = read_answer(query, k);
        check_answer_itself(scene, &r, asked.tolerance, options.gamma);
        ck_assert(r.t_start == (k == 0 ? 0 : read_answer(query, k - 1).t_end));
        const double t = r.t_end <= 0.5 ? r.t_end : r.t_start;
        const double x = 3 - 6 * t, d = sqrt(x * x + 4) - 1.5;
        ck_assert_msg(r.lower <= d * (1 + 1e-15) && r.upper >= d * (1 - 1e-15) &&
                          r.upper <= r.lower / (1 - 1e-3) * (1 + 1e-15),
                      "slice %zu: [%g, %g], not %g", k, r.lower, r.upper, d);
        ck_assert(isnan(r.t_violated));
        ck_assert_int_eq(r.verdict, d < 1 ? IMP_REQUIREMENT_VIOLATED : IMP_REQUIREMENT_HOLDS);
    }
    ck_assert(read_answer(query, SLICES - 1).t_end == 1);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(each_two_bodies_have_a_bracket_of_their_own)
{
    const double distance[] = {1, 4, 1, sqrt(9.25) - 2, sqrt(36.25) - 2};
    const size_t body[][2] = {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}};
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of_three(registry);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.each = true;
    asked.slices = 2;
    imp_query *query = begin(scene, &options, &asked);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    ck_assert_uint_eq(imp_clearance_count(query), 10);
    for (size_t k = 0; k < 10; ++k) {
        const imp_clearance r = read_answer(query, k);
        check_answer_itself(scene, &r, asked.tolerance, options.gamma);
        ck_assert(r.body[0] == body[k / 2][0] && r.body[1] == body[k / 2][1]);
        ck_assert(r.a.body == r.body[0] && r.b.body == r.body[1]);
        if (k % 2 == 0) continue;
        ck_assert(r.lower <= distance[k / 2] * (1 + 1e-15) &&
                  r.upper >= distance[k / 2] * (1 - 1e-15));
    }
    asked = imp_clearance_options_default();
    const imp_clearance all = measure(scene, &options, &asked);
    ck_assert(all.body[0] == SIZE_MAX && all.lower <= 1 && all.upper >= 1);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(where_nobody_meets_anybody_the_distance_is_infinite)
{
    imp_registry *registry = query_registry();
    const char one[] = "{\"bodies\":[{\"name\":\"a\",\"surfaces\":[{\"type\":\"sphere\"}]}]}";
    const char ignored[] =
        "{\"bodies\":[{\"name\":\"a\",\"surfaces\":[{\"type\":\"sphere\"}]},{\"name\":\"b\","
        "\"surfaces\":[{\"type\":\"sphere\"}]}],\"ignore\":[[\"a\",\"b\"]]}";
    const char *const text[] = {one, ignored};
    for (int k = 0; k < 2; ++k) {
        imp_scene *scene = imp_scene_from_json(registry, text[k], strlen(text[k]), "one", NULL);
        const imp_options options = imp_options_default(scene);
        imp_clearance_options asked = imp_clearance_options_default();
        asked.required = 2;
        asked.decide = k == 1;
        const imp_clearance r = measure(scene, &options, &asked);
        ck_assert(r.lower == INFINITY && r.upper == INFINITY && !r.has_witness);
        ck_assert(r.reason == IMP_REASON_NO_PAIRS && r.verdict == IMP_REQUIREMENT_HOLDS);
        asked.each = true;
        imp_query *query = begin(scene, &options, &asked);
        ck_assert(step(query, 0) == IMP_REASON_NONE && imp_clearance_count(query) == 0);
        imp_query_free(query);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("clearance", closed_forms_lie_within_the_bracket,
           what_meets_is_no_farther_apart_than_gamma, no_sample_is_nearer_than_the_lower_bound,
           contact_at_other_distances_agrees, nets_that_others_made_change_no_minimum_distance,
           slices_have_brackets_of_their_own, each_two_bodies_have_a_bracket_of_their_own,
           where_nobody_meets_anybody_the_distance_is_infinite)
