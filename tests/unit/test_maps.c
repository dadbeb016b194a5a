/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/formula.h>
#include <stdio.h>
#include <string.h>

#include "core/surface/region.h"
#include "tests/support/map_images.h"
#include "tests/support/model_value.h"

/* What the equations of the maps promise, beside being what they are (test_plugins.c). */

/* --- Motions ---------------------------------------------------------------------------------- */

START_TEST(a_turn_of_the_screw_advances_by_its_pitch)
{
    instance made = map("screw", "{\"axis\": [0,0,3], \"center\": [1,0,0], \"pitch\": 0.5,"
                                 " \"rate\": 6.283185307179586}");
    expect_image(&made, (double[4]){2, 0, 0, 0}, (double[3]){2, 0, 0}, 1e-15);
    expect_image(&made, (double[4]){2, 0, 0, 0.25}, (double[3]){1, 1, 0.125}, 1e-15);
    expect_image(&made, (double[4]){2, 0, 0, 3}, (double[3]){2, 0, 1.5}, 1e-14);
    instance_free(&made);
}
END_TEST

START_TEST(a_crank_by_formula_turns_and_moves_its_piston)
{
    instance made = map("motion-formula",
                        "{\"offset\": [\"0\", \"0\", \"r*cos(2*t)+1*sqrt(4-(r*sin(2*t))^2)\"],"
                        " \"constants\": {\"r\": 1}}");
    expect_image(&made, (double[4]){5, 6, 7, 0}, (double[3]){5, 6, 10}, 1e-15);
    expect_image(&made, (double[4]){5, 6, 7, M_PI_4}, (double[3]){5, 6, 7 + sqrt(3)}, 1e-14);
    expect_image(&made, (double[4]){5, 6, 7, M_PI_2}, (double[3]){5, 6, 8}, 1e-14);
    instance_free(&made);
    made = map("motion-formula", "{\"angle\": \"pi*t^2/2\", \"axis\": [0,0,3], \"center\":"
                                 " [1,0,0], \"offset\": [\"t\", \"0\", \"5\"]}");
    expect_image(&made, (double[4]){3, 0, 0, 0}, (double[3]){3, 0, 5}, 0);
    expect_image(&made, (double[4]){3, 0, 0, 1}, (double[3]){2, 2, 5}, 1e-14);
    expect_image(&made, (double[4]){3, 0, 0, -1}, (double[3]){0, 2, 5}, 1e-14);
    instance_free(&made);
}
END_TEST

/* Where a text is undefined, or infinitely steep, nothing is claimed. */
START_TEST(a_motion_is_unbounded_where_its_formulas_are)
{
    static const char *const texts[] = {"{\"angle\": \"sqrt(t)\"}",
                                        "{\"offset\": [\"0\", \"sqrt(t)\", \"0\"]}"};
    static const struct {
        double lo, hi;
        imp_status expected;
    } spans[] = {{-2, -1, IMP_STATUS_UNBOUNDED}, {-1, -1, IMP_STATUS_UNBOUNDED},
                 {-1, 1, IMP_STATUS_UNBOUNDED},  {0, 1, IMP_STATUS_UNBOUNDED},
                 {1, 2, IMP_STATUS_OK},          {1, 1, IMP_STATUS_OK}};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        instance made = map("motion-formula", texts[k]);
        const double before[4] = {1, 2, 3, -1};
        double x[3];
        ck_assert_int_eq(made.map->eval(made.self, 1, before, x, NULL), IMP_STATUS_DOMAIN);
        for (size_t i = 0; i < sizeof spans / sizeof *spans; ++i) {
            const imp_region region =
                region_make((double[3]){0, 0, spans[i].lo}, (double[3]){0, 0, spans[i].hi});
            const imp_model t =
                spans[i].lo < spans[i].hi ? imp_param(&region, 2) : imp_num(spans[i].lo);
            const imp_model in[4] = {imp_num(1), imp_num(2), imp_num(3), t};
            imp_model out[3];
            imp_pose pose;
            memset(&pose, 0, sizeof pose);
            ck_assert_int_eq(made.map->rigid(made.self, &t, &pose), spans[i].expected);
            ck_assert_int_eq(made.map->apply(made.self, in, out), spans[i].expected);
        }
        instance_free(&made);
    }
}
END_TEST

