/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <signal.h>

#include "slab.h"

/* Crashes when asked for its domain. */
static void domain(const void *self, double lo[3], double hi[3])
{
    raise(SIGSEGV);
    slab_domain(self, lo, hi);
}

static const imp_surface_type type =
    SLAB_TYPE("domain_crashes", slab_create, domain, slab_eval, slab_rate, slab_include);
SLAB_PLUGIN("domain_crashes", type);
