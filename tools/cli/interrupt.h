/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_INTERRUPT_H
#define TOOLS_CLI_INTERRUPT_H

#include <stdbool.h>

/* SIGINT and SIGTERM end a search, not its answer
 * ===============================================
 * Queries call interrupt_came about ten times a second (imp_options.progress) and end with what is
 * proved so far. A second signal of the same kind ends the process as usual, and a message names
 * the callback that may hang. */

/* Installs the handlers. Before, signals end the process: nothing is proved yet. */
void interrupt_prepare(void);

/* Whether a signal has come. [any thread] */
bool interrupt_came(void);

#endif
