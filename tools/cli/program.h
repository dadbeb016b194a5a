/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_PROGRAM_H
#define TOOLS_CLI_PROGRAM_H

#include <stdbool.h>

/* Runs other programs, such as compilers and pkg-config, and waits for them. */

typedef enum program_stream { PROGRAM_OUTPUT = 1, PROGRAM_ERRORS = 2 } program_stream;

typedef struct program_end {
    int error;  /* why it could not be run (as errno), or 0 */
    int status; /* its exit status; 128 + number if a signal ended it */
    char *said; /* the text that it wrote to the stream, NUL-terminated, or NULL; free it */
} program_end;

/* Runs words[0], found on PATH, with its NULL-terminated words. What it writes to `stream` is
 * kept and, if `shown`, passed on to standard error as it comes; the other streams are ours.
 * An interrupt from the keyboard ends the program, not us. */
program_end program_run(const char *const *words, program_stream stream, bool shown);

/* Returns the file that the shell would run for this name, or NULL. Free it. */
char *program_find(const char *name);

/* Returns the program of that name in this program's own folder (of a build tree: in tools), else
 * on PATH, or NULL. Free it. */
char *program_beside(const char *name);

/* Appends the blank-separated words of `text`, which is modified, at words[*count]. False: there
 * would be more than `most`; the rest is left out. */
bool program_words(char *text, const char **words, int *count, int most);

#endif
