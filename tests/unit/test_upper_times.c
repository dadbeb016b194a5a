/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/random.h"
#include "tests/support/query_helpers.h"

/* Contacts of patches, which the search meets before it has proved them to be the first: what it
 * puts off until then is neither lost to smaller gammas nor to what waits. */

enum { TEXT = 4000 };

/* Writes control point k of a list; returns the length of its text. */
static size_t add_point(char *text, size_t room, int k, double x, double y, double z)
{
    return (size_t)snprintf(text, room, "%s[%.3f,%.3f,%.3f]", k > 0 ? "," : "", x, y, z);
}

/* A patch of degrees 2 and 2 that bends and deforms, over the unit square around (0, 0, z), at
 * speed w along z. */
static void draw_patch(uint64_t *state, double z, double w, char text[TEXT])
{
    size_t used = (size_t)snprintf(text, TEXT, "bezier degree=2,2 points=[");
    for (int k = 0; k < 9; ++k)
        used += add_point(text + used, TEXT - used, k, k / 3 - 1 + random_between(state, -0.3, 0.3),
                          k % 3 - 1 + random_between(state, -0.3, 0.3),
                          z + random_between(state, -1, 1));
    used += (size_t)snprintf(text + used, TEXT - used, "] velocities=[");
    for (int k = 0; k < 9; ++k)
        used += add_point(text + used, TEXT - used, k, random_between(state, -0.3, 0.3),
                          random_between(state, -0.3, 0.3), w + random_between(state, -0.3, 0.3));
    snprintf(text + used, TEXT - used, "]");
}

