/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SPHERE_SCENES_H
#define TESTS_SUPPORT_SPHERE_SCENES_H

#include <impinge/formula.h>
#include <string.h>

#include "core/scene/scene.h"
#include "tests/support/compose.h"
#include "tests/support/suite.h"

/* Balls in flight: a surface type of the tests' own, without a plugin, and scenes of them. A test
 * varies the type's callbacks as it likes. */

typedef struct ball {
    double radius, centre[3], velocity[3];
    double start, end; /* when it exists; start == end == 0: always */
} ball;

static void ball_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const ball *b = self;
    imp_model su, cu, sv, cv;
    imp_sincos(u, &su, &cu);
    imp_sincos(v, &sv, &cv);
    const imp_model n[3] = {imp_mul(cv, cu), imp_mul(cv, su), sv};
    for (int i = 0; i < 3; ++i)
        out[i] = imp_add(imp_scale(n[i], b->radius),
                         imp_shift(imp_scale(t, b->velocity[i]), b->centre[i]));
}
IMP_SURFACE_FORMULA(ball_formula)

static inline void ball_domain(const void *self, double lo[3], double hi[3])
{
    const ball *b = self;
    const bool always = b->start == 0 && b->end == 0;
    lo[0] = 0, hi[0] = 6.3, lo[1] = -1.6, hi[1] = 1.6;
    lo[2] = always ? -INFINITY : b->start;
    hi[2] = always ? INFINITY : b->end;
}

static inline void ball_destroy(void *self) { (void)self; }

static IMP_UNUSED_ const imp_surface_type ball_type = {.name = "ball",
                                                       .flags = IMP_FLAG_ABSENT_OUTSIDE_TIMES,
                                                       .destroy = ball_destroy,
                                                       .domain = ball_domain,
                                                       .eval = ball_formula_eval,
                                                       .rate = ball_formula_rate,
                                                       .include = ball_formula_include};

/* Adds a body of one such surface; the ball must outlive the scene. */
static inline imp_code spheres_add(imp_scene *scene, const imp_surface_type *type, const ball *b)
{
    const imp_code code = scene_add_body(scene, "one");
    if (code != IMP_SUCCESS) return code;
    surface *s = surface_new(type, (void *)(uintptr_t)b);
    return s == NULL ? IMP_ERROR_MEMORY
                     : scene_add_surface(scene, imp_scene_body_count(scene) - 1, s);
}

/* Two bodies. */
static inline imp_scene *spheres_scene(const imp_surface_type *type_a, const ball *a,
                                       const imp_surface_type *type_b, const ball *b)
{
    imp_scene *scene = scene_new();
    ck_assert_ptr_nonnull(scene);
    ck_assert_int_eq(spheres_add(scene, type_a, a), IMP_SUCCESS);
    ck_assert_int_eq(spheres_add(scene, type_b, b), IMP_SUCCESS);
    return scene;
}

#endif
