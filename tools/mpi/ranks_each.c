/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "tools/cli/each.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"
#include "tools/mpi/ranks.h"

/* --- Parts ------------------------------------------------------------------------------------ */

/* Takes parts until there are none. Answers the number of the first that failed here, with its
 * error, or the count. */
static int64_t solve_parts(const each *e, ranks_counter *counter, imp_error *error)
{
    const int64_t count = (int64_t)e->plan.count;
    for (int64_t k; (k = ranks_counter_next(counter)) < count;)
        if (parts_solve(&e->plan, (size_t)k, error) != IMP_SUCCESS) return k;
    return count;
}

/* Each answer is there on one rank, and all bytes 0 on the others. */
static void gather(each *e)
{
    enum { AT_ONCE = 4096 };
    const bool first = ranks_own() == FIRST_RANK;
    for (size_t k = 0; k < e->plan.count; k += AT_ONCE) {
        const size_t left = e->plan.count - k;
        const size_t bytes = (left < AT_ONCE ? left : AT_ONCE) * sizeof *e->answers;
        MPI_Reduce(first ? MPI_IN_PLACE : e->answers + k, first ? e->answers + k : NULL, (int)bytes,
                   MPI_BYTE, MPI_BOR, FIRST_RANK, MPI_COMM_WORLD);
    }
}

/* Whether all ranks have divided the scene alike: a limit of time may end one and not another. */
static bool is_agreed(const each *e)
{
    const int64_t own[2] = {(int64_t)e->plan.count, -(int64_t)e->plan.count};
    int64_t most[2];
    MPI_Allreduce(own, most, 2, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    return most[0] == -most[1];
}

/* The first failure of all, told by its rank. */
static exit_status complain_of_first(const each *e, int64_t failed, const imp_error *error)
{
    int64_t first;
    MPI_Allreduce(&failed, &first, 1, MPI_INT64_T, MPI_MIN, MPI_COMM_WORLD);
    if (first == (int64_t)e->plan.count) return EXIT_ANSWERED;
    const bool ours = first == failed;
    complain_aloud(ours);
    return ranks_worst(ours ? complain_of(error, e->args->verb->name) : EXIT_ANSWERED);
}

static exit_status solve_and_print(each *e)
{
    ranks_counter counter;
    imp_error error = {0};
    if (!is_agreed(e))
        return complain(EXIT_UNDECIDED, e->args->verb->name,
                        "time ran out while bodies were paired; raise --max-seconds");
    if (!ranks_counter_open(&counter, 0)) return complain_of_memory(e->args->verb->name);
    const int64_t failed = solve_parts(e, &counter, &error);
    ranks_counter_close(&counter);
    const exit_status status = complain_of_first(e, failed, &error);
    if (status != EXIT_ANSWERED) return status;
    gather(e);
    return ranks_own() == FIRST_RANK ? each_print(e) : EXIT_ANSWERED;
}

/* --- The scene -------------------------------------------------------------------------------- */

exit_status ranks_each(const arguments *args)
{
    bool complained = false;
    imp_error error = {0};
    imp_registry *registry = query_registry(args);
    imp_scene *scene = NULL;
    exit_status status = registry != NULL ? EXIT_ANSWERED : EXIT_DATA;
    each e = {.args = args};
    interrupt_prepare();
    if (registry != NULL) scene = query_scene(registry, args, &complained, &error);
    if (registry != NULL && scene == NULL)
        status = complained ? EXIT_DATA : complain_of(&error, args->verb->name);
    if (scene != NULL) status = each_begin(&e, scene, args, 1);
    status = ranks_worst(status);
    if (status == EXIT_ANSWERED) status = solve_and_print(&e);
    each_end(&e);
    imp_scene_free(scene);
    query_registry_free(registry);
    return status;
}
