/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/random.h"
#include "core/scene/scene.h"
#include "core/surface/surface_internal.h"
#include "tests/support/query_helpers.h"

/* Round surfaces that turn and drift inside and outside of each other, hardly apart along whole
 * areas; at rest somewhere, or carried away together. Their distance at each moment is known: what
 * a query answers is held against it at many. */

enum { SCENES = 18, MOMENTS = 2000, TEXT = 400 };

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }

static void close_registry(void) { imp_registry_free(registry); }

/* The middle of the inner surface moves from `start` by `way` in time 1. */
typedef struct slide {
    char moving[TEXT], fixed[TEXT];
    double start[3], way[3];
    double size[4]; /* of the shapes, as `distance` takes them */
} slide;

typedef struct kind {
    const char *name;
    /* Makes both shapes, c apart at the start where that may be. */
    void (*draw)(uint64_t *random, double c, slide *s);
    double (*distance)(const slide *s, const double at[3]);
} kind;

static double beyond(double x, double least) { return x > least ? x - least : 0; }

/* A path of the length `reach`, or a part of it, in a direction of that many dimensions. */
static void draw_way(uint64_t *random, double reach, int dimensions, double way[3])
{
    double length = 0;
    for (int i = 0; i < dimensions; ++i) {
        way[i] = random_between(random, -1, 1);
        length += way[i] * way[i];
    }
    const double part = reach * random_between(random, 0, 2) / sqrt(length);
    for (int i = 0; i < dimensions; ++i) way[i] *= part;
}

/* One in the other or, half as often, outside of it. */
static double draw_radius(uint64_t *random, double c, slide *s, int axis)
{
    const bool outside = random_bits(random) % 3 == 0;
    const double r = outside ? random_between(random, 0.1, 1) : 1 - c;
    if (outside) s->start[axis] = 1 + r + c;
    return r;
}

/* --- Spheres ---------------------------------------------------------------------------------- */

static void draw_spheres(uint64_t *random, double c, slide *s)
{
    s->size[0] = draw_radius(random, c, s, 2);
    draw_way(random, c, 3, s->way);
    snprintf(s->moving, TEXT, "sphere radius=%.17g", s->size[0]);
    snprintf(s->fixed, TEXT, "sphere");
}

/* The distance of two circles or spheres of radii r and 1. */
static double between_round(double r, double apart)
{
    return apart > 1 ? beyond(apart, 1 + r) : beyond(1 - r, apart);
}

static double of_spheres(const slide *s, const double at[3])
{
    return between_round(s->size[0], sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]));
}

/* --- Cylinders -------------------------------------------------------------------------------- */

static void draw_cylinders(uint64_t *random, double c, slide *s)
{
    s->size[0] = draw_radius(random, c, s, 0);
    draw_way(random, c, 2, s->way);
    s->way[2] = random_between(random, -0.5, 0.5);
    snprintf(s->moving, TEXT, "cylinder radius=%.17g height=1 ! rotate rate=%.17g", s->size[0],
             random_between(random, -3, 3));
    snprintf(s->fixed, TEXT, "cylinder height=4");
}

static double of_cylinders(const slide *s, const double at[3])
{
    return between_round(s->size[0], sqrt(at[0] * at[0] + at[1] * at[1]));
}

/* --- A sphere in a ring, a funnel, and above a table ------------------------------------------ */

static void draw_in_torus(uint64_t *random, double c, slide *s)
{
    const double round = random_between(random, 0, 6);
    s->size[0] = 0.25 - c;
    s->start[0] = cos(round);
    s->start[1] = sin(round);
    draw_way(random, c, 3, s->way);
    snprintf(s->moving, TEXT, "sphere radius=%.17g", s->size[0]);
    snprintf(s->fixed, TEXT, "torus");
}

static double of_torus(const slide *s, const double at[3])
{
    const double q = sqrt(at[0] * at[0] + at[1] * at[1]) - 1;
    return beyond(fabs(0.25 - sqrt(q * q + at[2] * at[2])), s->size[0]);
}

