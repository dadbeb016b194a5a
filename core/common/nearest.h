/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_NEAREST_H
#define CORE_COMMON_NEAREST_H

#include <stddef.h>

/* Spelling hints: "did you mean 'radius'?"
 * =========================================
 * Begin with {.wanted = what was written}, offer every valid name, read `best`. It stays NULL while no
 * name is near: one edit is allowed for every three letters written. Of equals the first is kept. */

#define NEAREST_NAME_MAX 63 /* bytes; longer names are near to nothing */

typedef struct nearest {
    const char *wanted;
    const char *best;
    size_t distance; /* of best, in edits */
} nearest;

void nearest_offer(nearest *search, const char *candidate);

/* Edits that turn a into b: a letter changed, inserted or removed, two neighbours swapped. SIZE_MAX
 * if one is longer than NEAREST_NAME_MAX. */
size_t nearest_distance(const char *a, const char *b);

#endif
