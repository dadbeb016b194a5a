/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "nearest.h"

#include <string.h>

/* Longer names are never near: keeps the rows of the edit table on the stack. */
#define NAME_LIMIT 64

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* Edits from a to b, row by row: row[j] is the cost from a[0..i) to b[0..j); a swap of
 * neighbours looks two rows back. */
static size_t edit_count(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][NAME_LIMIT + 1];
    for (size_t j = 0; j <= b_length; ++j) rows[0][j] = j;
    for (size_t i = 1; i <= a_length; ++i) {
        size_t *row = rows[i % 3];
        const size_t *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; ++j) {
            row[j] = least(least(above[j], row[j - 1]) + 1,
                           above[j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], two_above[j - 2] + 1);
        }
    }
    return rows[a_length % 3][b_length];
}

nearest nearest_to(const char *wanted) { return (nearest){wanted, NULL, 0}; }

void nearest_offer(nearest *n, const char *candidate)
{
    const size_t a = strlen(n->wanted), b = strlen(candidate);
    if (a > NAME_LIMIT || b > NAME_LIMIT) return;
    const size_t edits = edit_count(n->wanted, a, candidate, b);
    if (edits > (a > b ? a : b) / 2) return;
    if (n->name != NULL && n->edits <= edits) return;
    n->name = candidate;
    n->edits = edits;
}
