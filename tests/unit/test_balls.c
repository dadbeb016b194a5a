/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/bounds/distance.h"
#include "core/common/random.h"
#include "core/scene/scene.h"
#include "tests/support/query_helpers.h"

/* Balls under random chains of rotations and shifts, beside surfaces that move, too: points of a
 * ball are within its radius of its center, and no point of the other surface is nearer than the
 * distance of the center, less the radius, says. */

enum { SCENES = 100, POINTS = 24, GRID = 16, STEPS = 120, TEXT = 1600 };

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }

static void close_registry(void) { imp_registry_free(registry); }

/* --- Scenes ----------------------------------------------------------------------------------- */

static void add_maps(uint64_t *random, char *text)
{
    const int count = (int)(random_bits(random) % 4);
    for (int k = 0; k < count; ++k) {
        char *end = text + strlen(text);
        if (random_bits(random) % 2)
            snprintf(end, (size_t)(text + TEXT - end),
                     " ! rotate axis=%.17g,%.17g,%.17g center=%.17g,%.17g,%.17g angle=%.17g,%.17g",
                     random_part(random), random_part(random), 1 + random_part(random),
                     random_part(random), random_part(random), random_part(random),
                     3 * random_part(random), 4 * random_part(random));
        else
            snprintf(end, (size_t)(text + TEXT - end),
                     " ! translate offset=[[%.17g,%.17g,%.17g],[%.17g,%.17g,%.17g]]",
                     random_part(random), random_part(random), random_part(random),
                     random_part(random), random_part(random), random_part(random));
    }
}

static void draw_ball(uint64_t *random, char text[TEXT])
{
    snprintf(text, TEXT, "sphere radius=%.17g center=%.17g,%.17g,%.17g",
             random_power(random, -6, 0), 2 * random_part(random), 2 * random_part(random),
             2 * random_part(random));
    add_maps(random, text);
}

static const char *const others[] = {"sphere",
                                     "torus major_radius=1.5 minor_radius=0.4",
                                     "cylinder radius=0.7 height=3",
                                     "cone radius=1 height=2",
                                     "ellipsoid radii=1,1,0.5",
                                     "plane origin=-1,-1,0 edge_u=2,0,0 edge_v=0,2,0.5",
                                     "disc radius=1 axis=1,2,3"};
enum { OTHERS = sizeof others / sizeof *others };

/* The other surface at rest, shifted, turning about its own axis, or under any maps; a ball at rest
 * slides along what turns about its own axis. */
static void draw_other(uint64_t *random, char text[TEXT])
{
    const uint64_t kind = random_bits(random) % 5;
    snprintf(text, TEXT, "%s", others[random_bits(random) % OTHERS]);
    if (kind == 0) add_maps(random, text);
    if (kind == 1)
        snprintf(text + strlen(text), TEXT - strlen(text), " ! rotate rate=%.17g",
                 5 * random_part(random));
    if (kind == 2)
        snprintf(text + strlen(text), TEXT - strlen(text), " ! translate velocity=%.17g,%.17g,1",
                 random_part(random), random_part(random));
}

static imp_scene *scene_of(const char *a, const char *b)
{
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static void place_at(const surface *s, double u, double v, double t, double x[3])
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    const double p[3] = {lo[0] + u * (hi[0] - lo[0]), lo[1] + v * (hi[1] - lo[1]), t};
    ck_assert_int_eq(surface_eval(s, 1, p, x, NULL), IMP_STATUS_OK);
}

static double apart(const double x[3], const double y[3])
{
    return hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
}

static double value_at(const imp_model *m, double s)
{
    return m->a + m->b[2] * s + m->q[IMP_TT] * s * s;
}

/* --- Points of a ball ------------------------------------------------------------------------- */

/* Counts points that are farther from the center than `share` of the radius, and the models' errors
 * beyond that. */
