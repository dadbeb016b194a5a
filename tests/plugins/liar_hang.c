/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Does not come back from rate, over small regions. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    volatile bool waiting = region->d[0] < 1e-3;
    while (waiting) continue;
    return wavy_formula_rate(self, region, rates);
}
LIAR_RATE("liar_hang", rate);
