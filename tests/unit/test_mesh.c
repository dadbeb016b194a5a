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

/* The point of the triangles that stands for (u,v). */
static vec stand_in(const mesh *m, double u, double v)
{
    const size_t i = step_of(m->u, m->nu, u), j = step_of(m->v, m->nv, v), at = i * m->nv + j;
    const double s = (u - m->u[i]) / (m->u[i + 1] - m->u[i]);
    const double r = (v - m->v[j]) / (m->v[j + 1] - m->v[j]);
    const vec a = m->point[at], c = m->point[at + m->nv + 1];
    const vec b = s >= r ? m->point[at + m->nv] : m->point[at + 1];
    return s >= r ? vec_along(vec_along(a, s, vec_sub(b, a)), r, vec_sub(c, b))
                  : vec_along(vec_along(a, r, vec_sub(b, a)), s, vec_sub(c, b));
}

static void check_surface(imp_registry *registry, const char *text, double tolerance)
{
    const double t = 0.3;
    const mesh_plan plan = {.times = &t,
                            .time_count = 1,
                            .tolerance = tolerance,
                            .lines = 3,
                            .max_cells = 20000,
                            .focus_radius = INFINITY};
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, text, "point", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    mesh m;
    double upper;
    ck_assert_int_eq(mesh_make(scene, (imp_place){0, 0, 0}, &plan, &m, &error), IMP_SUCCESS);
    ck_assert_int_eq(mesh_move(scene, &m, t, &error), IMP_SUCCESS);
    ck_assert_int_eq(mesh_error(scene, &m, t, &upper, &error), IMP_SUCCESS);
    ck_assert_msg(upper <= tolerance, "%s: %g of %g", text, upper, tolerance);
    uint64_t random = suite_seed();
    double worst = 0;
    for (int k = 0; k < suite_times(4000); ++k) {
        const double u = random_between(&random, m.u[0], m.u[m.nu - 1]);
        const double v = random_between(&random, m.v[0], m.v[m.nv - 1]);
        const double p[3] = {u, v, t};
        double x[3];
        ck_assert_int_eq(imp_scene_eval(scene, 0, 0, 1, p, x, NULL, &error), IMP_SUCCESS);
        worst = fmax(worst, vec_length(vec_sub(vec_of(x), stand_in(&m, u, v))));
    }
    ck_assert_msg(worst <= upper, "%s: got %g, stated %g", text, worst, upper);
    ck_assert_msg(worst >= upper / 60, "%s: got %g, stated %g", text, worst, upper);
    for (size_t k = 0; k < m.nu * m.nv; ++k)
        ck_assert_double_le(fabs(vec_length(m.normal[k]) - 1), 1e-9);
    mesh_free(&m);
    imp_scene_free(scene);
}

START_TEST(no_point_is_farther_from_its_triangle_than_stated)
{
    imp_registry *registry = built_registry();
    for (size_t k = 0; k < sizeof surfaces / sizeof surfaces[0]; ++k) {
        check_surface(registry, surfaces[k], 1e-1);
        check_surface(registry, surfaces[k], 1e-2);
    }
    imp_registry_free(registry);
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
    imp_registry *registry = built_registry();
    imp_scene *scene = imp_scene_from_pair(registry, "sphere", "point", NULL);
    mesh m;
    imp_error error = {IMP_SUCCESS, ""};
    double upper;
    ck_assert_int_eq(mesh_make(scene, (imp_place){0, 0, 0}, &plan, &m, &error), IMP_SUCCESS);
    ck_assert_int_eq(mesh_error(scene, &m, t, &upper, &error), IMP_SUCCESS);
    ck_assert_double_le(upper, plan.tolerance);
    ck_assert_uint_lt(m.nu * m.nv, 60000);
    ck_assert_double_gt(m.u[m.nu / 2 + 1] - m.u[m.nu / 2], 0.1);
    mesh_free(&m);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("mesh", no_point_is_farther_from_its_triangle_than_stated,
           cells_out_of_focus_stay_coarse)
