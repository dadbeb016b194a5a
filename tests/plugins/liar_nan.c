/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* NaN, with good manners otherwise, for t > 1/2. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = wavy_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < n; ++k)
        if (p[3 * k + 2] > 0.5) x[3 * k] = NAN;
    return status;
}
LIAR_EVAL("liar_nan", eval);