static void draw_in_cone(uint64_t *random, double c, slide *s)
{
    s->start[2] = 1;
    s->size[0] = 2 * 3 / sqrt(4 + 16) - c; /* touches a circle of the cone but for c */
    draw_way(random, c, 3, s->way);
    snprintf(s->moving, TEXT, "sphere radius=%.17g", s->size[0]);
    snprintf(s->fixed, TEXT, "cone radius=2 height=4");
}

static double of_cone(const slide *s, const double at[3])
{
    const double q = sqrt(at[0] * at[0] + at[1] * at[1]);
    return beyond(fabs(4 * q + 2 * (at[2] - 4)) / sqrt(4 + 16), s->size[0]);
}

static void draw_on_plane(uint64_t *random, double c, slide *s)
{
    s->size[0] = random_between(random, 0.2, 1);
    s->start[2] = (random_bits(random) % 2 ? 1 : -1) * (s->size[0] + c);
    draw_way(random, c, 3, s->way);
    s->way[0] = random_between(random, -1, 1);
    snprintf(s->moving, TEXT, "sphere radius=%.17g", s->size[0]);
    snprintf(s->fixed, TEXT, "plane origin=-5,-5,0 edge_u=10,0,0 edge_v=1,10,0");
}

static double of_plane(const slide *s, const double at[3])
{
    return beyond(fabs(at[2]), s->size[0]);
}

/* --- Rings and cones in each other ------------------------------------------------------------ */

static void draw_tori(uint64_t *random, double c, slide *s)
{
    s->size[0] = 0.25 - c;
    s->way[2] = c * random_between(random, -2, 2);
    snprintf(s->moving, TEXT, "torus minor_radius=%.17g ! rotate rate=%.17g", s->size[0],
             random_between(random, -1, 1));
    snprintf(s->fixed, TEXT, "torus");
}

static double of_tori(const slide *s, const double at[3])
{
    return beyond(0.25 - s->size[0], fabs(at[2]));
}

static void draw_cones(uint64_t *random, double c, slide *s)
{
    s->size[0] = 4 - 2.5 - 0.5; /* from apex to apex, of one that begins 0.5 higher */
    s->start[2] = s->size[0] - c * sqrt(4 + 16) / 2;
    s->way[2] = c * random_between(random, -2, 4);
    snprintf(s->moving, TEXT, "cone radius=1.25 height=2.5 center=0,0,0.5 ! rotate rate=%.17g",
             random_between(random, -1, 1));
    snprintf(s->fixed, TEXT, "cone radius=2 height=4");
}

static double of_cones(const slide *s, const double at[3])
{
    return beyond(s->size[0], at[2]) * 2 / sqrt(4 + 16);
}

