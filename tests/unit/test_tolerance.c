/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/common/random.h"
#include "tests/support/query_helpers.h"
#include "tests/support/suite.h"

/* The map `tolerance`: its parts hold every rigid displacement within its offset and angle. */

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

static imp_scene *scene_of(const char *text)
{
    imp_error error;
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "s.json", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

typedef struct tolerance {
    double offset, angle, center[3];
} tolerance;

static tolerance random_tolerance(uint64_t *r)
{
    return (tolerance){
        random_power(r, -8, 1),
        random_between(r, 0, 1.5),
        {random_between(r, -2, 2), random_between(r, -2, 2), random_between(r, -2, 2)}};
}

/* A point under a tolerance, and a wall at x = 20. */
static imp_scene *point_within(const tolerance *of, const double at[3])
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"bodies\":[{\"surfaces\":[{\"type\":\"point\",\"position\":[%.17g,%.17g,%.17g]}],"
             "\"maps\":[{\"type\":\"tolerance\",\"offset\":%.17g,\"angle\":%.17g,"
             "\"center\":[%.17g,%.17g,%.17g]}]},{\"surfaces\":[{\"type\":\"plane\","
             "\"origin\":[20,-90,-90],\"edge_u\":[0,180,0],\"edge_v\":[0,0,180]}]}]}",
             at[0], at[1], at[2], of->offset, of->angle, of->center[0], of->center[1],
             of->center[2]);
    return scene_of(text);
}

