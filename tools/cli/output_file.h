/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_OUTPUT_FILE_H
#define TOOLS_CLI_OUTPUT_FILE_H

#include <stdio.h>

#include "tools/cli/message.h"
#include "tools/cli/output_target.h"

/* A file that appears whole or not at all
 * =======================================
 * It is written beside its place, as FILE.part, which then replaces FILE. FILE.part is locked
 * meanwhile, so that of two runs on one output the second is refused. Symbolic links stay: the file
 * they lead to is replaced, with its mode and, where that is allowed, its owner. Devices, pipes and
 * descriptors are written directly; "-" is standard output. */

typedef struct output_file {
    FILE *file; /* to write to */
    int descriptor;
    int error;    /* errno of the first write that failed; 0: none */
    char *path;   /* the name that the user gave */
    char *target; /* the file that FILE.part replaces; NULL: written directly */
    char *draft;  /* FILE.part; NULL: written straight through */
    const char *verb;
} output_file;

/* Opens the file. Complains on behalf of `verb`. The struct must not move until output_file_end. */
exit_status output_file_begin(output_file *out, const char *path, const char *verb);

/* Puts the file in its place if all of it was written and `keep`; else removes the draft. Complains
 * about errors of writing even without `keep`, since they may be why the caller failed. */
exit_status output_file_end(output_file *out, bool keep);

#endif
