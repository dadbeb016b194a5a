/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <math.h>

#include "plugins/patch/round_profile.h"
#include "tests/support/suite.h"

/* Distances of surfaces of revolution whose profile is a line or an arc, or is not by little:
 * against dense samples of the profile, for points of space on it and near it. */

enum { PROFILES = 600, PLACES = 40, STEPS = 4000, POINTS = 6 };

typedef struct curve {
    double points[2 * POINTS], weights[POINTS];
    size_t count;
} curve;

static void curve_at(const curve *c, double s, double at[2])
{
    double x[POINTS], y[POINTS], w[POINTS];
    for (size_t k = 0; k < c->count; ++k) {
        w[k] = c->weights[k];
        x[k] = w[k] * c->points[2 * k];
        y[k] = w[k] * c->points[2 * k + 1];
    }
    for (size_t n = c->count - 1; n > 0; --n)
        for (size_t k = 0; k < n; ++k) {
            x[k] = (1 - s) * x[k] + s * x[k + 1];
            y[k] = (1 - s) * y[k] + s * y[k + 1];
            w[k] = (1 - s) * w[k] + s * w[k + 1];
        }
    at[0] = x[0] / w[0];
    at[1] = y[0] / w[0];
}

/* Writes the curve with one more control point. */
static void elevate(curve *c)
{
    const size_t n = c->count;
    for (size_t k = n; k-- > 0;) {
        const double a = (double)(k + 1) / (double)n;
        if (k + 1 == n) {
            c->weights[n] = c->weights[k];
            c->points[2 * n] = c->points[2 * k];
            c->points[2 * n + 1] = c->points[2 * k + 1];
            continue;
        }
        const double w = a * c->weights[k] + (1 - a) * c->weights[k + 1];
        for (size_t i = 0; i < 2; ++i)
            c->points[2 * (k + 1) + i] =
                (a * c->weights[k] * c->points[2 * k + i] +
                 (1 - a) * c->weights[k + 1] * c->points[2 * (k + 1) + i]) /
                w;
        c->weights[k + 1] = w;
    }
    c->count = n + 1;
}

static curve draw_line(uint64_t *random)
{
    curve c = {.weights = {1, random_power(random, -2, 2)}, .count = 2};
    for (size_t i = 0; i < 4; ++i) c.points[i] = random_between(random, i % 2 == 0 ? 0 : -2, 2);
    const double kind = random_between(random, 0, 3);
    if (kind < 1) c.points[2] = c.points[0];
    if (kind > 2) c.points[3] = c.points[1];
    return c;
}

/* An arc of some circle, half of them about a point of the axis. */
static curve draw_arc(uint64_t *random)
{
    const double half = random_between(random, 0.1, 1.4),
                 middle = random_between(random, -3.1, 3.1);
    const double radius = random_between(random, 0.3, 2);
    const double ring = random_between(random, -1, 1) < 0 ? 0 : random_between(random, -1, 3);
    const double z = random_between(random, -1, 1), out = radius / cos(half);
    const curve c = {{ring + radius * cos(middle - half), z + radius * sin(middle - half),
                      ring + out * cos(middle), z + out * sin(middle),
                      ring + radius * cos(middle + half), z + radius * sin(middle + half)},
                     {1, cos(half), 1},
                     3};
    return c;
}

static curve draw_curve(uint64_t *random)
{
    curve c = random_between(random, -1, 1) < 0 ? draw_line(random) : draw_arc(random);
    const double side = random_between(random, -1, 1) < 0 ? -1 : 1;
    for (double more = random_between(random, 0, 4); more > 1; --more) elevate(&c);
    const double off = random_between(random, 0, 1) < 0.3 ? 0 : random_power(random, -50, -9);
    for (size_t i = 0; i < 2 * c.count; ++i) {
        if (i % 2 == 0) c.points[i] *= side;
        c.points[i] += off * random_between(random, -1, 1);
    }
    return c;
}

typedef struct judgement {
    size_t asked, sharp; /* points; those of which nearly all of the distance is claimed */
    double beyond;       /* what is claimed most beyond what is true; length */
} judgement;

