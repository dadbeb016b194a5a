/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/region.h"
#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"
#include "tests/support/query_helpers.h"

/* What is special to single shapes of the catalogue. That their bounds hold at all is tested for
 * all of them together in test_plugins.c. */

static imp_registry *registry;

static instance shape(const char *type, const char *parameters)
{
    uint64_t random = suite_seed();
    if (registry == NULL) registry = built_registry();
    return instance_make(registry, type, parameters, &random);
}

static void point_of(const instance *made, double u, double v, double t, double x[3])
{
    const double p[3] = {u, v, t};
    ck_assert_int_eq(made->surface->eval(made->self, 1, p, x, NULL), IMP_STATUS_OK);
}

static void models_of(const instance *made, const double lo[3], const double hi[3],
                      imp_model model[3])
{
    const imp_region region = region_make(lo, hi);
    ck_assert_int_eq(made->surface->include(made->self, &region, model), IMP_STATUS_OK);
}

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

/* G. Farin, B. Piper, A. Worsey, The octant of a sphere as a non-degenerate triangular Bezier
 * patch, 1987. As JSON, or as a pipeline. */
static const char *octant_text(bool as_pipeline)
{
    static char text[1200];
    const double a = (sqrt(3) - 1) / sqrt(3), b = (sqrt(3) + 1) / (2 * sqrt(3));
    const double c = 1 - (5 - sqrt(2)) * (7 - sqrt(3)) / 46;
    const double far = 4 * sqrt(3) * (sqrt(3) - 1), near = 3 * sqrt(2);
    const double inner = sqrt(2. / 3) * (3 + 2 * sqrt(2) - sqrt(3));
    const double p[15][4] = {{0, 0, 1, far},   {a, 0, 1, near}, {0, a, 1, near}, {b, 0, b, 4},
                             {c, c, 1, inner}, {0, b, b, 4},    {1, 0, a, near}, {1, c, c, inner},
                             {c, 1, c, inner}, {0, 1, a, near}, {1, 0, 0, far},  {1, a, 0, near},
                             {b, b, 0, 4},     {a, 1, 0, near}, {0, 1, 0, far}};
    FILE *out = fmemopen(text, sizeof text, "w");
    fputs(as_pipeline ? "bezier-triangle degree=4 points=[" : "{\"degree\": 4, \"points\": [", out);
    for (int k = 0; k < 15; ++k)
        fprintf(out, "%s[%.17g,%.17g,%.17g]", k > 0 ? "," : "", p[k][0], p[k][1], p[k][2]);
    fputs(as_pipeline ? "] weights=[" : "], \"weights\": [", out);
    for (int k = 0; k < 15; ++k) fprintf(out, "%s%.17g", k > 0 ? "," : "", p[k][3]);
    fputs(as_pipeline ? "]" : "]}", out);
    ck_assert_int_eq(fclose(out), 0);
    return text;
}

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

/* --- NURBS ------------------------------------------------------------------------------------ */

START_TEST(a_nurbs_without_inner_knots_is_a_bezier_patch)
{
    const char *bezier_text = "{\"degree\": [3,2], \"points\": [@12[?,?,?]], \"weights\": [@12+],"
                              " \"velocities\": [@12[?,?,?]]}";
    const char *nurbs_text = "{\"degree\": [3,2], \"points\": [@12[?,?,?]], \"weights\": [@12+],"
                             " \"velocities\": [@12[?,?,?]], \"knots_u\": [0,0,0,0,1,1,1,1],"
                             " \"knots_v\": [0,0,0,1,1,1]}";
    instance bezier = shape("bezier", bezier_text), nurbs = shape("nurbs", nurbs_text);
    const double lo[3] = {0.2, 0.5, 0.1}, hi[3] = {0.4, 0.9, 0.3};
    imp_model f[3], g[3];
    models_of(&bezier, lo, hi, f);
    models_of(&nurbs, lo, hi, g);
    for (int i = 0; i < 3; ++i) {
        ck_assert_double_eq_tol(f[i].a, g[i].a, 1e-12);
        ck_assert_double_eq_tol(f[i].b[0], g[i].b[0], 1e-12);
        ck_assert_double_eq_tol(f[i].e, g[i].e, 1e-9);
    }
    instance_free(&bezier);
    instance_free(&nurbs);
}
END_TEST

