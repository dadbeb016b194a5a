/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Something inside goes wrong, always. */
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)self, (void)why;
    return IMP_STATUS_INTERNAL;
}

static const imp_surface_type type = TINY_TYPE("create_fails", create, tiny_eval, 0, NULL);
TINY_PLUGIN("create_fails", type);
