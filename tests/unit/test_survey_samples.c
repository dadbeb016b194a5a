/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/survey_scenes.h"
#include "tests/support/told_boxes.h"

/* Random scenes with parameters: boxes that are proved against sampled points. */

/* --- Random scenes against samples ------------------------------------------------------------ */

/* The least distance of points of both bodies at some values and a time, on a grid. */
static double sampled(const imp_scene *scene, const double *values, double t)
{
    double point[2][GRID * GRID * 8][3], least = INFINITY;
    size_t count[2] = {0, 0};
    imp_scene *at = at_values(scene, values);
    for (size_t body = 0; body < 2; ++body)
        for (size_t k = 0; k < imp_scene_piece_count(at, body, 0) && k < 8; ++k) {
            double lo[3], hi[3];
            imp_piece_domain(at, (imp_place){body, 0, k}, lo, hi);
            for (int i = 0; i < GRID * GRID; ++i) {
                const double p[3] = {lo[0] + (hi[0] - lo[0]) * (i / GRID) / (GRID - 1),
                                     lo[1] + (hi[1] - lo[1]) * (i % GRID) / (GRID - 1), t};
                ck_assert_int_eq(imp_piece_eval(at, (imp_place){body, 0, k}, 1, p,
                                                point[body][count[body]++], NULL, NULL),
                                 IMP_SUCCESS);
            }
        }
    for (size_t i = 0; i < count[0]; ++i)
        for (size_t j = 0; j < count[1]; ++j) {
            const double d = query_distance(point[0][i], point[1][j]);
            if (d < least) least = d;
        }
    imp_scene_free(at);
    return least;
}

/* The least distance of both bodies at some values during the times of a box, from above. */
static double searched(const imp_scene *scene, const double *values, const told_box *box)
{
    imp_scene *at = at_values(scene, values);
    imp_options options = imp_options_default(at);
    options.t_start = box->in.time[0], options.t_end = box->in.time[1];
    options.max_pairs = 3000;
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = 0.01;
    const double upper = query_clearance(at, &options, &asked).upper;
    imp_scene_free(at);
    return upper;
}

enum { SEARCH_EVERY = 8 }; /* boxes of which one is searched, too */

static void check_box(uint64_t *r, const imp_scene *scene, const told_box *box, const char *text)
{
    double values[PARAMETERS];
    const int corner = (int)(8 * random_fraction(r));
    const bool at_corner = random_fraction(r) < 0.5; /* the worst of a box is there, mostly */
    for (int j = 0; j < PARAMETERS; ++j)
        values[j] = at_corner ? (corner >> j & 1 ? box->in.hi[j] : box->in.lo[j])
                              : random_between(r, box->in.lo[j], box->in.hi[j]);
    const double t = random_between(r, box->in.time[0], box->in.time[1]);
    const double d = random_fraction(r) < 1. / SEARCH_EVERY ? searched(scene, values, box)
                                                            : sampled(scene, values, t);
    ck_assert_msg(d >= box->lower, "%.17g at %.17g, %.17g, %.17g, t %.17g, but %.17g is proved: %s",
                  d, values[0], values[1], values[2], t, box->lower, text);
}

/* Asks for the earliest contact, for a requirement, or for a bracket. */
static void survey_for_boxes(uint64_t *r, imp_scene *scene, int kind, told_boxes *boxes)
{
    imp_survey_options how = imp_survey_options_default();
    imp_clearance_options asked = imp_clearance_options_default();
    *boxes = (told_boxes){.random = r, .most = TOLD_MAX};
    how.sink = keep_box;
    how.sink_context = boxes;
    how.max_boxes = 60;
    asked.tolerance = 0.2;
    asked.decide = kind == 1;
    asked.required = kind == 1 ? random_between(r, 0.01, 1) : 0;
    survey(scene, 0.02, kind == 0 ? NULL : &asked, &how);
}

START_TEST(no_sample_is_nearer_than_what_is_proved_of_its_box)
{
    uint64_t random = suite_seed() + (uint64_t)_i;
    static told_boxes boxes;
    const int scenes = suite_times(12);
    for (int n = 0; n < scenes; ++n) {
        char text[4000];
        double lo[PARAMETERS], hi[PARAMETERS];
        imp_scene *scene =
            random_scene(&random, n % 2 == 0 ? 1 : random_between(&random, 0.02, 0.3), text,
                         sizeof text, lo, hi);
        survey_for_boxes(&random, scene, n % 3, &boxes);
        for (size_t k = 0; k < boxes.count; ++k) check_box(&random, scene, &boxes.at[k], text);
        imp_scene_free(scene);
    }
}
END_TEST

/* The least distance of both bodies, from above, at the corners of the whole box and at values
 * inside. */
static double nearest_of_values(uint64_t *r, const imp_scene *scene, const double *lo,
                                const double *hi)
{
    told_box box = {.in.time = {0, 1}};
    double least = INFINITY;
    for (int k = 0; k < 12; ++k) {
        double values[PARAMETERS];
        for (int j = 0; j < PARAMETERS; ++j)
            values[j] = k < 8 ? (k >> j & 1 ? hi[j] : lo[j]) : random_between(r, lo[j], hi[j]);
        const double d = searched(scene, values, &box);
        if (d < least) least = d;
    }
    return least;
}

/* Where some values are known to bring the bodies nearer than what is required, all bounds of the
 * box that holds them are tried at their limit. */
