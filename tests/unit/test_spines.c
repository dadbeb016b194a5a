/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/bounds/spine.h"
#include "core/scene/scene.h"
#include "core/surface/course.h"
#include "tests/support/side_trial.h"

/* Surfaces that turn, and their spines: all points are within the radius of the segment, it is
 * where its models say, and no points of two surfaces are nearer than spines show. */

enum {
    SPINES = 80,
    SCENES = 48,
    MOMENTS = 4,
    STARTS = 32,
    BEST = 3,
    STEPS = 80,
    TEXT = TRIAL_TEXT
};

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }

static void close_registry(void) { imp_registry_free(registry); }

/* --- Scenes ----------------------------------------------------------------------------------- */

#define COIL                                                                                       \
    "formula x=(1+0.1*cos(2*pi*(v-u)))*cos(2*pi*u) y=(1+0.1*cos(2*pi*(v-u)))*sin(2*pi*u) "         \
    "z=0.5*v domain=[[0,1],[-2,2]]"
#define DRUM                                                                                       \
    "mesh points=[[1,0,0],[0,1,0],[-1,0,0],[0,-1,0],[0.8,0.1,1],[0,0.9,1],[-0.8,0,1],[0,-0.8,1]] " \
    "faces=[[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7],[3,2,1,0],[4,5,6,7]]"

#define SHEET                                                                                      \
    "bezier degree=2,2 points=[[-1,-1,0],[-1,0,0.3],[-1,1,0],[0,-1,0],[0,0,0],[0,1,0.4],"          \
    "[1,-1,0.2],[1,0,0],[1,1,0]]"

static const char *const turned[] = {
    "thread radius=1 profile=0.1 pitch=0.5 height=1",
    "thread radius=0.8 profile=0.1,0.05 pitch=-0.4 starts=2 height=1",
    COIL,
    DRUM,
    "box size=1.2,0.8,0.6",
    "box size=1,1,1 ! twist axis=0,0,1 rate=0.5",
    "cylinder radius=0.7 height=0.8 ends=true",
    "capsule radius=0.3 from=0,0.1,-0.4 to=0,0,0.4",
    "ellipsoid radii=0.9,0.6,0.4",
    "revolution profile=[[0.6,-1],[1.5,-0.4],[0,0.4],[0.6,1]]",
    "torus major_radius=0.7 minor_radius=0.2",
    "cone radius=0.8 height=0.9",
    "spike radius=0.7 height=0.3 width=0.3",
    SHEET,
    "triangle points=[[1,0,0],[0,1,0.3],[-1,0,0]]",
    "sphere radius=0.5 center=0.3,0,0"};
static const char *const others[] = {
    "plane origin=@,-2,-2 edge_u=0.3,4,0 edge_v=0,0,4",
    "box size=1,1,1 center=@,0.2,0",
    "cylinder radius=0.4 height=2 ! translate offset=[[@,0.1,0.2]]",
    "cylinder radius=0.4 height=2 ends=true ! rotate axis=1,0,0 angle=0.5 ! translate "
    "offset=[[@,0,0]]",
    "cylinder radius=@ height=3",
    "cylinder radius=@ height=3 ! rotate axis=0,1,0 angle=0.1",
    "sphere radius=0.4 center=@,0.1,0.2",
    "sphere radius=@",
    "thread radius=0.5 profile=0.1 pitch=0.3 height=1 ! translate offset=[[@,0,0.1]]",
    DRUM " ! rotate axis=0,0,1 rate=2 ! translate offset=[[@,0,0.1]]",
    "torus major_radius=@ minor_radius=0.3",
    "point position=@,0,0.1"};

/* Turns about its own line, about another one, and shifts, each or none; or a table of poses. */
static void add_motion(uint64_t *random, char text[TEXT])
{
    if (random_bits(random) % 8 == 0) {
        const double angle = 0.7 * random_part(random), x = 0.3 * random_part(random);
        text_add(text, TEXT,
                 " ! keyframes times=0,0.5,1 positions=[[0,0,0],[%.17g,0,0],[%.17g,0,0.1]] "
                 "rotations=[[1,0,0,0],[%.17g,0,0,%.17g],[%.17g,0,0,%.17g]]",
                 x, 2 * x, cos(angle), sin(angle), cos(2 * angle), sin(2 * angle));
        return;
    }
    if (random_bits(random) % 4)
        text_add(text, TEXT, " ! rotate axis=%.17g,0,1 rate=%.17g",
                 random_bits(random) % 4 ? 0 : random_part(random),
                 random_power(random, -2, 6) * random_part(random));
    if (random_bits(random) % 4 == 0)
        text_add(text, TEXT, " ! translate offset=[[%.17g,0,0],[0,%.17g,0]]",
                 0.2 * random_part(random), 0.2 * random_part(random));
    if (random_bits(random) % 4 == 0)
        text_add(text, TEXT, " ! rotate axis=%.17g,0,1 rate=%.17g",
                 random_bits(random) % 2 ? 0 : 0.2 * random_part(random), 4 * random_part(random));
}

