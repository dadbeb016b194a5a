/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/formula.h>
#include <string.h>
#include <time.h>

#include "core/surface/region.h"
#include "tests/support/map_images.h"

/* Keyframes: what they promise, beside being what their equation says (test_plugins.c). */

START_TEST(keyframes_pass_through_their_keys)
{
    instance made =
        map("keyframes", "{\"times\": [0,1,3], \"positions\": [[0,0,0],[1,2,3],[1,0,1]],"
                         " \"rotations\": [[1,0,0,0],[0.6,0,0,0.8],[0,0,0,-1]]}");
    expect_image(&made, (double[4]){1, 0, 0, 0}, (double[3]){1, 0, 0}, 1e-15);
    expect_image(&made, (double[4]){1, 0, 0, 1}, (double[3]){1 - 0.28, 2.96, 3}, 1e-14);
    expect_image(&made, (double[4]){1, 0, 0, 3}, (double[3]){0, 0, 1}, 1e-13);
    instance_free(&made);
}
END_TEST

START_TEST(keyframes_reproduce_free_fall)
{
    instance made = map("keyframes", "{\"times\": [0,0.5,1,1.5,2], \"positions\": [[0,0,0],"
                                     "[0.5,0,-1.25],[1,0,-5],[1.5,0,-11.25],[2,0,-20]]}");
    for (double t = 0; t <= 2; t += 0.03125)
        expect_image(&made, (double[4]){1, 2, 3, t}, (double[3]){1 + t, 2, 3 - 5 * t * t}, 1e-13);
    instance_free(&made);
}
END_TEST

static const char long_turn[] =
    "{\"times\": [0,0.5,1.25,2,2.25], \"positions\": [[0,0,0],[1,0,0],[1,1,0],[1,1,1],[0,0,0]],"
    " \"rotations\": "
    "[[1,0,0,0],[-0.8,0,0.6,0],[0.48,0.36,-0.8,0],[0.36,0.48,-0.8,0],[0,0.6,-0.8,0]]}";

START_TEST(velocities_are_continuous_across_keys)
{
    const double keys[] = {0.5, 1.25, 2}, h = 1e-5;
    instance made = map("keyframes", long_turn);
    for (int k = 0; k < 3; ++k) {
        double before[3], at[3], after[3];
        image(&made, 1, 2, 3, keys[k] - h, before);
        image(&made, 1, 2, 3, keys[k], at);
        image(&made, 1, 2, 3, keys[k] + h, after);
        for (int i = 0; i < 3; ++i)
            ck_assert_double_le(fabs(after[i] - 2 * at[i] + before[i]), 1e3 * h * h);
    }
    instance_free(&made);
}
END_TEST

START_TEST(keyframes_turn_rigidly)
{
    instance made = map("keyframes", long_turn);
    uint64_t random = suite_seed();
    for (int k = 0; k < 200; ++k) {
        double t = random_between(&random, 0, 2.25), o[3], x[3], y[3];
        image(&made, 0, 0, 0, t, o);
        image(&made, 3, 0, 4, t, x);
        image(&made, 0, 2, 0, t, y);
        double length = 0, dot = 0;
        for (int i = 0; i < 3; ++i) {
            length += (x[i] - o[i]) * (x[i] - o[i]);
            dot += (x[i] - o[i]) * (y[i] - o[i]);
        }
        ck_assert_double_le(fabs(length - 25) + fabs(dot), 1e-12);
    }
    instance_free(&made);
}
END_TEST

START_TEST(keyframes_are_defined_from_the_first_key_to_the_last)
{
    instance made = map("keyframes", long_turn);
    const double before[4] = {0, 0, 0, -1e-300}, after[4] = {0, 0, 0, 2.2500000000000004};
    double lo, hi, x[3];
    made.map->time_domain(made.self, &lo, &hi);
    ck_assert(lo == 0 && hi == 2.25);
    ck_assert_int_eq(made.map->eval(made.self, 1, before, x, NULL), IMP_STATUS_DOMAIN);
    ck_assert_int_eq(made.map->eval(made.self, 1, after, x, NULL), IMP_STATUS_DOMAIN);
    instance_free(&made);
}
END_TEST