/* A rotation by an angle of at most `of`, often by all of it. */
static void random_rotation(uint64_t *r, const tolerance *of, double m[3][3])
{
    double n[3], length = 0;
    const double part = random_between(r, 0, 2), a = of->angle * (part < 1 ? part : 1);
    for (int i = 0; i < 3; ++i) n[i] = random_between(r, -1, 1) + 1e-9, length += n[i] * n[i];
    for (int i = 0; i < 3; ++i) n[i] /= sqrt(length);
    const double c = cos(a), s = sin(a),
                 turn[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m[i][j] = (i == j ? c : 0) + s * turn[i][j] + (1 - c) * n[i] * n[j];
}

static void random_offset(uint64_t *r, const tolerance *of, double d[3])
{
    double length = 0;
    for (int i = 0; i < 3; ++i) d[i] = random_between(r, -1, 1) + 1e-9, length += d[i] * d[i];
    const double part = random_between(r, 0, 2), far = of->offset * (part < 1 ? part : 1);
    for (int i = 0; i < 3; ++i) d[i] *= far / sqrt(length);
}

/* Rounding of an angle at the end of its range is no miss. */
static double clipped(double x, double most)
{
    ck_assert_double_le(fabs(x), most * (1 + 1e-12) + 1e-15);
    return x > most ? most : x < -most ? -most : x;
}

static void displace(const tolerance *of, double m[3][3], const double d[3], const double at[3],
                     double to[3])
{
    for (int i = 0; i < 3; ++i) {
        to[i] = of->center[i] + d[i];
        for (int j = 0; j < 3; ++j) to[i] += m[i][j] * (at[j] - of->center[j]);
    }
}

START_TEST(some_values_are_each_rigid_displacement)
{
    uint64_t r = suite_seed();
    const int draws = suite_times(400);
    for (int k = 0; k < draws; ++k) {
        const tolerance of = random_tolerance(&r);
        const double at[3] = {random_between(&r, -3, 3), random_between(&r, -3, 3), 1};
        double m[3][3], d[3], wanted[3], found[3], place[3] = {0, 0, 0};
        imp_error error;
        random_rotation(&r, &of, m);
        random_offset(&r, &of, d);
        displace(&of, m, d, at, wanted);
        imp_scene *scene = point_within(&of, at);
        const double values[6] = {clipped(atan2(m[2][1], m[2][2]), of.angle),
                                  clipped(-asin(m[2][0]), of.angle),
                                  clipped(atan2(m[1][0], m[0][0]), of.angle),
                                  clipped(d[0], of.offset),
                                  clipped(d[1], of.offset),
                                  clipped(d[2], of.offset)};
        imp_scene *one = imp_scene_at(scene, values, &error);
        ck_assert_msg(one != NULL, "%s", error.text);
        ck_assert_int_eq(imp_scene_eval(one, 0, 0, 1, place, found, NULL, &error), IMP_SUCCESS);
        for (int i = 0; i < 3; ++i) ck_assert_double_eq_tol(found[i], wanted[i], 1e-12);
        imp_scene_free(one);
        imp_scene_free(scene);
    }
}
END_TEST

/* Searches displacements for one that brings the point nearer to the wall than what is proved. */
START_TEST(no_displacement_is_nearer_than_what_is_proved)
{
    uint64_t r = suite_seed();
    const int draws = suite_times(40);
    for (int k = 0; k < draws; ++k) {
        tolerance of = random_tolerance(&r);
        of.angle *= 0.1;
        const double at[3] = {random_between(&r, -3, 3), random_between(&r, -3, 3), 1};
        imp_scene *scene = point_within(&of, at);
        imp_clearance found = {.struct_size = sizeof found};
        imp_clearance_options asked = imp_clearance_options_default();
        imp_options options = imp_options_default(scene);
        imp_error error;
        double nearest = INFINITY;
        asked.tolerance = 0.05;
        options.max_pairs = 100000;
        imp_survey *s = imp_survey_new(scene, &options, &asked, NULL, &error);
        ck_assert_msg(s != NULL, "%s", error.text);
        ck_assert_int_eq(imp_survey_step(s, 0, &error), IMP_SUCCESS);
        ck_assert_int_eq(imp_survey_get_clearance(s, &found, &error), IMP_SUCCESS);
        for (int n = 0; n < 2000; ++n) {
            double m[3][3], d[3], to[3];
            random_rotation(&r, &of, m);
            random_offset(&r, &of, d);
            displace(&of, m, d, at, to);
            if (20 - to[0] < nearest) nearest = 20 - to[0];
        }
        ck_assert_double_gt(found.lower, 0.5 * nearest); /* it says something */
        ck_assert_double_le(found.lower, nearest + 1e-12);
        imp_survey_free(s);
        imp_scene_free(scene);
    }
}
END_TEST

START_TEST(its_parameters_have_its_name)
{
    const tolerance of = {0.5, 0.125, {1, 2, 3}};
    imp_scene *scene = point_within(&of, of.center);
    imp_scene_parameter_info info;
    char name[20];
    ck_assert_uint_eq(imp_scene_parameter_count(scene), 6);
    for (size_t k = 0; k < 6; ++k) {
        snprintf(name, sizeof name, "tolerance#%zu", k + 1);
        ck_assert(imp_scene_parameter(scene, k, &info));
        ck_assert_str_eq(info.name, name);
        ck_assert_double_eq(info.hi, k < 3 ? of.angle : of.offset);
        ck_assert_double_eq(info.lo, -info.hi);
        ck_assert(info.is_followed && imp_scene_follows(scene, 0, k));
    }
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_builder_puts_its_parts_in_its_place_too)
{
    imp_error error;
    size_t body;
    const imp_argument given = imp_argument_number("angle", 0.25);
    imp_builder *b = imp_builder_new(registry);
    ck_assert_int_eq(imp_builder_body(b, "part", &body, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_builder_surface(b, body, "sphere", NULL, 0, &error), IMP_SUCCESS);
    ck_assert_msg(imp_builder_map(b, body, "tolerance", &given, 1, &error) == IMP_SUCCESS, "%s",
                  error.text);
    imp_scene *scene = imp_builder_finish(b, &error);
    imp_builder_free(b);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_scene_parameter_info info;
    ck_assert_uint_eq(imp_scene_parameter_count(scene), 3); /* none of the offset, which is 0 */
    ck_assert(imp_scene_parameter(scene, 2, &info));
    ck_assert_double_eq(info.lo, -0.25);
    imp_scene_free(scene);
}
END_TEST

/* Values that leave out what is 0, and how many parameters are left. */
static const struct left {
    double offset, angle;
    size_t parameters;
} left[] = {{0, 0, 0}, {0.25, 0, 3}, {0, 0.25, 3}, {0.25, 0.25, 6}};

START_TEST(what_is_0_takes_no_parameters)
{
    const tolerance of = {left[_i].angle, left[_i].offset, {1, 2, 3}};
    const size_t count = left[_i].parameters;
    imp_scene *scene = point_within(&of, of.center);
    imp_scene_parameter_info info;
    ck_assert_uint_eq(imp_scene_parameter_count(scene), count);
    for (size_t k = 0; k < count; ++k) {
        ck_assert(imp_scene_parameter(scene, k, &info));
        ck_assert_double_eq(info.hi, 0.25);
    }
    imp_scene_free(scene);
}
END_TEST

static const struct wrong {
    const char *map, *words;
} wrong[] = {
    {"\"offset\":1,\"clock\":\"p\"", "'tolerance' has clocks of its own; leave it out"},
    {"\"offset\":1,\"clock\":[0,1]", "/bodies/0/maps/0/clock"},
    {"\"offset\":-1", "/bodies/0/maps/0/offset"},
    {"\"angle\":2", "/bodies/0/maps/0/angle"},
    {"\"anglee\":1", "did you mean 'angle'"},
};

START_TEST(what_is_wrong_with_it_is_refused)
{
    char text[300];
    imp_error error;
    snprintf(text, sizeof text,
             "{\"parameters\":{\"p\":[0,1]},\"bodies\":[{\"surfaces\":[{\"type\":\"sphere\"}],"
             "\"maps\":[{\"type\":\"tolerance\",%s}]}]}",
             wrong[_i].map);
    ck_assert_ptr_null(imp_scene_from_json(registry, text, strlen(text), "s.json", &error));
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_msg(strstr(error.text, wrong[_i].words) != NULL, "%s", error.text);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {{some_values_are_each_rigid_displacement, 1},
                                {no_displacement_is_nearer_than_what_is_proved, 1},
                                {its_parameters_have_its_name, 1},
                                {a_builder_puts_its_parts_in_its_place_too, 1},
                                {what_is_0_takes_no_parameters, sizeof left / sizeof *left},
                                {what_is_wrong_with_it_is_refused, sizeof wrong / sizeof *wrong}};
    return suite_main_loops("tolerance", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
