/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_READING_LIMIT_H
#define TOOLS_CLI_READING_LIMIT_H

#include "tools/cli/arguments.h"
#include "tools/cli/input.h"

#include <impinge/impinge.h>

/* --max-seconds and --max-bytes while a scene is read. */

/* Gives the limits, and a tenth (and 0.1 s) more, to the registry, where the verb has them: the
 * scene is then refused, with EXIT_UNDECIDED, at the next place that asks. Who reads in less is
 * left to the search, whose answer says more. */
imp_code reading_limit_share(const arguments *args, imp_registry *registry, imp_error *error);

/* Returns the bytes that a text may have, for input_text. */
size_t reading_limit_most(const arguments *args);

/* Complains, with EXIT_UNDECIDED, if a text of a scene is too large to be parsed that many times
 * within --max-bytes. */
exit_status reading_limit_check(const arguments *args, const input_text *text, unsigned times);

/* A type that does not ask cannot be interrupted: an alarm of this thread ends the process, with a
 * message and EXIT_UNDECIDED, once reading has taken that much of the thread's time, and a tenth
 * and 0.2 s more. `scene`: its name; NULL: "the scene". Isolated types have a limit of their own.
 * [any thread] */
void reading_limit_begin(const arguments *args, const char *scene);
void reading_limit_end(void);

#endif