static const char held_turn[] =
    "{\"times\": [0,1,3], \"positions\": [[0,0,0],[1,2,3],[1,0,1]], \"hold\": true,"
    " \"rotations\": [[1,0,0,0],[0.6,0,0,0.8],[0,0,0,-1]]}";

START_TEST(keyframes_that_hold_stay_at_their_ends)
{
    const double early[] = {-1e300, -7, -5e-324, 0}, late[] = {3, 3.0000000000000004, 9, 1e300};
    instance made = map("keyframes", held_turn);
    double lo, hi, first[3], last[3];
    made.map->time_domain(made.self, &lo, &hi);
    ck_assert(lo == -INFINITY && hi == INFINITY);
    image(&made, 1, 2, 4, 0, first);
    image(&made, 1, 2, 4, 3, last);
    for (int k = 0; k < 4; ++k) {
        expect_image(&made, (double[4]){1, 2, 4, early[k]}, first, 0);
        expect_image(&made, (double[4]){1, 2, 4, late[k]}, last, 0);
    }
    instance_free(&made);
}
END_TEST

START_TEST(keyframes_that_hold_are_at_rest_outside)
{
    const imp_box4 before = {{-1, -1, -1, -9}, {1, 1, 1, -1}}, after = {{0, 0, 0, 3}, {1, 1, 1, 4}};
    instance made = map("keyframes", held_turn);
    imp_map_rates rates;
    ck_assert_int_eq(made.map->rate(made.self, &before, &rates), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) ck_assert_double_eq(rates.m[i][3], 0);
    ck_assert_int_eq(made.map->rate(made.self, &after, &rates), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) ck_assert_double_eq(rates.m[i][3], 0);
    instance_free(&made);
}
END_TEST

/* Models of a point that keyframes move, over the times lo to hi. */
static void moved_point(const instance *made, double lo, double hi, imp_model out[3])
{
    const double from[3] = {0, 0, lo}, to[3] = {1, 1, hi};
    const imp_region region = region_make(from, to);
    const imp_model in[4] = {imp_num(1), imp_num(-2), imp_num(0.5), imp_param(&region, 2)};
    ck_assert_int_eq(made->map->apply(made->self, in, out), IMP_STATUS_OK);
}

START_TEST(remainders_shrink_by_the_square_across_a_key_and_by_the_cube_elsewhere)
{
    instance made = map("keyframes", long_turn);
    for (double width = 0x1p-4; width > 0x1p-12; width /= 2) {
        imp_model whole[3], half[3];
        moved_point(&made, 1.25 - width, 1.25 + width, whole);
        moved_point(&made, 1.25 - width / 2, 1.25 + width / 2, half);
        for (int i = 0; i < 3; ++i) ck_assert_double_lt(half[i].e, whole[i].e / 3);
        moved_point(&made, 1.75 - width, 1.75 + width, whole);
        moved_point(&made, 1.75 - width / 2, 1.75 + width / 2, half);
        for (int i = 0; i < 3; ++i) ck_assert_double_lt(half[i].e, whole[i].e / 6 + 1e-14);
    }
    instance_free(&made);
}
END_TEST

/* A walk of `keys` keys, each turned from the one before by up to `turn` radians; at times 0, 1, 2
 * ..., or at uneven ones. */
