/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "tools/cli/batch_resume.h"
#include "tools/cli/input.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/ordered_pool.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

/* A stream of scenes, one a line, and of answers, one a line, in the same order. A line that cannot
 * be answered is answered by its error; the rest goes on. Lines are solved by a pool of threads;
 * answers are printed in order, as soon as those before them are. */
typedef struct batch {
    const arguments *args;
    imp_registry *registry;
    const char *name; /* of the input, for messages */
    size_t line;      /* number of the last line read, from 1 */
    size_t scenes;    /* lines that are not blank, read so far */
    bool input_failed;
    batch_shard shard;
    batch_resume resume;
    /* changed while the pool runs by finish_line only, and before its first line by is_wanted */
    size_t failures; /* lines answered by an error */
    size_t answered; /* number of the last line answered */
    uint64_t done;   /* scenes answered, by earlier runs too */
    exit_status worst;
    bool over; /* nothing more is printed */
} batch;

enum { ITEMS_PER_THREAD = 8 }; /* enough that a slow line does not leave the other threads idle */

/* One line under way. */
typedef struct batch_item {
    input_text text;
    size_t line;
    char *answer;       /* a line of JSON; NULL: none, or no memory */
    exit_status status; /* what the answer stands for */
    bool failed, interrupted;
} batch_item;

static void keep_worst(batch *b, exit_status status)
{
    if (status > b->worst) b->worst = status;
}

/* --- One line; on any thread ------------------------------------------------------------------- */

/* One line of the id and, behind it, what `rest` holds, which has a key. Takes over both; NULL: no
 * memory. */
static char *answer_of(json_t *id, json_t *rest)
{
    char *id_text = output_json_line(id), *rest_text = output_json_line(rest), *line = NULL;
    if (id_text != NULL && rest_text != NULL &&
        asprintf(&line, "{\"id\":%s,%s", id_text, rest_text + 1) < 0)
        line = NULL;
    free(id_text);
    free(rest_text);
    return line;
}

static json_t *error_json(batch_item *item, const imp_error *error)
{
    item->failed = true;
    item->status = status_of_code(error->code);
    return json_pack("{s:o, s:I}", "error", output_json_text(message_of(error)), "line",
                     (json_int_t)item->line);
}

static json_t *solve_line(const batch *b, batch_item *item)
{
    char *name = NULL;
    imp_error error = {.code = IMP_ERROR_MEMORY};
    imp_result result;
    json_t *answer = NULL;
    imp_scene *scene = NULL;
    if (asprintf(&name, "%s, line %zu", b->name, item->line) >= 0) {
        scene = imp_scene_from_json(b->registry, item->text.text, item->text.length, name, &error);
        free(name);
    }
    if (scene == NULL || query_solve(scene, b->args, &result, &error) != IMP_SUCCESS) {
        answer = error_json(item, &error);
    } else {
        item->status = query_status(&result, b->args);
        item->interrupted = result.reason == IMP_REASON_CANCELLED;
        answer = result_json(scene, &result);
    }
    imp_scene_free(scene);
    return answer;
}

static void answer_line(const batch *b, batch_item *item)
{
    json_t *rest = solve_line(b, item);
    json_t *id = item->failed ? batch_line_id(&item->text) : batch_scene_id(&item->text);
    item->answer = answer_of(id, rest);
}

static void work_on_line(void *context, void *of)
{
    const batch *b = context;
    batch_item *item = of;
    item->failed = item->interrupted = false;
    item->answer = NULL;
    if (interrupt_came())
        item->interrupted = true; /* not begun: no answer */
    else
        answer_line(b, item);
}

/* In order, one at a time. What a signal has cut short ends the output: printed, as it says how far
 * the proof came, unless the output is to be resumed, which solves that line again. */
static bool finish_line(void *context, void *of)
{
    batch *b = context;
    batch_item *item = of;
    b->over = b->over || (item->interrupted && (item->answer == NULL || b->resume.file != NULL));
    if (b->over) {
        free(item->answer);
        return false;
    }
    b->failures += item->failed;
    b->answered = item->line;
    keep_worst(b, item->status);
    const exit_status printed = output_line(item->answer, b->args->verb->name);
    keep_worst(b, printed);
    b->over = printed != EXIT_ANSWERED || item->interrupted;
    progress_count(++b->done);
    return !b->over;
}

/* --- The stream --------------------------------------------------------------------------------- */

static bool is_blank(const input_text *line)
{
    for (size_t i = 0; i < line->length; ++i)
        if (line->text[i] == '\0' || strchr(" \t\r\n", line->text[i]) == NULL) return false;
    return true;
}

/* Whether the line is answered here and now: not blank, of our shard, and without an answer in the
 * output that is resumed. *ok false: that output does not fit the input. */
