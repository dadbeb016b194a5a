/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Remainders half as large as they have to be. */
static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    const imp_status status = wavy_formula_include(self, region, model);
    for (int i = 0; i < 3; ++i) model[i].e *= 0.5;
    return status;
}
LIAR_INCLUDE("liar_remainder", include);
