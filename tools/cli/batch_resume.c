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
#include "tools/cli/output_target.h"
#include "tools/cli/standard_output.h"
#include "tools/cli/verbs.h"

static const char *verb_of(const batch_resume *resume) { return resume->args->verb->name; }

static exit_status fail(const batch_resume *resume, const char *what)
{
    return complain(EXIT_DATA, verb_of(resume), "%s: %s", resume->path, what);
}

/* --- Opening ---------------------------------------------------------------------------------- */

/* Whether the line is an incomplete result: cut off, or with a place that was never written. A line
 * that begins with such a place may be anything, unless the file is known for results, or lines
 * before it have to be some. */
static bool is_torn_answer(const batch_resume *resume, const input_text *line)
{
    static const char beginning[] = "{\"id\":";
    const size_t most = sizeof beginning - 1, length = strnlen(line->text, line->length);
    if (length == 0 && line->length > 0) return resume->record.is_known || resume->end > 0;
    return memcmp(line->text, beginning, length < most ? length : most) == 0;
}

static bool is_torn(const input_text *line)
{
    return line->length == 0 || line->text[line->length - 1] != '\n' ||
           memchr(line->text, '\0', line->length) != NULL;
}

/* Counts the complete lines from the start; `end` is the offset after the last of them. A zero byte
 * is a place that was never written: its line and all later ones are incomplete. */
static exit_status count_answers(batch_resume *resume)
{
    while (input_read_line(resume->file, resume->path, verb_of(resume), &resume->line)) {
        if (is_torn(&resume->line)) {
            rewind(resume->file);
            resume->has_rest = resume->line.length > 0;
            if (is_torn_answer(resume, &resume->line)) return EXIT_ANSWERED;
            return fail(resume, "its last line is no answer of a batch; name another file");
        }
        resume->end += (off_t)resume->line.length;
        resume->answers += 1;
    }
    return EXIT_DATA; /* complained of */
}

static exit_status open_file(batch_resume *resume)
{
    const int fd = open(resume->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd >= 0) resume->file = fdopen(fd, "r");
    if (resume->file != NULL) return EXIT_ANSWERED;
    const exit_status status = fail(resume, system_error_text(errno));
    if (fd >= 0) close(fd);
    return status;
}

exit_status batch_resume_open(batch_resume *resume, const char *path, const arguments *args,
                              bool to_stdout)
{
    const output_target target = output_target_of(path);
    *resume = (batch_resume){.path = target.path,
                             .args = args,
                             .record = {.descriptor = -1},
                             .is_new = target.kind == OUTPUT_NEW,
                             .to_stdout = to_stdout};
    if (target.kind == OUTPUT_REFUSED)
        return complain(EXIT_DATA, args->verb->name, "%s: %s", path, system_error_text(errno));
    if (target.path == NULL)
        return complain(EXIT_DATA, args->verb->name,
                        "%s: --resume needs a file, which can be read and cut", path);
    if (input_is_same(path, args->operands[0]))
        return fail(resume, "the output must not be the input");
    exit_status status = batch_record_open(&resume->record, target.path, args);
    if (status == EXIT_ANSWERED) status = open_file(resume);
    return status == EXIT_ANSWERED ? count_answers(resume) : status;
}

exit_status batch_resume_close(batch_resume *resume)
{
    const char *speaker = resume->args != NULL ? verb_of(resume) : NULL;
    if (resume->is_new && !resume->begun && resume->file != NULL) unlink(resume->path);
    if (resume->args != NULL) batch_record_close(&resume->record);
    if (resume->file != NULL) fclose(resume->file);
    free(resume->line.text);
    free(resume->path);
    *resume = (batch_resume){0};
    return output_flush(speaker);
}

/* --- Answers that are there ------------------------------------------------------------------- */

/* Returns what a result of an earlier run adds to the exit status. */
static answered_line judge(const batch_resume *resume, const json_t *answer)
{
    const char *verdict = json_string_value(json_object_get(answer, "verdict"));
    const bool exit_code = arguments_option(resume->args, "exit-code") != NULL;
    if (verdict == NULL) return (answered_line){true, EXIT_DATA};
    if (strcmp(verdict, "undecided") == 0) return (answered_line){false, EXIT_UNDECIDED};
    const bool touches = strcmp(verdict, "contact") == 0;
    return (answered_line){false, touches && exit_code ? EXIT_CONTACT : EXIT_ANSWERED};
}

