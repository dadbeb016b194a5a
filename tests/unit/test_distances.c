/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <string.h>

#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"
#include "tests/support/nearest.h"
#include "tests/support/sampling.h"
#include "tests/support/suite.h"

/* Distances of the built types from random moving points against the exact ones in numbers of 200
 * bits: from whole cylinders, cones, planes, circles and threads, which are no nearer than their
 * parts. */

enum { REGIONS = 400, POINTS = 6, PATIENCE = 20 };

typedef struct row {
    const char *type, *parameters;
    number (*exact)(const type_arguments *arguments, const number x[3]);
} row;

static number from(const type_arguments *arguments, const char *name, const number x[3], size_t i)
{
    return num_sub(x[i], argument_at(arguments, name, i));
}

static number across(const type_arguments *a, const number x[3])
{
    return num_hypot(from(a, "center", x, 0), from(a, "center", x, 1));
}

static number sphere(const type_arguments *a, const number x[3])
{
    const number to_center = num_hypot(across(a, x), from(a, "center", x, 2));
    return num_abs(num_sub(to_center, argument_at(a, "radius", 0)));
}

static number cylinder(const type_arguments *a, const number x[3])
{
    return num_abs(num_sub(across(a, x), argument_at(a, "radius", 0)));
}

static number torus(const type_arguments *a, const number x[3])
{
    const number q = num_sub(across(a, x), argument_at(a, "major_radius", 0));
    const number to_middle = num_hypot(q, from(a, "center", x, 2));
    return num_abs(num_sub(to_middle, argument_at(a, "minor_radius", 0)));
}

/* From the half line from (0, h) through (r, 0). */
static number cone(const type_arguments *a, const number x[3])
{
    const number h = argument_at(a, "height", 0), r = argument_at(a, "radius", 0);
    const number q = across(a, x), y = num_sub(h, from(a, "center", x, 2));
    const number along = num_add(num_mul(r, q), num_mul(h, y));
    if (num_near(h) != 0 && num_is_less(along, num(0))) return num_hypot(q, y);
    const number up = num_mul(r, num_sub(from(a, "center", x, 2), h));
    return num_div(num_abs(num_add(num_mul(h, across(a, x)), up)), num_hypot(h, r));
}

static number plane(const type_arguments *a, const number x[3])
{
    number n[3], sum = num(0), square = num(0);
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = num_sub(num_mul(argument_at(a, "edge_u", j), argument_at(a, "edge_v", k)),
                       num_mul(argument_at(a, "edge_u", k), argument_at(a, "edge_v", j)));
        sum = num_add(sum, num_mul(n[i], from(a, "origin", x, i)));
        square = num_add(square, num_sqr(n[i]));
    }
    return num_div(num_abs(sum), num_sqrt(square));
}

static number disc(const type_arguments *a, const number x[3])
{
    number sum = num(0), square = num(0);
    for (size_t i = 0; i < 3; ++i) {
        const number k = argument_at(a, "axis", i);
        sum = num_add(sum, num_mul(k, from(a, "center", x, i)));
        square = num_add(square, num_sqr(k));
    }
    return num_div(num_abs(sum), num_sqrt(square));
}

/* From the endless cylinder of its first piece. */
static number capsule(const type_arguments *a, const number x[3])
{
    number d[3], m[3], square = num(0), length = num(0);
    for (size_t i = 0; i < 3; ++i) {
        d[i] = num_sub(argument_at(a, "to", i), argument_at(a, "from", i));
        m[i] = from(a, "from", x, i);
    }
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const number c = num_sub(num_mul(d[j], m[k]), num_mul(d[k], m[j]));
        square = num_add(square, num_sqr(c));
        length = num_add(length, num_sqr(d[i]));
    }
    return num_abs(num_sub(num_sqrt(num_div(square, length)), argument_at(a, "radius", 0)));
}

/* From the plane of its first piece. */
static number box(const type_arguments *a, const number x[3])
{
    const double size = argument(a, "size")->number[0], center = argument(a, "center")->number[0];
    return num_abs(num_sub(x[0], num(center - size / 2)));
}

/* A control point [r, z] of the profile that turns. */
static number profile(const type_arguments *a, size_t point, size_t coordinate)
{
    const number x = argument_at(a, "profile", 2 * point + coordinate);
    return coordinate == 0 ? num_abs(x) : x;
}