START_TEST(scaling_grows_collapses_and_mirrors_about_its_centre)
{
    instance made = map("scale", "{\"factors\": [[1],[-1]], \"center\": [1,1,1]}");
    expect_image(&made, (double[4]){3, 1, 0, 0}, (double[3]){3, 1, 0}, 0);
    expect_image(&made, (double[4]){3, 1, 0, -1}, (double[3]){5, 1, -1}, 1e-15);
    expect_image(&made, (double[4]){3, 1, 0, 1}, (double[3]){1, 1, 1}, 1e-15);
    expect_image(&made, (double[4]){3, 1, 0, 2}, (double[3]){-1, 1, 2}, 1e-15);
    instance_free(&made);
    made = map("scale", "{\"factor\": [1,2,0]}");
    expect_image(&made, (double[4]){3, 1, 5, 7}, (double[3]){3, 2, 0}, 1e-15);
    instance_free(&made);
}
END_TEST

START_TEST(a_wave_travels_at_its_speed)
{
    instance made = map("wave", "{\"amplitude\": [0.25,0,1], \"wave_vector\": [3,4,0],"
                                " \"speed\": 0.5, \"phase\": 0.1}");
    for (double t = -2; t < 2; t += 0.1) {
        double x[3], swing = sin(5 * (0.2 * 0.6 - 0.3 * 0.8) + 0.1);
        image(&made, 0.2 + 0.3 * t, -0.3 + 0.4 * t, 1, t, x); /* along k / |k| at 0.5 */
        expect_point(x, 0.2 + 0.3 * t + 0.25 * swing, -0.3 + 0.4 * t, 1 + swing, 1e-14);
    }
    instance_free(&made);
}
END_TEST

/* x turned about the unit vector along `axis`, through the center. */
static void turn(const double axis[3], const double center[3], long double angle, const double x[3],
                 long double out[3])
{
    const long double length =
        sqrtl((long double)axis[0] * axis[0] + (long double)axis[1] * axis[1] +
              (long double)axis[2] * axis[2]);
    long double k[3], w[3], kw = 0;
    for (int i = 0; i < 3; ++i) {
        k[i] = axis[i] / length;
        w[i] = (long double)x[i] - center[i];
        kw += k[i] * w[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        out[i] = center[i] + k[i] * kw + cosl(angle) * (w[i] - k[i] * kw) +
                 sinl(angle) * (k[j] * w[l] - k[l] * w[j]);
    }
}

START_TEST(turned_points_are_within_their_errors_beside_long_doubles)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(2000); ++k) {
        double axis[3], center[3], p[4], x[3], error[3], size = 0;
        long double exact[3];
        char text[300];
        for (int i = 0; i < 3; ++i) {
            axis[i] = random_bits(&state) % 4 ? random_between(&state, -1, 1) : i == 0;
            center[i] = random_bits(&state) % 2 ? 0 : random_between(&state, -9, 9);
            p[i] = random_between(&state, -1, 1) * random_power(&state, -20, 4);
            size += fabs(p[i]) + fabs(center[i]);
        }
        const uint64_t kind = random_bits(&state) % 4; /* of time: 0, next to it, any */
        p[3] = kind == 0 ? 0 : random_between(&state, 0, 1) * (kind == 1 ? 0x1p-70 : 1);
        const double rate = random_between(&state, -1, 1) * random_power(&state, -3, 10);
        snprintf(
            text, sizeof text,
            "{\"axis\": [%.17g,%.17g,%.17g], \"center\": [%.17g,%.17g,%.17g], \"rate\": %.17g}",
            axis[0], axis[1], axis[2], center[0], center[1], center[2], rate);
        instance made = map("rotate", text);
        const long double angle = (long double)rate * p[3];
        turn(axis, center, angle, p, exact);
        ck_assert_int_eq(made.map->eval(made.self, 1, p, x, error), IMP_STATUS_OK);
        const double bound = (0x1p-46 + 0x1p-50 * fabs((double)angle)) * size;
        const long double off = (0x1p-60L + 0x1p-63L * fabsl(angle)) * size;
        for (int i = 0; i < 3; ++i) {
            ck_assert(fabsl(exact[i] - x[i]) <= error[i] + off);
            ck_assert_double_le(error[i], bound + 4 * IMP_TINY);
        }
        instance_free(&made);
    }
}
END_TEST