static void draw_other(uint64_t *random, char text[TEXT])
{
    const char *from = others[random_bits(random) % (sizeof others / sizeof *others)];
    const double far = random_between(random, 1, 3);
    for (; *from != '\0'; ++from) {
        if (*from == '@')
            text_add(text, TEXT, "%.17g", far);
        else
            text_add(text, TEXT, "%c", *from);
    }
}

static void trial_begin(trial *y, uint64_t *random)
{
    char place[TEXT] = "";
    const double t0 = 0.5 * random_fraction(random), t1 = t0 + random_power(random, -6, -1);
    memset(y, 0, sizeof *y);
    strcpy(y->text[0], turned[random_bits(random) % (sizeof turned / sizeof *turned)]);
    add_motion(random, y->text[0]);
    draw_other(random, y->text[1]);
    if (random_bits(random) % 2)
        text_add(place, TEXT,
                 " ! rotate axis=%.17g,%.17g,1 angle=%.17g ! translate offset=[[%.17g,2,3]]",
                 random_part(random), random_part(random), 3 * random_part(random),
                 random_part(random));
    for (int k = 0; k < 2; ++k) strcat(y->text[k], place);
    trial_open(y, registry, t0, t1);
}

/* --- Radii ------------------------------------------------------------------------------------ */

/* How far x is from the segment, given its ends. */
static long double beside(const double ends[2][3], const double x[3])
{
    long double way[3], from[3], along = 0, square = 0, rest = 0;
    for (int i = 0; i < 3; ++i) {
        way[i] = (long double)ends[1][i] - ends[0][i];
        from[i] = (long double)x[i] - ends[0][i];
        along += way[i] * from[i];
        square += way[i] * way[i];
    }
    const long double f = square > 0 ? along / square : 0, z = f < 0 ? 0 : f > 1 ? 1 : f;
    for (int i = 0; i < 3; ++i) rest += (from[i] - z * way[i]) * (from[i] - z * way[i]);
    return sqrtl(rest);
}

/* The greatest distance from the segment, at a moment, that steps from some points find. */
static long double farthest(const trial *y, const spine *of, uint64_t *random)
{
    const double t = random_between(random, y->times.lo, y->times.hi);
    double ends[2][3];
    long double most = 0;
    for (int i = 0; i < 3; ++i) {
        ends[0][i] = of->center[i] + of->from * of->axis[i];
        ends[1][i] = of->center[i] + of->to * of->axis[i];
    }
    ck_assert_int_eq(surface_move_outward(of->of, of->inner, t, 2, ends[0]), IMP_STATUS_OK);
    for (int n = 0; n < STARTS / 4; ++n) {
        const surface *piece =
            surface_part(of->of, random_bits(random) % surface_part_count(of->of));
        double at[2] = {random_fraction(random), random_fraction(random)}, x[3], step = 0.3;
        place_at(piece, at, t, x);
        long double best = beside((const double(*)[3])ends, x);
        for (int k = 0; k < STEPS && step > 1e-6; ++k) {
            bool found = false;
            for (int d = 0; d < 4; ++d) {
                double to[2] = {at[0], at[1]};
                to[d / 2] += d % 2 ? step : -step;
                to[d / 2] = to[d / 2] < 0 ? 0 : to[d / 2] > 1 ? 1 : to[d / 2];
                place_at(piece, to, t, x);
                const long double here = beside((const double(*)[3])ends, x);
                if (!(here > best)) continue;
                best = here, found = true;
                memcpy(at, to, sizeof at);
            }
            if (!found) step *= 0.5;
        }
        if (best > most) most = best;
    }
    return most;
}

/* Counts radii, those that are refuted if all are a part less, and those near a point's. */
typedef struct radii {
    int known, refuted, near;
} radii;

static void try_radius(double share, uint64_t *random, radii *sum)
{
    trial y;
    spine of;
    imp_error error;
    bool known = false;
    trial_begin(&y, random);
    if (spine_choose(y.s[0], &y.times, &of)) {
        const double goal = of.radius * (1 + random_power(random, -16, 0));
        ck_assert_int_eq(spine_measure(&of, &y.times, goal, &known, &error), IMP_SUCCESS);
    }
    if (known) {
        const long double found = farthest(&y, &of, random), most = share * of.radius + 1e-12;
        sum->known += 1;
        sum->near += found > 0.999L * most;
        sum->refuted += found > most;
        if (share == 1) ck_assert_msg(found <= most, "%s: %.17Lg, %.17Lg", y.text[0], found, most);
    }
    trial_end(&y);
}

