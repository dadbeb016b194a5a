/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* The derivative by time is forgotten. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const imp_status status = wavy_formula_rate(self, region, rates);
    for (int i = 0; i < 3; ++i) rates->m[i][2] = 0;
    return status;
}
LIAR_RATE("liar_time", rate);
