/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/shape_points.h"

/* Triangles, superquadrics and swept curves against closed forms. That bounds hold at all is tested
 * for all types together in test_plugins.c. */

/* --- Straight --------------------------------------------------------------------------------- */

static void expect_remainders(const char *type, const char *parameters, double most)
{
    instance made = shape(type, parameters);
    double lo[3], hi[3];
    imp_model model[3];
    made.surface->domain(made.self, lo, hi);
    lo[2] = 0, hi[2] = 1;
    models_of(&made, lo, hi, model);
    for (int i = 0; i < 3; ++i) ck_assert_msg(model[i].e <= most, "%s: e = %g", type, model[i].e);
    instance_free(&made);
}

START_TEST(moving_points_segments_and_planes_are_followed_exactly)
{
    expect_remainders("point", "{\"velocity\": [1,2,-3]}", 1e-14);
    expect_remainders("point", "{\"position\": [1e8,0,3]}", 0);
    expect_remainders("segment", "{\"points\": [@2[?,?,?]], \"velocities\": [@2[?,?,?]]}", 1e-14);
    expect_remainders("plane", "{}", 3e-15);
    expect_remainders("triangle", "{}", 1e-14);
}
END_TEST

/* The term in u v t alone is not quadratic: 1/8 of its coefficient over the whole domain. */
START_TEST(a_triangle_whose_corners_part_is_followed_but_for_one_cubic_term)
{
    instance made = shape("triangle", "{\"velocities\": [[0,0,0],[0,0,1],[0,0,3]]}");
    imp_model model[3];
    models_of(&made, (double[3]){0, 0, 0}, (double[3]){1, 1, 1}, model);
    ck_assert_double_eq_tol(model[2].e, 2. / 8, 1e-14);
    instance_free(&made);
}
END_TEST

START_TEST(a_collapsed_edge_is_one_point)
{
    instance triangle = shape("triangle", "{\"points\": [[1,2,3],[5,0,0],[0,7,0]]}");
    instance cone = shape("cone", "{\"radius\": 2, \"height\": 3}");
    double x[3];
    for (int k = 0; k <= 8; ++k) {
        point_of(&triangle, 0, k / 8., 0, x);
        ck_assert(x[0] == 1 && x[1] == 2 && x[2] == 3);
        point_of(&cone, k * 0.7, 1, 0, x);
        ck_assert(x[0] == 0 && x[1] == 0 && x[2] == 3);
    }
    instance_free(&triangle);
    instance_free(&cone);
}
END_TEST

/* --- Bezier triangles ------------------------------------------------------------------------- */

static void expect_same_points(const instance *a, const instance *b, double most)
{
    for (int k = 0; k <= 100; ++k) {
        double x[3], y[3];
        point_of(a, k % 11 / 10., k / 11 / 10., 0.3, x);
        point_of(b, k % 11 / 10., k / 11 / 10., 0.3, y);
        for (int i = 0; i < 3; ++i) ck_assert_double_eq_tol(x[i], y[i], most);
    }
}

START_TEST(a_bezier_triangle_of_degree_1_is_a_triangle)
{
    const char *corners = "\"points\": [@3[?,?,?]], \"velocities\": [@3[?,?,?]]}";
    char text[120];
    snprintf(text, sizeof text, "{\"degree\": 1, %s", corners);
    instance bezier = shape("bezier-triangle", text);
    snprintf(text, sizeof text, "{%s", corners);
    instance plain = shape("triangle", text);
    expect_same_points(&bezier, &plain, 1e-14);
    instance_free(&bezier);
    instance_free(&plain);
}
END_TEST

/* The polar form of x^2 + y^2 is the dot product: control points above corners and edges'
 * middles. */
START_TEST(a_quadratic_triangle_holds_a_paraboloid)
{
    instance made = shape("bezier-triangle",
                          "{\"degree\": 2, \"points\": "
                          "[[-1,-1,2],[0,-0.5,-1],[-0.5,1,-3],[1,0,1],[0.5,1.5,0],[0,3,9]]}");
    for (int k = 0; k <= 100; ++k) {
        double x[3];
        point_of(&made, k % 11 / 10., k / 11 / 10., 0, x);
        ck_assert_double_eq_tol(x[2], x[0] * x[0] + x[1] * x[1], 1e-14);
    }
    instance_free(&made);
}
END_TEST

