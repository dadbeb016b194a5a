/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/ordered_pool.h"
#include "tools/cli/progress.h"
#include "tools/cli/survey_parts.h"

/* All questions, by several threads (survey_parts.h). */

typedef struct asking {
    survey_parts *parts;
    size_t done;     /* changed by finish only */
    imp_error error; /* the first */
} asking;

typedef struct turn {
    size_t k;
    imp_error error;
} turn;

static void work(void *context, void *of)
{
    const asking *a = context;
    turn *item = of;
    item->error = (imp_error){.code = IMP_SUCCESS};
    if (!survey_parts_are_over(a->parts))
        item->error.code = survey_parts_ask(a->parts, item->k, &item->error);
}

static bool finish(void *context, void *of)
{
    asking *a = context;
    const turn *item = of;
    if (a->error.code == IMP_SUCCESS) a->error = item->error;
    progress_count(++a->done);
    return a->error.code == IMP_SUCCESS;
}

imp_code survey_parts_run(survey_parts *p, imp_error *error)
{
    asking a = {.parts = p, .error = {.code = IMP_SUCCESS}};
    const size_t threads = p->threads < p->count ? p->threads : p->count > 0 ? p->count : 1;
    const ordered_pool_plan plan = {.threads = threads,
                                    .items = 4 * threads,
                                    .item_size = sizeof(turn),
                                    .work = work,
                                    .finish = finish,
                                    .context = &a};
    ordered_pool *pool = ordered_pool_new(&plan);
    turn *item;
    if (pool == NULL) return error->code = IMP_ERROR_MEMORY;
    progress_count_from(0, p->count, "pairs of bodies");
    for (size_t k = 0; k < p->count && (item = ordered_pool_next(pool)) != NULL; ++k) {
        item->k = k;
        ordered_pool_submit(pool);
    }
    ordered_pool_join(pool);
    ordered_pool_free(pool);
    progress_wipe();
    if (a.error.code != IMP_SUCCESS) *error = a.error;
    return a.error.code;
}
