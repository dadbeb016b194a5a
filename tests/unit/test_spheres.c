/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

/* Earliest contacts of moving spheres, which have a closed form: |c(t)| = r_a + r_b (or the
 * difference, from inside) for the line of centres c(t) = c + v t. */

typedef struct flight {
    double c[3], v[3], ra, rb;
} flight;

/* Sphere A rests at the origin, B moves; the pipelines live as long as the caller's buffers. */
static question flight_question(const flight *f, char *a, char *b, size_t size, double gamma)
{
    snprintf(a, size, "sphere radius=%.17g", f->ra);
    snprintf(b, size,
             "sphere radius=%.17g center=%.17g,%.17g,%.17g ! translate velocity=%.17g,%.17g,%.17g",
             f->rb, f->c[0], f->c[1], f->c[2], f->v[0], f->v[1], f->v[2]);
    return (question){.a = a, .b = b, .gamma = gamma};
}

/* First t >= 0 with |c + v t| = reach, or INFINITY; c farther than reach. */
static double flight_time(const flight *f, double reach)
{
    const long double vv = f->v[0] * f->v[0] + f->v[1] * f->v[1] + f->v[2] * f->v[2];
    const long double cv = f->c[0] * f->v[0] + f->c[1] * f->v[1] + f->c[2] * f->v[2];
    const long double cc = f->c[0] * f->c[0] + f->c[1] * f->c[1] + f->c[2] * f->c[2];
    const long double disc = cv * cv - vv * (cc - (long double)reach * reach);
    return disc < 0 || cv >= 0 ? INFINITY : (double)((-cv - sqrtl(disc)) / vv);
}

static void random_direction(uint64_t *state, double n[3])
{
    double norm;
    do {
        for (int i = 0; i < 3; ++i) n[i] = random_between(state, -1, 1);
        norm = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    } while (!(norm > 0.1 && norm < 1));
    for (int i = 0; i < 3; ++i) n[i] /= norm;
}

START_TEST(spheres_in_general_directions_meet_when_the_formula_says)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(60); ++k) {
        flight f = {.ra = random_power(&state, -3, 1), .rb = random_power(&state, -3, 1)};
        double away[3], aside[3];
        random_direction(&state, away);
        random_direction(&state, aside);
        const double far = (f.ra + f.rb) * random_between(&state, 1.2, 4);
        for (int i = 0; i < 3; ++i) {
            f.c[i] = far * away[i];
            f.v[i] = -1.5 * f.c[i] + 0.3 * (f.ra + f.rb) * aside[i];
        }
        const double gamma = 1e-6 * (f.ra + f.rb);
        char a[256], b[512];
        const question q = flight_question(&f, a, b, sizeof b / 2, gamma);
        /* at most where the gap is gamma, at least where it is gamma / 2 */
        const double latest = flight_time(&f, f.ra + f.rb),
                     soonest = flight_time(&f, f.ra + f.rb + gamma);
        ck_assert(latest < 1);
        ask_contact(&q, latest, latest - soonest);
    }
}
END_TEST

START_TEST(near_misses_are_clear_and_near_hits_are_contacts)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(30); ++k) {
        /* B passes A at distance reach (1 + s): a miss by s for s > 0, a hit for s < 0 */
        flight f = {.ra = 1, .rb = 0.5};
        double n[3], w[3];
        random_direction(&state, n);
        random_direction(&state, w);
        const double along = n[0] * w[0] + n[1] * w[1] + n[2] * w[2];
        const bool miss = k % 2 == 0;
        const double pass = 1.5 + (miss ? 4e-6 : -4e-6);
        for (int i = 0; i < 3; ++i) {
            const double across = w[i] - along * n[i];
            f.v[i] = 8 * across;
            f.c[i] = pass * n[i] - 4 * across;
        }
        char a[256], b[512];
        const question q = flight_question(&f, a, b, sizeof b / 2, 1e-6);
        if (miss)
            ask_clear(&q);
        else
            ask_contact(&q, flight_time(&f, 1.5), 2e-3);
    }
}
END_TEST

START_TEST(grazing_contact_is_never_reported_clear)
{
    /* the gap falls to exactly 0 at t = 0.5 and grows again */
    const question q = {
        .a = "sphere", .b = "sphere center=-2,2,0 ! translate velocity=4,0,0", .gamma = 1e-6};
    ask_contact(&q, 0.5, 1e-3);
}
END_TEST

START_TEST(contact_at_the_start_is_reported_at_the_start)
{
    const question apart_slowly = {.a = "sphere",
                                   .b = "sphere center=1.2,0.9,1.0 ! translate velocity=1,1,1"};
    const imp_result r = ask_contact(&apart_slowly, 0, 0);
    ck_assert(r.t == 0);
    const question touching = {.a = "sphere",
                               .b = "sphere center=2,0,0 ! translate velocity=1,0,0"};
    ask_contact(&touching, 0, 0);
    const question late = {.a = "sphere", .b = "sphere center=2,1,0", .t_start = 7, .t_end = 9};
    ck_assert_int_eq(ask(&late).verdict, IMP_VERDICT_CLEAR);
    const question later = {.a = "sphere", .b = "sphere center=1,1,0", .t_start = 7, .t_end = 9};
    ask_contact(&later, 7, 0);
}
END_TEST

