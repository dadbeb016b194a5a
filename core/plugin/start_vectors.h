/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_START_VECTORS_H
#define CORE_PLUGIN_START_VECTORS_H

#include <stdbool.h>
#include <stddef.h>

/* Whether constructors leave the program's arguments and environment alone
 * ========================================================================
 * The loader calls constructors with argc, argv and envp. In a damaged file another function of
 * the plugin may be called instead, which takes them for its outputs: it returns in order, and the
 * host dies when it reads its environment next. So a trial compares both vectors. A constructor may
 * set variables, also ones that were set, but must not lose one. */

typedef struct start_vectors {
    char **names; /* of environment variables */
    size_t name_count;
    char **arguments; /* argv, where the C library tells it to shared objects; or none */
    size_t argument_count;
} start_vectors;

/* False: no memory; nothing is to be freed then. */
bool start_vectors_copy(start_vectors *v);

/* Whether the program still has them; false: `text` says what is gone. It crashes if the
 * environment cannot be read any more. */
bool start_vectors_are_kept(const start_vectors *v, char *text, size_t size);

void start_vectors_free(start_vectors *v);

#endif