START_TEST(points_turned_out_of_range_are_undefined)
{
    double x[3];
    instance made = map("rotate", "{\"axis\": [1,1,0], \"rate\": 1}");
    ck_assert_int_eq(made.map->eval(made.self, 1, (double[4]){0, INFINITY, 0, 0}, x, NULL),
                     IMP_STATUS_DOMAIN);
    ck_assert_int_eq(made.map->eval(made.self, 1, (double[4]){0, 0, NAN, 0}, x, NULL),
                     IMP_STATUS_DOMAIN);
    instance_free(&made);
}
END_TEST

/* --- Deformations ----------------------------------------------------------------------------- */

START_TEST(a_taper_is_linear_within_its_range_and_constant_beyond)
{
    instance made = map("taper", "{\"range\": [0,2], \"start\": [1,1], \"end\": 3}");
    expect_image(&made, (double[4]){1, -1, -5, 0}, (double[3]){1, -1, -5}, 1e-15);
    expect_image(&made, (double[4]){1, -1, -5, 1}, (double[3]){2, -2, -5}, 1e-15);
    expect_image(&made, (double[4]){1, -1, 1, 0}, (double[3]){2, -2, 1}, 1e-15);
    expect_image(&made, (double[4]){1, -1, 1, 1}, (double[3]){2.5, -2.5, 1}, 1e-15);
    expect_image(&made, (double[4]){1, -1, 7, 5}, (double[3]){3, -3, 7}, 1e-15);
    instance_free(&made);
}
END_TEST

START_TEST(a_twist_turns_each_height_by_its_own_angle)
{
    instance made = map("twist", "{\"rate\": [0,1.5707963267948966], \"center\": [0,0,1]}");
    expect_image(&made, (double[4]){2, 0, 1, 1}, (double[3]){2, 0, 1}, 1e-14);
    expect_image(&made, (double[4]){2, 0, 2, 1}, (double[3]){0, 2, 2}, 1e-14);
    expect_image(&made, (double[4]){2, 0, 0, 1}, (double[3]){0, -2, 0}, 1e-14);
    expect_image(&made, (double[4]){2, 0, 2, 2}, (double[3]){-2, 0, 2}, 1e-14);
    instance_free(&made);
}
END_TEST

START_TEST(a_rod_bends_into_an_arc_and_is_straight_beyond)
{
    const double pi = 3.141592653589793;
    instance made = map("bend", "{\"curvature\": 1, \"range\": [0,1.5707963267948966]}");
    expect_image(&made, (double[4]){5, pi / 6, 0, 0}, (double[3]){5, 0.5, 1 - sqrt(0.75)}, 1e-15);
    expect_image(&made, (double[4]){5, pi / 6, 1, 0}, (double[3]){5, 0, 1}, 1e-15);
    expect_image(&made, (double[4]){0, pi / 2, 0, 0}, (double[3]){0, 1, 1}, 1e-15);
    expect_image(&made, (double[4]){0, pi / 2 + 3, 0, 0}, (double[3]){0, 1, 4}, 1e-14);
    expect_image(&made, (double[4]){0, -3, 0.5, 0}, (double[3]){0, -3, 0.5}, 1e-15);
    instance_free(&made);
}
END_TEST

START_TEST(a_rod_straightens_through_no_curvature_at_all)
{
    instance made = map("bend", "{\"curvature\": [-1,1], \"range\": [-1,1]}");
    expect_image(&made, (double[4]){1, 0.5, 0.25, 1}, (double[3]){1, 0.5, 0.25}, 1e-15);
    double before[3], after[3];
    image(&made, 1, 0.5, 0.25, 1 - 1e-9, before);
    image(&made, 1, 0.5, 0.25, 1 + 1e-9, after);
    for (int i = 0; i < 3; ++i) ck_assert_double_le(fabs(after[i] - before[i]), 1e-9);
    instance_free(&made);
}
END_TEST

START_TEST(a_lattice_in_place_deforms_nothing)
{
    char text[4000] = "{\"lattice\": [3,2,5], \"lo\": [0,0,0], \"hi\": [2,1,4], \"points\": [";
    for (int k = 0; k < 30; ++k)
        sprintf(text + strlen(text), "%s[%d,%d,%d]", k ? "," : "", k / 10, k / 5 % 2, k % 5);
    instance made = map("ffd", strcat(text, "]}"));
    uint64_t random = suite_seed();
    for (int k = 0; k < 100; ++k) {
        double p[4] = {0, 0, 0, 3};
        for (int j = 0; j < 3; ++j) p[j] = random_between(&random, -1, 5);
        expect_image(&made, p, p, 1e-14);
    }
    instance_free(&made);
}
END_TEST

