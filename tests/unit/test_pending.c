/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/region.h"
#include "tests/support/sphere_scenes.h"

/* What pictures are drawn from: inclusions of a scene's surfaces, and what a search has left to do.
 */

static const ball at_rest = {.radius = 1};
static const ball flying = {.radius = 0.5, .centre = {2, 1.5, -1}, .velocity = {-2, -2, 1.2}};

static imp_query *begin(imp_scene *scene)
{
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-3;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_ptr_nonnull(query);
    return query;
}

static bool covers(const struct imp_pending_side *side, size_t body, double u, double v)
{
    return side->body == body && side->surface == 0 && side->u[0] <= u && u <= side->u[1] &&
           side->v[0] <= v && v <= side->v[1];
}

/* Until when no pair that is left has the two points; the end if none ever has. */
static double clear_until(const imp_query *query, const double a[2], const double b[2], double end)
{
    imp_pending p;
    for (size_t i = 0; imp_query_pending(query, i, &p); ++i)
        if (p.t_lower < end && covers(&p.a, 0, a[0], a[1]) && covers(&p.b, 1, b[0], b[1]))
            end = p.t_lower;
    return end;
}

static double distance(const imp_scene *scene, const double a[2], const double b[2], double t)
{
    double x[2][3];
    const double p[2][3] = {{a[0], a[1], t}, {b[0], b[1], t}};
    for (size_t k = 0; k < 2; ++k)
        ck_assert_int_eq(imp_scene_eval(scene, k, 0, 1, p[k], x[k], NULL, NULL), IMP_SUCCESS);
    return hypot(hypot(x[0][0] - x[1][0], x[0][1] - x[1][1]), x[0][2] - x[1][2]);
}

/* Near the direction that a ball looks into when it meets the other, where pairs are left. */
static void draw(uint64_t *random, double u, double v, double p[2])
{
    p[0] = random_between(random, u - 0.5, u + 0.5);
    p[1] = random_between(random, v - 0.5, v + 0.5);
}

START_TEST(what_is_left_at_the_contact_covers_all_that_comes_near_later)
{
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &flying);
    imp_query *query = begin(scene);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    const imp_result r = imp_query_result(query);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    uint64_t random = suite_seed();
    int left = 0;
    for (int k = 0; k < suite_times(20000); ++k) {
        double a[2], b[2];
        draw(&random, r.a.u, r.a.v, a);
        draw(&random, r.b.u, r.b.v, b);
        const double until = clear_until(query, a, b, 1);
        ck_assert_double_ge(until, r.t_lower);
        left += until < 1;
        const double t = random_between(&random, 0, until);
        ck_assert_double_ge(distance(scene, a, b, t), r.gamma_clear);
    }
    ck_assert_int_gt(left, 0);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(nothing_is_left_of_what_is_clear)
{
    const ball elsewhere = {.radius = 0.5, .centre = {2, 0, 0}};
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &elsewhere);
    imp_query *query = begin(scene);
    imp_pending p;
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_result(query).verdict, IMP_VERDICT_CLEAR);
    ck_assert(!imp_query_pending(query, 0, &p));
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(before_the_candidate_pairs_are_collected_nothing_is_known)
{
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &flying);
    imp_options options = imp_options_default(scene);
    options.max_bytes = 1;
    imp_query *query = imp_query_new(scene, &options, NULL);
    imp_pending p;
    ck_assert_ptr_nonnull(query);
    ck_assert(!imp_query_pending(query, 0, &p));
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_uint_eq(imp_query_result(query).stats.pairs, 0);
    ck_assert(!imp_query_pending(query, 0, &p));
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* The polynomial of a model at s. */
static double model_at(const imp_model *m, const double s[3])
{
    double sum = m->a;
    for (int j = 0, jk = 0; j < 3; ++j) {
        sum += m->b[j] * s[j];
        for (int k = j; k < 3; ++k) sum += m->q[jk++] * s[j] * s[k];
    }
    return sum;
}

START_TEST(an_inclusion_of_a_scenes_surface_holds_its_points)
{
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &flying);
    uint64_t random = suite_seed();
    for (int k = 0; k < suite_times(2000); ++k) {
        const double u = random_between(&random, 0, 6), v = random_between(&random, -1.5, 1.3);
        const double width = random_power(&random, -12, -2);
        const double lo[3] = {u, v, 0.25}, hi[3] = {u + width, v + width, 0.25 + width};
        imp_model model[3];
        double p[3], s[3], x[3], error[3];
        for (int j = 0; j < 3; ++j) {
            p[j] = random_between(&random, lo[j], hi[j]);
            s[j] = (p[j] - 0.5 * (lo[j] + hi[j])) / (0.5 * (hi[j] - lo[j]));
        }
        ck_assert_int_eq(imp_scene_include(scene, 1, 0, lo, hi, model, NULL), IMP_SUCCESS);
        ck_assert_int_eq(imp_scene_eval(scene, 1, 0, 1, p, x, error, NULL), IMP_SUCCESS);
        for (int i = 0; i < 3; ++i) {
            const double slack = error[i] + 1e-14;
            ck_assert_double_le(fabs(model_at(&model[i], s) - x[i]), model[i].e + slack);
            ck_assert(model[i].lo - slack <= x[i] && x[i] <= model[i].hi + slack);
        }
    }
    imp_scene_free(scene);
}
END_TEST

START_TEST(regions_that_are_no_part_of_the_surface_are_refused)
{
    const double inside[2][3] = {{0, 0, 0}, {1, 1, 1}};
    const double wrong[][2][3] = {{{-1, 0, 0}, {1, 1, 1}},       {{0, 0, 0}, {1, 2, 1}},
                                  {{1, 0, 0}, {0, 1, 1}},        {{0, 0, 0}, {NAN, 1, 1}},
                                  {{0, 0, 0}, {1, 1, INFINITY}}, {{0, 0, -INFINITY}, {1, 1, 1}}};
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &flying);
    imp_model model[3];
    imp_error error;
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        ck_assert_int_eq(imp_scene_include(scene, 0, 0, wrong[k][0], wrong[k][1], model, &error),
                         IMP_ERROR_USAGE);
        ck_assert_ptr_nonnull(strstr(error.text, "must be finite and inside the domain"));
    }
    ck_assert_int_eq(imp_scene_include(scene, 2, 0, inside[0], inside[1], model, &error),
                     IMP_ERROR_USAGE);
    ck_assert_str_eq(error.text, "body 2 has no surface 0");
    imp_scene_free(scene);
}
END_TEST

SUITE_MAIN("pending", what_is_left_at_the_contact_covers_all_that_comes_near_later,
           nothing_is_left_of_what_is_clear,
           before_the_candidate_pairs_are_collected_nothing_is_known,
           an_inclusion_of_a_scenes_surface_holds_its_points,
           regions_that_are_no_part_of_the_surface_are_refused)
