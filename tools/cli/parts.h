/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_PARTS_H
#define TOOLS_CLI_PARTS_H

#include <impinge/impinge.h>

#include "tools/cli/ordered_pool.h"

/* A query about each pair of bodies of a scene, by several threads
 * ================================================================
 * The query is divided (imp_query_divide); each part is solved to its end by one thread. The result
 * of a part does not depend on the others, so that the results do not depend on the number of
 * threads. */

typedef struct parts_plan {
    imp_query *whole; /* divided */
    size_t count;     /* of its parts */
    size_t threads;
    void (*take)(void *context, size_t index, imp_query *part); /* [any of the threads] */
    /* Called during the search, but not during `take`: parts without an answer so far are proved
     * clear before t_lower. False: stop. May be NULL. [one thread] */
    bool (*advance)(void *context, double t_lower);
    /* Whether to leave out parts that have not begun, because a limit of all parts is reached. May
     * be NULL. [any of the threads] */
    bool (*is_over)(void *context);
    void *context;
} parts_plan;

/* Solves part `index` and calls `take` with its answer. [any thread] */
imp_code parts_solve(const parts_plan *plan, size_t index, imp_error *error);

/* Solves all parts. With `advance` they take turns, a slice of pairs each, so that a hard part does
 * not delay the answers of the others. The error is that of the first part that fails, by turns and
 * in the order of the scene. */
imp_code parts_run(const parts_plan *plan, imp_error *error);

#endif
