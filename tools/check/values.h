/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_VALUES_H
#define TOOLS_CHECK_VALUES_H

#include <impinge/impinge.h>
#include <jansson.h>

/* The parameters' values in a stage, "sphere radius=2", as the host reads them. */

/* Returns all of it: {"type": "sphere", "radius": 2}. NULL: it cannot be read, or no memory. */
json_t *stage_values(const imp_registry *registry, imp_type_kind kind, const char *stage);

/* Returns a parameter's value among them, or the table's default. NULL: absent, or no memory. */
json_t *stage_value(const json_t *values, const imp_parameter *row);

/* Returns the stage with the parameter's value, text, replaced or added. Free it. NULL: it cannot
 * be read, or no memory. */
char *stage_with(const imp_registry *registry, imp_type_kind kind, const char *stage,
                 const char *parameter, const char *value);

/* The stage that has these values. Free it. NULL: no memory. */
char *stage_print(json_t *values);

#endif