START_TEST(a_rational_circle_of_four_arcs_is_round)
{
    instance made = shape(
        "nurbs",
        "{\"degree\": [2,1], \"knots_u\": [0,0,0,1,1,2,2,3,3,4,4,4], \"knots_v\": [0,0,1,1],"
        " \"points\": [[1,0,0],[1,0,1],[1,1,0],[1,1,1],[0,1,0],[0,1,1],[-1,1,0],[-1,1,1],[-1,0,0],"
        "[-1,0,1],[-1,-1,0],[-1,-1,1],[0,-1,0],[0,-1,1],[1,-1,0],[1,-1,1],[1,0,0],[1,0,1]],"
        " \"weights\": [1,1,0.7071067811865476,0.7071067811865476,1,1,0.7071067811865476,"
        "0.7071067811865476,1,1,0.7071067811865476,0.7071067811865476,1,1,0.7071067811865476,"
        "0.7071067811865476,1,1]}");
    for (int k = 0; k <= 40; ++k) {
        double x[3];
        point_of(&made, k / 10., 0.5, 0, x);
        ck_assert_double_eq_tol(hypot(x[0], x[1]), 1, 1e-15);
    }
    instance_free(&made);
}
END_TEST

/* A region inside a cell has the net that a Bezier patch has there; one that a knot crosses has
 * none. */
START_TEST(a_nurbs_has_nets_between_its_knots)
{
    const char *points =
        "\"points\": [@12[?,?,?]], \"weights\": [@12+], \"velocities\": [@12[?,?,?]]";
    char text[300];
    snprintf(text, sizeof text, "{\"degree\": [3,2], %s}", points);
    instance bezier = shape("bezier", text);
    snprintf(text, sizeof text,
             "{\"degree\": [3,2], %s, \"knots_u\": [0,0,0,0,1,1,1,1], \"knots_v\": [0,0,0,1,1,1]}",
             points);
    instance nurbs = shape("nurbs", text);
    const imp_region inside = region_make((double[3]){0.2, 0.5, 0.1}, (double[3]){0.4, 0.9, 0.3});
    imp_net f = {.degree = {0, 0}}, g = f;
    ck_assert_int_eq(bezier.surface->net(bezier.self, &inside, &f), IMP_STATUS_OK);
    ck_assert_int_eq(nurbs.surface->net(nurbs.self, &inside, &g), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) {
        ck_assert_double_le(g.error[i], 1e-11);
        for (int k = 0; k < 12; ++k) {
            ck_assert_double_eq_tol(f.place[i] + f.point[i][k], g.place[i] + g.point[i][k], 1e-11);
            ck_assert_double_eq_tol(f.weight[k], g.weight[k], 1e-11);
        }
    }
    instance_free(&bezier);
    instance_free(&nurbs);
    nurbs = shape("nurbs", "{}"); /* a knot at 1 */
    const imp_region crossed = region_make((double[3]){0.5, 0, 0}, (double[3]){1.5, 1, 1});
    ck_assert_int_eq(nurbs.surface->net(nurbs.self, &crossed, &g), IMP_STATUS_UNBOUNDED);
    instance_free(&nurbs);
}
END_TEST

/* A region that a knot crosses is not left with a box: halved, it loses three quarters of its
 * remainder, as the curvature jumps there; and seven eighths where even that is continuous. */
static double remainder_across(const char *knots, int degree, int points, double half)
{
    char text[400];
    snprintf(text, sizeof text,
             "{\"degree\": [%d,1], \"knots_u\": %s, \"knots_v\": [0,0,1,1], \"points\":"
             " [@%d[?,?,?]]}",
             degree, knots, points);
    instance made = shape("nurbs", text);
    imp_model model[3];
    models_of(&made, (double[3]){1 - half, 0.5, 0}, (double[3]){1 + half, 0.5, 0}, model);
    instance_free(&made);
    return fmax(model[0].e, fmax(model[1].e, model[2].e));
}

