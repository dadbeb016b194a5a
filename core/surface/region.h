/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_REGION_H
#define CORE_SURFACE_REGION_H

#include <stdbool.h>

#include <impinge/surface.h>

/* Regions: boxes in p = (u, v, t), with the guarantees of imp_region. */

typedef enum parameter { PARAMETER_U, PARAMETER_V, PARAMETER_T } parameter;

/* Makes the region lo..hi; lo <= hi, finite. */
void region_set(imp_region *region, const double lo[3], const double hi[3]);
imp_region region_make(const double lo[3], const double hi[3]);

/* Whether a double lies strictly inside the interval of parameter j. */
static inline bool region_can_split(const imp_region *region, parameter j)
{
    return region->lo[j] < region->c[j] && region->c[j] < region->hi[j];
}

/* The half of the region below (side 0) or above (side 1) its centre along j. The two
 * share the identical split value. Precondition: region_can_split. */
void region_set_half(imp_region *half, const imp_region *region, parameter j, int side);

/* Returns sum_j rate_j d_j, rounded up: how far one coordinate can be from its value at the
 * centre. */
double region_reach_upper(const imp_region *region, const double rate[3]);

#endif