START_TEST(a_rational_quartic_triangle_is_an_octant_of_a_sphere)
{
    instance made = shape("bezier-triangle", octant_text(false));
    for (int k = 0; k <= 100; ++k) {
        double x[3];
        point_of(&made, k % 11 / 10., k / 11 / 10., 0, x);
        ck_assert_double_eq_tol(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], 1, 4e-15);
    }
    instance_free(&made);
}
END_TEST

START_TEST(each_face_is_a_triangle_of_its_own_points)
{
    instance many =
        shape("bezier-triangle", "{\"degree\": 1, \"points\": [[0,0,0],[1,0,0],[0,1,0],[5,5,5]],"
                                 " \"velocities\": [@4[0,0,1]], \"faces\": [[0,1,2],[1,3,2]]}");
    instance one = shape("bezier-triangle", "{\"degree\": 1, \"points\": [[1,0,0],[5,5,5],[0,1,0]],"
                                            " \"velocities\": [@3[0,0,1]]}");
    ck_assert_uint_eq(many.surface->piece_count(many.self), 2);
    ck_assert_uint_eq(one.surface->piece_count(one.self), 1);
    for (int k = 0; k <= 100; ++k) {
        const double p[3] = {k % 11 / 10., k / 11 / 10., 0.3};
        double x[3], y[3];
        point_of(&one, p[0], p[1], p[2], x);
        const void *second = many.surface->piece(many.self, 1);
        ck_assert_int_eq(many.surface->eval(second, 1, p, y, NULL), IMP_STATUS_OK);
        ck_assert_mem_eq(x, y, sizeof x);
    }
    instance_free(&many);
    instance_free(&one);
}
END_TEST

/* Halved toward the corner into which u = 0 collapses, a triangle loses seven eighths of its
 * remainder each time, and its net follows it. */
START_TEST(bounds_shrink_at_the_collapsed_corner_as_anywhere)
{
    instance made = shape("bezier-triangle", "{\"degree\": 3, \"points\": [@10[?,?,?]]}");
    double last = 0;
    for (double size = 0x1p-6; size > 0x1p-10; size /= 2) {
        imp_model model[3];
        imp_net net = {.degree = {0, 0}};
        const imp_region region = region_make((double[3]){0, 0, 0}, (double[3]){size, 1, 0});
        models_of(&made, region.lo, region.hi, model);
        const double e = fmax(model[0].e, fmax(model[1].e, model[2].e));
        ck_assert(last == 0 || e < 0.3 * last);
        last = e;
        ck_assert_int_eq(made.surface->net(made.self, &region, &net), IMP_STATUS_OK);
        for (int k = 0; k < 16; ++k)
            ck_assert_double_le(fabs(net.place[0] + net.point[0][k] - model[0].a), 16 * size);
    }
    instance_free(&made);
}
END_TEST

/* --- Superquadrics ---------------------------------------------------------------------------- */

static double superellipsoid_equation(const double x[3], const double exponents[2])
{
    const double ring = pow(fabs(x[0]), 2 / exponents[1]) + pow(fabs(x[1]), 2 / exponents[1]);
    return pow(ring, exponents[1] / exponents[0]) + pow(fabs(x[2]), 2 / exponents[0]);
}

START_TEST(superellipsoids_satisfy_their_implicit_equation)
{
    static const double exponents[][2] = {{1, 1}, {0.5, 0.5}, {2, 2}, {0.3, 1.7}, {1.2, 0.25}};
    uint64_t random = suite_seed();
    for (size_t k = 0; k < sizeof exponents / sizeof exponents[0]; ++k) {
        char text[80];
        snprintf(text, sizeof text, "{\"exponents\": [%g,%g]}", exponents[k][0], exponents[k][1]);
        instance made = shape("superellipsoid", text);
        for (int n = 0; n < suite_times(200); ++n) {
            double x[3];
            point_of(&made, random_between(&random, 0, 6.28), random_between(&random, -1.57, 1.57),
                     0, x);
            ck_assert_double_eq_tol(superellipsoid_equation(x, exponents[k]), 1, 1e-12);
        }
        instance_free(&made);
    }
}
END_TEST