START_TEST(bounds_across_a_knot_tighten_as_fast_as_the_surface_is_smooth)
{
    const char *quadratic = "[0,0,0,1,2,2,2]", *cubic = "[0,0,0,0,1,2,2,2,2]";
    const double slow =
        remainder_across(quadratic, 2, 8, 0.02) / remainder_across(quadratic, 2, 8, 0.01);
    const double fast = remainder_across(cubic, 3, 10, 0.02) / remainder_across(cubic, 3, 10, 0.01);
    ck_assert_double_ge(slow, 3.9);
    ck_assert_double_ge(fast, 7.8);
}
END_TEST

/* 100 by 100 cells of a bilinear wavy sheet. */
static char *sheet_text(void)
{
    enum { SIDE = 101 };
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    ck_assert_ptr_nonnull(out);
    fputs("{\"degree\": [1,1], \"knots\": [", out);
    for (int side = 0; side < 2; ++side) {
        fputs(side ? ",[0" : "[0", out);
        for (int k = 0; k < SIDE; ++k) fprintf(out, ",%d", k);
        fprintf(out, ",%d]", SIDE - 1);
    }
    fputs("], \"points\": [", out);
    for (int i = 0; i < SIDE; ++i)
        for (int j = 0; j < SIDE; ++j)
            fprintf(out, "%s[%d,%d,%.17g]", i + j ? "," : "", i, j, sin(i) * cos(j));
    fputs("]}", out);
    fclose(out);
    return text;
}

START_TEST(a_surface_of_many_knots_is_bounded_as_a_whole_and_in_the_small)
{
    char *text = sheet_text();
    instance made = shape("nurbs", text);
    imp_model model[3];
    models_of(&made, (double[3]){0, 0, 0}, (double[3]){100, 100, 0}, model);
    ck_assert_double_eq_tol(model[0].lo, 0, 1e-12);
    ck_assert_double_eq_tol(model[0].hi, 100, 1e-12);
    ck_assert(model[2].lo <= -0.99 && model[2].lo >= -1.001 && model[2].hi <= 1.001);
    models_of(&made, (double[3]){70.25, 3.5, 0}, (double[3]){70.5, 3.75, 0}, model);
    ck_assert_double_le(model[2].e, 1e-12);
    instance_free(&made);
    free(text);
}
END_TEST

/* --- Earliest contacts ------------------------------------------------------------------------ */

static void expect_contact(const char *a, const char *b, double time, double early)
{
    const question q = {.a = a, .b = b};
    ask_contact(&q, time, early);
}

START_TEST(a_falling_vertex_meets_a_face)
{
    expect_contact("triangle points=[[-1,-1,0],[2,-1,0],[-1,2,0]]",
                   "point position=0.1,0.2,1.5 velocity=0,0,-2", 0.75, 1e-6);
    expect_contact(
        "triangle points=[[-1,-1,0],[2,-1,0],[-1,2,0]] velocities=[[0,0,1],[0,0,1],[0,0,1]]",
        "point position=0.1,0.2,1.5 velocity=0,0,-2", 0.5, 1e-6);
}
END_TEST

START_TEST(an_edge_meets_an_edge)
{
    expect_contact("segment points=[[-1,0,0],[1,0,0]]",
                   "segment points=[[0.3,-1,1],[0.3,1,2]] velocities=[[0,0,-3],[0,0,-3]]", 0.5,
                   1e-6);
    const question past = {.a = "segment points=[[-1,0,0],[1,0,0]]",
                           .b = "segment points=[[1.1,-1,1],[1.1,1,1]] "
                                "velocities=[[0,0,-3],[0,0,-3]]"};
    ask_clear(&past);
}
END_TEST

START_TEST(a_bullet_does_not_pass_through_a_plate)
{
    expect_contact("plane origin=-1,-1,0 edge_u=2,0,0 edge_v=0,2,0",
                   "point position=0.123,0.2,500000 velocity=0,0,-1000000", 0.5, 1e-11);
}
END_TEST

/* Support height of the ellipsoid turned by 2 t: sqrt(a^2 sin^2 + c^2 cos^2). It reaches 1.2 where
 * sin^2 = 0.44 / 3. */
