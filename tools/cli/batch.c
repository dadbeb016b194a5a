/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/batch.h"

#include <stdlib.h>
#include <string.h>

#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/reading_limit.h"
#include "tools/cli/result.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

void batch_keep_worst(batch *b, exit_status status)
{
    if (status > b->worst) b->worst = status;
}

/* --- One line; on any thread ------------------------------------------------------------------ */

/* Makes one line of the id followed by the members of `rest`, which has at least one. Takes
 * ownership of both. NULL: no memory. */
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

/* Solves a scene without parameters. The answer is NULL without memory for it. */
static imp_code solve_pose(imp_scene *scene, const arguments *args, imp_result *result,
                           json_t **answer, imp_error *error)
{
    char *advice = NULL;
    const imp_code code = query_solve(scene, args, result, &advice, error);
    *answer = code == IMP_SUCCESS ? result_json(scene, result) : NULL;
    if (*answer != NULL &&
        !(result_set_advice(*answer, advice) && result_set_warnings(*answer, scene))) {
        json_decref(*answer);
        *answer = NULL;
    }
    free(advice);
    return code;
}

static json_t *solve_line(const batch *b, batch_item *item)
{
    char *name = NULL;
    imp_error error = {.code = IMP_ERROR_MEMORY};
    imp_result result;
    json_t *answer = NULL;
    imp_scene *scene = NULL;
    if (asprintf(&name, "%s, line %zu", b->name, item->line) >= 0) {
        reading_limit_begin(b->args, name);
        scene = imp_scene_from_json(b->registry, item->text.text, item->text.length, name, &error);
        reading_limit_end();
        free(name);
    }
    const bool is_range = imp_scene_parameter_count(scene) > 0;
    if (scene == NULL || (is_range ? survey_solve : solve_pose)(scene, b->args, &result, &answer,
                                                                &error) != IMP_SUCCESS) {
        answer = error_json(item, &error);
    } else {
        item->status = query_status(&result, b->args);
        item->interrupted = result.reason == IMP_REASON_CANCELLED;
    }
    imp_scene_free(scene);
    return answer;
}

static void answer_line(const batch *b, batch_item *item)
{
    json_t *rest = solve_line(b, item);
    /* A line that is no JSON has no id, and one beyond a limit is not parsed. */
    const bool is_json = !item->failed || item->status == EXIT_UNDECIDED;
    json_t *id = is_json ? batch_scene_id(&item->text, !item->failed) : batch_line_id(&item->text);
    item->answer = answer_of(id, rest);
}

void batch_answer(const batch *b, batch_item *item)
{
    item->failed = item->interrupted = false;
    item->status = EXIT_ANSWERED;
    item->answer = NULL;
    if (interrupt_came())
        item->interrupted = true; /* not begun: no answer */
    else
        answer_line(b, item);
}

void batch_count(batch *b, const batch_item *item)
{
    b->failures += item->failed;
    b->answered = item->line;
    b->done += 1;
    batch_keep_worst(b, item->status);
}

/* --- The stream ------------------------------------------------------------------------------- */

static bool is_blank(const input_text *line)
{
    for (size_t i = 0; i < line->length; ++i)
        if (line->text[i] == '\0' || strchr(" \t\r\n", line->text[i]) == NULL) return false;
    return true;
}

/* Whether this run solves the line: it is not blank, belongs to our shard, and has no result in the
 * output that is resumed. *ok false: that output does not match the input. */
static bool is_wanted(batch *b, const input_text *line, bool *ok)
{
    if (is_blank(line) || b->scenes++ % b->shard.count != b->shard.index) return false;
    if (b->passed_over > 0) {
        b->passed_over -= 1;
        return false;
    }
    answered_line done;
    const resume_state state = batch_resume_match(&b->resume, line, &done);
    *ok = state != RESUME_REFUSED;
    if (state == RESUME_ANSWERED) {
        b->failures += done.failed;
        b->answered = b->line;
        batch_keep_worst(b, done.status);
    }
    return state == RESUME_NEW;
}

bool batch_next_line(batch *b, batch_item *item)
{
    bool ok = true, wanted = false;
    while (ok && !wanted && !interrupt_came()) {
        item->text.most = reading_limit_most(b->args);
        const bool read = input_read_line(b->file, b->name, b->args->verb->name, &item->text);
        if (!read && !interrupt_came()) b->input_failed = true;
        if (read && item->text.length == 0) b->input_failed = !batch_resume_match_end(&b->resume);
        if (!read || item->text.length == 0) return false;
        item->line = ++b->line;
        wanted = is_wanted(b, &item->text, &ok);
    }
    if (!ok) b->input_failed = true;
    return wanted;
}

uint64_t batch_scene_count(const batch *b)
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

/* --- From start to end ------------------------------------------------------------------------ */

exit_status batch_begin(batch *b, const arguments *args)
{
    *b = (batch){.args = args, .name = input_name(args->operands[0]), .shard = {0, 1}};
    exit_status checked = query_check(args);
    if (checked == EXIT_ANSWERED) checked = batch_shard_read(args, &b->shard);
    if (checked != EXIT_ANSWERED) return checked;
    b->file = input_open(args->operands[0], args->verb->name);
    return b->file != NULL ? EXIT_ANSWERED : EXIT_DATA;
}

exit_status batch_prepare(batch *b)
{
    b->registry = query_registry(b->args);
    if (b->registry == NULL) return EXIT_DATA;
    json_object_seed(0); /* before there are threads */
    interrupt_prepare();
    return EXIT_ANSWERED;
}

void batch_sum_up(batch *b)
{
    const char *speaker = b->args->verb->name;
    if (b->input_failed) batch_keep_worst(b, EXIT_DATA);
    if (b->failures > 0)
        remark(speaker,
               "%s: %zu of %zu lines could not be answered; their errors are in their places",
               b->name, b->failures, b->line);
    if (interrupt_came()) {
        remark(speaker, "%s: interrupted after line %zu", b->name, b->answered);
        batch_keep_worst(b, EXIT_UNDECIDED);
    }
}

void batch_end(batch *b)
{
    query_registry_free(b->registry);
    if (b->file != NULL) input_close(b->file);
}
