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
#include "tools/cli/run_options.h"
#include "tools/cli/verbs.h"

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
    json_t *then = json_loadb(text, (size_t)length, 0, NULL), *now = run_options_json(args);
    const run_options_source of = {out, record->path};
    json_t *options = json_object_get(then, "options");
    const exit_status status =
        !json_is_object(options)
            ? complain(EXIT_DATA, args->verb->name,
                       "%s: does not tell how the answers of %s were made; name a new file",
                       record->path, out)
            : run_options_compare(&of, options, json_object_get(now, "options"), args);
    const char *scene = json_string_value(json_object_get(then, "scene"));
    if (scene != NULL) snprintf(record->scene, sizeof record->scene, "%s", scene);
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
    json_t *json = run_options_json(args);
    if (record->scene[0] != '\0') json_object_set_new(json, "scene", json_string(record->scene));
    char *line = output_json_line(json), *text = NULL;
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
