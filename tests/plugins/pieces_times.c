/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* The last piece is there for a while only, the others always. */
static void domain(const void *self, double lo[3], double hi[3])
{
    slab_domain(self, lo, hi);
    if (self == &stack_slabs[2]) hi[2] = 5;
}

static const imp_surface_type type = STACK_TYPE("pieces_times", domain, stack_count, stack_piece);
SLAB_PLUGIN("pieces_times", type);
