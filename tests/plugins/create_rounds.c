/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <fenv.h>

#include "tiny.h"

/* Leaves another rounding mode behind. */
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    fesetround(FE_UPWARD);
    return tiny_create(values, self, why);
}

static const imp_surface_type type = TINY_TYPE("create_rounds", create, tiny_eval, 0, NULL);
TINY_PLUGIN("create_rounds", type);
