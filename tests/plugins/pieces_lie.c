/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* The last piece rises faster than its inclusion says. */
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = slab_eval(self, n, p, x, error);
    for (size_t k = 0; self == &stack_slabs[2] && k < n; ++k) x[3 * k + 2] += p[3 * k + 2];
    return status;
}

#define slab_eval eval
static const imp_surface_type type =
    STACK_TYPE("pieces_lie", slab_domain, stack_count, stack_piece);
SLAB_PLUGIN("pieces_lie", type);
