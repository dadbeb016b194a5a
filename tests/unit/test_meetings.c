/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/random.h"
#include "tests/support/query_helpers.h"

/* A point that meets a triangle, and two edges that meet, with corners that move linearly. */

/* Four corners and their velocities: a point and a triangle, or two ends of either edge. */
typedef struct corners {
    double x[4][3], v[4][3];
} corners;

/* Fast corners turn faces and edges so much that they may meet more than once. */
static corners draw(uint64_t *state, bool edges, double speed)
{
    corners c;
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 3; ++i) {
            c.x[k][i] = random_between(state, -1, 1) + (i == 2 && k < (edges ? 2 : 1) ? 2 : 0);
            c.v[k][i] =
                random_between(state, -speed, speed) - (i == 2 && k < (edges ? 2 : 1) ? 3 : 0);
        }
    return c;
}

static imp_scene *build(imp_registry *registry, const corners *c, bool edges)
{
    const size_t first = edges ? 2 : 1;
    imp_error error;
    imp_builder *b = imp_builder_new(registry);
    const imp_argument a[2] = {edges ? imp_argument_rows("points", c->x[0], 2, 3)
                                     : imp_argument_list("position", c->x[0], 3),
                               edges ? imp_argument_rows("velocities", c->v[0], 2, 3)
                                     : imp_argument_list("velocity", c->v[0], 3)};
    const imp_argument other[2] = {imp_argument_rows("points", c->x[first], 4 - first, 3),
                                   imp_argument_rows("velocities", c->v[first], 4 - first, 3)};
    ck_assert_int_eq(imp_builder_time(b, 0, 1, &error), IMP_SUCCESS);
    for (size_t k = 0; k < 2; ++k) {
        const char *type = edges ? "segment" : k == 0 ? "point" : "triangle";
        ck_assert_int_eq(imp_builder_body(b, NULL, NULL, &error), IMP_SUCCESS);
        const imp_code code = imp_builder_surface(b, k, type, k == 0 ? a : other, 2, &error);
        ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    }
    imp_scene *scene = imp_builder_finish(b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_builder_free(b);
    return scene;
}

/* --- Meetings from coplanar corners ----------------------------------------------------------- */

static void corner_at(const corners *c, int k, double t, double *x)
{
    for (int i = 0; i < 3; ++i) x[i] = c->x[k][i] + t * c->v[k][i] - (c->x[0][i] + t * c->v[0][i]);
}

static double triple(const double *a, const double *b, const double *c)
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* The volume that the corners span at a time. */
static double volume(const corners *c, double t)
{
    double x[3][3];
    for (int k = 0; k < 3; ++k) corner_at(c, k + 1, t, x[k]);
    return triple(x[0], x[1], x[2]);
}

/* Whether corners that lie in one plane meet: the sum of weights w that vanishes, w0 + ... + w3 = 0
 * with w0 x0 + ... + w3 x3 = 0, has signs as +--- for a point and a triangle, ++-- for edges. */
static bool meet(const corners *c, double t, bool edges)
{
    double x[4][3] = {{0}}, n[3], w[4];
    for (int k = 1; k < 4; ++k) corner_at(c, k, t, x[k]);
    const double p[3] = {x[2][0] - x[1][0], x[2][1] - x[1][1], x[2][2] - x[1][2]};
    const double q[3] = {x[3][0] - x[1][0], x[3][1] - x[1][1], x[3][2] - x[1][2]};
    for (int i = 0; i < 3; ++i)
        n[i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
    w[1] = triple(n, x[2], x[3]);
    w[2] = triple(n, x[3], x[1]);
    w[3] = triple(n, x[1], x[2]);
    w[0] = -(w[1] + w[2] + w[3]);
    return edges ? w[0] * w[1] > 0 && w[2] * w[3] > 0 && w[0] * w[2] < 0
                 : w[1] * w[2] > 0 && w[2] * w[3] > 0;
}

/* Returns the first time at which the corners are in one plane, and meet; NAN: none. */
static double first_meeting(const corners *c, bool edges)
{
    enum { PARTS = 2000, HALVINGS = 60 };
    for (int k = 0; k < PARTS; ++k) {
        double lo = (double)k / PARTS, hi = (double)(k + 1) / PARTS;
        const double before = volume(c, lo);
        if (before * volume(c, hi) > 0) continue;
        for (int j = 0; j < HALVINGS; ++j) {
            const double middle = 0.5 * (lo + hi);
            if (before * volume(c, middle) > 0)
                lo = middle;
            else
                hi = middle;
        }
        if (meet(c, lo, edges)) return lo;
    }
    return NAN;
}

/* --- Tests ------------------------------------------------------------------------------------ */

/* A gap of gamma closes in less than this time, but for meetings that graze. */
#define SOON 1e-4

START_TEST(corners_meet_where_they_are_in_one_plane_and_mostly_with_one_pair)
{
    uint64_t state = suite_seed();
    imp_registry *registry = query_registry();
    for (int edges = 0; edges < 2; ++edges) {
        int contacts = 0, slow = 0, with_one = 0;
        for (int k = 0; k < 1000; ++k) {
            const corners c = draw(&state, edges, k % 2 == 0 ? 1 : 6);
            const double expected = first_meeting(&c, edges);
            imp_scene *scene = build(registry, &c, edges);
            imp_options options = imp_options_default(scene);
            imp_result r = {.struct_size = sizeof r};
            ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
            const bool met = r.verdict == IMP_VERDICT_CONTACT;
            ck_assert_msg(met ? fabs(r.t - expected) < SOON : isnan(expected),
                          "%s, scene %d: contact at %.17g, expected at %.17g",
                          edges ? "edges" : "a point and a triangle", k, r.t, expected);
            ck_assert(!met || (r.gap <= r.gamma && r.gap >= 0.999 * r.gamma_clear));
            contacts += met;
            slow += met && k % 2 == 0;
            with_one += met && k % 2 == 0 && r.stats.pairs == 1 && r.stats.witness_searches == 1;
            imp_scene_free(scene);
        }
        ck_assert_int_ge(contacts, 20);
        ck_assert_msg(2 * with_one > slow, "%d of %d contacts with one pair", with_one, slow);
    }
    imp_registry_free(registry);
}
END_TEST

/* Newton steps lead to a later meeting than the first, which only the proof tells. */
static const struct {
    bool edges;
    corners c;
} LATER[] = {
    {false,
     {{{-0.938, -0.258, 2.367},
       {-0.705, -0.595, -0.897},
       {0.232, 0.713, 0.918},
       {0.223, -0.405, -0.756}},
      {{4.613, 7.171, -9.219},
       {-1.668, 9.128, 6.513},
       {-6.638, 0.861, 4.593},
       {8.809, 8.828, 2.180}}}},
    {true,
     {{{0.501, -0.221, 1.713},
       {0.935, -0.054, 1.097},
       {-0.707, 0.534, -0.872},
       {0.172, -0.169, 0.828}},
      {{2.476, 1.158, -3.223},
       {-1.229, 3.999, -5.828},
       {1.393, -1.127, -0.645},
       {5.686, 4.420, -0.169}}}},
    {true,
     {{{-0.587, 0.355, 1.747},
       {0.766, 0.312, 1.662},
       {-0.895, -0.580, 0.087},
       {0.741, 0.910, 0.957}},
      {{-1.865, -2.570, 0.573},
       {-3.462, 1.568, -8.507},
       {-5.881, 3.265, 3.695},
       {-2.556, -4.326, 3.460}}}},
};

START_TEST(a_meeting_that_is_not_the_first_is_refused)
{
    imp_registry *registry = query_registry();
    for (size_t k = 0; k < sizeof LATER / sizeof *LATER; ++k) {
        const double expected = first_meeting(&LATER[k].c, LATER[k].edges);
        imp_scene *scene = build(registry, &LATER[k].c, LATER[k].edges);
        const imp_options options = imp_options_default(scene);
        imp_result r = {.struct_size = sizeof r};
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        ck_assert_msg(fabs(r.t - expected) < SOON, "scene %zu: contact at %.17g, expected at %.17g",
                      k, r.t, expected);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(a_meeting_is_refined_like_a_new_query)
{
    uint64_t state = suite_seed();
    imp_registry *registry = query_registry();
    for (int k = 0; k < 100; ++k) {
        const corners c = draw(&state, k % 2 == 1, 1);
        imp_scene *scene = build(registry, &c, k % 2 == 1);
        imp_options options = imp_options_default(scene);
        options.gamma = 1e-3;
        imp_query *query = imp_query_new(scene, &options, NULL);
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        const imp_result coarse = imp_query_result(query);
        if (coarse.verdict == IMP_VERDICT_CONTACT) {
            ck_assert_int_eq(imp_query_refine(query, 1e-7, -1, NULL), IMP_SUCCESS);
            ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
            const imp_result fine = imp_query_result(query);
            const double expected = first_meeting(&c, k % 2 == 1);
            ck_assert(fine.verdict == IMP_VERDICT_CONTACT ? fabs(fine.t - expected) < SOON
                                                          : isnan(expected));
            ck_assert(fine.t_lower >= coarse.t_lower);
        }
        imp_query_free(query);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("meetings", corners_meet_where_they_are_in_one_plane_and_mostly_with_one_pair,
           a_meeting_that_is_not_the_first_is_refused, a_meeting_is_refined_like_a_new_query)
