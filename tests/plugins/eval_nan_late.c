/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slab.h"

/* No numbers from t = 1/2 on. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    slab_eval(self, n, p, x, error);
    for (size_t k = 0; k < n; ++k)
        if (p[3 * k + 2] > 0.5) x[3 * k + 1] = NAN;
    return IMP_STATUS_OK;
}

static const imp_surface_type type =
    SLAB_TYPE("eval_nan_late", slab_create, slab_domain, eval, slab_rate, slab_include);
SLAB_PLUGIN("eval_nan_late", type);
