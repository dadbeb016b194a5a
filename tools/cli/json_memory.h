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
 * the command checks this before it prints: JSON values read or made since then may be damaged. */

void json_memory_prepare(void);

bool json_memory_failed(void);

/* Returns the text of a value, like json_dumps; free it with free(). NULL: an allocation failed,
 * even if json_dumps only left out a key. The value may be NULL. */
char *json_memory_text(const json_t *value, size_t flags);

#endif