/* A point of space that is `off` from the profile's point, and as far as it is from all of it. */
static void judge_place(const curve *c, const round_profile *p, uint64_t *random, judgement *all)
{
    double on[2], least = INFINITY;
    curve_at(c, random_between(random, 0, 1), on);
    const double off = random_power(random, -40, 1), way = random_between(random, 0, 6.28);
    const double turn = random_between(random, 0, 6.28), q = fabs(on[0] + off * cos(way));
    const double z = on[1] + off * sin(way);
    const imp_model m[3] = {imp_num(q * cos(turn)), imp_num(q * sin(turn)), imp_num(z)};
    const imp_model g = round_profile_distance(p, m);
    const double claimed = g.lo > 0 ? g.lo : g.hi < 0 ? -g.hi : 0;
    for (int k = 0; k <= STEPS; ++k) {
        double at[2];
        curve_at(c, (double)k / STEPS, at);
        const double apart = hypot(q - fabs(at[0]), z - at[1]);
        if (apart < least) least = apart;
    }
    if (off < least) least = off;
    all->asked += 1;
    all->sharp += claimed > 0.9 * least;
    if (claimed - least > all->beyond) all->beyond = claimed - least;
}

static int drawn(void) { return suite_times_from(PROFILES, PROFILES / 3); }

/* `kept`: the part of `off` that is subtracted. */
static judgement judge_curves(double kept, size_t kinds[ROUND_CIRCLE + 1])
{
    judgement all = {0};
    uint64_t random = suite_seed();
    for (int k = 0; k < drawn(); ++k) {
        const curve c = draw_curve(&random);
        round_profile p = round_profile_of(c.points, c.weights, c.count);
        kinds[p.kind] += 1;
        p.off *= kept;
        for (int j = 0; j < PLACES && p.kind != ROUND_NONE; ++j) judge_place(&c, &p, &random, &all);
    }
    return all;
}

#define ROUNDING 1e-13 /* of the sampled points, and of the points asked about */

START_TEST(no_distance_is_greater_than_that_of_sampled_points)
{
    size_t kinds[ROUND_CIRCLE + 1] = {0};
    const judgement all = judge_curves(1, kinds);
    for (int k = ROUND_CYLINDER; k <= ROUND_CIRCLE; ++k)
        ck_assert_int_gt(40 * (int)kinds[k], drawn());
    ck_assert_msg(all.beyond <= ROUNDING, "%g beyond the distance", all.beyond);
    ck_assert_uint_gt(4 * all.sharp, all.asked);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(what_the_profile_is_off_has_to_be_subtracted)
{
    size_t kinds[ROUND_CIRCLE + 1] = {0};
    ck_assert_double_gt(judge_curves(0.25, kinds).beyond, ROUNDING);
}
END_TEST

START_TEST(profiles_that_are_neither_lines_nor_arcs_have_no_distance)
{
    static const double vase[8] = {0.6, -1, 1.5, -0.4, 0, 0.4, 0.6, 1};
    static const double crossing[4] = {-0.5, 0, 1, 1}, axis[4] = {0, 0, 0, 1};
    static const double beyond[6] = {-1, 0, -1, 2, 3, 2}, weights[3] = {1, 1, 2};
    const imp_model m[3] = {imp_num(5), imp_num(0), imp_num(0)};
    const round_profile p[] = {round_profile_of(vase, NULL, 4), round_profile_of(crossing, NULL, 2),
                               round_profile_of(axis, NULL, 2),
                               round_profile_of(beyond, weights, 3)};
    for (size_t k = 0; k < sizeof p / sizeof *p; ++k) {
        ck_assert_int_eq(p[k].kind, ROUND_NONE);
        ck_assert(!(round_profile_distance(&p[k], m).e < INFINITY));
    }
}
END_TEST

SUITE_MAIN("round profiles", no_distance_is_greater_than_that_of_sampled_points,
           what_the_profile_is_off_has_to_be_subtracted,
           profiles_that_are_neither_lines_nor_arcs_have_no_distance)