static char *random_walk(int keys, double turn, bool uneven, uint64_t seed)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fprintf(out, "{\"times\": [");
    double t = 0;
    for (int i = 0; i < keys; ++i) {
        fprintf(out, "%s%.17g", i ? "," : "", t);
        t += uneven ? random_power(&seed, -10, 10) : 1;
    }
    fprintf(out, "], \"positions\": [");
    for (int i = 0; i < keys; ++i)
        fprintf(out, "%s[%d,%.17g,0]", i ? "," : "", i, random_between(&seed, -1, 1));
    fprintf(out, "], \"rotations\": [");
    double q[4] = {1, 0, 0, 0};
    for (int i = 0; i < keys; ++i) {
        double v[3], length = 0, angle = random_between(&seed, 0.9, 1) * turn / 2, next[4];
        for (int j = 0; j < 3; ++j) v[j] = random_between(&seed, -1, 1), length += v[j] * v[j];
        for (int j = 0; j < 3; ++j) v[j] *= sin(angle) / sqrt(length);
        fprintf(out, "%s[%.17g,%.17g,%.17g,%.17g]", i ? "," : "", q[0], q[1], q[2], q[3]);
        next[0] = q[0] * cos(angle) - q[1] * v[0] - q[2] * v[1] - q[3] * v[2];
        next[1] = q[0] * v[0] + q[1] * cos(angle) + q[2] * v[2] - q[3] * v[1];
        next[2] = q[0] * v[1] + q[2] * cos(angle) + q[3] * v[0] - q[1] * v[2];
        next[3] = q[0] * v[2] + q[3] * cos(angle) + q[1] * v[1] - q[2] * v[0];
        memcpy(q, next, sizeof q);
    }
    fprintf(out, "]}");
    fclose(out);
    return text;
}

START_TEST(keys_may_turn_by_170_degrees_at_any_times)
{
    for (uint64_t seed = 0; seed < (uint64_t)suite_times(20); ++seed) {
        char *text = random_walk(50, 170 * 3.141592653589793 / 180, seed % 2, suite_seed() + seed);
        instance made = map("keyframes", text);
        instance_free(&made);
        free(text);
    }
}
END_TEST

/* Processor time of a call over the times lo to hi, in seconds: the least of some. */
static double cost(const instance *made, double lo, double hi)
{
    enum { CALLS = 50 };
    imp_model out[3];
    double least = INFINITY;
    for (int k = 0; k < 20; ++k) {
        clock_t start = clock();
        for (int n = 0; n < CALLS; ++n) moved_point(made, lo, hi, out);
        least = fmin(least, (double)(clock() - start) / CLOCKS_PER_SEC / CALLS);
    }
    return least;
}

START_TEST(a_thousand_keys_cost_no_more_than_a_few)
{
    char *few = random_walk(4, 1, false, 1), *many = random_walk(1000, 1, false, 1);
    instance small = map("keyframes", few), great = map("keyframes", many);
    double usual = cost(&small, 0.1, 2.9);
    ck_assert_double_lt(cost(&great, 500.1, 502.9), 3 * usual);
    ck_assert_double_lt(cost(&great, 0.1, 998.9), 3 * usual);
    instance_free(&small);
    instance_free(&great);
    free(few);
    free(many);
}
END_TEST

/* Spans of all sizes of a long track: what points say lies in what models say. */
START_TEST(spans_of_many_keys_hold_their_points)
{
    char *text = random_walk(300, 2, false, 5);
    instance made = map("keyframes", text);
    uint64_t random = suite_seed();
    for (int k = 0; k < suite_times(300); ++k) {
        double lo = random_between(&random, 0, 299), hi = lo + random_power(&random, -3, 8);
        imp_model out[3];
        if (hi > 299) hi = 299;
        moved_point(&made, lo, hi, out);
        double t = random_between(&random, lo, hi), x[3], s = (2 * t - lo - hi) / (hi - lo);
        image(&made, 1, -2, 0.5, t, x);
        for (int i = 0; i < 3; ++i) {
            double quadratic = out[i].a + (out[i].b[2] + out[i].q[IMP_TT] * s) * s;
            ck_assert_double_le(fabs(x[i] - quadratic), out[i].e + 1e-11);
            ck_assert(out[i].lo - 1e-11 <= x[i] && x[i] <= out[i].hi + 1e-11);
        }
    }
    instance_free(&made);
    free(text);
}
END_TEST

SUITE_MAIN("keyframes", keyframes_pass_through_their_keys, keyframes_reproduce_free_fall,
           velocities_are_continuous_across_keys, keyframes_turn_rigidly,
           keyframes_are_defined_from_the_first_key_to_the_last,
           keyframes_that_hold_stay_at_their_ends, keyframes_that_hold_are_at_rest_outside,
           remainders_shrink_by_the_square_across_a_key_and_by_the_cube_elsewhere,
           keys_may_turn_by_170_degrees_at_any_times, a_thousand_keys_cost_no_more_than_a_few,
           spans_of_many_keys_hold_their_points)
