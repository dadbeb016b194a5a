/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <signal.h>

#include "slab.h"

/* Crashes when asked for points. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    raise(SIGSEGV);
    return slab_eval(self, n, p, x, error);
}

static const imp_surface_type type =
    SLAB_TYPE("eval_crashes", slab_create, slab_domain, eval, slab_rate, slab_include);
SLAB_PLUGIN("eval_crashes", type);
