/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_READING_LIMIT_H
#define TOOLS_CLI_READING_LIMIT_H

#include "tools/cli/arguments.h"

/* --max-seconds while a scene is read, which cannot be interrupted: an alarm ends the process, with
 * a message and EXIT_UNDECIDED, once reading has taken that much time of the processor, and a tenth
 * and 0.2 s more; who reads in less is left to the search, whose answer says more. Isolated types
 * have a limit of their own. */
void reading_limit_begin(const arguments *args);
void reading_limit_end(void);

#endif