START_TEST(contact_at_the_very_end_is_found_and_just_after_the_end_is_clear)
{
    const question at_end = {.a = "sphere", .b = "sphere center=3,0,0 ! translate velocity=-1,0,0"};
    ask_contact(&at_end, 1, 1e-6);
    const question after = {.a = "sphere",
                            .b = "sphere center=3.00001,0,0 ! translate velocity=-1,0,0"};
    ask_clear(&after);
}
END_TEST

START_TEST(a_small_sphere_inside_a_hollow_one_touches_nothing_until_it_reaches_the_wall)
{
    const question inside = {.a = "sphere radius=3", .b = "sphere ! translate velocity=1,0.5,0"};
    ask_clear(&inside);
    const question reaches = {.a = "sphere radius=3", .b = "sphere ! translate velocity=3,4,0"};
    ask_contact(&reaches, 0.4, 2e-7 + 1e-12);
}
END_TEST

START_TEST(a_query_of_one_moment_is_answered)
{
    const question hit = {.a = "sphere",
                          .b = "sphere center=3,0,0 ! translate velocity=-1,0,0",
                          .t_start = 1.5,
                          .t_end = 1.5};
    ask_contact(&hit, 1.5, 0);
    const question miss = {.a = "sphere",
                           .b = "sphere center=3,0,0 ! translate velocity=-1,0,0",
                           .t_start = 0.5,
                           .t_end = 0.5};
    ask_clear(&miss);
}
END_TEST

START_TEST(the_normal_points_from_a_to_b_along_the_line_of_centres)
{
    const question q = {.a = "sphere", .b = "sphere center=3,4,0 ! translate velocity=-3,-4,0"};
    const imp_result r = ask_contact(&q, 0.6, 2e-7 + 1e-12);
    ck_assert(r.has_normal);
    ck_assert_double_le(fabs(r.normal[0] - 0.6) + fabs(r.normal[1] - 0.8) + fabs(r.normal[2]),
                        1e-3);
}
END_TEST

/* query_distance computes squares, which are 0 here. */
START_TEST(a_gap_whose_square_underflows_is_told_and_no_contact_of_a_smaller_gamma)
{
    question q = {.a = "point velocity=1,1,0", .b = "point position=1e-170,0,0", .gamma = 1e-160};
    imp_registry *registry = query_registry();
    imp_scene *scene = imp_scene_from_pair(registry, q.a, q.b, NULL);
    imp_options options = query_options(scene, &q);
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.gap == 1e-170);
    ck_assert(r.has_normal && r.normal[0] == 1);
    options.gamma = 1e-200;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
    ck_assert(r.verdict != IMP_VERDICT_CONTACT);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(every_form_of_the_paper_agrees_with_the_models)
{
    question q = {.a = "sphere center=-2,0.3,0.1 ! translate velocity=2,0,0",
                  .b = "sphere center=2,0,0 ! translate velocity=-2,0.1,0",
                  .gamma = 0.2};
    const imp_result best = ask(&q);
    ck_assert_int_eq(best.verdict, IMP_VERDICT_CONTACT);
    const uint32_t volumes[] = {IMP_BASELINE_BOXES, IMP_BASELINE_SPHERES},
                   rates[] = {0, IMP_BASELINE_COLUMN_RATES, IMP_BASELINE_CONSTANT_RATES};
    for (int k = 0; k < 6; ++k) {
        q.baseline = volumes[k / 3] | rates[k % 3];
        const imp_result r = ask(&q);
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        ck_assert_double_le(fabs(r.t - best.t), 0.1);
    }
}
END_TEST

START_TEST(the_same_question_has_the_same_answer_bit_for_bit)
{
    const question q = {.a = "torus ! rotate axis=1,2,3 rate=2",
                        .b = "sphere center=2,1,1 ! translate velocity=-2,-1,-1",
                        .gamma = 1e-7};
    const imp_result first = ask(&q), second = ask(&q);
    ck_assert(first.t == second.t && first.gap == second.gap);
    ck_assert(first.a.u == second.a.u && first.b.v == second.b.v);
    ck_assert_uint_eq(first.stats.pairs, second.stats.pairs);
    ck_assert_uint_eq(first.stats.nodes, second.stats.nodes);
}
END_TEST

SUITE_MAIN("spheres", spheres_in_general_directions_meet_when_the_formula_says,
           near_misses_are_clear_and_near_hits_are_contacts,
           grazing_contact_is_never_reported_clear, contact_at_the_start_is_reported_at_the_start,
           contact_at_the_very_end_is_found_and_just_after_the_end_is_clear,
           a_small_sphere_inside_a_hollow_one_touches_nothing_until_it_reaches_the_wall,
           a_query_of_one_moment_is_answered,
           the_normal_points_from_a_to_b_along_the_line_of_centres,
           a_gap_whose_square_underflows_is_told_and_no_contact_of_a_smaller_gamma,
           every_form_of_the_paper_agrees_with_the_models,
           the_same_question_has_the_same_answer_bit_for_bit)
