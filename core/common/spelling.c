/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/spelling.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* Dynamic programming over prefixes: after round i, row[i % 3][j] is the distance of the
 * first i letters of a from the first j of b. Swaps of neighbours reach two rounds back. */
size_t spelling_distance(const char *a, const char *b)
{
    size_t row[3][SPELLING_NAME_MAX + 1];
    size_t n = strlen(a), m = strlen(b);
    if (n > SPELLING_NAME_MAX || m > SPELLING_NAME_MAX) return SIZE_MAX;
    for (size_t j = 0; j <= m; ++j) row[0][j] = j;
    for (size_t i = 1; i <= n; ++i) {
        size_t *now = row[i % 3], *before = row[(i + 2) % 3], *earlier = row[(i + 1) % 3];
        now[0] = i;
        for (size_t j = 1; j <= m; ++j) {
            size_t d = before[j - 1] + (a[i - 1] != b[j - 1]);
            d = least(d, least(before[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d = least(d, earlier[j - 2] + 1);
            now[j] = d;
        }
    }
    return row[n % 3][m];
}

/* Names of before, and what they became. */
static const char *const renamed[][2] = {{"clearance", "gamma_clear"},
                                         {"clearance", "gamma-clear"}};

static bool was_called(const char *name, const char *before)
{
    for (size_t k = 0; k < sizeof renamed / sizeof *renamed; ++k)
        if (strcmp(renamed[k][0], before) == 0 && strcmp(renamed[k][1], name) == 0) return true;
    return false;
}

void spelling_offer(spelling_search *search, const char *candidate)
{
    size_t allowed = (strlen(search->wanted) + 2) / 3;
    size_t d =
        was_called(candidate, search->wanted) ? 0 : spelling_distance(search->wanted, candidate);
    if (d > allowed || d >= strlen(candidate)) return;
    if (search->best != NULL && search->distance <= d) return;
    search->best = candidate;
    search->distance = d;
}
