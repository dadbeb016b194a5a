/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Rates 1 % low in 1 % of the domain. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    return rate_low_in_square(self, region, 0.4, 0.99, rates);
}
LIAR_RATE("liar_percent", rate);
