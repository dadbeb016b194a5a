/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BATCH_RESUME_H
#define TOOLS_CLI_BATCH_RESUME_H

#include <jansson.h>

#include "tools/cli/arguments.h"
#include "tools/cli/input.h"

/* Which scenes of a batch are answered by this run
 * ================================================
 * A run that was interrupted left a file of answers. With --resume OUT its last line, if torn, is
 * cut off, the scenes that have answers are passed over, and the rest goes behind them. With
 * --shard I/N a run answers scenes I, I + N, I + 2N, ... */

typedef struct batch_shard {
    size_t index, count; /* index from 0 */
} batch_shard;

/* From --shard, if it is given. Complains of what is wrong. */
exit_status batch_shard_read(const arguments *args, batch_shard *shard);

/* The "id" of a scene's line, or null, also where the line is no JSON. NULL: no memory. */
json_t *batch_line_id(const input_text *line);

/* The same of a line that is known to be a scene, without reading it all again. */
json_t *batch_scene_id(const input_text *line);

typedef struct batch_resume {
    FILE *file;       /* NULL: not resumed */
    const char *path; /* the caller's */
    const char *verb;
    size_t answers, matched; /* lines of the file; those that the input has come to */
    bool exit_code;
    input_text line;
} batch_resume; /* begins as {0} */

/* Opens the file, or makes it, cuts off a torn last line, and lets standard output go behind the
 * answers, unless `size` is given: then the caller writes from there on. Complains and answers false if
 * that cannot be. */
bool batch_resume_open(batch_resume *resume, const char *path, const arguments *args, off_t *size);

/* Complains if the file could not be written. */
exit_status batch_resume_close(batch_resume *resume);

typedef enum resume_state {
    RESUME_NEW,      /* no answer yet */
    RESUME_ANSWERED, /* the file has one */
    RESUME_MISMATCH  /* the file has one with another id, which is complained of */
} resume_state;

typedef struct answered_line {
    bool failed; /* by an error */
    exit_status status;
} answered_line;

/* The next scene of the input against the next answer of the file. `answer` is set with
 * RESUME_ANSWERED. */
resume_state batch_resume_match(batch_resume *resume, const input_text *scene,
                                answered_line *answer);

#endif