/* From the line through the first point and the second, from the axis on. */
static number turned_line(const type_arguments *a, const number x[3])
{
    const number out = num_sub(profile(a, 1, 0), profile(a, 0, 0)),
                 up = num_sub(profile(a, 1, 1), profile(a, 0, 1));
    const number q = num_sub(across(a, x), profile(a, 0, 0)),
                 z = num_sub(from(a, "center", x, 2), profile(a, 0, 1));
    if (num_near(out) != 0) {
        const number above = num_add(z, num_div(num_mul(profile(a, 0, 0), up), out));
        const number along = num_add(num_mul(out, across(a, x)), num_mul(up, above));
        const bool is_beyond =
            num_near(out) > 0 ? num_is_less(along, num(0)) : num_is_less(num(0), along);
        if (is_beyond) return num_hypot(across(a, x), above);
    }
    const number apart = num_sub(num_mul(q, up), num_mul(z, out));
    return num_div(num_abs(apart), num_hypot(out, up));
}

/* From the circle whose quarter goes upward from its outermost point. */
static number turned_circle(const type_arguments *a, const number x[3])
{
    const number q = num_sub(across(a, x), profile(a, 2, 0)),
                 z = num_sub(from(a, "center", x, 2), profile(a, 0, 1));
    const number radius = num_sub(profile(a, 0, 0), profile(a, 2, 0));
    return num_abs(num_sub(num_hypot(q, z), radius));
}

#define TURNED(PROFILE) "{\"profile\": " PROFILE "}"
#define TURNED_AT(PROFILE) "{\"profile\": " PROFILE ", \"center\": [?, ?, ?]}"
#define QUARTER(PROFILE) "{\"profile\": " PROFILE ", \"weights\": [1, 1, 2], \"center\": [?, ?, ?]}"

static const row rows[] = {
    {"revolution", TURNED_AT("[[2, -1], [2, 1]]"), turned_line},
    {"revolution", TURNED_AT("[[2, 0.5], [1, 0.5], [3, 0.5]]"), turned_line},
    {"revolution", TURNED_AT("[[1, 0], [2, 1], [2, 1]]"), turned_line},
    {"revolution", TURNED_AT("[[-4, 0.5], [-0.5, 0.25]]"), turned_line},
    {"revolution", TURNED("[[1, 0], [1.0009765625, 64]]"), turned_line},
    {"revolution", QUARTER("[[1, 0], [1, 1], [0, 1]]"), turned_circle},
    {"revolution", QUARTER("[[3, -1], [3, 0], [2, 0]]"), turned_circle},
    {"revolution", QUARTER("[[-6, 2], [-6, 4], [-4, 4]]"), turned_circle},
    {"sphere", "{\"radius\": +, \"center\": [?, ?, ?]}", sphere},
    {"sphere", "{\"radius\": 1}", sphere},
    {"cylinder", "{\"radius\": +, \"height\": +, \"center\": [?, ?, ?]}", cylinder},
    {"cylinder", "{\"radius\": 1}", cylinder},
    {"torus", "{\"major_radius\": 5, \"minor_radius\": +, \"center\": [?, ?, ?]}", torus},
    {"torus", "{\"major_radius\": 1, \"minor_radius\": 1}", torus},
    {"cone", "{\"radius\": +, \"height\": +, \"center\": [?, ?, ?]}", cone},
    {"cone", "{\"radius\": +, \"height\": -2}", cone},
    {"cone", "{\"radius\": 1, \"height\": 1e-3}", cone},
    {"cone", "{\"radius\": +, \"height\": 0, \"center\": [?, ?, ?]}", cone},
    {"thread", "{}", nearest_of_thread},
    {"thread", "{\"radius\": +, \"pitch\": +, \"center\": [?, ?, ?]}", nearest_of_thread},
    {"thread", "{\"radius\": 1.5, \"profile\": [0.2, 0.1, -0.05], \"pitch\": -6, \"starts\": 3}",
     nearest_of_thread},
    {"thread", "{\"radius\": 0.5, \"profile\": 0.49, \"pitch\": 6, \"height\": 8}",
     nearest_of_thread},
    {"ellipsoid", "{}", nearest_of_ellipsoid},
    {"ellipsoid", "{\"radii\": [+, +, +], \"center\": [?, ?, ?]}", nearest_of_ellipsoid},
    {"ellipsoid", "{\"radii\": [1, 1, 3]}", nearest_of_ellipsoid},
    {"plane", "{\"origin\": [?, ?, ?], \"edge_u\": [?, ?, ?], \"edge_v\": [?, ?, ?]}", plane},
    {"disc", "{}", disc},
    {"disc", "{\"radius\": +, \"center\": [?, ?, ?], \"axis\": [?, ?, ?]}", disc},
    {"box", "{\"size\": [+, +, +], \"center\": [?, ?, ?]}", box},
    {"capsule", "{\"radius\": +}", capsule},
    {"capsule", "{\"radius\": +, \"from\": [?, ?, ?], \"to\": [?, ?, ?]}", capsule},
    {"plane", "{\"edge_u\": [1e60, 0, 3e60], \"edge_v\": [0, 1e-60, ?]}", plane},
};
enum { ROWS = sizeof rows / sizeof *rows };

