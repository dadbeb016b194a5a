/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slab.h"

/* Has no domain that a number could lie in. */
static void domain(const void *self, double lo[3], double hi[3])
{
    slab_domain(self, lo, hi);
    lo[2] = NAN;
}

static const imp_surface_type type =
    SLAB_TYPE("domain_nan", slab_create, domain, slab_eval, slab_rate, slab_include);
SLAB_PLUGIN("domain_nan", type);