START_TEST(a_lattice_moves_space_outside_along_with_its_faces)
{
    instance made = map("ffd", "{\"lattice\": [3,3,3], \"points\": [@27[?,?,?]]}");
    uint64_t random = suite_seed();
    for (int k = 0; k < 100; ++k) {
        double p[3], x[3], near[3], far[3];
        for (int j = 0; j < 3; ++j) p[j] = random_between(&random, -1, 1);
        image(&made, 1, p[1], p[2], 0, x);
        image(&made, 1 + 1e-12, p[1], p[2], 0, near);
        image(&made, 4, p[1], p[2], 0, far);
        expect_point(near, x[0], x[1], x[2], 1e-11);
        expect_point(far, x[0] + 3, x[1], x[2], 1e-14);
    }
    instance_free(&made);
}
END_TEST

/* --- Tightness -------------------------------------------------------------------------------- */

enum { GRID = 9, REGIONS = 30 };

/* A part of the unit sphere at longitude 3 u, latitude 3 v, and t, over a region. */
static void sphere_part(const imp_region *region, imp_model in[4])
{
    imp_model sin_u, cos_u, sin_v, cos_v;
    imp_sincos(imp_scale(imp_param(region, 0), 3), &sin_u, &cos_u);
    imp_sincos(imp_scale(imp_param(region, 1), 3), &sin_v, &cos_v);
    in[0] = imp_mul(cos_v, cos_u);
    in[1] = imp_mul(cos_v, sin_u);
    in[2] = sin_v;
    in[3] = imp_param(region, 2);
}

/* The greatest distance from the quadratic on a grid. */
static void look(const instance *made, const imp_region *region, const imp_model out[3],
                 double off[3])
{
    off[0] = off[1] = off[2] = 0;
    for (int n = 0; n < GRID * GRID * GRID; ++n) {
        const int at[3] = {n % GRID, n / GRID % GRID, n / GRID / GRID};
        double s[3], p[3], x[3];
        for (int j = 0; j < 3; ++j) {
            s[j] = 2.0 * at[j] / (GRID - 1) - 1;
            p[j] = fmax(region->lo[j], fmin(region->c[j] + region->d[j] * s[j], region->hi[j]));
        }
        double ring = cos(3 * p[1]);
        image(made, ring * cos(3 * p[0]), ring * sin(3 * p[0]), sin(3 * p[1]), p[2], x);
        for (int i = 0; i < 3; ++i) off[i] = fmax(off[i], fabs(x[i] - quadratic_at(&out[i], s)));
    }
}

/* Geometric mean of e over the greatest distance seen, for parts of that width. */
static double remainder_ratio(const char *type, const char *parameters, double width)
{
    uint64_t random = suite_seed();
    double sum = 0;
    int counted = 0;
    for (int k = 0; k < REGIONS; ++k) {
        instance made = instance_make(map_registry(), type, parameters, &random);
        double lo[3], hi[3], off[3];
        for (int j = 0; j < 3; ++j) {
            lo[j] = random_between(&random, 0, 1 - width);
            hi[j] = lo[j] + width;
        }
        const imp_region region = region_make(lo, hi);
        imp_model in[4], out[3];
        sphere_part(&region, in);
        ck_assert_int_eq(made.map->apply(made.self, in, out), IMP_STATUS_OK);
        look(&made, &region, out, off);
        for (int i = 0; i < 3; ++i) {
            if (off[i] < 1e-11) continue;
            sum += log2(out[i].e / off[i]);
            ++counted;
        }
        instance_free(&made);
    }
    return exp2(sum / counted);
}

