/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slab.h"

/* Rises four times as fast as it says. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    slab_rate(self, region, rates);
    rates->m[2][2] = 0.25;
    return IMP_STATUS_OK;
}

static const imp_surface_type type =
    SLAB_TYPE("rate_lies", slab_create, slab_domain, slab_eval, rate, NULL);
SLAB_PLUGIN("rate_lies", type);
