/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_SPELLING_H
#define CORE_COMMON_SPELLING_H

#include <stddef.h>

/* Spelling hints: "did you mean 'radius'?"
 * =========================================
 * Begin with {.wanted = what was written}, offer every valid name, read `best`. It stays NULL while
 * no name is near: one edit is allowed for every three letters written, and a name that was renamed
 * is near to what it became. Of equals the first is kept. */

#define SPELLING_NAME_MAX 63 /* bytes; longer names are near to nothing */

typedef struct spelling_search {
    const char *wanted;
    const char *best;
    size_t distance; /* of best, in edits */
} spelling_search;

void spelling_offer(spelling_search *search, const char *candidate);

/* Counts the edits that turn a into b: a letter changed, inserted or removed, two neighbours
 * swapped. SIZE_MAX if one of them is longer than SPELLING_NAME_MAX. */
size_t spelling_distance(const char *a, const char *b);

#endif