/* Not much more than they are; the sphere's own remainder, doubled by the map, counts as 2. */
static const struct limit {
    const char *type, *parameters;
    double coarse, fine; /* for parts of width 1/4 and 1/64 */
} limits[] = {
    {"scale", "{\"factors\": [[1,1,1],[1,2,3]]}", 1.4, 1.3},
    {"rotate", "{\"axis\": [?,?,?], \"rate\": 2}", 1.9, 1.8},
    {"screw", "{\"axis\": [?,?,?], \"rate\": 2}", 1.9, 1.8},
    {"motion-formula", "{\"axis\": [?,?,?], \"angle\": \"2*t\"}", 1.9, 1.8},
    {"motion-formula", "{\"offset\": [\"0\", \"0\", \"sin(2*t)\"]}", 1.9, 1.8},
    {"taper", "{\"range\": [-10,10]}", 1.3, 1.2},
    {"taper", "{\"axis\": [?,?,?], \"end\": [1,?]}", 2.4, 2},
    {"twist", "{}", 1.9, 1.8},
    {"twist", "{\"axis\": [?,?,?], \"rate\": [0,?]}", 2.9, 2.2},
    {"bend", "{}", 4, 2.9},
    {"wave", "{\"amplitude\": [0,0,0.1], \"wave_vector\": [6,0,0]}", 1.3, 1.3},
    {"keyframes", "{\"times\": [0,0.5,1], \"positions\": [@3[?,?,?]]}", 1.3, 1.2},
    {"trajectory",
     "{\"times\": [0,1], \"positions\": [@2[?,?,?]],"
     " \"rotations\": [[1,0,0,0],[0.7316888688738209,0,0,0.6816387600233341]],"
     " \"spins\": [[0,0,1.5]], \"accelerations\": [[0,0,-9.81]]}",
     1.5, 1.4},
    {"keyframes", "{\"times\": [0,1], \"rotations\": [[1,0,0,0],[0.8,0.6,0,0]]}", 1.5, 1.4},
    {"ffd", "{\"lo\": [-2,-2,-2], \"hi\": [2,2,2], \"points\": [@8[?,?,?]]}", 2.6, 2.4},
    {"ffd", "{\"lo\": [-2,-2,-2], \"hi\": [2,2,2], \"lattice\": [4,4,4], \"points\": [@64[?,?,?]]}",
     3.5, 3.4},
};

START_TEST(remainders_are_not_much_wider_than_what_they_bound)
{
    for (size_t k = 0; k < sizeof limits / sizeof limits[0]; ++k) {
        const struct limit *limit = &limits[k];
        double coarse = remainder_ratio(limit->type, limit->parameters, 0.25);
        double fine = remainder_ratio(limit->type, limit->parameters, 1. / 64);
        ck_assert_msg(coarse < limit->coarse && fine < limit->fine,
                      "%s %s: remainders %g times too wide, %g on small parts", limit->type,
                      limit->parameters, coarse, fine);
    }
}
END_TEST

/* --- Tables ----------------------------------------------------------------------------------- */

/* Points within their errors, beside long doubles, and as the formula of any polynomial has
 * them. */
START_TEST(translations_at_constant_velocity_are_exact_but_for_rounding)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(500); ++k) {
        static const double special[] = {0, 1, -1, 0x1p-1030};
        double c[2][3], p[4], x[3], error[3], y[3];
        char text[300], longer[320];
        for (int i = 0; i < 6; ++i) {
            const uint64_t kind = random_bits(&state) % 8;
            c[i / 3][i % 3] = kind < 4 ? special[kind] : random_between(&state, -3, 3);
        }
        for (int i = 0; i < 4; ++i)
            p[i] = random_bits(&state) % 4 ? random_between(&state, -2, 2) : 0;
        const int length =
            snprintf(text, sizeof text, "{\"offset\": [[%.17g,%.17g,%.17g],[%.17g,%.17g,%.17g]",
                     c[0][0], c[0][1], c[0][2], c[1][0], c[1][1], c[1][2]);
        snprintf(longer, sizeof longer, "%s,[0,0,0]]}", text);
        snprintf(text + length, sizeof text - (size_t)length, "]}");
        instance made = map("translate", text), general = map("translate", longer);
        imp_map_rates rates;
        const imp_box4 box = {{-1, -1, -1, -1}, {1, 1, 1, 1}};
        ck_assert_int_eq(made.map->eval(made.self, 1, p, x, error), IMP_STATUS_OK);
        ck_assert_int_eq(general.map->eval(general.self, 1, p, y, NULL), IMP_STATUS_OK);
        ck_assert_int_eq(made.map->rate(made.self, &box, &rates), IMP_STATUS_OK);
        for (int i = 0; i < 3; ++i) {
            const double size = fabs(c[0][i]) + fabs(c[1][i] * p[3]) + fabs(p[i]);
            const long double sum = (long double)c[0][i] + (long double)c[1][i] * p[3] + p[i];
            ck_assert(fabsl(sum - x[i]) <= error[i] + 0x1p-62L * size);
            ck_assert_double_le(error[i], 0x1p-51 * size + 4 * IMP_TINY);
            ck_assert_double_eq_tol(x[i], y[i], 1e-14);
            for (int j = 0; j < 4; ++j)
                ck_assert(rates.m[i][j] == (j < 3 ? i == j : fabs(c[1][i])));
        }
        instance_free(&made);
        instance_free(&general);
    }
}
END_TEST

