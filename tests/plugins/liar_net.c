/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

#include "slack_net.h"

/* Nets whose errors are nine tenths of what they have to be. */
static imp_status net(const void *self, const imp_region *region, imp_net *out)
{
    const imp_status status = slack_net(self, region, out);
    for (int i = 0; i < 3; ++i) out->error[i] *= 0.9;
    return status;
}
LIAR_NET("liar_net", net);
