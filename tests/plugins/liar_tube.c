/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* A pipe as it is, of which it says that it were nearer to its middle than its ends are. */
static imp_status tube(const void *self, const imp_region *region, imp_tube *of)
{
    (void)self, (void)region;
    for (int i = 0; i < 3; ++i) of->line[i] = imp_num(i == 2);
    of->radius = 1.41;
    return IMP_STATUS_OK;
}
LIAR_TUBE("liar_tube", tube);