static const kind kinds[] = {
    {"spheres", draw_spheres, of_spheres},   {"cylinders", draw_cylinders, of_cylinders},
    {"in a torus", draw_in_torus, of_torus}, {"in a cone", draw_in_cone, of_cone},
    {"on a plane", draw_on_plane, of_plane}, {"tori", draw_tori, of_tori},
    {"cones", draw_cones, of_cones},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* --- Judging ---------------------------------------------------------------------------------- */

static double distance_at(const kind *k, const slide *s, double t)
{
    double at[3];
    for (int i = 0; i < 3; ++i) at[i] = s->start[i] + t * s->way[i];
    return k->distance(s, at);
}

static void judge(const kind *k, const slide *s, const question *q, const imp_result *r)
{
    const double gamma_clear = 0.5 * q->gamma, rounding = 1e-12;
    ck_assert_msg(r->verdict != IMP_VERDICT_UNDECIDED, "%s | %s: undecided after %g pairs", q->a,
                  q->b, (double)r->stats.pairs);
    for (int m = 0; m <= MOMENTS; ++m) {
        const double t = (double)m / MOMENTS;
        if (t >= r->t_lower && r->verdict == IMP_VERDICT_CONTACT) break;
        ck_assert_msg(distance_at(k, s, t) > gamma_clear - rounding,
                      "%s: %s | %s: %g apart at %.17g, before %.17g", k->name, q->a, q->b,
                      distance_at(k, s, t), t, r->t_lower);
    }
    if (r->verdict != IMP_VERDICT_CONTACT) return;
    ck_assert_msg(distance_at(k, s, r->t) < q->gamma + rounding, "%s: %s | %s: %g apart at %.17g",
                  k->name, q->a, q->b, distance_at(k, s, r->t), r->t);
}

/* --- Placed and carried ----------------------------------------------------------------------- */

/* Rigid maps that put both somewhere else; over time, if they `move`. */
static void draw_carrier(uint64_t *random, bool moves, char text[TEXT])
{
    double x[6];
    for (int k = 0; k < 6; ++k) x[k] = random_between(random, -1, 1);
    snprintf(text, TEXT,
             " ! rotate axis=%.17g,%.17g,1 center=%.17g,0,1 angle=%.17g,%.17g"
             " ! translate offset=[[%.17g,2,3],[%.17g,1,0]]",
             x[0], x[1], x[2], 3 * x[3], moves ? 6 * x[4] : 0, 8 * x[5], moves ? 3 * x[4] : 0);
}

/* Puts the same instances of the maps on both. */
static void carry(imp_scene *scene, const char *carrier)
{
    char text[2 * TEXT];
    imp_error error;
    snprintf(text, sizeof text, "sphere%s", carrier);
    imp_scene *donor = imp_scene_from_pair(registry, text, "sphere", &error);
    ck_assert_ptr_nonnull(donor);
    const surface *from = scene_surface(donor, 0, 0);
    for (size_t body = 0; body < 2; ++body) {
        surface *to = (surface *)(uintptr_t)scene_surface(scene, body, 0);
        for (size_t k = 0; k < from->map_count; ++k)
            ck_assert_int_eq(surface_add_instance(to, from->maps[k].origin), IMP_SUCCESS);
    }
    imp_scene_free(donor);
}

static imp_result ask_carried(const question *q, const char *carrier)
{
    imp_error error;
    imp_result r = {.struct_size = sizeof r};
    imp_scene *scene = imp_scene_from_pair(registry, q->a, q->b, &error);
    ck_assert_ptr_nonnull(scene);
    carry(scene, carrier);
    const imp_options options = query_options(scene, q);
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_SUCCESS);
    query_check(scene, &options, &r);
    imp_scene_free(scene);
    return r;
}

static imp_result ask_placed(const question *q, const char *place)
{
    char a[3 * TEXT], b[3 * TEXT];
    question placed = *q;
    snprintf(a, sizeof a, "%s%s", q->a, place);
    snprintf(b, sizeof b, "%s%s", q->b, place);
    placed.a = a, placed.b = b;
    return ask_in(registry, &placed);
}

/* --- Slides ----------------------------------------------------------------------------------- */

typedef enum setting { FREE, PLACED, CARRIED, SETTINGS } setting;

/* Spheres turn about their middles first; other shapes have turned about their axes. */
static imp_verdict try_slide(const kind *k, setting where, uint64_t *random)
{
    slide s = {.start = {0, 0, 0}, .way = {0, 0, 0}};
    const double c = random_power(random, -12, -3);
    char text[2 * TEXT], maps[TEXT];
    k->draw(random, c, &s);
    const bool spins = strncmp(s.moving, "sphere", 6) == 0;
    snprintf(text, sizeof text, "%s%s ! translate offset=[[%.17g,%.17g,%.17g],[%.17g,%.17g,%.17g]]",
             s.moving, spins ? " ! rotate axis=1,2,3 rate=1.5" : "", s.start[0], s.start[1],
             s.start[2], s.way[0], s.way[1], s.way[2]);
    const bool first = random_bits(random) % 2;
    const question q = {.a = first ? text : s.fixed,
                        .b = first ? s.fixed : text,
                        .gamma = c * random_power(random, -3, 0)};
    draw_carrier(random, where == CARRIED, maps);
    const imp_result r = where == FREE     ? ask_in(registry, &q)
                         : where == PLACED ? ask_placed(&q, maps)
                                           : ask_carried(&q, maps);
    judge(k, &s, &q, &r);
    return r.verdict;
}

START_TEST(what_slides_is_answered_as_its_distance_at_each_moment_demands)
{
    uint64_t random = suite_seed();
    for (int k = 0; k < KINDS; ++k) {
        int seen[3] = {0, 0, 0};
        for (int n = 0; n < suite_times_at_least(SCENES); ++n)
            seen[try_slide(&kinds[k], (setting)(n % SETTINGS), &random)] += 1;
        ck_assert_msg(seen[IMP_VERDICT_CONTACT] > 0 && seen[IMP_VERDICT_CLEAR] > 0,
                      "%s: %d contacts, %d clear", kinds[k].name, seen[IMP_VERDICT_CONTACT],
                      seen[IMP_VERDICT_CLEAR]);
    }
}
END_TEST

