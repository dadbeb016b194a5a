/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* One error too many is written. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = wavy_formula_eval(self, n, p, x, error);
    if (error != NULL) error[3 * n] = 0;
    return status;
}
LIAR_EVAL("liar_beyond", eval);
