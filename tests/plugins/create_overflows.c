/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Complains at length, beyond the end of the complaint. */
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    volatile char *to = why->text;
    if (values[0].number[0] >= 0) return tiny_create(values, self, why);
    for (size_t k = 0; k < sizeof why->text + 20; ++k) to[k] = 'x';
    return IMP_STATUS_PARAMETER;
}

static const imp_parameter table[] = {{.name = "size",
                                       .unit = "length",
                                       .doc = "not negative",
                                       .default_value = "1",
                                       .kind = IMP_KIND_NUMBER,
                                       .min = -1,
                                       .max = 1}};
static const imp_surface_type type = TINY_TYPE("create_overflows", create, tiny_eval, 1, table);
TINY_PLUGIN("create_overflows", type);
