/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "input.h"
#include "interrupt.h"
#include "output.h"
#include "query.h"
#include "result.h"
#include "verbs.h"

/* A stream of scenes, one a line, and of answers, one a line, in the same order. A line that cannot
 * be answered is answered by its error; the rest goes on. */
typedef struct batch {
    const arguments *args;
    imp_registry *registry;
    const char *name; /* of the input, for messages */
    size_t line;      /* number of the current line, from 1 */
    size_t failures;  /* lines answered by an error */
    exit_status worst;
} batch;

static void keep_worst(batch *b, exit_status status)
{
    if (status > b->worst) b->worst = status;
}

/* The line's "id", or null. What is wrong with the line is said elsewhere. */
static json_t *line_id(const char *text, size_t length)
{
    json_t *object = json_loadb(text, length, 0, NULL);
    json_t *id = json_object_get(object, "id");
    id = id != NULL ? json_incref(id) : json_null();
    json_decref(object);
    return id;
}

/* One object of the id and, behind it, what `rest` holds. Takes over both; NULL: no memory. */
static json_t *answer_of(json_t *id, json_t *rest)
{
    json_t *object = json_pack("{s:o}", "id", id);
    const bool failed = object == NULL || rest == NULL || json_object_update(object, rest) != 0;
    json_decref(rest);
    if (!failed) return object;
    json_decref(object);
    return NULL;
}

static json_t *error_json(batch *b, const imp_error *error)
{
    const char *text = error->text[0] != '\0' ? error->text : imp_code_text(error->code);
    ++b->failures;
    keep_worst(b, status_of_code(error->code));
    return json_pack("{s:o, s:I}", "error", output_json_text(text), "line", (json_int_t)b->line);
}

static json_t *solve_line(batch *b, const char *text, size_t length)
{
    char *name = NULL;
    imp_error error = {.code = IMP_ERROR_MEMORY};
    imp_result result;
    json_t *answer = NULL;
    imp_scene *scene = NULL;
    if (asprintf(&name, "%s, line %zu", b->name, b->line) >= 0) {
        scene = imp_scene_from_json(b->registry, text, length, name, &error);
        free(name);
    }
    if (scene == NULL || query_solve(scene, b->args, &result, &error) != IMP_SUCCESS) {
        answer = error_json(b, &error);
    } else {
        keep_worst(b, query_status(&result, b->args));
        answer = result_json(scene, &result);
    }
    imp_scene_free(scene);
    return answer;
}

static bool is_blank(const char *text, size_t length)
{
    for (size_t i = 0; i < length; ++i)
        if (strchr(" \t\r\n", text[i]) == NULL || text[i] == '\0') return false;
    return true;
}

/* False: there is no point in going on. */
static bool answer_line(batch *b, const char *text, size_t length)
{
    ++b->line;
    if (is_blank(text, length)) return true;
    json_t *answer = answer_of(line_id(text, length), solve_line(b, text, length));
    const exit_status printed = output_json(answer, b->args->verb->name);
    keep_worst(b, printed);
    return printed == EXIT_ANSWERED;
}

static void answer_lines(batch *b, FILE *file)
{
    input_text line = {0};
    bool more = true;
    while (more && !interrupt_came()) {
        const bool read = input_read_line(file, b->name, b->args->verb->name, &line);
        more = read && line.length > 0 && answer_line(b, line.text, line.length);
        if (!read && !interrupt_came()) keep_worst(b, EXIT_DATA);
    }
    free(line.text);
}

static void sum_up(batch *b)
{
    const char *speaker = b->args->verb->name;
    if (b->failures > 0)
        complain(b->worst, speaker,
                 "%s: %zu of %zu lines could not be answered; their errors stand in "
                 "their places",
                 b->name, b->failures, b->line);
    if (interrupt_came())
        keep_worst(b, complain(EXIT_UNDECIDED, speaker, "%s: interrupted after line %zu", b->name,
                               b->line));
}

static exit_status run(const arguments *args)
{
    const exit_status checked = query_check(args);
    if (checked != EXIT_ANSWERED) return checked;
    FILE *file = input_open(args->operands[0], args->verb->name);
    if (file == NULL) return EXIT_DATA;
    batch b = {
        .args = args, .registry = query_registry(args), .name = input_name(args->operands[0])};
    interrupt_prepare();
    if (b.registry != NULL) {
        answer_lines(&b, file);
        sum_up(&b);
        imp_registry_free(b.registry);
    } else {
        b.worst = EXIT_DATA;
    }
    input_close(file);
    return b.worst;
}

static const option *const tables[] = {options_query, options_registry, options_always, NULL};

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
        "on; the exit status is the greatest any line earned. Blank lines are passed over. Limits\n"
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