/* The promise of the radial parametrisation: by the chain of both superellipses, at most 2 per unit
 * of angle and per unit of radius. */
START_TEST(superquadrics_move_at_most_at_speed_two_for_every_exponent)
{
    static const char *const exponents[] = {"2,2",      "1,1",        "1.5,0.5",
                                            "0.01,1.9", "1e-9,1e-17", "1e-300,5e-324"};
    uint64_t random = suite_seed();
    for (size_t k = 0; k < sizeof exponents / sizeof exponents[0]; ++k) {
        char text[80];
        snprintf(text, sizeof text, "{\"exponents\": [%s]}", exponents[k]);
        instance made = shape("superellipsoid", text);
        double lo[3], hi[3];
        made.surface->domain(made.self, lo, hi);
        for (int n = 0; n < suite_times(100); ++n) {
            const double d = random_power(&random, -40, 2);
            const double u = 1.5707963267948966 * (double)(random_bits(&random) % 5);
            const double v = 0.7853981633974483 * ((double)(random_bits(&random) % 5) - 2);
            const double from[3] = {fmax(u - d, lo[0]), fmax(v - d, lo[1]), 0};
            const double to[3] = {fmin(u + d, hi[0]), fmin(v + d, hi[1]), 0};
            const imp_region region = region_make(from, to);
            imp_rate_matrix rates;
            ck_assert_int_eq(made.surface->rate(made.self, &region, &rates), IMP_STATUS_OK);
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 2; ++j) ck_assert_double_le(rates.m[i][j], 2 + 1e-9);
        }
        instance_free(&made);
    }
}
END_TEST

START_TEST(exponents_beyond_two_are_refused_with_the_reason)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_registry *types = query_registry();
    ck_assert_ptr_null(
        imp_scene_from_pair(types, "superellipsoid exponents=1,2.5", "sphere", &error));
    ck_assert_ptr_nonnull(strstr(error.text, "exponents/1: got 2.5, must be in (0, 2]"));
    ck_assert_ptr_nonnull(strstr(error.text, "Lipschitz"));
    imp_registry_free(types);
}
END_TEST

/* --- Curves that sweep ------------------------------------------------------------------------ */

START_TEST(a_rational_quarter_of_a_circle_turns_into_half_a_sphere)
{
    instance made = shape("revolution", "{\"profile\": [[1,0],[1,1],[0,1]], \"weights\": [1,1,2]}");
    for (int k = 0; k <= 10; ++k) {
        double x[3];
        point_of(&made, 0.6 * k, k / 10., 0, x);
        ck_assert_double_eq_tol(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], 1, 1e-14);
    }
    instance_free(&made);
}
END_TEST

START_TEST(a_sweep_is_the_sum_of_its_curves)
{
    instance made = shape("sweep", "{}");
    double whole[3], profile[3], path[3], corner[3];
    point_of(&made, 0.3, 0.8, 0, whole);
    point_of(&made, 0.3, 0, 0, profile);
    point_of(&made, 0, 0.8, 0, path);
    point_of(&made, 0, 0, 0, corner);
    for (int i = 0; i < 3; ++i)
        ck_assert_double_eq_tol(whole[i] + corner[i], profile[i] + path[i], 1e-15);
    instance_free(&made);
}
END_TEST

SUITE_MAIN("shapes", moving_points_segments_and_planes_are_followed_exactly,
           a_triangle_whose_corners_part_is_followed_but_for_one_cubic_term,
           a_collapsed_edge_is_one_point, a_bezier_triangle_of_degree_1_is_a_triangle,
           a_quadratic_triangle_holds_a_paraboloid,
           a_rational_quartic_triangle_is_an_octant_of_a_sphere,
           each_face_is_a_triangle_of_its_own_points,
           bounds_shrink_at_the_collapsed_corner_as_anywhere,
           superellipsoids_satisfy_their_implicit_equation,
           superquadrics_move_at_most_at_speed_two_for_every_exponent,
           exponents_beyond_two_are_refused_with_the_reason,
           a_rational_quarter_of_a_circle_turns_into_half_a_sphere,
           a_sweep_is_the_sum_of_its_curves)
