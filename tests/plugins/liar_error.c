/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* An error bound that is too small: none at all. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = wavy_formula_eval(self, n, p, x, error);
    if (error != NULL) memset(error, 0, 3 * n * sizeof *error);
    return status;
}
LIAR_EVAL("liar_error", eval);
