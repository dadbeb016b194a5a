/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* A count of pieces, and no way to get at one. */
static const imp_surface_type type = STACK_TYPE("pieces_half", slab_domain, stack_count, NULL);
SLAB_PLUGIN("pieces_half", type);
