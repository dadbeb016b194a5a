/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* A fiftieth more than it is. */
static imp_status distance(const void *self, const imp_model point[4], imp_model *g)
{
    const imp_status status = pipe_gap_distance(self, point, g);
    *g = imp_scale(*g, 1.02);
    return status;
}
LIAR_DISTANCE("liar_distance", distance);
