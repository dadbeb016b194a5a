/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/rough_sheets.h"

/* Answers about meshes agree with those about their triangles. */

/* --- Answers ---------------------------------------------------------------------------------- */

static imp_result solve(imp_scene *scene, uint32_t baseline)
{
    imp_options options = imp_options_default(scene);
    options.baseline = baseline;
    options.gamma = baseline == IMP_BASELINE_BOXES ? 1e-2 : 1e-4;
    options.audit = baseline == IMP_BASELINE_NONE;
    imp_result r = {.struct_size = sizeof r};
    imp_error error;
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s", error.text);
    return r;
}

/* The witness of one side is where its piece is. */
static void expect_point(const imp_scene *scene, const imp_side *side, double t)
{
    const double p[3] = {side->u, side->v, t};
    double x[3];
    const imp_place at = {side->body, side->surface, side->piece};
    ck_assert_int_eq(imp_piece_eval(scene, at, 1, p, x, NULL, NULL), IMP_SUCCESS);
    ck_assert_mem_eq(x, side->point, sizeof x);
}

static void compare(sheet sheets[2], const char *motion, uint32_t baseline)
{
    imp_scene *whole = scene_of(sheets, motion, true), *apart = scene_of(sheets, motion, false);
    const imp_result a = solve(whole, baseline), b = solve(apart, baseline);
    ck_assert_int_eq(a.verdict, b.verdict);
    ck_assert_double_eq_tol(a.t_lower, b.t_lower, a.gamma);
    if (a.verdict == IMP_VERDICT_CONTACT) {
        ck_assert_double_le(a.gap, a.gamma);
        expect_point(whole, &a.a, a.t);
        expect_point(whole, &a.b, a.t);
        ck_assert_uint_lt(a.b.piece, FACES);
        ck_assert_uint_eq(a.a.surface, 0);
        ck_assert_uint_eq(b.a.piece, 0);
    }
    imp_scene_free(whole);
    imp_scene_free(apart);
}

START_TEST(a_mesh_meets_another_when_their_triangles_do)
{
    uint64_t random = suite_seed();
    for (int k = 0; k < suite_times(3); ++k)
        for (int m = 0; m < MOTIONS; ++m) {
            sheet sheets[2] = {rough_sheet(&random, 0, 0.1), rough_sheet(&random, 1.2, m % 2)};
            compare(sheets, motions[m], IMP_BASELINE_NONE);
            if (k == 0 && m == 1) compare(sheets, motions[m], IMP_BASELINE_BOXES);
        }
}
END_TEST

START_TEST(a_mesh_keeps_the_distance_that_its_triangles_keep)
{
    uint64_t random = suite_seed();
    sheet sheets[2] = {rough_sheet(&random, 0, 0), rough_sheet(&random, 3, 0.5)};
    double bracket[2][2];
    for (int whole = 0; whole < 2; ++whole) {
        imp_scene *scene = scene_of(sheets, motions[1], whole);
        const imp_options options = imp_options_default(scene);
        imp_query *query = imp_clearance_new(scene, &options, NULL, NULL);
        ck_assert_ptr_nonnull(query);
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        imp_clearance answer = {.struct_size = sizeof answer};
        ck_assert_int_eq(imp_clearance_get(query, 0, &answer, NULL), IMP_SUCCESS);
        ck_assert(answer.has_witness && answer.reason == IMP_REASON_NONE);
        expect_point(scene, &answer.a, answer.t);
        expect_point(scene, &answer.b, answer.t);
        bracket[whole][0] = answer.lower, bracket[whole][1] = answer.upper;
        imp_query_free(query);
        imp_scene_free(scene);
    }
    ck_assert(bracket[0][0] <= bracket[1][1] && bracket[1][0] <= bracket[0][1]);
    ck_assert_double_le(bracket[1][1] - bracket[1][0], 1.001e-3 * bracket[1][1]);
}
END_TEST

