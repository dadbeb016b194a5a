/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_HEAP_GROWTH_H
#define TOOLS_CHECK_HEAP_GROWTH_H

#include <stdbool.h>

/* Whether an operation that is repeated leaks memory. */

/* No block is smaller; bytes. */
#define HEAP_BLOCK_LEAST 16.0

/* Returns the least growth of the heap, in bytes, by that many repetitions: malloc caches up to
 * some 200 kB of free blocks, so that the heap may grow in many rounds without a leak; a leak grows
 * it in each, by HEAP_BLOCK_LEAST or more. Negative: unknown. 0, too, where `repeated` answers
 * false: it is impossible. */
double heap_growth_lower(bool (*repeated)(const void *), const void *context, int rounds);

#endif
