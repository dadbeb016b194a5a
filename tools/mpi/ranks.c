/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/mpi/ranks.h"

int ranks_own(void)
{
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

int ranks_count(void)
{
    int count;
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    return count;
}

exit_status ranks_worst(exit_status status)
{
    int own = (int)status, worst;
    MPI_Allreduce(&own, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return (exit_status)worst;
}

bool ranks_counter_open(ranks_counter *counter, int64_t first)
{
    const MPI_Aint bytes = ranks_own() == FIRST_RANK ? (MPI_Aint)sizeof(int64_t) : 0;
    if (MPI_Win_allocate(bytes, (int)sizeof(int64_t), MPI_INFO_NULL, MPI_COMM_WORLD,
                         &counter->value, &counter->window) != MPI_SUCCESS)
        return false;
    MPI_Win_lock_all(0, counter->window);
    if (bytes > 0) {
        *counter->value = first;
        MPI_Win_sync(counter->window);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    return true;
}

void ranks_counter_close(ranks_counter *counter)
{
    MPI_Win_unlock_all(counter->window);
    MPI_Win_free(&counter->window);
}

int64_t ranks_counter_next(ranks_counter *counter)
{
    const int64_t one = 1;
    int64_t next;
    MPI_Fetch_and_op(&one, &next, MPI_INT64_T, FIRST_RANK, 0, MPI_SUM, counter->window);
    MPI_Win_flush(FIRST_RANK, counter->window);
    return next;
}
