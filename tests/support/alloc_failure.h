/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_ALLOC_FAILURE_H
#define TESTS_SUPPORT_ALLOC_FAILURE_H

#include <stdbool.h>
#include <stddef.h>

/* Every allocation fails once
 * ===========================
 * A program linked with $(alloc_failure_ldflags) has the allocations of core, of itself and, after
 * alloc_failure_begin, of jansson go through here. Those of plugins and of libc do not.
 *
 *     for (size_t n = 1; alloc_failure_begin(n), thing = thing_new(), alloc_failure_end(); ++n)
 *         check that thing is NULL and alloc_failure_live() is what it was                       */

/* From now on, the n-th allocation fails (from 1); 0: none does. */
void alloc_failure_begin(size_t n);

/* Back to normal. True if the n-th allocation was reached. */
bool alloc_failure_end(void);

/* Allocations since alloc_failure_begin. */
size_t alloc_failure_calls(void);

/* Blocks allocated and not freed. */
size_t alloc_failure_live(void);

#endif
