/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_EXAMINED_TIMES_H
#define CORE_BROAD_PHASE_EXAMINED_TIMES_H

#include "core/base/limit_watch.h"
#include "core/scene/scene.h"

/* The times that a query examines
 * ===============================
 * Two surfaces are compared at the times at which both exist. Surfaces of some types do not exist
 * outside of their times (IMP_FLAG_ABSENT_OUTSIDE_TIMES), and touch nothing then. Other types and
 * maps are undefined outside of their times: nothing can be proved there, so a query that needs
 * such times is an error. */

typedef struct examined_times {
    bool any_pair; /* two surfaces are to be tested with each other */
    double lo, hi; /* first and last time at which such a pair exists; lo > hi: none */
} examined_times;

/* Finds the times that a query from t_start to t_end examines. IMP_ERROR_SCENE: the query needs
 * times at which a type or map is undefined; the message names the body, the type or map, and its
 * times. Where the watch ends it, *found is all of the query's times, and nothing is known of
 * undefined ones: `watch` must then end the query, too. */
imp_code examined_times_find(const imp_scene *scene, double t_start, double t_end,
                             const limit_watch *watch, examined_times *found, imp_error *error);

/* A watch that ends at a time of the clock; INFINITY: never. */
limit_watch examined_times_until(double *seconds);

#endif
