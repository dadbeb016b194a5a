/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/batch_resume.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/common/system_error.h"
#include "tools/cli/output.h"
#include "tools/cli/standard_output.h"
#include "tools/cli/verbs.h"

exit_status batch_shard_read(const arguments *args, batch_shard *shard)
{
    const option_value *value = arguments_option(args, "shard");
    *shard = (batch_shard){0, 1};
    if (value == NULL) return EXIT_ANSWERED;
    char rest;
    unsigned index, count;
    if (strspn(value->text, "0123456789/") == strlen(value->text) &&
        sscanf(value->text, "%9u/%9u%c", &index, &count, &rest) == 2 && index >= 1 &&
        index <= count) {
        *shard = (batch_shard){index - 1, count};
        return EXIT_ANSWERED;
    }
    return complain(EXIT_USAGE, args->verb->name,
                    "--shard: got '%s', must be I/N with 1 <= I <= N, for example 1/4",
                    value->text);
}

/* --- Ids ---------------------------------------------------------------------------------------- */

/* Behind the JSON string that begins at `at`; NULL: it does not end. *plain: without escapes. */
static const char *behind_string(const char *at, const char *end, bool *plain)
{
    *plain = true;
    for (++at; at < end && *at != '"'; ++at)
        if (*at == '\\') {
            *plain = false;
            ++at;
        }
    return at < end ? at + 1 : NULL;
}

/* The keys and values of the outermost object, one by one. */
typedef struct member_walk {
    const char *at, *end;
} member_walk;

static void skip_blanks(member_walk *w)
{
    while (w->at < w->end && strchr(" \t\r\n", *w->at) != NULL) ++w->at;
}

/* To the ',' or '}' behind a value. False: there is none. */
static bool skip_value(member_walk *w)
{
    size_t depth = 0;
    bool plain;
    while (w->at != NULL && w->at < w->end) {
        if (*w->at == '"') {
            w->at = behind_string(w->at, w->end, &plain);
            continue;
        }
        if (depth == 0 && (*w->at == ',' || *w->at == '}')) return true;
        depth += *w->at == '{' || *w->at == '[';
        depth -= depth > 0 && (*w->at == '}' || *w->at == ']');
        ++w->at;
    }
    return false;
}

/* Where the value of the last "id" is, found without reading the rest as values. False: the text is
 * no object, or has keys with escapes. */
static bool find_id(const input_text *line, const char **id, size_t *length)
{
    member_walk w = {line->text, line->text + line->length};
    *id = NULL;
    skip_blanks(&w);
    if (w.at == w.end || *w.at != '{') return false;
    do {
        ++w.at; /* the '{' or ',' */
        skip_blanks(&w);
        const char *key = w.at;
        bool plain;
        if (w.at == w.end || *w.at != '"') return false;
        w.at = behind_string(w.at, w.end, &plain);
        if (w.at == NULL || !plain) return false;
        const bool is_id = w.at - key == 4 && memcmp(key, "\"id\"", 4) == 0;
        skip_blanks(&w);
        if (w.at == w.end || *w.at++ != ':') return false;
        const char *value = w.at;
        if (!skip_value(&w)) return false;
        if (is_id) *id = value, *length = (size_t)(w.at - value);
    } while (*w.at == ',');
    return true;
}

json_t *batch_scene_id(const input_text *line)
{
    const char *text;
    size_t length;
    if (!find_id(line, &text, &length)) return batch_line_id(line);
    json_t *id = text != NULL ? json_loadb(text, length, JSON_DECODE_ANY, NULL) : NULL;
    return id != NULL ? id : json_null();
}

json_t *batch_line_id(const input_text *line)
{
    json_t *object = json_loadb(line->text, line->length, 0, NULL);
    json_t *id = json_object_get(object, "id");
    id = id != NULL ? json_incref(id) : json_null();
    json_decref(object);
    return id;
}

/* --- The file of answers ------------------------------------------------------------------------ */

static bool fail(const batch_resume *resume, const char *what)
{
    complain(EXIT_DATA, resume->verb, "%s: %s", resume->path, what);
    return false;
}

/* Counts the whole lines from the start; *end is behind the last of them. A zero byte is a place
 * that was never written: what is from its line on is torn. */
static bool count_answers(batch_resume *resume, off_t *end)
{
    for (*end = 0; input_read_line(resume->file, resume->path, resume->verb, &resume->line);) {
        const input_text *line = &resume->line;
        if (line->length == 0 || line->text[line->length - 1] != '\n' ||
            memchr(line->text, '\0', line->length) != NULL)
            return true;
        *end += (off_t)line->length;
        resume->answers += 1;
    }
    return false; /* complained of */
}

/* Standard output goes behind the last whole answer from now on. */
static bool take_over_stdout(const batch_resume *resume, int fd, off_t end)
{
    return (lseek(fd, end, SEEK_SET) == end && fflush(stdout) == 0 &&
            standard_output_replace(fd)) ||
           fail(resume, system_error_text(errno));
}

bool batch_resume_open(batch_resume *resume, const char *path, const arguments *args, off_t *size)
{
    *resume = (batch_resume){.path = path,
                             .verb = args->verb->name,
                             .exit_code = arguments_option(args, "exit-code") != NULL};
    if (input_is_same(path, args->operands[0]))
        return fail(resume, "the output must not be the input");
    const int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) return fail(resume, system_error_text(errno));
    resume->file = fopen(path, "r");
    off_t end;
    bool ok = resume->file != NULL || fail(resume, system_error_text(errno));
    ok = ok && count_answers(resume, &end) &&
         (ftruncate(fd, end) == 0 || fail(resume, system_error_text(errno))) &&
         (size != NULL || take_over_stdout(resume, fd, end));
    if (ok && size != NULL) *size = end;
    if (ok) rewind(resume->file);
    close(fd);
    return ok;
}

exit_status batch_resume_close(batch_resume *resume)
{
    free(resume->line.text);
    if (resume->file != NULL) fclose(resume->file);
    const char *speaker = resume->verb;
    *resume = (batch_resume){0};
    return output_flush(speaker);
}

/* What an answer of an earlier run adds to the exit status. */
static answered_line judge(const batch_resume *resume, const json_t *answer)
{
    const char *verdict = json_string_value(json_object_get(answer, "verdict"));
    if (verdict == NULL) return (answered_line){true, EXIT_DATA};
    if (strcmp(verdict, "undecided") == 0) return (answered_line){false, EXIT_UNDECIDED};
    const bool touches = strcmp(verdict, "contact") == 0;
    return (answered_line){false, touches && resume->exit_code ? EXIT_CONTACT : EXIT_ANSWERED};
}

resume_state batch_resume_match(batch_resume *resume, const input_text *scene,
                                answered_line *answer)
{
    if (resume->file == NULL || resume->matched == resume->answers) return RESUME_NEW;
    const bool read = input_read_line(resume->file, resume->path, resume->verb, &resume->line);
    json_t *done = read ? json_loadb(resume->line.text, resume->line.length, 0, NULL) : NULL;
    json_t *wanted = batch_line_id(scene);
    const json_t *id = json_object_get(done, "id");
    resume->matched += 1;
    const bool fits = id != NULL && json_equal(id, wanted);
    *answer = judge(resume, done);
    json_decref(done);
    json_decref(wanted);
    if (fits) return RESUME_ANSWERED;
    complain(EXIT_DATA, resume->verb,
             "%s, line %zu: not the answer to that scene of the input (another id, or no answer); "
             "name the output of the same input, options and shard, or a new file",
             resume->path, resume->matched);
    return RESUME_MISMATCH;
}
