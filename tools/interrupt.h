/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_INTERRUPT_H
#define TOOLS_INTERRUPT_H

#include <impinge/impinge.h>

/* SIGINT and SIGTERM end a search, not its answer
 * ===============================================
 * The first signal cancels the query that is watched, which then tells what is proved so far. A
 * second one of the same kind ends the process as usual. */

/* From now on signals are taken. Before, they end the process: nothing is proved yet. */
void interrupt_prepare(void);

/* The query to cancel from now on; NULL: none. Unwatch before freeing it. */
void interrupt_watch(imp_query *query);

/* Whether a signal has come. */
bool interrupt_came(void);

#endif
