/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* The middle of its range, with nine tenths of what it may be off by. */
static imp_status distance(const void *self, const imp_model point[4], imp_model *g)
{
    const imp_status status = pipe_gap_distance(self, point, g);
    const double lo = g->lo, hi = g->hi;
    *g = imp_model_collapse(*g);
    g->e *= 0.9;
    g->lo = 2 * lo - hi;
    g->hi = 2 * hi - lo;
    return status;
}
LIAR_DISTANCE("liar_distance_remainder", distance);
