/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_STACK_H
#define TESTS_PLUGINS_STACK_H

#include "slab.h"

/* Three slabs one above the other, at 0, 1 and 2, as the pieces of one instance. Each plugin beside
 * this file takes it and commits one sin. */

static const slab stack_slabs[3] = {{0}, {1}, {2}};

static inline size_t stack_count(const void *self)
{
    (void)self;
    return 3;
}

static inline const void *stack_piece(const void *self, size_t k)
{
    (void)self;
    return &stack_slabs[k];
}

#define STACK_TYPE(NAME, DOMAIN, COUNT, PIECE)                                                     \
    {                                                                                              \
        .struct_size = sizeof(imp_surface_type), .parameter_count = 1,                             \
        .parameter_size = sizeof(imp_parameter), .name = (NAME), .summary = "three squares",       \
        .equation = "(u, v, k + t)", .example = (NAME), .parameters = slab_table,                  \
        .create = slab_create, .destroy = slab_destroy, .domain = (DOMAIN), .eval = slab_eval,     \
        .rate = slab_rate, .include = slab_include, .piece_count = (COUNT), .piece = (PIECE),      \
    }

#endif
