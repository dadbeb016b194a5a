/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <fenv.h>

#include "slab.h"

/* Asked for its domain, it leaves another rounding mode behind. */
static void domain(const void *self, double lo[3], double hi[3])
{
    fesetround(FE_UPWARD);
    slab_domain(self, lo, hi);
}

static const imp_surface_type type =
    SLAB_TYPE("domain_rounds", slab_create, domain, slab_eval, slab_rate, slab_include);
SLAB_PLUGIN("domain_rounds", type);
