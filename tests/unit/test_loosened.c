/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/sphere_scenes.h"

#include <impinge/baseline.h>

/* Bounds may be loose: that costs pairs and changes no verdict. The same ball under five types,
 * from models to rates twice as large as they need be, must meet within the ladder that
 * tests/support/scene_variants.h derives: later than t_lower at a coarser gamma, no later than the
 * contact at a finer one. */

/* --- Looser types ----------------------------------------------------------------------------- */

static imp_status double_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const imp_status status = ball_formula_rate(self, region, rates);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) rates->m[i][j] *= 2;
    return status;
}

/* Twice the remainder, and a range that is wider by it. */
static imp_status double_include(const void *self, const imp_region *region, imp_model model[3])
{
    const imp_status status = ball_formula_include(self, region, model);
    for (int i = 0; i < 3; ++i) {
        const double width = model[i].hi - model[i].lo;
        model[i].lo -= 0.5 * width;
        model[i].hi += 0.5 * width;
        model[i].e *= 2;
        for (int j = 0; j < 3; ++j) model[i].rate[j] *= 2;
    }
    return status;
}

/* No curvature: what was quadratic is remainder. */
static imp_status linear_include(const void *self, const imp_region *region, imp_model model[3])
{
    const imp_status status = ball_formula_include(self, region, model);
    for (int i = 0; i < 3; ++i) {
        double rest = model[i].e;
        for (int k = 0; k < 6; ++k) {
            rest += fabs(model[i].q[k]);
            model[i].q[k] = 0;
        }
        model[i].e = rest + rest * 0x1p-50;
    }
    return status;
}

#define LOOSE(NAME, RATE, INCLUDE)                                                                 \
    {                                                                                              \
        .name = NAME, .destroy = ball_destroy, .domain = ball_domain, .eval = ball_formula_eval,   \
        .rate = RATE, .include = INCLUDE                                                           \
    }
static const imp_surface_type types[] = {
    LOOSE("models", ball_formula_rate, ball_formula_include),
    LOOSE("twofold models", double_rate, double_include),
    LOOSE("linear models", ball_formula_rate, linear_include),
    LOOSE("rates", ball_formula_rate, NULL),
    LOOSE("twofold rates", double_rate, NULL),
};
enum { TYPES = sizeof types / sizeof *types };

/* --- Flights ---------------------------------------------------------------------------------- */

static const ball at_rest = {.radius = 1};
static const ball hits = {.radius = 0.5, .centre = {2, 1.5, -1}, .velocity = {-2, -2, 1.2}};
static const ball misses = {.radius = 0.5, .centre = {2, 1.5, -1}, .velocity = {-2, 0.5, 0}};

static imp_result solve(const imp_surface_type *a, const imp_surface_type *b, const ball *flying,
                        double gamma, uint32_t baseline)
{
    imp_scene *scene = spheres_scene(a, &at_rest, b, flying);
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    options.baseline = baseline;
    imp_result r = {.struct_size = sizeof r};
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s", error.text);
    imp_scene_free(scene);
    return r;
}

/* Every mixture of types, on the rung between gamma and gamma / 16. */
static void check_mixtures(double gamma, uint32_t baseline)
{
    const double before = solve(types, types, &hits, gamma, IMP_BASELINE_NONE).t_lower,
                 after = solve(types, types, &hits, gamma / 16, IMP_BASELINE_NONE).t;
    for (int k = 0; k < TYPES * TYPES; ++k) {
        const imp_surface_type *a = &types[k / TYPES], *b = &types[k % TYPES];
        imp_result r = solve(a, b, &hits, gamma / 4, baseline);
        ck_assert_msg(r.verdict == IMP_VERDICT_CONTACT && r.t >= before && r.t <= after,
                      "%s and %s: verdict %d, t_lower %.17g, expected in [%.17g, %.17g]", a->name,
                      b->name, (int)r.verdict, r.t_lower, before, after);
        r = solve(a, b, &misses, gamma / 4, baseline);
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CLEAR);
    }
}

START_TEST(looser_bounds_lead_to_the_same_contact) { check_mixtures(0.1, IMP_BASELINE_NONE); }
END_TEST

START_TEST(looser_rates_lead_the_paper_to_the_same_contact)
{
    check_mixtures(0.4, IMP_BASELINE_BOXES);
}
END_TEST

START_TEST(looser_bounds_cost_more_and_models_least)
{
    uint64_t pairs[TYPES];
    for (int k = 0; k < TYPES; ++k)
        pairs[k] = solve(&types[k], &types[k], &hits, 0.01, IMP_BASELINE_NONE).stats.pairs;
    ck_assert_uint_lt(pairs[0], pairs[2]);
    ck_assert_uint_lt(pairs[2], pairs[3]);
    ck_assert_uint_lt(pairs[3], pairs[4]);
}
END_TEST

SUITE_MAIN("loosened", looser_bounds_lead_to_the_same_contact,
           looser_rates_lead_the_paper_to_the_same_contact,
           looser_bounds_cost_more_and_models_least)