/* Polynomial of g at s. */
static number value_at(const imp_model *g, const number s[3])
{
    number x = num(g->a);
    for (int j = 0; j < 3; ++j) x = num_add(x, num_mul(num(g->b[j]), s[j]));
    for (int j = 0, k = 0; j < 3; ++j)
        for (int l = j; l < 3; ++l, ++k) x = num_add(x, num_mul(num(g->q[k]), num_mul(s[j], s[l])));
    return x;
}

/* Whether both some g with |g| <= exact is left by polynomial and remainder, and by the range. */
static bool holds(const imp_model *g, const number s[3], number exact)
{
    const number off = num_sub(num_abs(value_at(g, s)), num(g->e));
    const number beyond = num(g->lo > 0 ? g->lo : g->hi < 0 ? -g->hi : 0);
    return !num_is_less(exact, off) && !num_is_less(exact, beyond);
}

typedef struct tally {
    size_t judged, refuted;
    double sharpest; /* of what is claimed, the greatest part of what is true */
} tally;

static void try_points(const row *r, const instance *made, const sample_models *models,
                       const imp_model *g, uint64_t *random, tally *t)
{
    for (int k = 0; k < POINTS; ++k) {
        double p[3];
        number x[4], s[3];
        num_forget();
        sample_point(random, 3, models->region.lo, models->region.hi, p);
        sample_value(models, p, x);
        sample_normalized(&models->region, p, s);
        const number exact = r->exact(&made->arguments, x);
        const double claimed = num_near(num_sub(num_abs(value_at(g, s)), num(g->e)));
        t->judged += 1;
        t->refuted += !holds(g, s, exact);
        if (num_near(exact) > 0 && claimed / num_near(exact) > t->sharpest)
            t->sharpest = claimed / num_near(exact);
    }
}

/* In `times` regions, or until one refutes: remainders times `share`, g times `factor`. */
static tally try_row(const imp_registry *registry, const row *r, int times, double share,
                     double factor)
{
    tally t = {0, 0, 0};
    uint64_t random = suite_seed() + (uint64_t)(r - rows);
    instance made = instance_make(registry, r->type, r->parameters, &random);
    for (int k = 0; k < times && t.refuted == 0; ++k) {
        sample_models models = sample_map_arguments(&random, -INFINITY, INFINITY);
        imp_model g;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) models.in[i].rate[j] = INFINITY;
        errno = 0;
        const imp_status status = made.surface->distance(made.self, models.in, &g);
        ck_assert_msg(status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED, "%s: %d", r->type,
                      status);
        ck_assert_int_eq(errno, 0);
        if (status == IMP_STATUS_UNBOUNDED) continue;
        ck_assert(g.e >= 0 && g.lo <= g.hi);
        g.e *= share * factor;
        g.a *= factor;
        for (int j = 0; j < 3; ++j) g.b[j] *= factor;
        for (int j = 0; j < 6; ++j) g.q[j] *= factor;
        try_points(r, &made, &models, &g, &random, &t);
    }
    instance_free(&made);
    return t;
}

