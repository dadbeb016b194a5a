/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* What create makes is never let go. */
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = malloc(100);
    return *self != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}
LIAR_SURFACE("liar_leak", create, tiny_destroy, wavy_formula_eval, wavy_formula_rate,
             wavy_formula_include);
