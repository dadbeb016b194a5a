/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Calls what nobody defines. */
double nobody_defines_this(void);

static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    return nobody_defines_this() > 0 ? IMP_STATUS_INTERNAL : tiny_create(values, self, why);
}

static const imp_surface_type type = TINY_TYPE("undefined_symbol", create, tiny_eval, 0, NULL);
TINY_PLUGIN("undefined_symbol", type);
