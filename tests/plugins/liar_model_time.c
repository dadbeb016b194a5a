/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Models that say nothing depends on time, and are of the time in the middle. */
static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    const double lo[3] = {region->lo[0], region->lo[1], region->c[2]};
    const double hi[3] = {region->hi[0], region->hi[1], region->c[2]};
    const imp_region moment = imp_region_between(lo, hi);
    const imp_status status = wavy_formula_include(self, &moment, model);
    for (int i = 0; i < 3; ++i) {
        model[i].b[2] = model[i].q[IMP_UT] = model[i].q[IMP_VT] = model[i].q[IMP_TT] = 0;
        model[i].rate[2] = 0;
        model[i].depends &= 3;
    }
    return status;
}
LIAR_INCLUDE("liar_model_time", include);
