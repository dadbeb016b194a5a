/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* The second piece is missing. */
static const void *piece(const void *self, size_t k)
{
    (void)self;
    return k == 1 ? NULL : &stack_slabs[k];
}

static const imp_surface_type type = STACK_TYPE("pieces_null", slab_domain, stack_count, piece);
SLAB_PLUGIN("pieces_null", type);
