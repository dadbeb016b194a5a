/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_NEAREST_H
#define TOOLS_NEAREST_H

#include <stddef.h>

/* Which valid name was meant?
 * ===========================
 * Feed candidates one by one; the best of those that need few enough edits (insert, delete,
 * replace, swap neighbours: at most half the length of the longer name) is kept. */

typedef struct nearest {
    const char *wanted;
    const char *name; /* best so far, or NULL: nothing is near */
    size_t edits;
} nearest;

nearest nearest_to(const char *wanted);
void nearest_offer(nearest *n, const char *candidate);

#endif
