/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CATALOGUE_H
#define TOOLS_CLI_CATALOGUE_H

#include <impinge/impinge.h>
#include <jansson.h>

/* Descriptions of types, for people and for programs. */

/* Returns "surface" or "map". */
const char *catalogue_kind_name(imp_type_kind kind);

/* Returns row `index` of the type's parameter table. */
const imp_parameter *catalogue_parameter(const imp_type_info *info, size_t index);

/* "number", "vector of 3 numbers", "list of vectors of 3 numbers", ... */
typedef struct shape_text {
    char text[160];
} shape_text;
shape_text catalogue_shape(const imp_parameter *p);

/* "> 0", "from 0 to 2", "> 0 and <= 2", "" where every number is allowed. */
typedef struct range_text {
    char text[96];
} range_text;
range_text catalogue_range(const imp_parameter *p);

/* Return the type as in the objects of tools/schema/types.schema.json: in short, as `list` prints
 * it, or in full, as `info` does. NULL: no memory. */
json_t *catalogue_short_json(const imp_type_info *info);
json_t *catalogue_full_json(const imp_type_info *info);

#endif
