/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/batch_record.h"

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/common/system_error.h"
#include "tools/cli/file_lock.h"
#include "tools/cli/output.h"
#include "tools/cli/verbs.h"

/* Whether the option changes decided results: limits and options of output or threads do not. */
static bool changes_questions(const char *name)
{
    static const char *const others[] = {
        "audit",    "exit-code",   "isolate",  "json",   "max-bytes", "max-pairs", "max-seconds",
        "no-color", "plugin-path", "progress", "resume", "secure",    "threads"};
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k)
        if (strcmp(others[k], name) == 0) return false;
    return true;
}

/* {"options": {NAME: VALUE, ...}}, values as they were written. NULL: no memory. */
static json_t *record_json(const arguments *args)
{
    json_t *options = json_object();
    for (size_t k = 0; k < args->value_count; ++k) {
        const option_value *value = &args->values[k];
        if (changes_questions(value->row->name))
            json_object_set_new(options, value->row->name,
                                output_json_text(value->text != NULL ? value->text : ""));
    }
    return json_pack("{s:o}", "options", options);
}

/* --- Comparison with the present options ------------------------------------------------------ */

/* Complains of an option that was given with another value, or in only one of the two runs. */
static exit_status complain_of_option(const batch_record *record, const char *out, const char *name,
                                      const json_t *then, const json_t *now, const char *speaker)
{
    static const char cure[] = "give the same options, or name a new file";
    if (then == NULL)
        return complain(EXIT_DATA, speaker,
                        "%s: its answers were made without --%s, this run has --%s %s (%s); %s",
                        out, name, name, json_string_value(now), record->path, cure);
    if (now == NULL)
        return complain(EXIT_DATA, speaker,
                        "%s: its answers were made with --%s %s, this run has none (%s); %s", out,
                        name, json_string_value(then), record->path, cure);
    return complain(
        EXIT_DATA, speaker, "%s: its answers were made with --%s %s, this run has --%s %s (%s); %s",
        out, name, json_string_value(then), name, json_string_value(now), record->path, cure);
}

/* Returns the first option of `x` that `y` lacks or has with another value; NULL: there is none. */
static const char *first_other(json_t *x, const json_t *y)
{
    const char *name;
    json_t *value;
    json_object_foreach(x, name,
                        value) if (!json_equal(value, json_object_get(y, name))) return name;
    return NULL;
}

static exit_status compare(const batch_record *record, const char *out, json_t *then, json_t *now,
                           const arguments *args)
{
    const char *name = first_other(then, now);
    if (name == NULL) name = first_other(now, then);
    if (name == NULL) return EXIT_ANSWERED;
    return complain_of_option(record, out, name, json_object_get(then, name),
                              json_object_get(now, name), args->verb->name);
}

/* Compares the record's text with the present options; an empty record is new. */
static exit_status judge(batch_record *record, const char *out, const arguments *args)
{
    char text[1 << 14];
    const ssize_t length = pread(record->descriptor, text, sizeof text, 0);
    if (length < 0)
        return complain(EXIT_DATA, args->verb->name, "%s: %s", record->path,
                        system_error_text(errno));
    record->is_known = length > 0;
    if (length == 0) return EXIT_ANSWERED;
    json_t *then = json_loadb(text, (size_t)length, 0, NULL), *now = record_json(args);
    json_t *options = json_object_get(then, "options");
    const exit_status status =
        !json_is_object(options)
            ? complain(EXIT_DATA, args->verb->name,
                       "%s: does not tell how the answers of %s were made; name a new file",
                       record->path, out)
            : compare(record, out, options, json_object_get(now, "options"), args);
    json_decref(then);
    json_decref(now);
    return status;
}

/* --- The file --------------------------------------------------------------------------------- */

exit_status batch_record_open(batch_record *record, const char *out, const arguments *args)
{
    struct stat is;
    *record = (batch_record){.descriptor = -1};
    if (asprintf(&record->path, "%s.options", out) < 0) {
        record->path = NULL;
        return complain_of_memory(args->verb->name);
    }
    const file_lock lock = {.file = record->path, .output = out, .verb = args->verb->name};
    const exit_status locked = file_lock_open(&lock, &record->descriptor, &is);
    return locked == EXIT_ANSWERED ? judge(record, out, args) : locked;
}

exit_status batch_record_write(batch_record *record, const arguments *args)
{
    if (record->is_known) return EXIT_ANSWERED;
    char *line = output_json_line(record_json(args)), *text = NULL;
    const int length = line != NULL ? asprintf(&text, "%s\n", line) : -1;
    free(line);
    if (length < 0) return complain_of_memory(args->verb->name);
    record->is_known = write(record->descriptor, text, (size_t)length) == length;
    const int error = errno;
    free(text);
    if (record->is_known) return EXIT_ANSWERED;
    return complain(EXIT_DATA, args->verb->name, "%s: %s", record->path, system_error_text(error));
}

void batch_record_close(batch_record *record)
{
    if (record->descriptor >= 0 && !record->is_known) unlink(record->path);
    if (record->descriptor >= 0) close(record->descriptor);
    free(record->path);
    *record = (batch_record){.descriptor = -1};
}