START_TEST(what_some_values_violate_is_never_proved)
{
    uint64_t random = suite_seed() + 1000 + (uint64_t)_i;
    const int scenes = suite_times(20);
    for (int n = 0; n < scenes; ++n) {
        char text[4000];
        double lo[PARAMETERS], hi[PARAMETERS];
        imp_scene *scene =
            random_scene(&random, random_between(&random, 0.02, 0.6), text, sizeof text, lo, hi);
        imp_clearance_options asked = imp_clearance_options_default();
        imp_survey_options how = imp_survey_options_default();
        how.max_boxes = 10;
        asked.decide = true;
        asked.required = 1.0001 * nearest_of_values(&random, scene, lo, hi);
        if (asked.required > 0.01) {
            const answer found = survey(scene, 1e-3, &asked, &how);
            ck_assert_msg(found.near.verdict != IMP_REQUIREMENT_HOLDS, "%.17g is not kept: %s",
                          asked.required, text);
        }
        imp_scene_free(scene);
    }
}
END_TEST

/* --- Requirements with a coarse bracket ------------------------------------------------------- */

/* A random scene of rigid bodies that one parameter moves: it may be the time of all queries, so
 * that no box is ever halved. */
static imp_scene *scene_of_one_parameter(scene_writer *w, uint64_t *r)
{
    for (;;) {
        imp_scene *scene = write_scene(w, r, random_power(r, -2, 0), random_between(r, 1, 3), true);
        if (imp_scene_parameter_count(scene) == 1) return scene;
        imp_scene_free(scene);
    }
}

static imp_clearance bracket(imp_scene *scene, double gamma, double tolerance, double required)
{
    const imp_survey_options how = imp_survey_options_default();
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = tolerance;
    asked.required = required;
    return survey(scene, gamma, &asked, &how).near;
}

START_TEST(a_requirement_is_decided_however_coarse_the_bracket)
{
    uint64_t random = suite_seed() + 31 * (uint64_t)_i;
    static scene_writer w;
    const int scenes = suite_times(12);
    int exhausted = 0; /* too many pairs to tell D from the least distance */
    for (int n = 0; n < scenes; ++n) {
        imp_scene *scene = scene_of_one_parameter(&w, &random);
        const imp_clearance fine = bracket(scene, 1e-6, 1e-4, 0);
        const double lower = fine.lower, upper = fine.upper;
        const double required[] = {lower * random_between(&random, 0.5, 1),
                                   lower,
                                   upper,
                                   random_between(&random, lower, upper),
                                   lower * (1 - random_power(&random, -9, -3)),
                                   upper * (1 + random_power(&random, -9, -3))};
        for (size_t k = 0; k < sizeof required / sizeof *required && lower > 1e-3; ++k) {
            const double tolerance = random_between(&random, 0.05, 0.9), d = required[k];
            /* the search is not to end at a gamma above what is required */
            const double gamma = n % 2 == 0 ? 1e-6 : d * random_between(&random, 1, 3);
            const imp_clearance coarse = bracket(scene, gamma, tolerance, d);
            exhausted += coarse.reason == IMP_REASON_PAIRS;
            if (coarse.reason == IMP_REASON_PAIRS) continue;
            ck_assert_msg(
                coarse.verdict != IMP_REQUIREMENT_UNDECIDED,
                "--gamma %.17g --tolerance %.17g --require %.17g: undecided, reason %d: %s", gamma,
                tolerance, d, (int)coarse.reason, w.text);
            if (d <= lower) ck_assert_int_eq(coarse.verdict, IMP_REQUIREMENT_HOLDS);
            if (d > upper) ck_assert_int_eq(coarse.verdict, IMP_REQUIREMENT_VIOLATED);
        }
        imp_scene_free(scene);
    }
    ck_assert_int_le(exhausted, 1 + scenes / 6);
}
END_TEST

/* Two balls 1e-6 apart that the least change of either parameter, which no double halves, moves by
 * 2e-10. */
static const char apart_by_rounding[] =
    "{'parameters':{'c':[1,1.0000000000000002],'d':[1,1.0000000000000002]},'bodies':["
    "{'surfaces':[{'type':'sphere'}],'maps':[{'type':'translate','velocity':[0,1e6,0],"
    "'clock':'d'},{'type':'translate','offset':[[0,-1e6,0]]}]},"
    "{'surfaces':[{'type':'sphere'}],'maps':[{'type':'translate','velocity':[1e6,0,0],"
    "'clock':'c'},{'type':'translate','offset':[[-999997.999999,0,0]]}]}]}";

START_TEST(what_doubles_cannot_decide_is_unresolved)
{
    imp_scene *scene = scene_of(apart_by_rounding);
    const imp_clearance near = bracket(scene, 1e-9, 0.5, 1e-6);
    ck_assert_int_eq(near.verdict, IMP_REQUIREMENT_UNDECIDED);
    ck_assert_int_eq(near.reason, IMP_REASON_RESOLUTION);
    ck_assert(near.lower < 1e-6 && 1e-6 < near.upper);
    const imp_clearance less = bracket(scene, 1e-9, 0.5, 9e-7);
    ck_assert_int_eq(less.verdict, IMP_REQUIREMENT_HOLDS);
    ck_assert_int_eq(less.reason, IMP_REASON_NONE);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {
        {no_sample_is_nearer_than_what_is_proved_of_its_box, 4},
        {what_some_values_violate_is_never_proved, 4},
        {a_requirement_is_decided_however_coarse_the_bracket, 2},
        {what_doubles_cannot_decide_is_unresolved, 1},
    };
    return suite_main_loops("survey_samples", loops, sizeof loops / sizeof *loops, open_registry,
                            close_registry);
}