/* Returns the gamma that a scene is solved with. */
static double gamma_of(const batch_resume *resume, const json_t *scene)
{
    const option_value *given = arguments_option(resume->args, "gamma");
    const json_t *own = json_object_get(scene, "gamma");
    if (given != NULL) return given->number[0];
    return json_is_number(own) ? json_number_value(own) : 1e-6; /* as scene files are read */
}

static bool refuse(const batch_resume *resume, const char *why)
{
    complain(
        EXIT_DATA, verb_of(resume),
        "%s, line %zu: %s; name the output of the same input, options and shard, or a new file",
        resume->path, resume->matched, why);
    return false;
}

/* Whether the result is that scene's. Complains if not. */
static bool fits(const batch_resume *resume, const json_t *answer, const json_t *scene)
{
    const json_t *id = json_object_get(answer, "id"), *wanted = json_object_get(scene, "id");
    const json_t *gamma = json_object_get(answer, "gamma");
    if (id == NULL || !(wanted != NULL ? json_equal(id, wanted) : json_is_null(id)))
        return refuse(resume,
                      "not the answer to that scene of the input (another id, or no answer)");
    if (gamma == NULL || json_number_value(gamma) == gamma_of(resume, scene)) return true;
    return refuse(resume, "the answer was asked for with another gamma");
}

/* Truncates the file after its results, all of which match. */
static bool begin(batch_resume *resume)
{
    const int fd = fileno(resume->file);
    if (resume->begun) return true;
    if (batch_record_write(&resume->record, resume->args) != EXIT_ANSWERED) return false;
    resume->begun = ftruncate(fd, resume->end) == 0;
    if (resume->begun && resume->to_stdout)
        resume->begun = lseek(fd, resume->end, SEEK_SET) == resume->end && fflush(stdout) == 0 &&
                        standard_output_replace(fd);
    if (!resume->begun) fail(resume, system_error_text(errno));
    return resume->begun;
}

/* Whether `scene`, the first one of the input, is the one whose hash the record has; where it has
 * none, that becomes its hash. Complains if not. */
static bool is_first_scene(batch_resume *resume, const input_text *scene)
{
    char *known = resume->record.scene, own[SHA256_TEXT];
    uint8_t digest[SHA256_BYTES];
    size_t length = scene->length;
    sha256 hash;
    while (length > 0 && strchr("\r\n", scene->text[length - 1]) != NULL) length -= 1;
    sha256_begin(&hash);
    sha256_add(&hash, scene->text, length);
    sha256_end(&hash, digest);
    sha256_text(digest, own);
    if (known[0] == '\0' && !resume->record.is_known) memcpy(known, own, sizeof own);
    if (known[0] == '\0' || strcmp(known, own) == 0) return true;
    complain(EXIT_DATA, verb_of(resume),
             "%s: its answers were made from another input, whose first scene differs (%s); name "
             "the output of this input, or a new file",
             resume->path, resume->record.path);
    return false;
}

resume_state batch_resume_match(batch_resume *resume, const input_text *scene,
                                answered_line *answer)
{
    if (resume->file == NULL) return RESUME_NEW;
    const bool is_first = resume->matched == 0 && !resume->begun;
    if (resume->matched == resume->answers)
        return (!is_first || is_first_scene(resume, scene)) && begin(resume) ? RESUME_NEW
                                                                             : RESUME_REFUSED;
    const bool read = input_read_line(resume->file, resume->path, verb_of(resume), &resume->line);
    json_t *done = read ? json_loadb(resume->line.text, resume->line.length, 0, NULL) : NULL;
    json_t *asked = json_loadb(scene->text, scene->length, 0, NULL);
    resume->matched += 1;
    const bool good = fits(resume, done, asked) && (!is_first || is_first_scene(resume, scene));
    *answer = judge(resume, done);
    json_decref(done);
    json_decref(asked);
    return good ? RESUME_ANSWERED : RESUME_REFUSED;
}

bool batch_resume_match_end(batch_resume *resume)
{
    if (resume->file == NULL || resume->begun) return true;
    if (resume->matched == resume->answers && !resume->has_rest) return begin(resume);
    resume->matched += 1;
    return refuse(resume, "the input has no scene for this line");
}
