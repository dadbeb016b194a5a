/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slab.h"

/* Better than exact. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    slab_eval(self, n, p, x, error);
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = -1;
    return IMP_STATUS_OK;
}

static const imp_surface_type type =
    SLAB_TYPE("eval_error_negative", slab_create, slab_domain, eval, slab_rate, slab_include);
SLAB_PLUGIN("eval_error_negative", type);
