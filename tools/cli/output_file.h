/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_OUTPUT_FILE_H
#define TOOLS_CLI_OUTPUT_FILE_H

#include <stdio.h>

#include "tools/cli/message.h"

/* A file that appears whole or not at all: written beside its place under another name, then
 * renamed. */

typedef struct output_file {
    FILE *file;
    char *path, *draft;
    const char *verb;
} output_file;

/* Complains on behalf of `verb` where it cannot be. */
exit_status output_file_begin(output_file *out, const char *path, const char *verb);

/* Puts the file in its place if all of it could be written and `keep`; else removes the draft.
 * Complains of what went wrong in writing. */
exit_status output_file_end(output_file *out, bool keep);

#endif
