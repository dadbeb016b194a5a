/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stddef.h>

#include "core/surface/surface_parts.h"

bool part_offers_distance(const imp_surface_type *type)
{
    return type->struct_size >= offsetof(imp_surface_type, distance) + sizeof type->distance &&
           type->distance != NULL;
}

bool surface_has_distance(const surface *s)
{
    return s->map_count == 0 && part_offers_distance(s->type);
}

/* A NaN or an infinity among the coefficients: nothing is known. Nothing is infinitely far away. */
static imp_status judge(imp_status status, const imp_model *distance)
{
    if (status != IMP_OK) return status;
    if (!(distance->e >= 0 && distance->lo <= distance->hi)) return SURFACE_BAD_DISTANCE;
    if (!(distance->lo < INFINITY && distance->hi > -INFINITY)) return SURFACE_BAD_DISTANCE;
    double sum = fabs(distance->a) + distance->e;
    for (int j = 0; j < 3; ++j) sum += fabs(distance->b[j]);
    for (int k = 0; k < 6; ++k) sum += fabs(distance->q[k]);
    return sum < INFINITY ? IMP_OK : IMP_UNBOUNDED;
}

imp_status surface_distance(const surface *s, const imp_region *region, const imp_model point[3],
                            imp_model *distance)
{
    if (!(s->lo[2] <= region->lo[2] && region->hi[2] <= s->hi[2])) return IMP_UNBOUNDED;
    const imp_model at[4] = {point[0], point[1], point[2], surface_time(region)};
    const fp_mode mode = surface_call_begin(s->type->name, "distance");
    const imp_status status = s->type->distance(s->self, at, distance);
    return judge(surface_call_end(mode, status), distance);
}
