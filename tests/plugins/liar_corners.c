/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Rates as found at the corners of the region. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    return rate_of_grid(self, region, 2, rates);
}
LIAR_RATE("liar_corners", rate);
