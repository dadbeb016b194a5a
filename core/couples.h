/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COUPLES_H
#define CORE_COUPLES_H

#include "scene.h"
#include "time_of_impact.h"

/* How a query begins
 * ==================
 * Every surface that exists at any of the query's times gets its tree, whose root is a box around
 * all that the surface sweeps; those of different bodies whose boxes come within the clearance of
 * each other, unless their bodies ignore each other, are the couples that are searched. */

typedef struct couple_list {
    couple *couples; /* in the order of the scene */
    size_t count, capacity;
} couple_list;

/* Fills an empty list; the nodes made for it are added to `stats`. The trees are the scene's. After
 * a failure the list may be filled again. */
imp_code couples_find(couple_list *list, imp_scene *scene, const imp_options *options,
                      double clearance, imp_stats *stats, imp_error *error);

/* Why there are none: IMP_REASON_NO_PAIRS if no two bodies are to be tested with each other,
 * IMP_REASON_NO_TIME if no two that are exist at one time of the query, else IMP_REASON_NONE. */
imp_reason couples_reason_of_none(const imp_scene *scene, const imp_options *options);

void couples_clear(couple_list *list);

#endif
