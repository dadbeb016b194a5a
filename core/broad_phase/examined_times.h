/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_EXAMINED_TIMES_H
#define CORE_BROAD_PHASE_EXAMINED_TIMES_H

#include "core/scene/scene.h"

/* The times that a query examines
 * ==============================
 * Two surfaces are compared at the times at which both exist. Outside of their times surfaces of
 * some types do not exist (IMP_FLAG_ABSENT_OUTSIDE_TIMES), and touch nothing. Any other type or map
 * leaves open where its surface is outside of its times: nothing can be proved about those, so a
 * query that needs them is refused. */

typedef struct examined_times {
    bool any_pair; /* two surfaces are to be tested with each other */
    double lo, hi; /* from the first to the last time at which two such exist together; lo > hi:
                      never within the query's times */
} examined_times;

/* Finds the times that a query from t_start to t_end examines. IMP_ERROR_SCENE names the body, the
 * type or map, and its times, where it needs times that these do not cover. */
imp_code examined_times_find(const imp_scene *scene, double t_start, double t_end,
                             examined_times *found, imp_error *error);

#endif
