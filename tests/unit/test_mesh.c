/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/built_plugins.h"
#include "tools/view/mesh.h"

/* Pictures state how far a surface is from the triangles drawn for it. */

static const char *const surfaces[] = {
    "sphere radius=2",
    "torus",
    "ellipsoid radii=1,2,3 ! twist rate=0.5 ! rotate rate=2",
    "spike",
    "ripple size=4,4 amplitude=0.2 wavelength=1 direction=1,1 speed=2",
    "cylinder ! bend curvature=0.3 ! translate velocity=-3,0,0"};

static size_t step_of(const double *at, size_t count, double x)
{
    size_t k = 0;
    while (k + 2 < count && at[k + 1] <= x) ++k;
    return k;
}

static double segment_distance(vec p, vec a, vec b)
{
    const vec ab = vec_sub(b, a);
    const double square = vec_dot(ab, ab), s = square > 0 ? vec_dot(vec_sub(p, a), ab) / square : 0;
    return vec_length(vec_sub(p, vec_along(a, s < 0 ? 0 : s > 1 ? 1 : s, ab)));
}

static double triangle_distance(vec p, vec a, vec b, vec c)
{
    const vec n = vec_cross(vec_sub(b, a), vec_sub(c, a));
    const bool inside = vec_dot(n, n) > 0 &&
                        vec_dot(vec_cross(vec_sub(b, a), vec_sub(p, a)), n) >= 0 &&
                        vec_dot(vec_cross(vec_sub(c, b), vec_sub(p, b)), n) >= 0 &&
                        vec_dot(vec_cross(vec_sub(a, c), vec_sub(p, c)), n) >= 0;
    if (inside) return fabs(vec_dot(vec_unit(n), vec_sub(p, a)));
    return fmin(segment_distance(p, a, b),
                fmin(segment_distance(p, b, c), segment_distance(p, c, a)));
}

/* How far the point x = (u,v) is from the triangles of its cell, of a surface of one piece. */
static double cell_distance(const mesh *m, double u, double v, vec x)
{
    const mesh_patch *g = &m->patches[0];
    const size_t i = step_of(mesh_u(m, g), g->nu, u), j = step_of(mesh_v(m, g), g->nv, v);
    const vec *p = m->point + i * g->nv + j;
    return fmin(triangle_distance(x, p[0], p[g->nv], p[g->nv + 1]),
                triangle_distance(x, p[0], p[g->nv + 1], p[1]));
}

static imp_registry *registry;

static void open_registry(void) { registry = built_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

static imp_scene *scene_of(const char *text)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, text, "point", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

/* Made for one time, and moved there. */
static void make_at(const imp_scene *scene, const mesh_plan *plan, mesh *m)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(mesh_make(scene, 0, 0, plan, m, &error) == IMP_SUCCESS, "%s", error.text);
    ck_assert_int_eq(mesh_move(scene, m, plan->times[0], NULL, &error), IMP_SUCCESS);
}

static double error_at(const imp_scene *scene, const mesh *m, double t)
{
    double upper;
    ck_assert_int_eq(mesh_error(scene, m, t, NULL, &upper, NULL), IMP_SUCCESS);
    return upper;
}

/* The greatest distance of points from what stands for them, at time t. */
static double worst_of(const imp_scene *scene, const mesh *m, double t)
{
    const mesh_patch *g = &m->patches[0];
    uint64_t random = suite_seed();
    double worst = 0;
    for (int k = 0; k < suite_times(4000); ++k) {
        const double u = random_between(&random, mesh_u(m, g)[0], mesh_u(m, g)[g->nu - 1]);
        const double v = random_between(&random, mesh_v(m, g)[0], mesh_v(m, g)[g->nv - 1]);
        const double p[3] = {u, v, t};
        double x[3];
        ck_assert_int_eq(imp_scene_eval(scene, 0, 0, 1, p, x, NULL, NULL), IMP_SUCCESS);
        worst = fmax(worst, cell_distance(m, u, v, vec_of(x)));
    }
    return worst;
}

