/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* Says that there are more pieces than there can be. */
static size_t count(const void *self)
{
    (void)self;
    return SIZE_MAX;
}

static const imp_surface_type type = STACK_TYPE("pieces_many", slab_domain, count, stack_piece);
SLAB_PLUGIN("pieces_many", type);
