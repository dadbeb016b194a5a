/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_INPUT_H
#define TOOLS_INPUT_H

#include <stdio.h>

#include "message.h"

/* Files named on the command line; "-" is standard input. */

/* What to call the file in messages. */
const char *input_name(const char *path);

/* Opens for reading. Complains and answers NULL if that cannot be. Close with input_close. */
FILE *input_open(const char *path, const char *verb);
void input_close(FILE *file);

/* The rest of the file, in memory. Complains and answers false if it cannot be read. Free *text. */
bool input_read(FILE *file, const char *name, const char *verb, char **text, size_t *length);

/* Do both paths lead to one file that exists? */
bool input_is_same(const char *a, const char *b);

/* A file of data that comes with the package, or NULL (complained): the build tree's when the
 * command runs from there, else the installed one. Free it. */
char *input_package_file(const char *name, const char *verb);

#endif
