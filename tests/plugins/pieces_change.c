/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* Gives another instance each time it is asked. */
static slab copies[64];
static int used;

static const void *piece(const void *self, size_t k)
{
    slab *copy = &copies[used++ % 64];
    (void)self;
    *copy = stack_slabs[k];
    return copy;
}

static const imp_surface_type type = STACK_TYPE("pieces_change", slab_domain, stack_count, piece);
SLAB_PLUGIN("pieces_change", type);
