/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* A wrong sign in include: of one mixed coefficient. */
static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    const imp_status status = wavy_formula_include(self, region, model);
    model[1].q[IMP_UV] = -model[1].q[IMP_UV];
    return status;
}
LIAR_INCLUDE("liar_sign", include);