START_TEST(no_distance_is_claimed_that_is_greater_than_the_exact_one)
{
    imp_registry *registry = built_registry();
    for (size_t k = 0; k < ROWS; ++k) {
        const tally t = try_row(registry, &rows[k], suite_times_at_least(REGIONS), 1, 1);
        ck_assert_msg(t.judged > REGIONS && t.refuted == 0, "%s %s: %zu of %zu refuted",
                      rows[k].type, rows[k].parameters, t.refuted, t.judged);
        ck_assert_msg(t.sharpest > 0.4, "%s %s claims %g of the distance at most", rows[k].type,
                      rows[k].parameters, t.sharpest);
    }
    imp_registry_free(registry);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(distances_that_are_too_large_are_found)
{
    imp_registry *registry = built_registry();
    for (size_t k = 0; k < ROWS; ++k) {
        const tally large = try_row(registry, &rows[k], PATIENCE * REGIONS, 1, 1.5);
        const tally sure = try_row(registry, &rows[k], PATIENCE * REGIONS, -1, 1);
        ck_assert_msg(large.refuted > 0 && sure.refuted > 0, "%s %s: %zu, %zu refuted",
                      rows[k].type, rows[k].parameters, large.refuted, sure.refuted);
    }
    imp_registry_free(registry);
}
END_TEST

/* --- Points beside surfaces whose distance has no closed form --------------------------------- */

enum { BESIDE = 4000 };

typedef struct shape {
    row about;
    void (*point)(const type_arguments *arguments, double u, double v, double x[3]);
} shape;

#define THREAD(PARAMETERS)                                                                         \
    {                                                                                              \
        {"thread", PARAMETERS, nearest_of_thread}, nearest_thread_point                            \
    }
#define ELLIPSOID(PARAMETERS)                                                                      \
    {                                                                                              \
        {"ellipsoid", PARAMETERS, nearest_of_ellipsoid}, nearest_ellipsoid_point                   \
    }

static const shape shapes[] = {
    THREAD("{}"),
    THREAD("{\"profile\": 0.9, \"pitch\": 100}"),
    THREAD("{\"profile\": [0.3, 0.2, 0.1], \"pitch\": -3, \"starts\": 2}"),
    THREAD("{\"profile\": 0.05, \"pitch\": 2, \"starts\": 12}"),
    THREAD("{\"radius\": 4, \"profile\": [0, 0, 0.4], \"pitch\": 0.8}"),
    ELLIPSOID("{}"),
    ELLIPSOID("{\"radii\": [5, 0.25, 1]}"),
    ELLIPSOID("{\"radii\": [2, 2, 2]}"),
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

/* At any distance from the axis or centre, or near the surface. */
static void draw_beside(uint64_t *random, const shape *s, const type_arguments *a, double x[3])
{
    const double near = random_power(random, -12, 0), v = random_between(random, -1.5, 1.5);
    const double part = random_between(random, 0, 1) < 0.5
                            ? random_between(random, 0, 1.5)
                            : 1 + near * random_between(random, -0.1, 0.1);
    s->point(a, random_between(random, 0, 6.28), v, x);
    x[0] *= part, x[1] *= part;
    if (s->point == nearest_ellipsoid_point) x[2] *= part;
}

/* Whether one of `times` points is claimed to be farther away than it is, g times `factor`. */
static bool is_refuted_beside(const imp_registry *registry, const shape *s, int times,
                              double factor)
{
    uint64_t random = suite_seed();
    instance made = instance_make(registry, s->about.type, s->about.parameters, &random);
    bool refuted = false;
    for (int k = 0; k < times && !refuted; ++k) {
        double x[3];
        imp_model in[4] = {{.a = 0}}, g;
        num_forget();
        draw_beside(&random, s, &made.arguments, x);
        for (int i = 0; i < 3; ++i) in[i] = (imp_model){.a = x[i], .lo = x[i], .hi = x[i]};
        ck_assert_int_eq(made.surface->distance(made.self, in, &g), IMP_STATUS_OK);
        const number at[3] = {num(x[0]), num(x[1]), num(x[2])};
        const double claimed = factor * (g.lo > 0 ? g.lo : g.hi < 0 ? -g.hi : 0);
        refuted = num_is_less(s->about.exact(&made.arguments, at), num(claimed));
    }
    instance_free(&made);
    return refuted;
}

START_TEST(points_beside_threads_and_ellipsoids_are_no_nearer_than_is_claimed)
{
    imp_registry *registry = built_registry();
    for (int k = 0; k < SHAPES; ++k) {
        const bool found = is_refuted_beside(registry, &shapes[k], suite_times(BESIDE), 1);
        const bool raised = is_refuted_beside(registry, &shapes[k], PATIENCE * BESIDE, 1.1);
        ck_assert_msg(!found && raised, "%s %s: %d, and raised %d", shapes[k].about.type,
                      shapes[k].about.parameters, found, raised);
    }
    imp_registry_free(registry);
}
END_TEST

START_TEST(a_torus_that_intersects_itself_has_no_distance)
{
    imp_registry *registry = built_registry();
    const row wide = {"torus", "{\"major_radius\": 1, \"minor_radius\": 1.5}", torus};
    ck_assert_uint_eq(try_row(registry, &wide, suite_times(REGIONS), 1, 1).judged, 0);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("distances", no_distance_is_claimed_that_is_greater_than_the_exact_one,
           distances_that_are_too_large_are_found,
           points_beside_threads_and_ellipsoids_are_no_nearer_than_is_claimed,
           a_torus_that_intersects_itself_has_no_distance)
