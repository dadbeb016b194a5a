/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_JSON_MEMORY_H
#define TOOLS_CLI_JSON_MEMORY_H

#include <jansson.h>
#include <stdbool.h>

/* Memory for Jansson that fails for good
 * ======================================
 * Jansson 2.14 does not always report an allocation that failed: an object may lack keys, or be
 * damaged by what is put into it afterwards. So once one allocation has failed all others do, and
 * the command asks before it prints whether that has happened: nothing that was read or made since
 * then can be relied on. */

void json_memory_prepare(void);

bool json_memory_failed(void);

/* The text of a value, as of json_dumps, for free(); NULL: memory failed, also where json_dumps has
 * left out a key instead of saying so. NULL is accepted. */
char *json_memory_text(const json_t *value, size_t flags);

#endif