static imp_scene *draw_scene(uint64_t *state, imp_registry *registry)
{
    char a[TEXT], b[TEXT];
    imp_error error = {IMP_SUCCESS, ""};
    draw_patch(state, 0, 0, a);
    draw_patch(state, 3, -4, b);
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static imp_query *begin(imp_scene *scene, double gamma)
{
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_ptr_nonnull(query);
    return query;
}

static imp_result contact_of(imp_query *query, double gamma)
{
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    const imp_result r = imp_query_result(query);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(r.t == r.t_lower && r.gap <= gamma);
    return r;
}

START_TEST(smaller_gammas_find_what_is_found_afresh)
{
    uint64_t state = suite_seed();
    imp_registry *registry = query_registry();
    for (int k = 0; k < suite_times(60); ++k) {
        imp_scene *scene = draw_scene(&state, registry);
        imp_query *query = begin(scene, 1e-2);
        imp_result r = contact_of(query, 1e-2);
        for (double gamma = 1e-3; gamma > 0.9e-9; gamma /= 10) {
            ck_assert_int_eq(imp_query_refine(query, gamma, -1, NULL), IMP_SUCCESS);
            const imp_result finer = contact_of(query, gamma);
            imp_query *afresh = begin(scene, gamma);
            ck_assert(finer.t >= r.t);
            ck_assert_double_le(fabs(finer.t - contact_of(afresh, gamma).t), 2 * gamma);
            imp_query_free(afresh);
            r = finer;
        }
        imp_query_free(query);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

static bool holds(const double range[2], double x) { return range[0] <= x && x <= range[1]; }

/* Until when no pair that is left has the two points. */
static double clear_until(const imp_query *query, const double a[2], const double b[2])
{
    double end = 1;
    imp_pending p;
    for (size_t i = 0; imp_query_pending(query, i, &p); ++i)
        if (p.t_lower < end && holds(p.a.u, a[0]) && holds(p.a.v, a[1]) && holds(p.b.u, b[0]) &&
            holds(p.b.v, b[1]))
            end = p.t_lower;
    return end;
}

/* The contact that is first from a later time on: points that are near then. */
static imp_result near_later(imp_scene *scene, double t, double gamma)
{
    imp_options options = imp_options_default(scene);
    imp_result r = {.struct_size = sizeof r};
    options.t_start = t;
    options.gamma = gamma;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
    return r;
}

START_TEST(what_is_put_off_until_the_contact_waits)
{
    uint64_t state = suite_seed();
    imp_registry *registry = query_registry();
    int met = 0;
    for (int k = 0; k < suite_times(30); ++k) {
        imp_scene *scene = draw_scene(&state, registry);
        imp_query *query = begin(scene, 1e-3);
        const imp_result first = contact_of(query, 1e-3);
        for (int l = 0; l < 20; ++l) {
            const imp_result r =
                near_later(scene, random_between(&state, first.t, 1), first.gamma_clear);
            if (r.verdict != IMP_VERDICT_CONTACT) continue;
            met += 1;
            ck_assert_double_le(
                clear_until(query, (double[]){r.a.u, r.a.v}, (double[]){r.b.u, r.b.v}), r.t);
        }
        imp_query_free(query);
        imp_scene_free(scene);
    }
    ck_assert_int_gt(met, suite_times(30));
    imp_registry_free(registry);
}
END_TEST

/* Nets of halves that were made without models are held against points with the nodes that they end
 * in. */
START_TEST(bounds_of_what_is_left_of_patches_hold_their_points)
{
    uint64_t state = suite_seed();
    imp_registry *registry = query_registry();
    for (int k = 0; k < suite_times(20); ++k) {
        imp_scene *scene = draw_scene(&state, registry);
        imp_options options = imp_options_default(scene);
        imp_result r[2];
        for (int audit = 0; audit < 2; ++audit) {
            imp_error error = {IMP_SUCCESS, ""};
            r[audit].struct_size = sizeof r[audit];
            options.audit = audit;
            ck_assert_msg(imp_scene_solve(scene, &options, &r[audit], &error) == IMP_SUCCESS, "%s",
                          error.text);
        }
        ck_assert(r[0].verdict == IMP_VERDICT_CONTACT && r[0].t == r[1].t);
        ck_assert(r[0].stats.pairs == r[1].stats.pairs && r[0].stats.nodes == r[1].stats.nodes);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

/* Two triangles, of whose nets their own pair has no use, and a patch that asks for them. */
#define FLAT(NAME, POINTS, OFFSET)                                                                 \
    "{\"name\":\"" NAME "\",\"surfaces\":[{\"type\":\"triangle\",\"points\":[" POINTS              \
    "]}],\"maps\":[{\"type\":\"translate\",\"offset\":[" OFFSET "]}]},"
static const char three_bodies[] = "{\"bodies\":[" FLAT(
    "a", "[-1.2,-1.2,0.2],[0.8,-0.9,-0.1],[-0.3,0.8,0.1]", "[0,0,0],[-0.1,0.1,0]")
    FLAT(
        "b", "[-1.3,-0.9,-0.2],[1.1,-1.1,-0.1],[-0.1,1.1,0]",
        "[1.1,0.4,1.2],[-1.1,-0.6,-1.1]") "{\"name\":\"c\",\"surfaces\":[{\"type\":\"bezier\","
                                          "\"degree\":[3,3],\"points\":["
                                          "[-0.9,-1,0.1],[-0.9,-0.3,0.3],[-1.1,0.3,-0.6],[-0.9,1,-"
                                          "0.5],"
                                          "[-0.4,-1,-0.4],[-0.3,-0.4,-0.1],[-0.3,0.3,0.2],[-0.3,1."
                                          "1,0.5],"
                                          "[0.3,-1.1,0],[0.3,-0.3,0.1],[0.3,0.3,-0.5],[0.4,0.9,0.6]"
                                          ","
                                          "[1,-1.1,0.5],[1.1,-0.4,-0.6],[1,0.3,0.5],[1,1.1,0.6]]}],"
                                          "\"maps\":[{\"type\":\"translate\",\"offset\":[[-1.2,-0."
                                          "4,1.5],[1.1,0.4,-1.4]]}]}]}";

START_TEST(what_was_asked_before_changes_no_answer)
{
    imp_registry *registry = query_registry();
    imp_scene *scenes[2];
    for (int k = 0; k < 2; ++k)
        scenes[k] =
            imp_scene_from_json(registry, three_bodies, sizeof three_bodies - 1, "three", NULL);
    imp_query *every = begin(scenes[1], 1e-6);
    contact_of(every, 1e-6);
    while (imp_query_result(every).verdict == IMP_VERDICT_CONTACT) {
        ck_assert_int_eq(imp_query_exclude_pair(every, NULL), IMP_SUCCESS);
        ck_assert_int_eq(imp_query_step(every, 0, NULL), IMP_SUCCESS);
    }
    imp_query_free(every);
    imp_result r[2];
    for (int k = 0; k < 2; ++k) {
        imp_query *query = begin(scenes[k], 1e-6);
        r[k] = contact_of(query, 1e-6);
        imp_query_free(query);
    }
    ck_assert_uint_eq(r[0].stats.pairs, r[1].stats.pairs);
    ck_assert(r[0].t == r[1].t && r[0].gap == r[1].gap);
    for (int k = 0; k < 2; ++k) imp_scene_free(scenes[k]);
    imp_registry_free(registry);
}
END_TEST

/* Roofs whose creases lie on knots, behind which the net of a node goes on as the surface does not.
 * Points that are sought on nets are points of the surface even where next to nothing is left
 * between gamma_clear and gamma. */
START_TEST(a_crease_is_met_that_nets_do_not_follow)
{
    uint64_t state = suite_seed();
    imp_registry *registry = query_registry();
    for (int k = 0; k < suite_times(100); ++k) {
        char a[TEXT], b[TEXT];
        size_t used = (size_t)snprintf(
            a, TEXT, "nurbs degree=1,1 knots_u=[0,0,1,2,2] knots_v=[0,0,1,2,2] points=[");
        for (int i = 0; i < 9; ++i)
            used += add_point(a + used, TEXT - used, i, i / 3 - 1, i % 3 - 1,
                              random_between(&state, 0, 0.3) + (i / 3 == 1 ? 1 : 0) +
                                  (i % 3 == 1 ? 0.5 : 0));
        snprintf(a + used, TEXT - used, "]");
        used = (size_t)snprintf(b, TEXT, "bezier degree=1,1 points=[");
        for (int i = 0; i < 4; ++i)
            used += add_point(b + used, TEXT - used, i, i / 2 * 4 - 2, i % 2 * 4 - 2,
                              random_between(&state, 2, 2.5));
        snprintf(b + used, TEXT - used, "] ! translate velocity=0,0,-2");
        imp_scene *scene = imp_scene_from_pair(registry, a, b, NULL);
        imp_options options = imp_options_default(scene);
        imp_result r = {.struct_size = sizeof r};
        options.gamma_clear = 0.99 * options.gamma;
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
        ck_assert_msg(r.verdict == IMP_VERDICT_CONTACT, "%s\n%s", a, b);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("upper times", a_crease_is_met_that_nets_do_not_follow,
           bounds_of_what_is_left_of_patches_hold_their_points,
           smaller_gammas_find_what_is_found_afresh, what_is_put_off_until_the_contact_waits,
           what_was_asked_before_changes_no_answer)
