/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Rates 20 % low in 0.04 % of the domain. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    return rate_low_in_square(self, region, 0.08, 0.8, rates);
}
LIAR_RATE("liar_spot", rate);
