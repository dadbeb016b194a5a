/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_COLUMNS_H
#define TOOLS_BENCH_COLUMNS_H

#include "tools/bench/bench.h"

/* The numbers of all scenes of a case, a column for each counter: what tallies are made from. */

enum { PAIRS, NODES, SEARCHES, HEAP, BYTES, SECONDS, COLUMNS };

typedef struct columns {
    size_t count;
    double *of[COLUMNS];
} columns;

/* Room for so many scenes; false: no memory. Free in any case. */
bool columns_make(columns *x, size_t count);
void columns_free(columns *x);

void columns_add(columns *x, const imp_stats *stats, double seconds);

/* Fills the spreads of a tally. Sorts the columns. */
void columns_tally(columns *x, bench_tally *tally);

/* Mean, median and greatest of x, which is sorted; all 0 if count is 0. */
bench_spread columns_spread(double *x, size_t count);

/* Sorts x; count > 0. */
double columns_median(double *x, size_t count);

#endif