static int count_beyond(const surface *s, const imp_region *r, double share, uint64_t *random)
{
    imp_model center[3];
    double radius;
    int beyond = 0;
    ck_assert_int_eq(surface_ball(s, r, center, &radius), IMP_STATUS_OK);
    ck_assert(radius < INFINITY);
    for (int k = 0; k < POINTS; ++k) {
        const double w = random_part(random), t = r->c[2] + w * r->d[2];
        double x[3], c[3], off = 1e-13;
        place_at(s, random_fraction(random), random_fraction(random), t, x);
        for (int i = 0; i < 3; ++i) {
            c[i] = value_at(&center[i], w);
            off += center[i].e;
        }
        beyond += apart(x, c) > share * radius + off;
    }
    return beyond;
}

START_TEST(points_of_a_ball_are_within_its_radius_of_its_center)
{
    uint64_t random = suite_seed();
    int farther = 0;
    for (int k = 0; k < suite_times_at_least(SCENES); ++k) {
        char a[TEXT];
        draw_ball(&random, a);
        imp_scene *scene = scene_of(a, "box");
        const double t0 = random_fraction(&random), t1 = t0 + random_power(&random, -20, -3);
        double lo[3], hi[3];
        surface_domain(scene_surface(scene, 0, 0), lo, hi);
        lo[2] = t0, hi[2] = t1;
        const imp_region r = region_make(lo, hi);
        ck_assert_msg(count_beyond(scene_surface(scene, 0, 0), &r, 1, &random) == 0, "%s", a);
        farther += count_beyond(scene_surface(scene, 0, 0), &r, 1 - 1e-3, &random);
        imp_scene_free(scene);
    }
    ck_assert(farther > 0);
}
END_TEST

START_TEST(only_balls_under_exact_rotations_have_a_radius)
{
    const char *const none[] = {"ellipsoid radii=1,1,0.5", "torus", "cylinder", "plane",
                                "sphere ! scale factors=[[1],[0.1]]"};
    for (size_t k = 0; k < sizeof none / sizeof *none; ++k) {
        imp_scene *scene = scene_of(none[k], "box");
        imp_model center[3];
        double radius = 0, lo[3], hi[3];
        const surface *s = scene_surface(scene, 0, 0);
        surface_domain(s, lo, hi);
        lo[2] = 0, hi[2] = 1;
        const imp_region r = region_make(lo, hi);
        ck_assert_int_eq(surface_ball(s, &r, center, &radius), IMP_STATUS_OK);
        ck_assert_msg(radius == INFINITY, "%s", none[k]);
        imp_scene_free(scene);
    }
}
END_TEST

/* --- Distances -------------------------------------------------------------------------------- */

/* Nearly the distance of both at a time, from above: points of the other on a grid, then steps. */
static double nearly_apart(const surface *ball, const surface *other, double t)
{
    imp_model center[3];
    double radius, lo[3], hi[3], c[3], best = INFINITY, at[2] = {0, 0};
    surface_domain(ball, lo, hi);
    lo[2] = hi[2] = t;
    const imp_region r = region_make(lo, hi);
    ck_assert_int_eq(surface_ball(ball, &r, center, &radius), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) c[i] = center[i].a;
    for (int k = 0; k < GRID * GRID; ++k) {
        double y[3];
        const double u = (k % GRID + 0.5) / GRID, v = (double)(k / GRID) / (GRID - 1);
        place_at(other, u, v, t, y);
        if (apart(c, y) < best) best = apart(c, y), at[0] = u, at[1] = v;
    }
    double step = 0.5 / GRID;
    for (int k = 0; k < STEPS && step > 1e-9; ++k) {
        bool found = false;
        for (int d = 0; d < 4; ++d) {
            double y[3], to[2] = {at[0], at[1]};
            to[d / 2] += d % 2 ? step : -step;
            if (!(to[d / 2] >= 0 && to[d / 2] <= 1)) continue;
            place_at(other, to[0], to[1], t, y);
            if (!(apart(c, y) < best)) continue;
            best = apart(c, y), found = true;
            memcpy(at, to, sizeof at);
        }
        if (!found) step *= 0.5;
    }
    return best < radius ? radius - best : best - radius;
}