START_TEST(translations_too_far_for_a_double_are_undefined)
{
    double x[3];
    instance made = map("translate", "{\"velocity\": [1e200,0,0]}");
    ck_assert_int_eq(made.map->eval(made.self, 1, (double[4]){0, 0, 0, 1e200}, x, NULL),
                     IMP_STATUS_DOMAIN);
    ck_assert_int_eq(made.map->eval(made.self, 1, (double[4]){0, 0, 0, NAN}, x, NULL),
                     IMP_STATUS_DOMAIN);
    ck_assert_int_eq(made.map->eval(made.self, 1, (double[4]){0, INFINITY, 0, 0}, x, NULL),
                     IMP_STATUS_DOMAIN);
    instance_free(&made);
}
END_TEST

static const char zigzag[] = "{\"times\": [0,1,1.5,2,4], \"positions\": [[0,0,0],[1,2,0],[0,2,1],"
                             "[1,1,1],[5,1,-1]]";

static instance zigzag_map(const char *more)
{
    char text[300];
    snprintf(text, sizeof text, "%s%s}", zigzag, more);
    return map("translate", text);
}

START_TEST(tables_pass_through_their_rows_and_go_straight_between_them)
{
    instance made = zigzag_map("");
    expect_image(&made, (double[4]){1, 1, 1, 0}, (double[3]){1, 1, 1}, 0);
    expect_image(&made, (double[4]){1, 1, 1, 0.25}, (double[3]){1.25, 1.5, 1}, 1e-15);
    expect_image(&made, (double[4]){1, 1, 1, 1}, (double[3]){2, 3, 1}, 1e-15);
    expect_image(&made, (double[4]){1, 1, 1, 3}, (double[3]){4, 2, 1}, 1e-15);
    expect_image(&made, (double[4]){1, 1, 1, 4}, (double[3]){6, 2, 0}, 1e-15);
    instance_free(&made);
    made = map("rotate", "{\"times\": [0,2], \"angles\": [0,3.141592653589793]}");
    expect_image(&made, (double[4]){1, 0, 0, 1}, (double[3]){0, 1, 0}, 1e-15);
    instance_free(&made);
}
END_TEST

START_TEST(tables_hold_or_are_undefined_beyond_their_ends)
{
    const double before[4] = {0, 0, 0, -1e-300}, after[4] = {0, 0, 0, 4.0000000000000009};
    const imp_box4 box = {{0, 0, 0, -1}, {1, 1, 1, 1}};
    imp_map_rates rates;
    double lo, hi, x[3];
    instance made = zigzag_map("");
    made.map->time_domain(made.self, &lo, &hi);
    ck_assert(lo == 0 && hi == 4);
    ck_assert_int_eq(made.map->eval(made.self, 1, before, x, NULL), IMP_STATUS_DOMAIN);
    ck_assert_int_eq(made.map->eval(made.self, 1, after, x, NULL), IMP_STATUS_DOMAIN);
    ck_assert_int_eq(made.map->rate(made.self, &box, &rates), IMP_STATUS_DOMAIN);
    instance_free(&made);
    made = zigzag_map(", \"hold\": true");
    made.map->time_domain(made.self, &lo, &hi);
    ck_assert(lo == -INFINITY && hi == INFINITY);
    expect_image(&made, (double[4]){1, 1, 1, -7}, (double[3]){1, 1, 1}, 0);
    expect_image(&made, (double[4]){1, 1, 1, 1e9}, (double[3]){6, 2, 0}, 1e-15);
    instance_free(&made);
}
END_TEST

