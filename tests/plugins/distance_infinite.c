/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* Everything is infinitely far away. */
static imp_status distance(const void *self, const imp_model point[4], imp_model *g)
{
    const imp_status status = pipe_gap_distance(self, point, g);
    g->lo = g->hi = INFINITY;
    return status;
}
LIAR_DISTANCE("distance_infinite", distance);
