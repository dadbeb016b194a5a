/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Rates as found on a grid of 5 x 5 x 5. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    return rate_of_grid(self, region, 5, rates);
}
LIAR_RATE("liar_grid", rate);
