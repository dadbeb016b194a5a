/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Points computed in single precision, with the errors of double. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = wavy_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < 3 * n; ++k) x[k] = (float)x[k];
    return status;
}
LIAR_EVAL("liar_single", eval);
