/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tests/support/built_plugins.h"

/* imp_piece_motion: where it is known, it moves every point as the surface itself does; where a
 * surface deforms, it is not known. */

static imp_registry *registry;

static void open_registry(void) { registry = built_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

static imp_scene *scene_of(const char *surface)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, surface, "point", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static void check_points(const imp_scene *scene, const char *text, double from, double to)
{
    const imp_place at = {0, 0, 0};
    imp_rigid_motion motion;
    imp_error error = {IMP_SUCCESS, ""};
    double lo[3], hi[3];
    uint64_t random = suite_seed();
    imp_piece_domain(scene, at, lo, hi);
    ck_assert_msg(imp_piece_motion(scene, at, from, to, &motion, &error) == IMP_SUCCESS, "%s",
                  error.text);
    ck_assert_msg(motion.is_known, "%s from %g to %g", text, from, to);
    for (int k = 0; k < suite_times(50); ++k) {
        const double u = random_between(&random, lo[0], hi[0]);
        const double v = random_between(&random, lo[1], hi[1]);
        const double p[6] = {u, v, from, u, v, to};
        double x[6];
        ck_assert_int_eq(imp_piece_eval(scene, at, 2, p, x, NULL, &error), IMP_SUCCESS);
        for (int i = 0; i < 3; ++i) {
            double image = motion.shift[i];
            for (int j = 0; j < 3; ++j) image += motion.turn[i][j] * x[j];
            ck_assert_msg(fabs(image - x[3 + i]) <= 1e-8, "%s from %g to %g: %.17g, not %.17g",
                          text, from, to, image, x[3 + i]);
        }
    }
}

START_TEST(rigid_surfaces_are_where_their_motion_says)
{
    static const char *const all[] = {
        "sphere radius=2",
        "torus ! rotate axis=1,2,0 rate=2 center=1,0,3",
        "spike ! translate velocity=1,2,3 ! rotate rate=-7",
        "superellipsoid exponents=[0.2,1.5] ! screw axis=0,1,0 rate=3 pitch=0.5",
        "superellipsoid radii=1,2,3 ! scale factor=0.25 ! rotate rate=2 ! translate velocity=1,0,0",
        "cylinder ! twist rate=0.7 ! rotate axis=1,0,0 rate=3",
        "mesh points=[[0,0,0],[1,0,0],[0,1,0],[0,0,1]] faces=[[0,2,1],[0,1,3]] ! rotate rate=1",
        ("bezier degree=1,1 points=[[0,0,0],[0,1,0],[1,0,0],[1,1,1]] ! keyframes times=[0,1] "
         "positions=[[0,0,0],[1,1,1]] rotations=[[1,0,0,0],[0.8,0.6,0,0]]")};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k) {
        imp_scene *scene = scene_of(all[k]);
        check_points(scene, all[k], 0, 0.7);
        check_points(scene, all[k], 1, 0.25);
        check_points(scene, all[k], 0.5, 0.5);
        imp_scene_free(scene);
    }
}
END_TEST

START_TEST(surfaces_that_deform_have_no_motion)
{
    static const char *const all[] = {"ripple speed=2", "sphere ! twist rate=[0,0.5]",
                                      "torus ! rotate rate=2 ! bend curvature=0.3",
                                      ("mesh points=[[0,0,0],[1,0,0],[0,1,0]] faces=[[0,1,2]] "
                                       "velocities=[[0,0,0],[0,0,0],[0,0,1]]")};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k) {
        imp_scene *scene = scene_of(all[k]);
        imp_rigid_motion motion;
        ck_assert_int_eq(imp_piece_motion(scene, (imp_place){0, 0, 0}, 0, 1, &motion, NULL),
                         IMP_SUCCESS);
        ck_assert_msg(!motion.is_known, "%s", all[k]);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) ck_assert(motion.turn[i][j] == (i == j));
        imp_scene_free(scene);
    }
}
END_TEST

START_TEST(a_piece_that_moves_by_itself_is_told_from_one_that_does_not)
{
    imp_scene *scene =
        scene_of("mesh points=[[0,0,0],[1,0,0],[0,1,0],[0,0,1]] faces=[[0,1,2],[0,1,3]] "
                 "velocities=[[0,0,0],[0,0,0],[0,0,0],[0,0,1]] ! rotate rate=1");
    for (size_t piece = 0; piece < 2; ++piece) {
        imp_rigid_motion motion;
        ck_assert_int_eq(imp_piece_motion(scene, (imp_place){0, 0, piece}, 0, 1, &motion, NULL),
                         IMP_SUCCESS);
        ck_assert_int_eq(motion.is_known, piece == 0);
    }
    imp_scene_free(scene);
}
END_TEST

START_TEST(misuse_is_answered)
{
    imp_scene *scene = scene_of("sphere");
    imp_rigid_motion motion;
    imp_error error = {IMP_SUCCESS, ""};
    const imp_place at = {0, 0, 0};
    ck_assert_int_eq(imp_piece_motion(NULL, at, 0, 1, &motion, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_piece_motion(scene, at, 0, 1, NULL, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_piece_motion(scene, at, 0, NAN, &motion, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_piece_motion(scene, at, INFINITY, 0, &motion, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_piece_motion(scene, (imp_place){2, 0, 0}, 0, 1, &motion, &error),
                     IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_piece_motion(scene, (imp_place){0, 0, 1}, 0, 1, &motion, &error),
                     IMP_ERROR_USAGE);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        rigid_surfaces_are_where_their_motion_says, surfaces_that_deform_have_no_motion,
        a_piece_that_moves_by_itself_is_told_from_one_that_does_not, misuse_is_answered};
    return suite_main_with("rigid_motion", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
