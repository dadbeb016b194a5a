/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/shape_points.h"

/* NURBS: points, nets and bounds at their knots. */

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

SUITE_MAIN("nurbs", a_nurbs_without_inner_knots_is_a_bezier_patch,
           a_rational_circle_of_four_arcs_is_round, a_nurbs_has_nets_between_its_knots,
           bounds_across_a_knot_tighten_as_fast_as_the_surface_is_smooth,
           a_surface_of_many_knots_is_bounded_as_a_whole_and_in_the_small)
