/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_BALL_QUERIES_H
#define TESTS_SUPPORT_BALL_QUERIES_H

#include "core/base/unconst.h"
#include "tests/support/compose.h"
#include "tests/support/sphere_scenes.h"

#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/time.h>

#include <impinge/baseline.h>

/* Queries about two balls. */

static const ball at_rest = {.radius = 1};

static const ball flying = {.radius = 0.5, .centre = {2, 1.5, -1}, .velocity = {-2, -2, 1.2}};

static const ball elsewhere = {.radius = 0.5, .centre = {9, 9, 9}};

static inline imp_scene *two(const ball *a, const ball *b)
{
    return spheres_scene(&ball_type, a, &ball_type, b);
}

static inline imp_query *begin(imp_scene *scene, double gamma)
{
    imp_options options = imp_options_default(scene);
    options.t_start = 0, options.t_end = 1;
    options.gamma = gamma;
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    return query;
}

static inline imp_result step(imp_query *query, uint64_t pairs)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(imp_query_step(query, pairs, &error) == IMP_SUCCESS, "%s", error.text);
    return imp_query_result(query);
}

static inline imp_result solve(imp_scene *scene, double gamma)
{
    imp_query *query = begin(scene, gamma);
    const imp_result r = step(query, 0);
    imp_query_free(query);
    return r;
}

#endif
