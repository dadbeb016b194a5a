/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <fenv.h>

#include "slab.h"

/* Leaves another rounding mode behind with its bounds. */
static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    fesetround(FE_UPWARD);
    return slab_include(self, region, model);
}

static const imp_surface_type type =
    SLAB_TYPE("include_rounds", slab_create, slab_domain, slab_eval, slab_rate, include);
SLAB_PLUGIN("include_rounds", type);
