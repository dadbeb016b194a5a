/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slab.h"

/* The range has the greater end first. */
static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    slab_include(self, region, model);
    model[0].lo = 1;
    model[0].hi = -1;
    return IMP_STATUS_OK;
}

static const imp_surface_type type =
    SLAB_TYPE("include_inverted", slab_create, slab_domain, slab_eval, slab_rate, include);
SLAB_PLUGIN("include_inverted", type);
