/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/parts.h"

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

typedef struct parts_run_state {
    const parts_plan *plan;
    size_t done;     /* changed by finish_part only */
    imp_error error; /* the first in order; begins as a success */
} parts_run_state;

typedef struct part_item {
    size_t index;
    imp_error error;
} part_item;

static void work_on_part(void *context, void *of)
{
    const parts_run_state *run = context;
    part_item *item = of;
    item->error = (imp_error){.code = IMP_SUCCESS};
    item->error.code = parts_solve(run->plan, item->index, &item->error);
}

static bool finish_part(void *context, void *of)
{
    parts_run_state *run = context;
    const part_item *item = of;
    if (run->error.code == IMP_SUCCESS) run->error = item->error;
    progress_count(++run->done);
    return run->error.code == IMP_SUCCESS;
}

imp_code parts_run(const parts_plan *plan, imp_error *error)
{
    enum { ITEMS_PER_THREAD = 64 };
    parts_run_state run = {.plan = plan, .error = {.code = IMP_SUCCESS}};
    const size_t threads = plan->threads < plan->count ? plan->threads : plan->count;
    if (plan->count == 0) return IMP_SUCCESS;
    const ordered_pool_plan pool_plan = {.threads = threads,
                                         .items = ITEMS_PER_THREAD * threads,
                                         .item_size = sizeof(part_item),
                                         .work = work_on_part,
                                         .finish = finish_part,
                                         .context = &run};
    ordered_pool *pool = ordered_pool_new(&pool_plan);
    if (pool == NULL) return error->code = IMP_ERROR_MEMORY;
    part_item *item;
    progress_count_from(0, plan->count, "pairs of bodies");
    for (size_t k = 0; k < plan->count && (item = ordered_pool_next(pool)) != NULL; ++k) {
        item->index = k;
        ordered_pool_submit(pool);
    }
    ordered_pool_join(pool);
    ordered_pool_free(pool);
    progress_wipe();
    if (run.error.code != IMP_SUCCESS) *error = run.error;
    return run.error.code;
}