/* Across a kink the remainder is a share of the jump in slope, and shrinks with the span; within a
 * piece the model is exact but for rounding. */
START_TEST(models_of_linear_tables_are_exact_between_kinks_and_tight_across)
{
    instance made = zigzag_map("");
    for (double width = 0.25; width > 0x1p-20; width /= 2) {
        const double from[3] = {0, 0, 1 - width}, to[3] = {1, 1, 1 + width};
        const double inside[3] = {0, 0, 1 - 2 * width};
        const imp_region across = region_make(from, to), within = region_make(inside, from);
        imp_model in[4] = {imp_num(0), imp_num(0), imp_num(0), imp_param(&across, 2)}, out[3];
        ck_assert_int_eq(made.map->apply(made.self, in, out), IMP_STATUS_OK);
        /* x turns from slope 1 to -2 at 1. */
        ck_assert_double_le(out[0].e, 1.5 * width * 1.0001 + 1e-14);
        ck_assert(out[0].rate[2] >= 2 && out[0].rate[2] < 2.0001);
        in[3] = imp_param(&within, 2);
        ck_assert_int_eq(made.map->apply(made.self, in, out), IMP_STATUS_OK);
        for (int i = 0; i < 3; ++i) ck_assert_double_le(out[i].e, 1e-13);
    }
    instance_free(&made);
}
END_TEST

START_TEST(a_trajectory_follows_parabolas_and_turns_at_constant_spin)
{
    /* Up at 5 and down under 10; then up at 2 and a half turn more. */
    instance made =
        map("trajectory", "{\"times\": [0,1,3], \"positions\": [[0,0,1],[2,0,1],[2,0,-15]],"
                          " \"accelerations\": [[0,0,-10],[0,0,-10]],"
                          " \"rotations\": [[1,0,0,0],[0,0,0,1],[-1,0,0,0]],"
                          " \"spins\": [[0,0,3.141592653589793],"
                          "[0,0,1.5707963267948966]], \"center\": [1,0,0]}");
    double lo, hi;
    made.map->time_domain(made.self, &lo, &hi);
    ck_assert(lo == 0 && hi == 3);
    expect_image(&made, (double[4]){2, 0, 0, 0}, (double[3]){1, 0, 1}, 1e-14);
    expect_image(&made, (double[4]){2, 0, 0, 0.5}, (double[3]){1, 1, 2.25}, 1e-14);
    expect_image(&made, (double[4]){2, 0, 0, 1}, (double[3]){1, 0, 1}, 1e-14);
    expect_image(&made, (double[4]){2, 0, 0, 2}, (double[3]){2, -1, -2}, 1e-14);
    expect_image(&made, (double[4]){2, 0, 0, 3}, (double[3]){3, 0, -15}, 1e-14);
    const double after[4] = {0, 0, 0, 3.0000000000000004};
    double x[3];
    ck_assert_int_eq(made.map->eval(made.self, 1, after, x, NULL), IMP_STATUS_DOMAIN);
    instance_free(&made);
}
END_TEST

SUITE_MAIN("maps", a_trajectory_follows_parabolas_and_turns_at_constant_spin,
           translations_at_constant_velocity_are_exact_but_for_rounding,
           translations_too_far_for_a_double_are_undefined,
           tables_pass_through_their_rows_and_go_straight_between_them,
           tables_hold_or_are_undefined_beyond_their_ends,
           models_of_linear_tables_are_exact_between_kinks_and_tight_across,
           a_turn_of_the_screw_advances_by_its_pitch, a_crank_by_formula_turns_and_moves_its_piston,
           a_motion_is_unbounded_where_its_formulas_are,
           turned_points_are_within_their_errors_beside_long_doubles,
           points_turned_out_of_range_are_undefined,
           scaling_grows_collapses_and_mirrors_about_its_centre, a_wave_travels_at_its_speed,
           a_taper_is_linear_within_its_range_and_constant_beyond,
           a_twist_turns_each_height_by_its_own_angle,
           a_rod_bends_into_an_arc_and_is_straight_beyond,
           a_rod_straightens_through_no_curvature_at_all, a_lattice_in_place_deforms_nothing,
           a_lattice_moves_space_outside_along_with_its_faces,
           remainders_are_not_much_wider_than_what_they_bound)
