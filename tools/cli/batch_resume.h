/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BATCH_RESUME_H
#define TOOLS_CLI_BATCH_RESUME_H

#include "tools/cli/batch_record.h"
#include "tools/cli/batch_scene.h"

/* --resume OUT: a batch goes on behind the answers that an earlier run left
 * =========================================================================
 * Scenes that have results are skipped, an incomplete last line is removed, and new results are
 * appended. The file is not changed before all its results were found to be those of the input's
 * scenes, with the same options. */

typedef struct batch_resume {
    FILE *file; /* NULL: not resumed */
    char *path; /* links followed */
    const arguments *args;
    batch_record record;
    bool is_new;    /* the file was not there before */
    bool begun;     /* answers may be written */
    bool to_stdout; /* standard output is redirected to it; else the owner writes from `end` on */
    off_t end;      /* offset after the last complete result */
    bool has_rest;  /* an incomplete line follows */
    size_t answers, matched; /* lines of the file; those that the input has come to */
    input_text line;
} batch_resume; /* begins as {0} */

/* Opens the file, or makes it, and checks what can be checked before the input is read. Complains.
 * Call batch_resume_close in any case. */
exit_status batch_resume_open(batch_resume *resume, const char *path, const arguments *args,
                              bool to_stdout);

/* Complains if the file could not be written. */
exit_status batch_resume_close(batch_resume *resume);

typedef enum resume_state {
    RESUME_NEW,      /* no result yet; the file is ready for it */
    RESUME_ANSWERED, /* the file has one */
    RESUME_REFUSED   /* complained: the file has another scene's result, or cannot be written */
} resume_state;

typedef struct answered_line {
    bool failed; /* by an error */
    exit_status status;
} answered_line;

/* Compares the next scene of the input with the next result of the file. `answer` is set with
 * RESUME_ANSWERED. */
resume_state batch_resume_match(batch_resume *resume, const input_text *scene,
                                answered_line *answer);

/* Call it at the end of the input. False: the file has more results; it complains. */
bool batch_resume_match_end(batch_resume *resume);

#endif