static void check_surface(const char *text, double tolerance)
{
    const double t = 0.3;
    const mesh_plan plan = {.times = &t,
                            .time_count = 1,
                            .tolerance = tolerance,
                            .lines = 3,
                            .max_cells = 20000,
                            .focus_radius = INFINITY};
    imp_scene *scene = scene_of(text);
    mesh m;
    make_at(scene, &plan, &m);
    const double upper = error_at(scene, &m, t), worst = worst_of(scene, &m, t);
    ck_assert_msg(upper <= tolerance * 1.002, "%s: %g of %g", text, upper, tolerance);
    ck_assert_msg(worst <= upper, "%s: got %g, stated %g", text, worst, upper);
    ck_assert_msg(worst >= upper / 60, "%s: got %g, stated %g", text, worst, upper);
    for (size_t k = 0; k < m.point_count; ++k)
        ck_assert_double_le(fabs(vec_length(m.normal[k]) - 1), 1e-9);
    mesh_free(&m);
    imp_scene_free(scene);
}

START_TEST(no_point_is_farther_from_its_triangle_than_stated)
{
    for (size_t k = 0; k < sizeof surfaces / sizeof surfaces[0]; ++k) {
        check_surface(surfaces[k], 1e-1);
        check_surface(surfaces[k], 1e-2);
    }
}
END_TEST

START_TEST(cells_out_of_focus_stay_coarse)
{
    const double t = 0;
    const mesh_plan plan = {.times = &t,
                            .time_count = 1,
                            .tolerance = 1e-6,
                            .lines = 4,
                            .max_cells = 100000,
                            .focus_radius = 0.1,
                            .focus = {{1, 0, 0}}};
    imp_scene *scene = scene_of("sphere");
    mesh m;
    make_at(scene, &plan, &m);
    const mesh_patch *g = &m.patches[0];
    ck_assert_double_le(error_at(scene, &m, t), plan.tolerance * 1.002);
    ck_assert_uint_lt(m.point_count, 60000);
    ck_assert_double_gt(mesh_u(&m, g)[g->nu / 2 + 1] - mesh_u(&m, g)[g->nu / 2], 0.1);
    mesh_free(&m);
    imp_scene_free(scene);
}
END_TEST

/* --- What is rigid, and what is flat ---------------------------------------------------------- */

START_TEST(what_is_rigid_is_evaluated_once_and_moved)
{
    const double times[3] = {0, 0.4, 1};
    const mesh_plan plan = {.times = times,
                            .time_count = 3,
                            .tolerance = 1e-2,
                            .lines = 4,
                            .max_cells = 20000,
                            .focus_radius = INFINITY};
    imp_scene *scene = scene_of("torus ! rotate axis=1,0,0 rate=2 ! translate velocity=1,2,3");
    mesh m;
    make_at(scene, &plan, &m);
    ck_assert(m.is_rigid);
    for (size_t k = 0; k < 3; ++k) {
        ck_assert_int_eq(mesh_move(scene, &m, times[k], NULL, NULL), IMP_SUCCESS);
        ck_assert_double_le(worst_of(scene, &m, times[k]), error_at(scene, &m, times[k]));
    }
    mesh_free(&m);
    imp_scene_free(scene);
}
END_TEST

START_TEST(what_deforms_is_evaluated_at_each_time)
{
    const double times[2] = {0, 1};
    const mesh_plan plan = {.times = times,
                            .time_count = 2,
                            .tolerance = 1e-2,
                            .lines = 4,
                            .max_cells = 20000,
                            .focus_radius = INFINITY};
    imp_scene *scene = scene_of("cylinder ! twist rate=[0,2]");
    mesh m;
    make_at(scene, &plan, &m);
    ck_assert(!m.is_rigid);
    for (size_t k = 0; k < 2; ++k) {
        ck_assert_int_eq(mesh_move(scene, &m, times[k], NULL, NULL), IMP_SUCCESS);
        ck_assert_double_le(worst_of(scene, &m, times[k]), error_at(scene, &m, times[k]));
    }
    mesh_free(&m);
    imp_scene_free(scene);
}
END_TEST