typedef struct tally {
    int apart, cut, bounded, refuted, too_far;
} tally;

/* Cuts by the ball and holds what is claimed against `share` of distances at moments. */
static void try_cut(const distance_sides *of, double gamma_clear, double share, uint64_t *random,
                    tally *sum)
{
    const time_window whole = pair_times(of->node[0], of->node[1]);
    time_window left = whole;
    distance_view view;
    imp_error error;
    ck_assert_int_eq(distance_cut_ball(of, 0, gamma_clear, &left, &view, &error), IMP_SUCCESS);
    sum->apart += view.is_apart;
    sum->cut += !view.is_apart && (left.lo > whole.lo || left.hi < whole.hi);
    sum->bounded += view.lower > 0;
    for (int k = 0; k < POINTS / 4; ++k) {
        const double f = k == 0 ? 0 : k == 1 ? 1 : random_fraction(random);
        double t = whole.lo + f * (whole.hi - whole.lo);
        if (k == 2 && left.lo > whole.lo) t = left.lo - 1e-3 * (left.lo - whole.lo);
        const double found =
            share * nearly_apart(of->node[0]->surface, of->node[1]->surface, t) + 1e-12;
        const bool is_cut_off = view.is_apart || t < left.lo || t > left.hi;
        sum->refuted += is_cut_off && found < gamma_clear;
        sum->too_far += found < view.lower;
    }
}

static tree *tree_of(const surface *s, double t0, double t1)
{
    const tree_plan plan = {.kind = TREE_MODELS, .t_start = t0, .t_end = t1};
    tree_growth growth = {0};
    tree *made;
    imp_error error;
    ck_assert_int_eq(tree_new(s, &plan, &made, &growth, &error), IMP_SUCCESS);
    return made;
}

static void try_scene(double share, uint64_t *random, tally *sum)
{
    char a[TEXT], b[TEXT];
    draw_ball(random, a);
    draw_other(random, b);
    if (strstr(b, "rate=") != NULL && random_bits(random) % 2)
        a[strcspn(a, "!")] = '\0'; /* no maps */
    imp_scene *scene = scene_of(a, b);
    const surface *const s[2] = {scene_surface(scene, 0, 0), scene_surface(scene, 1, 0)};
    const double t0 = random_fraction(random), t1 = t0 + random_power(random, -12, 0);
    tree *const trees[2] = {tree_of(s[0], t0, t1), tree_of(s[1], t0, t1)};
    distance_slips slips = {.slip = {0, 0}};
    distance_sides of = {
        .slips = &slips, .seeks_start = random_bits(random) % 2, .takes_orbits = true};
    for (int k = 0; k < 2; ++k) {
        const imp_region times = region_make((double[3]){0, 0, t0}, (double[3]){0, 0, t1});
        of.node[k] = of.root[k] = tree_root(trees[k]);
        if (surface_has_distance(s[k]))
            ck_assert_int_eq(surface_still_maps(s[k], &times, &of.still_maps[k]), IMP_STATUS_OK);
    }
    const double near = nearly_apart(s[0], s[1], t0 + (t1 - t0) * random_fraction(random));
    try_cut(&of, near * (1 + random_power(random, -40, -1) * random_part(random)), share, random,
            sum);
    for (int k = 0; k < 2; ++k) tree_free(trees[k]);
    imp_scene_free(scene);
}

