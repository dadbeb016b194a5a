/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SIDE_TRIAL_H
#define TESTS_SUPPORT_SIDE_TRIAL_H

#include <string.h>

#include "core/bounds/distance.h"
#include "core/scene/scene.h"
#include "tests/support/query_helpers.h"

/* Two surfaces and their trees, for tests of what is claimed of both as a whole. */

enum { TRIAL_TEXT = 3000 };

typedef struct trial {
    imp_scene *scene;
    const surface *s[2];
    tree *trees[2];
    distance_slips slips;
    distance_sides of;
    time_window times;
    char text[2][TRIAL_TEXT];
} trial;

/* Makes the scene of the texts, and its trees between two times. */
static inline void trial_open(trial *y, imp_registry *registry, double t0, double t1)
{
    imp_error error;
    y->scene = imp_scene_from_pair(registry, y->text[0], y->text[1], &error);
    ck_assert_msg(y->scene != NULL, "%s | %s: %s", y->text[0], y->text[1], error.text);
    y->slips = (distance_slips){.slip = {0, 0}};
    y->of = (distance_sides){.slips = &y->slips, .takes_orbits = true};
    for (int k = 0; k < 2; ++k) {
        const tree_plan plan = {.kind = TREE_MODELS, .t_start = t0, .t_end = t1};
        tree_growth growth = {0};
        y->s[k] = scene_surface(y->scene, (size_t)k, 0);
        ck_assert_int_eq(tree_new(y->s[k], &plan, &y->trees[k], &growth, &error), IMP_SUCCESS);
        y->of.node[k] = y->of.root[k] = tree_root(y->trees[k]);
    }
    y->times = pair_times(y->of.root[0], y->of.root[1]);
}

static inline void trial_end(trial *y)
{
    for (int k = 0; k < 2; ++k) tree_free(y->trees[k]);
    imp_scene_free(y->scene);
}

/* Computes the point at these parts of the domain's width and height. */
static inline void place_at(const surface *s, const double at[2], double t, double x[3])
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    const double p[3] = {lo[0] + at[0] * (hi[0] - lo[0]), lo[1] + at[1] * (hi[1] - lo[1]), t};
    ck_assert_int_eq(surface_eval(s, 1, p, x, NULL), IMP_STATUS_OK);
}

#endif
