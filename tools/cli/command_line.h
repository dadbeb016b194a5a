/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_COMMAND_LINE_H
#define TOOLS_CLI_COMMAND_LINE_H

#include <stdbool.h>
#include <stddef.h>

/* A command line as it is typed into a shell, up to the cursor: words between blanks, without their
 * quotes and backslashes. The last one is the word at the cursor; it may be empty. */
typedef struct command_line {
    char *text; /* owns the words */
    const char **words;
    size_t count;   /* at least 1 */
    bool is_quoted; /* the word at the cursor has a quote that is still open */
} command_line;

/* False: no memory. Free it in any case. */
bool command_line_split(const char *typed, command_line *line);
void command_line_free(command_line *line);

#endif
