/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "stack.h"

/* In order: what the others beside it get wrong. */
static const imp_surface_type type = STACK_TYPE("pieces", slab_domain, stack_count, stack_piece);
SLAB_PLUGIN("pieces", type);
