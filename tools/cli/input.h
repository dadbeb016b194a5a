/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_INPUT_H
#define TOOLS_CLI_INPUT_H

#include <stdio.h>

#include "tools/cli/message.h"

/* Files named on the command line; "-" is standard input. */

/* Returns the file's name for messages. */
const char *input_name(const char *path);

/* Opens a file for reading. On failure complains and returns NULL. Close with input_close. */
FILE *input_open(const char *path, const char *verb);
void input_close(FILE *file);

/* The text that was read, not NUL-terminated. Starts empty; free `text`. */
typedef struct input_text {
    char *text;
    size_t length, size;
    size_t most;      /* bytes it may have, at most 1 GiB; 0: 1 GiB */
    bool is_too_long; /* it has more, and cannot be read */
} input_text;

/* Read the rest of the file, or its next line with its line end, into `text`. Length
 * 0: the end of the file. False: it cannot be read (they complain), or a signal came (they do
 * not). */
bool input_read(FILE *file, const char *name, const char *verb, input_text *text);
bool input_read_line(FILE *file, const char *name, const char *verb, input_text *line);

/* Whether the path is a regular file, which may be read twice. */
bool input_is_file(const char *path);

/* Whether both paths lead to one existing file. */
bool input_is_same(const char *a, const char *b);

/* Returns the path of a data file of the package, or NULL (complained): the build tree's if the
 * command runs from there, else the installed one. Free it. */
char *input_package_file(const char *name, const char *verb);

#endif