START_TEST(no_surface_is_nearer_to_a_ball_than_its_center_says)
{
    uint64_t random = suite_seed();
    tally sum = {0, 0, 0, 0, 0};
    for (int k = 0; k < suite_times_at_least(SCENES); ++k) try_scene(1, &random, &sum);
    ck_assert_msg(sum.apart > 0 && sum.cut > 0 && sum.bounded > 0 && sum.refuted == 0 &&
                      sum.too_far == 0,
                  "%d apart, %d cut, %d refuted; %d bounded, %d too far", sum.apart, sum.cut,
                  sum.refuted, sum.bounded, sum.too_far);
}
END_TEST

/* The test above must be able to fail: of distances that are a little less it does. */
START_TEST(distances_of_balls_that_are_too_large_are_found)
{
    uint64_t random = suite_seed();
    tally sum = {0, 0, 0, 0, 0};
    for (int k = 0; k < 3 * SCENES; ++k) try_scene(1 - 1e-2, &random, &sum);
    ck_assert_msg(sum.refuted > 0 && sum.too_far > 0, "%d refuted, %d too far", sum.refuted,
                  sum.too_far);
}
END_TEST

/* --- Answers ---------------------------------------------------------------------------------- */

/* Contacts at poles, across a seam, at the end of the times, and near misses. */
static const struct {
    const char *a, *b;
    double gamma, t; /* of the contact; < 0: none */
} meetings[] = {
    {"sphere", "sphere center=0,0,4 ! translate velocity=0,0,-4", 1e-6, 0.5},
    {"sphere", "sphere center=0,0,4 ! translate velocity=0,0,-4", 1e-9, 0.5},
    {"sphere ! rotate axis=1,0,0 rate=3", "sphere center=0,0,4 ! translate velocity=0,0,-4", 1e-9,
     0.5},
    {"sphere", "sphere center=0,0,4 ! translate velocity=0,0,-2", 1e-6, 1},
    {"sphere", "sphere center=4,0,0 ! translate velocity=-4,0,0", 1e-6, 0.5},
    {"sphere", "sphere center=0,0,4 ! translate velocity=0,0,-1.99999", 1e-6, -1},
    {"sphere", "sphere center=-2,0,2.000002 ! translate velocity=4,0,0", 1e-6, -1},
    {"ellipsoid radii=2,2,1", "sphere radius=0.5 center=0,0,3.5 ! translate velocity=0,0,-4", 1e-6,
     0.5},
    {"ellipsoid radii=1,1.2,0.7", "sphere center=0,0,3.7 ! translate velocity=0,0,-4", 1e-6, 0.5},
    {"torus major_radius=1 minor_radius=0.25",
     "sphere radius=0.5 center=1,0,2.75 ! translate velocity=0,0,-4", 1e-6, 0.5},
    {"plane origin=-1,-1,0 edge_u=2,0,0 edge_v=0,2,0",
     "sphere radius=0.5 center=0,0,2.5 ! translate velocity=0,0,-4", 1e-6, 0.5},
};
enum { MEETINGS = sizeof meetings / sizeof *meetings };

START_TEST(balls_meet_at_poles_in_few_pairs)
{
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, meetings[_i].a, meetings[_i].b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = meetings[_i].gamma;
    options.max_pairs = 10000;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s", error.text);
    query_check(scene, &options, &r);
    ck_assert_msg(r.stats.pairs <= 10, "%llu pairs", (unsigned long long)r.stats.pairs);
    if (meetings[_i].t < 0) {
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CLEAR);
    } else {
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        ck_assert_double_le(r.t, meetings[_i].t);
        ck_assert_double_ge(r.t, meetings[_i].t - options.gamma);
    }
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {{points_of_a_ball_are_within_its_radius_of_its_center, 1},
                                {only_balls_under_exact_rotations_have_a_radius, 1},
                                {no_surface_is_nearer_to_a_ball_than_its_center_says, 1},
                                {distances_of_balls_that_are_too_large_are_found, 1},
                                {balls_meet_at_poles_in_few_pairs, MEETINGS}};
    return suite_main_loops("balls", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
