/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_INPUT_H
#define TOOLS_CLI_INPUT_H

#include <stdio.h>

#include "tools/cli/message.h"

/* Files named on the command line; "-" is standard input. */

/* What to call the file in messages. */
const char *input_name(const char *path);

/* Opens for reading. Complains and answers NULL if that cannot be. Close with input_close. */
FILE *input_open(const char *path, const char *verb);
void input_close(FILE *file);

/* What was read, not ended by a zero. Starts empty; free `text`. */
typedef struct input_text {
    char *text;
    size_t length, size;
} input_text;

/* The rest of the file, or its next line with its end, in place of what the text was; no more than
 * 1 GiB. Nothing is left of the file when the length is 0. False: it cannot be read, which is
 * complained of, or a signal came, which is not. */
bool input_read(FILE *file, const char *name, const char *verb, input_text *text);
bool input_read_line(FILE *file, const char *name, const char *verb, input_text *line);

/* Is it a regular file, which may be read twice? */
bool input_is_file(const char *path);

/* Do both paths lead to one file that exists? */
bool input_is_same(const char *a, const char *b);

/* A file of data that comes with the package, or NULL (complained): the build tree's when the
 * command runs from there, else the installed one. Free it. */
char *input_package_file(const char *name, const char *verb);

#endif
