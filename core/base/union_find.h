/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_UNION_FIND_H
#define CORE_BASE_UNION_FIND_H

#include <stdbool.h>
#include <stddef.h>

/* Disjoint sets of 0, ..., count - 1 (union-find), in which each member has a sign relative to
 * every other member of its set: for patches, whether their orientations agree. Who needs no signs
 * joins with 1. */
typedef struct union_find {
    size_t *up;        /* a member of the same set; a root is its own */
    signed char *sign; /* relative to `up`, 1 or -1 */
} union_find;

/* Makes each member a set of its own. False: no memory; there is nothing to clear then. */
bool union_find_make(union_find *sets, size_t count);
void union_find_clear(union_find *sets);

size_t union_find_bytes(size_t count);

/* Returns the root of a member's set; *sign, unless NULL: the member's, relative to the root.
 * Shortens the path. */
size_t union_find_root(union_find *sets, size_t member, int *sign);

/* Joins the sets of two members whose signs have the product `sign`; the root of the first's set
 * becomes that of both. False: they were in one set, with the other product. */
bool union_find_join(union_find *sets, size_t a, size_t b, int sign);

#endif
