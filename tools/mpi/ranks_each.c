/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/each.h"
#include "tools/cli/explain.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"
#include "tools/mpi/ranks.h"

/* --- Parts ------------------------------------------------------------------------------------ */

/* Takes parts until there are none. Answers the number of the first that failed here, with its
 * error, or the count. */
static int64_t solve_parts(each *e, ranks_counter *counter, imp_error *error)
{
    const int64_t count = (int64_t)e->plan.count;
    for (int64_t k; (k = ranks_counter_next(counter)) < count;)
        if (each_solve_part(e, (size_t)k, error) != IMP_SUCCESS) return k;
    return count;
}

/* Gathers on the first rank bytes that are 0 on all ranks but one. */
static void gather_bytes(void *bytes, size_t count)
{
    const bool first = ranks_own() == FIRST_RANK;
    MPI_Reduce(first ? MPI_IN_PLACE : bytes, first ? bytes : NULL, (int)count, MPI_BYTE, MPI_BOR,
               FIRST_RANK, MPI_COMM_WORLD);
}

static void gather_answers(each *e)
{
    enum { AT_ONCE = 4096 };
    for (size_t k = 0; k < e->plan.count; k += AT_ONCE) {
        const size_t left = e->plan.count - k;
        gather_bytes(e->answers + k, (left < AT_ONCE ? left : AT_ONCE) * sizeof *e->answers);
    }
}

/* What surveys say of values. The numbers are bytes 0 on all ranks but one. */
static void gather_values(each *e)
{
    survey_parts *p = e->survey;
    if (p == NULL) return;
    for (size_t k = 0; k < p->count; ++k) {
        gather_bytes(&p->answers[k].state, sizeof p->answers[k].state);
        gather_bytes(&p->answers[k].has_values, sizeof p->answers[k].has_values);
        gather_bytes(p->answers[k].numbers, survey_answer_room(p->scene) * sizeof *p->numbers);
    }
}

static bool is_any_advised(const each *e)
{
    int own = 0, any = 0;
    for (size_t k = 0; k < e->plan.count; ++k) own = own || e->advice[k] != NULL;
    MPI_Allreduce(&own, &any, 1, MPI_INT, MPI_LOR, MPI_COMM_WORLD);
    return any;
}

static void gather_advice(each *e)
{
    enum { AT_ONCE = 128 };
    char texts[AT_ONCE][EXPLAIN_ADVICE_BYTES];
    if (!is_any_advised(e)) return;
    for (size_t from = 0; from < e->plan.count; from += AT_ONCE) {
        const size_t left = e->plan.count - from, count = left < AT_ONCE ? left : AT_ONCE;
        char **advice = e->advice + from;
        memset(texts, 0, sizeof texts);
        for (size_t k = 0; k < count; ++k)
            if (advice[k] != NULL) snprintf(texts[k], sizeof texts[k], "%s", advice[k]);
        gather_bytes(texts, count * sizeof *texts);
        for (size_t k = 0; k < count; ++k)
            if (advice[k] == NULL && texts[k][0] != '\0') advice[k] = strdup(texts[k]);
    }
}

/* Returns whether all ranks have divided the scene alike: a limit of time may end one and not
 * another. */
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
    gather_answers(e);
    gather_values(e);
    gather_advice(e);
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
