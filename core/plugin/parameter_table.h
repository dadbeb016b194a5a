/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_PARAMETER_TABLE_H
#define CORE_PLUGIN_PARAMETER_TABLE_H

#include <impinge/surface.h>

#include <stddef.h>

/* A type's parameter table, and its rows in words
 * ===============================================
 * Rows are found by the table's own stride, for a plugin's rows may be longer than ours. */

typedef struct parameter_table {
    const imp_parameter *rows;
    size_t count;
    size_t stride; /* bytes from row to row */
} parameter_table;

const imp_parameter *parameter_table_row(const parameter_table *table, size_t index);

/* Returns the index of the row of that name, or -1. */
ptrdiff_t parameter_table_find(const parameter_table *table, const char *name);

/* Returns how many bytes at the beginning of the text could be of a parameter's name. */
size_t parameter_name_length(const char *text);

/* Returns the parameter's name nearest to `name`, or NULL if none is near. */
const char *parameter_table_nearest(const parameter_table *table, const char *name);

/* A text that stands in a sentence after "must be". */
typedef struct parameter_words {
    char at[120];
} parameter_words;

/* "> 0", "in [0, 2)"; "finite" if there is no limit. */
parameter_words parameter_range_words(const imp_parameter *row);

/* What is expected at a depth of the value: "an array of 3 numbers > 0" at depth 0 of a vector,
 * "a number > 0" at its depth 1. */
parameter_words parameter_shape_words(const imp_parameter *row, uint32_t depth);

#endif
