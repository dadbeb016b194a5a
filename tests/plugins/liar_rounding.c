/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

#include <fenv.h>

/* The rounding mode is left behind. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    const imp_status status = wavy_formula_rate(self, region, rates);
    fesetround(FE_UPWARD);
    return status;
}
LIAR_RATE("liar_rounding", rate);