static bool is_wanted(batch *b, const input_text *line, bool *ok)
{
    if (is_blank(line) || b->scenes++ % b->shard.count != b->shard.index) return false;
    answered_line done;
    const resume_state state = batch_resume_match(&b->resume, line, &done);
    *ok = state != RESUME_MISMATCH;
    if (state == RESUME_ANSWERED) {
        b->failures += done.failed;
        b->answered = b->line;
        keep_worst(b, done.status);
    }
    return state == RESUME_NEW;
}

static void read_lines(batch *b, FILE *file, ordered_pool *pool)
{
    bool ok = true;
    batch_item *item;
    while (ok && !interrupt_came() && (item = ordered_pool_next(pool)) != NULL) {
        const bool read = input_read_line(file, b->name, b->args->verb->name, &item->text);
        if (!read && !interrupt_came()) b->input_failed = true;
        if (!read || item->text.length == 0) break;
        item->line = ++b->line;
        if (is_wanted(b, &item->text, &ok)) ordered_pool_submit(pool);
    }
    if (!ok) b->input_failed = true;
}

/* How many scenes of the file are ours; 0: unknown. */
static uint64_t count_scenes(const batch *b)
{
    const char *path = b->args->operands[0];
    FILE *file = progress_is_wanted() && input_is_file(path) ? fopen(path, "r") : NULL;
    input_text line = {0};
    uint64_t count = 0;
    while (file != NULL && input_read_line(file, path, b->args->verb->name, &line) &&
           line.length > 0 && !interrupt_came())
        count += !is_blank(&line);
    if (file != NULL) fclose(file);
    free(line.text);
    return (count + b->shard.count - 1 - b->shard.index) / b->shard.count;
}

static void answer_lines(batch *b, FILE *file)
{
    b->done = b->resume.answers;
    progress_count_from(b->done, count_scenes(b), "scenes");
    const size_t threads = query_threads(b->args);
    const ordered_pool_plan plan = {.threads = threads,
                                    .items = ITEMS_PER_THREAD * threads,
                                    .item_size = sizeof(batch_item),
                                    .work = work_on_line,
                                    .finish = finish_line,
                                    .context = b};
    ordered_pool *pool = ordered_pool_new(&plan);
    if (pool == NULL) {
        keep_worst(b, complain_of_memory(b->args->verb->name));
        return;
    }
    read_lines(b, file, pool);
    ordered_pool_join(pool);
    for (size_t k = 0; k < plan.items; ++k)
        free(((batch_item *)ordered_pool_item(pool, k))->text.text);
    ordered_pool_free(pool);
    if (b->input_failed) keep_worst(b, EXIT_DATA);
}

static void sum_up(batch *b)
{
    const char *speaker = b->args->verb->name;
    if (b->failures > 0)
        complain(b->worst, speaker,
                 "%s: %zu of %zu lines could not be answered; their errors are in "
                 "their places",
                 b->name, b->failures, b->line);
    if (interrupt_came())
        keep_worst(b, complain(EXIT_UNDECIDED, speaker, "%s: interrupted after line %zu", b->name,
                               b->answered));
}

static exit_status answer_file(batch *b, FILE *file)
{
    const option_value *resume = arguments_option(b->args, "resume");
    if (resume != NULL && !batch_resume_open(&b->resume, resume->text, b->args)) return EXIT_DATA;
    b->registry = query_registry(b->args);
    if (b->registry == NULL) return EXIT_DATA;
    json_object_seed(0); /* before there are threads */
    interrupt_prepare();
    answer_lines(b, file);
    sum_up(b);
    imp_registry_free(b->registry);
    if (resume != NULL) keep_worst(b, batch_resume_close(&b->resume));
    return b->worst;
}

static exit_status run(const arguments *args)
{
    batch b = {.args = args, .name = input_name(args->operands[0]), .shard = {0, 1}};
    exit_status checked = query_check(args);
    if (checked == EXIT_ANSWERED) checked = batch_shard_read(args, &b.shard);
    if (checked != EXIT_ANSWERED) return checked;
    FILE *file = input_open(args->operands[0], args->verb->name);
    if (file == NULL) return EXIT_DATA;
    const exit_status status = answer_file(&b, file);
    input_close(file);
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
        "hold for each scene by itself.\n",
    .example = "echo '{\"id\": 1, \"bodies\": [{\"name\": \"a\", \"surfaces\": [{\"type\": "
               "\"sphere\"}]},' \\\n"
               "       '{\"name\": \"b\", \"surfaces\": [{\"type\": \"sphere\", \"center\": "
               "[3,0,0]}]}]}' |\n"
               "    impinge batch -",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};
