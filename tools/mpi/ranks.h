/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_MPI_RANKS_H
#define TOOLS_MPI_RANKS_H

#include <mpi.h>

#include "tools/cli/arguments.h"

/* impinge-mpi: batch and solve --each by the processes (ranks) of an MPI run
 * ==========================================================================
 * Work is numbered; each rank takes the next number from a counter on rank 0 when it is done with
 * the one before (one-sided), so that a slow scene holds up nobody. Answers are those of `impinge`,
 * byte for byte but for seconds. Functions here are called by all ranks together, unless they say
 * otherwise. */

enum { FIRST_RANK = 0 };

int ranks_own(void); /* 0, 1, ... */
int ranks_count(void);

/* The greatest of all ranks' statuses. */
exit_status ranks_worst(exit_status status);

/* --- The counter ------------------------------------------------------------------------------ */

typedef struct ranks_counter {
    MPI_Win window;
    int64_t *value; /* on the first rank */
} ranks_counter;

bool ranks_counter_open(ranks_counter *counter, int64_t first);
void ranks_counter_close(ranks_counter *counter);

/* Returns the next number. [by one rank alone] */
int64_t ranks_counter_next(ranks_counter *counter);

/* --- Verbs ------------------------------------------------------------------------------------ */

/* Each answers the exit status of the whole on the first rank. */
exit_status ranks_batch(const arguments *args);
exit_status ranks_each(const arguments *args);

#endif
