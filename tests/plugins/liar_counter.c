/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* Another answer at every call: the last bit counts them. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    static unsigned calls;
    const imp_status status = wavy_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < 3 * n && calls % 2; ++k) x[k] = nextafter(x[k], INFINITY);
    ++calls;
    return status;
}
LIAR_EVAL("liar_counter", eval);
