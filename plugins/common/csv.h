/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_CSV_H
#define PLUGINS_COMMON_CSV_H

#include <impinge/plugin.h>
#include <stddef.h>

/* Columns of numbers from a file
 * ==============================
 * Cells (csv_cell.h) between commas, or between semicolons or tabs if the first line has these.
 * Empty lines, and those that begin with '#', are passed over. If no cell of the first line that is
 * left begins as a number does, and one is not empty, it is the head, which names the columns.
 * Every cell of every other line is a finite number, and all lines have as many cells as the
 * first. */

enum { CSV_COLUMNS_MAX = 4, CSV_LINE_MAX = 65536, CSV_UNIT_MAX = 16 };

/* The numbers read: `columns` in each of `rows` rows. */
typedef struct csv_numbers {
    double *number;
    size_t rows, capacity, columns;
    size_t place[CSV_COLUMNS_MAX];            /* of each column in the file, from 0 */
    char unit[CSV_COLUMNS_MAX][CSV_UNIT_MAX]; /* from the head, cut if longer; "": none */
} csv_numbers;

/* Reads the first column and those called `name` (to->columns in all); NULL: those that follow it.
 * The caller frees to->number, also on failure. `row` is the parameter with the path, `name_row`
 * that with names. */
imp_status csv_read(const char *path, int row, const char *const *name, int name_row,
                    csv_numbers *to, imp_create_error *why);

#endif