START_TEST(all_points_are_within_the_radius)
{
    uint64_t random = suite_seed();
    radii sum = {0, 0, 0};
    for (int k = 0; k < suite_times_from(SPINES, SPINES / 2); ++k) try_radius(1, &random, &sum);
    ck_assert_msg(sum.known > 5 && sum.near > 2, "%d known, %d near", sum.known, sum.near);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(radii_that_are_too_small_are_found)
{
    uint64_t random = suite_seed();
    radii sum = {0, 0, 0};
    for (int k = 0; k < 20 * SPINES && sum.refuted < 3; ++k) try_radius(0.999, &random, &sum);
    ck_assert_int_ge(sum.refuted, 3);
}
END_TEST

/* --- Places ----------------------------------------------------------------------------------- */

static double value_of(const imp_model *m, double s, double w)
{
    return m->a + m->b[1] * s + m->b[2] * w + m->q[IMP_VV] * s * s + m->q[IMP_VT] * s * w +
           m->q[IMP_TT] * w * w;
}

START_TEST(spines_are_where_their_models_say)
{
    uint64_t random = suite_seed();
    int judged = 0, exact = 0;
    for (int n = 0; n < suite_times_from(SPINES, SPINES / 4); ++n) {
        trial y;
        spine of;
        imp_model x[3];
        node made;
        trial_begin(&y, &random);
        const bool known = spine_choose(y.s[0], &y.times, &of) &&
                           spine_node(&of, y.times.lo, y.times.hi, x, &made);
        for (int k = 0; k < 8 && known; ++k, ++judged) {
            const double s = random_part(&random), w = random_part(&random);
            const double z = made.region.c[1] + s * made.region.d[1];
            const double t = made.region.c[2] + w * made.region.d[2];
            double at[3];
            for (int i = 0; i < 3; ++i) at[i] = of.center[i] + z * of.axis[i];
            ck_assert_int_eq(surface_move_outward(of.of, of.inner, t, 1, at), IMP_STATUS_OK);
            for (int i = 0; i < 3; ++i) {
                const double off = fabs(value_of(&x[i], s, w) - at[i]);
                ck_assert_msg(off <= x[i].e + 1e-13 * (1 + fabs(at[i])), "%s: %g", y.text[0], off);
            }
        }
        if (known) exact += x[0].e + x[1].e + x[2].e < 1e-12;
        trial_end(&y);
    }
    ck_assert_msg(judged > 0 && exact > 0, "%d judged, %d exact", judged, exact);
}
END_TEST

/* --- Distances -------------------------------------------------------------------------------- */

typedef struct spot {
    const surface *piece[2];
    double at[2][2], apart;
} spot;

static double apart(const spot *p, double t)
{
    double x[2][3];
    for (int j = 0; j < 2; ++j) place_at(p->piece[j], p->at[j], t, x[j]);
    return query_distance(x[0], x[1]);
}

static void step_nearer(spot *p, double t)
{
    double step = 0.2;
    for (int k = 0; k < STEPS && step > 1e-7; ++k) {
        bool found = false;
        for (int d = 0; d < 8; ++d) {
            spot to = *p;
            double *moved = &to.at[d / 4][d / 2 % 2];
            *moved += d % 2 ? step : -step;
            *moved = *moved < 0 ? 0 : *moved > 1 ? 1 : *moved;
            to.apart = apart(&to, t);
            if (to.apart < p->apart) *p = to, found = true;
        }
        if (!found) step *= 0.5;
    }
}

/* Nearly the distance at a time, from above. */
static double nearly_apart(const trial *y, double t, uint64_t *random)
{
    spot best[BEST];
    double least = INFINITY;
    for (int k = 0; k < BEST; ++k) best[k].apart = INFINITY;
    for (int n = 0; n < STARTS; ++n) {
        spot here;
        for (int j = 0; j < 2; ++j) {
            here.piece[j] =
                surface_part(y->s[j], random_bits(random) % surface_part_count(y->s[j]));
            for (int i = 0; i < 2; ++i) here.at[j][i] = random_fraction(random);
        }
        here.apart = apart(&here, t);
        for (int k = 0; k < BEST; ++k) {
            if (!(here.apart < best[k].apart)) continue;
            const spot other = best[k];
            best[k] = here, here = other;
        }
    }
    for (int k = 0; k < BEST; ++k) {
        step_nearer(&best[k], t);
        if (best[k].apart < least) least = best[k].apart;
    }
    return least;
}

typedef struct tally {
    int bounded, near, refuted;
} tally;

static void try_scene(double share, uint64_t *random, tally *sum)
{
    trial y;
    imp_error error;
    double least = INFINITY, lower, hope;
    trial_begin(&y, random);
    for (int k = 0; k < MOMENTS; ++k) {
        const double f = k == 0 ? 0 : k == 1 ? 1 : random_fraction(random);
        const double here = nearly_apart(&y, y.times.lo + f * (y.times.hi - y.times.lo), random);
        if (here < least) least = here;
    }
    const double limit = (1 - random_power(random, -10, 0)) * least;
    ck_assert_int_eq(spine_part(&y.of, &y.times, limit, &lower, &hope, &error), IMP_SUCCESS);
    sum->bounded += lower > limit;
    sum->near += lower > 0.9 * least;
    sum->refuted += lower > share * least + 1e-12;
    if (share == 1)
        ck_assert_msg(lower <= least + 1e-12, "%s | %s from %.17g to %.17g: %.17g, %.17g claimed",
                      y.text[0], y.text[1], y.times.lo, y.times.hi, least, lower);
    trial_end(&y);
}

START_TEST(no_points_are_nearer_than_spines_show)
{
    uint64_t random = suite_seed();
    tally sum = {0, 0, 0};
    for (int k = 0; k < suite_times_from(SCENES, SCENES / 2); ++k) try_scene(1, &random, &sum);
    ck_assert_msg(sum.bounded > 0 && sum.near > 0, "%d bounded, %d near", sum.bounded, sum.near);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(distances_of_spines_that_are_too_large_are_found)
{
    uint64_t random = suite_seed();
    tally sum = {0, 0, 0};
    for (int k = 0; k < 20 * SCENES && sum.refuted == 0; ++k) try_scene(0.97, &random, &sum);
    ck_assert_int_gt(sum.refuted, 0);
}
END_TEST

/* Surfaces that are as near as some points that were found, at one of the times from 0 to 1. Each
 * was told apart by spines once one step of a lemma was left out: a part of a remainder, the first
 * times, or what holds between points that are claimed one by one. */
static const struct {
    const char *text[2];
    double apart;
} found[] = {
    {{"supertoroid major_radius=0.71239 minor_radius=0.19123 exponents=0.57194,1.09697 ! rotate "
      "axis=-0.18753,-0.53718,-0.85117 angle=-0.59062 ! rotate angle=-0.42683,19.61927,2.82684",
      "thread radius=1.37032 height=3 ! translate offset=[[0.175853279,0.189190732,-1.7445e-05]]"},
     0.11069894856},
    {{"thread radius=0.62306 profile=0.06125,-0.04256 pitch=0.77635 starts=3 height=0.20295 "
      "center=0.07109,0.10169,-0.03749 ! rotate rate=-2.12573 ! translate "
      "velocity=-0.20466,0.13234,-0.11143",
      "box size=0.5,1,1 center=1.001549057,0.00019489,-9.1193e-05"},
     0.0037227608},
    {{"thread radius=1.61713 height=3",
      "thread radius=0.86919 profile=0.0541,-0.04714 pitch=0.57433 height=1.07127 "
      "center=0.08464,-0.26376,0.16675 ! translate offset=[[0.1,-0.07338,0.02311]] ! rotate "
      "angle=-0.22055,8.79754,2.55348"},
     0.20864952138}};

START_TEST(spines_show_no_more_than_the_distance_of_points)
{
    static const double parts[] = {0.5, 0.9, 0.99, 1.000001, 1.001};
    for (size_t k = 0; k < sizeof found / sizeof *found; ++k) {
        trial y;
        imp_error error;
        double lower, hope;
        memset(&y, 0, sizeof y);
        for (int j = 0; j < 2; ++j) strcpy(y.text[j], found[k].text[j]);
        trial_open(&y, registry, 0, 1);
        for (size_t j = 0; j < sizeof parts / sizeof *parts; ++j) {
            const double limit = parts[j] * found[k].apart;
            ck_assert_int_eq(spine_part(&y.of, &y.times, limit, &lower, &hope, &error),
                             IMP_SUCCESS);
            ck_assert_msg(lower <= found[k].apart, "scene %zu: %.17g, limit %.17g", k, lower,
                          limit);
            if (j == 0) ck_assert_double_gt(lower, limit);
        }
        trial_end(&y);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {all_points_are_within_the_radius,
                                  radii_that_are_too_small_are_found,
                                  spines_are_where_their_models_say,
                                  no_points_are_nearer_than_spines_show,
                                  distances_of_spines_that_are_too_large_are_found,
                                  spines_show_no_more_than_the_distance_of_points};
    return suite_main_with("spines", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