START_TEST(a_turning_ellipsoid_reaches_a_plane)
{
    expect_contact("ellipsoid radii=2,1,1 ! rotate axis=0,1,0 rate=2",
                   "plane origin=-5,-5,-1.2 edge_u=10,0,0 edge_v=0,10,0", asin(sqrt(0.44 / 3)) / 2,
                   1e-6);
}
END_TEST

/* The crest of the wave reaches the point where sin(2 pi (0 - t)) = 0.5 first: t = 7/12. */
START_TEST(a_wave_rises_to_a_point)
{
    expect_contact("ripple amplitude=0.1", "point position=0,0,0.05", 7. / 12, 1e-4);
}
END_TEST

START_TEST(the_apex_of_a_cone_pierces)
{
    expect_contact("cone radius=1 height=2 ! translate velocity=0,0,3",
                   "plane origin=-2.3,-2.1,3.5 edge_u=5,0,0 edge_v=0,5,0", 0.5, 1e-6);
}
END_TEST

START_TEST(triangles_of_a_paraboloid_and_of_a_sphere_are_met_where_these_are)
{
    expect_contact("bezier-triangle degree=2 points=[[-1,-1,2],[0,-0.5,-1],[-0.5,1,-3],[1,0,1],"
                   "[0.5,1.5,0],[0,3,9]]",
                   "point position=0.1,0.2,1.05 velocity=0,0,-2", 0.5, 1e-6);
    expect_contact(octant_text(true), "point position=0.48,0.6,1.64 velocity=0,0,-2", 0.5, 1e-6);
}
END_TEST

/* The corner u = 0 of both, the degenerate one, meets a corner: they move along the line
 * between. */
START_TEST(collapsed_corners_meet)
{
    expect_contact(
        "bezier-triangle degree=3 points=[[0,0,0],[1,0,-1],[0,1,-1],[2,0,-2],[1,1,-2],[0,2,-2],"
        "[3,0,-2],[2,1,-2],[1,2,-2],[0,3,-2]]",
        "bezier-triangle points=[[0,0,2],[-1,0,2.5],[0,-1,2.5],[-2,0,3],[-1,-1,3],[0,-2,3]] ! "
        "translate velocity=0,0,-4",
        0.5, 1e-6);
}
END_TEST

/* Exponents 2 make an octahedron, whose face x + y + z = 1 holds (1/3, 1/3, 1/3). */
START_TEST(the_bevel_of_a_superellipsoid_is_met_where_it_is)
{
    expect_contact("superellipsoid exponents=2,2", "point position=1,1,1 velocity=-1,-1,-1", 2. / 3,
                   1e-6);
}
END_TEST

SUITE_MAIN(
    "shapes", moving_points_segments_and_planes_are_followed_exactly,
    a_triangle_whose_corners_part_is_followed_but_for_one_cubic_term, a_collapsed_edge_is_one_point,
    a_bezier_triangle_of_degree_1_is_a_triangle, a_quadratic_triangle_holds_a_paraboloid,
    a_rational_quartic_triangle_is_an_octant_of_a_sphere, each_face_is_a_triangle_of_its_own_points,
    bounds_shrink_at_the_collapsed_corner_as_anywhere,
    superellipsoids_satisfy_their_implicit_equation,
    superquadrics_move_at_most_at_speed_two_for_every_exponent,
    exponents_beyond_two_are_refused_with_the_reason,
    a_rational_quarter_of_a_circle_turns_into_half_a_sphere, a_sweep_is_the_sum_of_its_curves,
    a_nurbs_without_inner_knots_is_a_bezier_patch, a_rational_circle_of_four_arcs_is_round,
    a_nurbs_has_nets_between_its_knots,
    bounds_across_a_knot_tighten_as_fast_as_the_surface_is_smooth,
    a_surface_of_many_knots_is_bounded_as_a_whole_and_in_the_small, a_falling_vertex_meets_a_face,
    an_edge_meets_an_edge, a_bullet_does_not_pass_through_a_plate,
    a_turning_ellipsoid_reaches_a_plane, a_wave_rises_to_a_point, the_apex_of_a_cone_pierces,
    the_bevel_of_a_superellipsoid_is_met_where_it_is,
    triangles_of_a_paraboloid_and_of_a_sphere_are_met_where_these_are, collapsed_corners_meet)