static void judge_pairs(const question *q, const imp_result *r, uint64_t most)
{
    ck_assert_int_eq(r->verdict, IMP_VERDICT_CLEAR);
    ck_assert_msg(r->stats.pairs <= most, "%s | %s: %g pairs", q->a, q->b, (double)r->stats.pairs);
}

static void count_pairs(const char *a, const char *b, double gamma, uint64_t most)
{
    const question q = {.a = a, .b = b, .gamma = gamma};
    const imp_result r = ask_in(registry, &q);
    judge_pairs(&q, &r, most);
}

START_TEST(a_distance_spares_the_neighbours)
{
    count_pairs("cylinder radius=0.999 ! rotate rate=3", "cylinder", 1e-4, 2000);
    count_pairs("cylinder", "cylinder radius=0.999 ! rotate rate=3", 1e-4, 2000);
    count_pairs("sphere radius=0.99 ! rotate axis=1,2,3 rate=2", "sphere", 1e-3, 9000);
    count_pairs("sphere radius=0.249 center=1,0,0 ! rotate rate=1", "torus", 1e-4, 9000);
}
END_TEST

/* There are as many pairs as without the maps, but for remainders that are turned into other
 * boxes. */
START_TEST(a_distance_spares_the_neighbours_where_both_are_placed)
{
    const char *place = " ! rotate axis=1,2,3 angle=0.7 ! translate offset=[[1,2,3]]";
    const question questions[] = {
        {.a = "cylinder radius=0.99 ! rotate rate=3", .b = "cylinder", .gamma = 1e-3},
        {.a = "cylinder", .b = "cylinder radius=0.99 ! rotate rate=3", .gamma = 1e-3},
        {.a = "sphere radius=0.9 ! rotate axis=1,2,3 rate=2", .b = "sphere", .gamma = 1e-2}};
    const uint64_t most[] = {600, 600, 4000};
    for (int k = 0; k < 3; ++k) {
        const imp_result r = ask_placed(&questions[k], place);
        judge_pairs(&questions[k], &r, most[k]);
    }
}
END_TEST

/* However fast that is: it took 111270, 119185 and more than 300000 pairs. */
START_TEST(a_distance_spares_the_neighbours_where_both_are_carried)
{
    const char *carrier = " ! rotate axis=1,1,0 rate=6 center=1,0,0 ! translate velocity=3,0,0";
    const question questions[] = {
        {.a = "cylinder radius=0.99 ! rotate rate=3", .b = "cylinder", .gamma = 1e-3},
        {.a = "cylinder", .b = "cylinder radius=0.99 ! rotate rate=3", .gamma = 1e-3},
        {.a = "sphere radius=0.99 ! rotate axis=1,2,3 rate=2", .b = "sphere", .gamma = 1e-3}};
    const uint64_t most[] = {500, 500, 9000};
    for (int k = 0; k < 3; ++k) {
        const imp_result r = ask_carried(&questions[k], carrier);
        judge_pairs(&questions[k], &r, most[k]);
    }
}
END_TEST

/* One contact is enough: no side is halved down to gamma first. */
START_TEST(what_touches_all_over_at_one_instant_is_found_at_once)
{
    const question q = {.a = "sphere radius=2",
                        .b = "sphere ! scale factors=[[1],[1]]",
                        .t_start = 1,
                        .t_end = 1,
                        .gamma = 1e-6};
    const imp_result r = ask_in(registry, &q);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_msg(r.stats.pairs <= 200, "%g pairs", (double)r.stats.pairs);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_slides_is_answered_as_its_distance_at_each_moment_demands,
                                  a_distance_spares_the_neighbours,
                                  a_distance_spares_the_neighbours_where_both_are_placed,
                                  a_distance_spares_the_neighbours_where_both_are_carried,
                                  what_touches_all_over_at_one_instant_is_found_at_once};
    return suite_main_with("sliding", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
