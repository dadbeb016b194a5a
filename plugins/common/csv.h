/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_CSV_H
#define PLUGINS_COMMON_CSV_H

#include <impinge/plugin.h>
#include <stddef.h>

/* Columns of numbers from a file
 * ==============================
 * Fields between commas, semicolons or tabs, with a point in numbers in every locale. Empty lines, and
 * those that begin with '#', are passed over. If the first line that is left has a field that is no
 * number, it names the columns. */

enum { CSV_COLUMNS_MAX = 4, CSV_LINE_MAX = 65536 };

/* What was read: `columns` numbers in each of `rows` rows. */
typedef struct csv_numbers {
    double *number;
    size_t rows, capacity, columns;
} csv_numbers;

/* Reads the first column and those called `name` (to->columns in all). The caller frees
 * to->number, also on failure. `row` is the parameter with the path, `name_row` that with names. */
imp_status csv_read(const char *path, int row, const char *const *name, int name_row,
                    csv_numbers *to, imp_create_error *why);

#endif
