/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/columns.h"

#include <stdlib.h>

static int ascending(const void *p, const void *q)
{
    const double a = *(const double *)p, b = *(const double *)q;
    return a < b ? -1 : a > b;
}

double columns_median(double *x, size_t count)
{
    qsort(x, count, sizeof *x, ascending);
    return 0.5 * (x[(count - 1) / 2] + x[count / 2]);
}

bench_spread columns_spread(double *x, size_t count)
{
    bench_spread s = {0, count > 0 ? columns_median(x, count) : 0, count > 0 ? x[count - 1] : 0};
    for (size_t k = 0; k < count; ++k) s.mean += x[k] / (double)count;
    return s;
}

void columns_free(columns *x)
{
    for (int k = 0; k < COLUMNS; ++k) free(x->of[k]);
}

bool columns_make(columns *x, size_t count)
{
    bool made = true;
    x->count = 0;
    for (int k = 0; k < COLUMNS; ++k) {
        x->of[k] = calloc(count + 1, sizeof *x->of[k]);
        made = made && x->of[k] != NULL;
    }
    return made;
}

void columns_add(columns *x, const imp_stats *stats, double seconds)
{
    const double row[COLUMNS] = {
        (double)stats->pairs,     (double)stats->nodes, (double)stats->witness_searches,
        (double)stats->peak_heap, (double)stats->bytes, seconds};
    for (int k = 0; k < COLUMNS; ++k) x->of[k][x->count] = row[k];
    x->count += 1;
}

void columns_tally(columns *x, bench_tally *tally)
{
    tally->pairs = columns_spread(x->of[PAIRS], x->count);
    tally->nodes = columns_spread(x->of[NODES], x->count);
    tally->searches = columns_spread(x->of[SEARCHES], x->count);
    tally->heap = columns_spread(x->of[HEAP], x->count);
    tally->bytes = columns_spread(x->of[BYTES], x->count);
    tally->seconds = columns_spread(x->of[SECONDS], x->count);
}