START_TEST(finer_answers_of_a_mesh_agree_with_those_found_afresh)
{
    uint64_t random = suite_seed();
    sheet sheets[2] = {rough_sheet(&random, 0, 0), rough_sheet(&random, 1.2, 0)};
    imp_scene *scene = scene_of(sheets, motions[2], true);
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_result(query).verdict, IMP_VERDICT_CONTACT);
    ck_assert_int_eq(imp_query_refine(query, 1e-8, -1, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    const imp_result fine = imp_query_result(query);
    ck_assert_int_eq(fine.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_le(fine.gap, 1e-8);
    imp_options finer = options;
    finer.gamma = 1e-8;
    imp_result afresh = {.struct_size = sizeof afresh};
    ck_assert_int_eq(imp_scene_solve(scene, &finer, &afresh, NULL), IMP_SUCCESS);
    ck_assert_double_eq_tol(fine.t, afresh.t, 1e-7);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* --- Limits ----------------------------------------------------------------------------------- */

/* A scene of the surfaces of another one, the second moved as it is there. */
static imp_scene *again(const imp_scene *scene, const double velocity[3])
{
    imp_error error;
    imp_builder *builder = imp_builder_new(registry);
    const imp_argument moved = imp_argument_list("velocity", velocity, 3);
    for (size_t b = 0; b < 2; ++b) {
        ck_assert_int_eq(imp_builder_body(builder, b == 0 ? "a" : "b", NULL, &error), IMP_SUCCESS);
        ck_assert_int_eq(imp_builder_surface_of(builder, b, scene, b, 0, &error), IMP_SUCCESS);
    }
    ck_assert_int_eq(imp_builder_map(builder, 1, "translate", &moved, 1, &error), IMP_SUCCESS);
    imp_scene *made = imp_builder_finish(builder, &error);
    ck_assert_msg(made != NULL, "%s", error.text);
    imp_builder_free(builder);
    return made;
}

static size_t pieces_made(const imp_scene *scene, size_t body)
{
    size_t made = 0;
    for (size_t k = 0; k < FACES; ++k) made += scene_surface(scene, body, 0)->pieces->is_made[k];
    return made;
}

START_TEST(a_scene_of_shared_meshes_makes_and_evaluates_the_pieces_it_reaches)
{
    uint64_t random = suite_seed();
    const double down[3] = {0, 0.2, -1.5}, slow[3] = {0, 0.2, -0.5};
    sheet sheets[2] = {rough_sheet(&random, 0, 0.1), rough_sheet(&random, 1.2, 0)};
    imp_scene *first = scene_of(sheets, motions[1], true);
    const imp_result expected = solve(first, IMP_BASELINE_NONE);
    ck_assert_int_eq(expected.verdict, IMP_VERDICT_CONTACT);
    ck_assert_uint_eq(pieces_made(first, 0), FACES); /* for the hierarchy */
    imp_scene *second = again(first, down), *apart = again(first, slow);
    imp_options options = imp_options_default(second);
    options.gamma = expected.gamma;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(second, &options, &r, NULL), IMP_SUCCESS);
    ck_assert(r.t == expected.t && r.a.piece == expected.a.piece && r.b.piece == expected.b.piece);
    ck_assert_uint_eq(r.stats.pairs, expected.stats.pairs);
    ck_assert_uint_gt(pieces_made(second, 0), 0);
    ck_assert(pieces_made(second, 1) > 0 && pieces_made(second, 1) < FACES);
    ck_assert_int_eq(imp_scene_solve(apart, &options, &r, NULL), IMP_SUCCESS);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CLEAR);
    ck_assert_uint_eq(pieces_made(apart, 0) + pieces_made(apart, 1), 0);
    imp_scene_free(first);
    imp_scene_free(second);
    imp_scene_free(apart);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_mesh_meets_another_when_their_triangles_do,
        a_mesh_keeps_the_distance_that_its_triangles_keep,
        finer_answers_of_a_mesh_agree_with_those_found_afresh,
        a_scene_of_shared_meshes_makes_and_evaluates_the_pieces_it_reaches,
    };
    return suite_main_with("piece_answers", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
