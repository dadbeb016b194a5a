/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>

#include "slab.h"

/* Ends the process when asked for points, and says that all is well. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    if (n > 0) exit(0);
    return slab_eval(self, n, p, x, error);
}

static const imp_surface_type type =
    SLAB_TYPE("eval_exits", slab_create, slab_domain, eval, slab_rate, slab_include);
SLAB_PLUGIN("eval_exits", type);
