/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* The axis of a pipe, which depends on v, as the line of a tube must not. */
static imp_status tube(const void *self, const imp_region *region, imp_tube *of)
{
    (void)self;
    of->line[0] = of->line[1] = imp_num(0);
    of->line[2] = imp_param(region, 1);
    of->radius = 1;
    return IMP_STATUS_OK;
}
LIAR_TUBE("tube_of_v", tube);
