/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "tools/cli/batch.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/ordered_pool.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

static void work_on_line(void *context, void *of) { batch_answer(context, of); }

/* Prints results in order, one at a time. The output ends with a result that a signal interrupted:
 * it says how far the proof came; with --resume it is left out, and solved again later. */
static bool finish_line(void *context, void *of)
{
    batch *b = context;
    batch_item *item = of;
    b->over = b->over || (item->interrupted && (item->answer == NULL || b->resume.file != NULL));
    if (b->over) {
        free(item->answer);
        return false;
    }
    batch_count(b, item);
    const exit_status printed = output_line(item->answer, b->args->verb->name);
    batch_keep_worst(b, printed);
    b->over = printed != EXIT_ANSWERED || item->interrupted;
    progress_count(b->done);
    return !b->over;
}

static void answer_lines(batch *b)
{
    b->done = b->resume.answers;
    progress_count_from(b->done, batch_scene_count(b), "scenes");
    const size_t threads = query_threads(b->args);
    const ordered_pool_plan plan = {.threads = threads,
                                    .items = BATCH_ITEMS_PER_THREAD * threads,
                                    .item_size = sizeof(batch_item),
                                    .work = work_on_line,
                                    .finish = finish_line,
                                    .context = b};
    ordered_pool *pool = ordered_pool_new(&plan);
    if (pool == NULL) {
        batch_keep_worst(b, complain_of_memory(b->args->verb->name));
        return;
    }
    batch_item *item;
    while (!interrupt_came() && (item = ordered_pool_next(pool)) != NULL &&
           batch_next_line(b, item))
        ordered_pool_submit(pool);
    ordered_pool_join(pool);
    for (size_t k = 0; k < plan.items; ++k)
        free(((batch_item *)ordered_pool_item(pool, k))->text.text);
    ordered_pool_free(pool);
}

static exit_status answer_file(batch *b)
{
    const option_value *resume = arguments_option(b->args, "resume");
    exit_status status = EXIT_ANSWERED;
    if (resume != NULL) status = batch_resume_open(&b->resume, resume->text, b->args, true);
    if (status == EXIT_ANSWERED) status = batch_prepare(b);
    if (status == EXIT_ANSWERED) {
        answer_lines(b);
        batch_sum_up(b);
    }
    batch_keep_worst(b, status);
    if (resume != NULL) batch_keep_worst(b, batch_resume_close(&b->resume));
    return b->worst;
}

static exit_status run(const arguments *args)
{
    batch b;
    exit_status status = batch_begin(&b, args);
    if (status == EXIT_ANSWERED) status = answer_file(&b);
    batch_end(&b);
    return status;
}

static const option options_batch[] = {
    {.name = "threads",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "solve N lines at a time; the answers are the same (all processors)"},
    {.name = "resume",
     .kind = OPTION_TEXT,
     .argument = "OUT",
     .help = "write to OUT, behind the answers that an earlier run left there"},
    {.name = "shard",
     .kind = OPTION_TEXT,
     .argument = "I/N",
     .help = "answer the I-th of each N scenes only, I from 1"},
    {.name = NULL},
};
static const option *const tables[] = {options_batch,    options_search, options_query,
                                       options_registry, options_always, NULL};

const verb verb_batch = {
    .name = "batch",
    .operands = "FILE.jsonl",
    .summary = "Answer a stream of scenes, one a line",
    .details =
        "Reads one scene a line ('-': standard input), as `impinge solve` takes it, on one line "
        "and\n"
        "with an \"id\" of your choice, and writes one JSON result a line, in the same order. A "
        "line\n"
        "that cannot be answered gives {\"id\": ..., \"error\": ..., \"line\": ...} and the rest "
        "goes\n"
        "on; the exit status is the greatest any line earned. Blank lines are skipped. Limits\n"
        "hold for each scene by itself. One with parameters is answered for all their values.\n",
    .example = "echo '{\"id\": 1, \"bodies\": [{\"name\": \"a\", \"surfaces\": [{\"type\": "
               "\"sphere\"}]},' \\\n"
               "       '{\"name\": \"b\", \"surfaces\": [{\"type\": \"sphere\", \"center\": "
               "[3,0,0]}]}]}' |\n"
               "    impinge batch -",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};
