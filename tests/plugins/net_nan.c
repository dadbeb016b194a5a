/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slack_net.h"

/* A point of the net is not a number. */
static imp_status net(const void *self, const imp_region *region, imp_net *out)
{
    const imp_status status = slack_net(self, region, out);
    out->point[1][0] = NAN;
    return status;
}
LIAR_NET("net_nan", net);
