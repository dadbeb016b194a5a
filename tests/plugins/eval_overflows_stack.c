/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slab.h"

/* Calls itself until the stack is used up. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    double deeper[3 * 64] = {p[0]};
    volatile double kept = p[0];
    if (n > 0) eval(self, n, deeper, x, error);
    return kept > 0 ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static const imp_surface_type type =
    SLAB_TYPE("eval_overflows_stack", slab_create, slab_domain, eval, slab_rate, slab_include);
SLAB_PLUGIN("eval_overflows_stack", type);
