/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_COMMUTE_H
#define CORE_SURFACE_COMMUTE_H

#include "core/surface/surface_internal.h"

/* Maps that commute: shifts, turns about one line, and turns with shifts along their line. */

typedef enum map_kind { MAP_SHIFTS, MAP_TURNS_ABOUT_LINE, MAP_IS_OTHER } map_kind;

/* What a map does at all times of its pose. */
typedef struct map_law {
    map_kind kind;
    bool moves;                    /* it depends on time */
    imp_model way[3];              /* of a shift; length */
    double point[3], direction[3]; /* of the line, exact; length, any */
} map_law;

/* Precondition: the map's turns are exact rotations. */
map_law map_law_of(const imp_pose *pose);

/* Bounds |X Y p - Y X p| for all points p of space, at all times: 0 where they commute. INFINITY:
 * it is not known. */
double map_laws_exchange_upper(const map_law *x, const map_law *y);

#endif
