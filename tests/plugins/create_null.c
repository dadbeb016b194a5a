/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Says OK and gives nothing. */
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = NULL;
    return IMP_STATUS_OK;
}

static const imp_surface_type type = TINY_TYPE("create_null", create, tiny_eval, 0, NULL);
TINY_PLUGIN("create_null", type);
