/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CREW_H
#define TOOLS_CLI_CREW_H

#include <stddef.h>

/* Threads that the command lends to a query (imp_options.parallel): they and the thread that calls
 * take one piece of work after the other. Where no thread can be started the caller does all. */

typedef struct crew {
    size_t threads; /* the caller's included */
} crew;

void crew_run(void *context, void (*work)(void *of, size_t index), void *of, size_t count);

#endif
