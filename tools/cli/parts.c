/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/parts.h"

#include <math.h>
#include <stdlib.h>

#include "tools/cli/interrupt.h"
#include "tools/cli/progress.h"

imp_code parts_solve(const parts_plan *plan, size_t index, imp_error *error)
{
    imp_query *part = imp_query_part(plan->whole, index, error);
    if (part == NULL) return error->code;
    if (interrupt_came()) imp_query_cancel(part);
    const imp_code code = imp_query_step(part, 0, error);
    if (code == IMP_SUCCESS) plan->take(plan->context, index, part);
    imp_query_free(part);
    return code;
}

/* --- All parts -------------------------------------------------------------------------------- */

/* A part that is being solved in turns. */
typedef struct open_part {
    size_t index;
    imp_query *query; /* NULL before its first turn and after its last */
} open_part;

typedef struct parts_run_state {
    const parts_plan *plan;
    open_part *open; /* NULL: each part has one turn, and none is listed */
    size_t count;    /* of them */
    size_t done;     /* changed by finish_turn only */
    imp_error error; /* the first; begins as a success */
} parts_run_state;

typedef struct turn {
    open_part *part;
    open_part only; /* of a part with one turn, which is not listed */
    imp_error error;
} turn;

static imp_code take_turn(const parts_plan *plan, open_part *part, imp_error *error)
{
    enum { PAIRS_A_TURN = 2000 };
    if (part->query == NULL && plan->is_over != NULL && plan->is_over(plan->context))
        return IMP_SUCCESS;
    if (part->query == NULL) part->query = imp_query_part(plan->whole, part->index, error);
    if (part->query == NULL) return error->code;
    if (interrupt_came()) imp_query_cancel(part->query);
    const bool is_only = plan->advance == NULL;
    const imp_code code = imp_query_step(part->query, is_only ? 0 : PAIRS_A_TURN, error);
    if (!is_only && code != IMP_SUCCESS) return code;
    if (!is_only && imp_query_result(part->query).reason == IMP_REASON_RUNNING) return IMP_SUCCESS;
    if (code == IMP_SUCCESS) plan->take(plan->context, part->index, part->query);
    imp_query_free(part->query);
    part->query = NULL;
    return code;
}

static void work_on_turn(void *context, void *of)
{
    const parts_run_state *run = context;
    turn *item = of;
    item->error = (imp_error){.code = IMP_SUCCESS};
    item->error.code = take_turn(run->plan, item->part, &item->error);
}

static bool finish_turn(void *context, void *of)
{
    parts_run_state *run = context;
    const turn *item = of;
    if (run->error.code == IMP_SUCCESS) run->error = item->error;
    run->done += item->part->query == NULL;
    progress_count(run->done);
    return run->error.code == IMP_SUCCESS;
}

/* Gives each open part one turn, and closes the finished ones. */
static imp_code take_turns(parts_run_state *run)
{
    enum { ITEMS_PER_THREAD = 64 };
    const size_t threads = run->plan->threads < run->count ? run->plan->threads : run->count;
    const ordered_pool_plan pool_plan = {.threads = threads,
                                         .items = ITEMS_PER_THREAD * threads,
                                         .item_size = sizeof(turn),
                                         .work = work_on_turn,
                                         .finish = finish_turn,
                                         .context = run};
    ordered_pool *pool = ordered_pool_new(&pool_plan);
    if (pool == NULL) return run->error.code = IMP_ERROR_MEMORY;
    turn *item;
    for (size_t k = 0; k < run->count && (item = ordered_pool_next(pool)) != NULL; ++k) {
        item->only = (open_part){.index = k};
        item->part = run->open != NULL ? &run->open[k] : &item->only;
        ordered_pool_submit(pool);
    }
    ordered_pool_join(pool);
    ordered_pool_free(pool);
    return run->error.code;
}

/* Drops the parts that are done. What is proved of all others. */
static double close_parts(parts_run_state *run)
{
    double t_lower = INFINITY;
    size_t kept = 0;
    for (size_t k = 0; k < run->count; ++k) {
        if (run->open[k].query == NULL) continue;
        const double t = imp_query_result(run->open[k].query).t_lower;
        if (t < t_lower) t_lower = t;
        run->open[kept++] = run->open[k];
    }
    run->count = kept;
    return t_lower;
}

/* Solves all parts in turns. */
static void run_in_turns(parts_run_state *run)
{
    const parts_plan *plan = run->plan;
    run->open = calloc(plan->count + 1, sizeof *run->open);
    if (run->open == NULL) run->error.code = IMP_ERROR_MEMORY;
    for (size_t k = 0; run->open != NULL && k < run->count; ++k) run->open[k].index = k;
    while (run->open != NULL && run->count > 0 && take_turns(run) == IMP_SUCCESS)
        if (!plan->advance(plan->context, close_parts(run))) break;
    for (size_t k = 0; run->open != NULL && k < run->count; ++k) imp_query_free(run->open[k].query);
    free(run->open);
}

imp_code parts_run(const parts_plan *plan, imp_error *error)
{
    parts_run_state run = {.plan = plan, .count = plan->count, .error = {.code = IMP_SUCCESS}};
    progress_count_from(0, plan->count, "pairs of bodies");
    if (plan->advance != NULL)
        run_in_turns(&run);
    else if (plan->count > 0)
        take_turns(&run); /* one each */
    progress_wipe();
    if (run.error.code != IMP_SUCCESS) *error = run.error;
    return run.error.code;
}
