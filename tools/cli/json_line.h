/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_JSON_LINE_H
#define TOOLS_CLI_JSON_LINE_H

#include <jansson.h>

/* Writes any value as compact JSON: members in their order, strings as Jansson writes them, numbers
 * as shortest_write does. [any thread]. The caller frees it. NULL: no memory, now or when the value
 * was made (json_memory.h). */
char *json_line_text(json_t *value);

#endif
