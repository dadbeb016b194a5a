/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/net_distance.h"

/* Types that offer nets: which nodes are asked for one, and nets far from their surfaces. */

/* --- Who is asked for one --------------------------------------------------------------------- */

static int asked;

static imp_status counting_net(const void *self, const imp_region *region, imp_net *to)
{
    (void)self, (void)region, (void)to;
    asked += 1;
    return IMP_STATUS_UNBOUNDED;
}

/* A square in the way of the ball. */
static void tile_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const ball *b = self;
    out[0] = imp_shift(imp_scale(t, b->velocity[0]), 0.5 * b->centre[0]);
    out[1] = imp_scale(u, 0.5);
    out[2] = imp_scale(v, 0.5);
}
IMP_SURFACE_FORMULA(tile_formula)

/* Models that bend, that are remainders alone, as there are no inclusions, and that are flat. */
typedef enum model_kind { BENT, BLURRED, FLAT } model_kind;

/* How often types of which the first `offering` of two have the callback are asked for nets, by a
 * query for the first contact or the minimum distance. */
static int times_asked(int offering, model_kind kind, bool minimum)
{
    static const ball a = {.radius = 1},
                      b = {.radius = 1, .centre = {3, 0, 0}, .velocity = {-2, 0, 0}};
    imp_surface_type plain = ball_type;
    if (kind == BLURRED) plain.include = NULL;
    if (kind == FLAT) {
        plain.eval = tile_formula_eval;
        plain.rate = tile_formula_rate;
        plain.include = tile_formula_include;
    }
    imp_surface_type type = plain;
    type.net = counting_net;
    imp_scene *scene =
        spheres_scene(offering > 0 ? &type : &plain, &a, offering > 1 ? &type : &plain, &b);
    imp_options options = imp_options_default(scene);
    options.max_pairs = 1000;
    imp_query *query = minimum ? imp_clearance_new(scene, &options, NULL, NULL)
                               : imp_query_new(scene, &options, NULL);
    asked = 0;
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_uint_gt(imp_query_result(query).stats.pairs, kind == FLAT || minimum ? 0 : 10);
    imp_query_free(query);
    imp_scene_free(scene);
    return asked;
}

START_TEST(a_net_is_asked_for_where_it_may_say_more_than_a_model_of_the_pair)
{
    ck_assert_int_eq(times_asked(0, BENT, false), 0);
    ck_assert_int_gt(times_asked(1, BENT, false), 2);
    ck_assert_int_gt(times_asked(2, BENT, false), 2);
    ck_assert_int_gt(times_asked(1, BLURRED, false), 2);
    ck_assert_int_gt(times_asked(2, BLURRED, false), 2);
    ck_assert_int_eq(times_asked(1, FLAT, false), 0);
    ck_assert_int_eq(times_asked(2, FLAT, false), 0);
    ck_assert_int_eq(times_asked(2, BENT, true), 0);
}
END_TEST

/* --- Nets that are rough ---------------------------------------------------------------------- */

/* The quadratic of a region of the ball's that is not too large, with its remainder; halves of it
 * have the same. */
static imp_status rough_net(const void *self, const imp_region *region, imp_net *to)
{
    static const double s[3] = {-1, 0, 1},
                        ss[3] = {1, -1, 1}; /* Bernstein coefficients of s and s^2 */
    const ball *b = self;
    imp_model f[3];
    if (ball_formula_include(self, region, f) != IMP_STATUS_OK) return IMP_STATUS_UNBOUNDED;
    to->degree[0] = to->degree[1] = 2;
    for (int i = 0; i < 3; ++i) {
        if (!(f[i].e < 0.02)) return IMP_STATUS_UNBOUNDED;
        for (int k = 0; k < 9; ++k) {
            const int u = k / 3, v = k % 3;
            to->point[i][k] = f[i].a + f[i].b[0] * s[u] + f[i].b[1] * s[v] +
                              f[i].q[IMP_UU] * ss[u] + f[i].q[IMP_UV] * s[u] * s[v] +
                              f[i].q[IMP_VV] * ss[v];
        }
        to->drift[i] = b->velocity[i];
        to->error[i] = f[i].e + 1e-12;
    }
    return IMP_STATUS_OK;
}

static double contact_of_balls(const imp_surface_type *type)
{
    static const ball a = {.radius = 1},
                      b = {.radius = 1, .centre = {3, 0.3, 0.2}, .velocity = {-2, 0, 0}};
    imp_scene *scene = spheres_scene(type, &a, type, &b);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-6;
    options.max_pairs = 100000;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    const imp_result r = imp_query_result(query);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    imp_query_free(query);
    imp_scene_free(scene);
    return r.t;
}

START_TEST(a_contact_is_found_where_nets_leave_their_surfaces_by_more_than_gamma)
{
    imp_surface_type rough = ball_type;
    rough.net = rough_net;
    ck_assert_double_eq_tol(contact_of_balls(&rough), contact_of_balls(&ball_type), 1e-6);
}
END_TEST

SUITE_MAIN("net_offers", a_net_is_asked_for_where_it_may_say_more_than_a_model_of_the_pair,
           a_contact_is_found_where_nets_leave_their_surfaces_by_more_than_gamma)