/* How many triangles and steps of each kind a surface has. */
static void check_steps(const char *text, size_t triangles, size_t edges, size_t folds, bool lines)
{
    const double t = 0;
    const mesh_plan plan = {.times = &t,
                            .time_count = 1,
                            .tolerance = 1e-2,
                            .lines = 4,
                            .max_cells = 20000,
                            .focus_radius = INFINITY};
    imp_scene *scene = scene_of(text);
    imp_error error = {IMP_SUCCESS, ""};
    size_t count[3] = {0, 0, 0};
    mesh m;
    make_at(scene, &plan, &m);
    ck_assert_int_eq(mesh_find_steps(&m, 1, 2, NULL, &error), IMP_SUCCESS);
    for (size_t k = 0; k < m.step_count; ++k) ++count[m.steps[k].kind];
    if (triangles > 0) ck_assert_uint_eq(m.triangle_count, triangles);
    ck_assert_msg(count[MESH_EDGE] == edges, "%s: %zu edges", text, count[MESH_EDGE]);
    ck_assert_msg(count[MESH_FOLD] == folds, "%s: %zu folds", text, count[MESH_FOLD]);
    ck_assert_msg((count[MESH_LINE] > 0) == lines, "%s: %zu lines", text, count[MESH_LINE]);
    mesh_free(&m);
    imp_scene_free(scene);
}

START_TEST(limits_end_the_search_for_edges)
{
    const double t = 0;
    const mesh_plan plan = {.times = &t,
                            .time_count = 1,
                            .tolerance = 1e-2,
                            .lines = 4,
                            .max_cells = 20000,
                            .focus_radius = INFINITY};
    imp_scene *scene = scene_of("sphere");
    imp_error error = {IMP_SUCCESS, ""};
    allowance over;
    mesh m;
    make_at(scene, &plan, &m);
    allowance_begin(&over, 1e-12, 0);
    ck_assert_int_eq(mesh_find_steps(&m, 1, 2, &over, &error), IMP_ERROR_MEMORY);
    ck_assert(allowance_ended(&over) && strstr(error.text, "--max-seconds 1e-12 was over") != NULL);
    mesh_free(&m);
    imp_scene_free(scene);
}
END_TEST

START_TEST(flat_faces_show_their_edges_alone)
{
    check_steps("plane", 2, 4, 0, false);
    check_steps("triangle", 1, 3, 0, false);
    /* A square of two triangles: its diagonal is none of its edges. */
    check_steps("mesh points=[[0,0,0],[1,0,0],[1,1,0],[0,1,0]] faces=[[0,1,2],[0,2,3]]", 2, 4, 0,
                false);
    /* A cube of squares: its edges, and no diagonals. */
    check_steps("mesh points=[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]] "
                "faces=[[0,3,2,1],[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]",
                12, 12, 0, false);
    /* Two squares at 11 degrees. */
    check_steps("mesh points=[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[1,2,0.2],[0,2,0.2]] "
                "faces=[[0,1,2,3],[3,2,4,5]]",
                4, 6, 1, false);
    /* A knife: two squares folded back on each other. */
    check_steps("mesh points=[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[1,0.01,0.1],[0,0.01,0.1]] "
                "faces=[[0,1,2,3],[3,2,4,5]]",
                4, 7, 0, false);
}
END_TEST

START_TEST(curved_surfaces_show_lines_of_constant_parameters)
{
    check_steps("sphere", 0, 0, 0, true);
    check_steps("torus", 0, 0, 0, true);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {no_point_is_farther_from_its_triangle_than_stated,
                                  cells_out_of_focus_stay_coarse,
                                  what_is_rigid_is_evaluated_once_and_moved,
                                  what_deforms_is_evaluated_at_each_time,
                                  limits_end_the_search_for_edges,
                                  flat_faces_show_their_edges_alone,
                                  curved_surfaces_show_lines_of_constant_parameters};
    return suite_main_with("mesh", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
