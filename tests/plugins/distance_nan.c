/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* What it may be off by is not a number. */
static imp_status distance(const void *self, const imp_model point[4], imp_model *g)
{
    const imp_status status = pipe_gap_distance(self, point, g);
    g->e = NAN;
    return status;
}
LIAR_DISTANCE("distance_nan", distance);
