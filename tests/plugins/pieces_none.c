/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* Has pieces, and none. */
static size_t count(const void *self)
{
    (void)self;
    return 0;
}

static const imp_surface_type type = STACK_TYPE("pieces_none", slab_domain, count, stack_piece);
SLAB_PLUGIN("pieces_none", type);
