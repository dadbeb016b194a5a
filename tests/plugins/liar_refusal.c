/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

#include <stdlib.h>

/* What create has made before it refuses is never let go. */
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    double *made = malloc(100);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made[0] = values[0].number[0];
    why->parameter = 0;
    if (made[0] < 0) return IMP_STATUS_PARAMETER;
    free(made);
    return tiny_create(values, self, why);
}

static const imp_parameter table[] = {{.name = "size",
                                       .unit = "length",
                                       .doc = "not negative",
                                       .default_value = "1",
                                       .kind = IMP_KIND_NUMBER,
                                       .min = -INFINITY,
                                       .max = INFINITY}};
static const imp_surface_type type = TINY_TYPE("liar_refusal", create, tiny_eval, 1, table);
TINY_PLUGIN("liar_refusal", type);
