/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_CSV_CELL_H
#define PLUGINS_COMMON_CSV_CELL_H

#include <stdbool.h>
#include <stddef.h>

/* Cells of a line of a table
 * ==========================
 * A cell is the text between two separators, without the blanks and quotes around it. A number
 * has a point in every locale. The cells of a head are names, perhaps with a unit: "j1 [deg]", "x
 * (mm)". */

/* A part of a line, which is not terminated. */
typedef struct csv_cell {
    const char *text;
    size_t length;
} csv_cell;

/* Returns the separator of a table whose first line this is: a semicolon if it has one, else a tab
 * if it has one, else a comma. */
char csv_separator_of(const char *line);

/* Cuts the cell at *next off; false: none is left. *next then is the cell after it, or NULL. */
bool csv_cell_next(const char **next, char separator, csv_cell *cell);

/* False: it is no finite number. */
bool csv_cell_number(const csv_cell *cell, double *number);

/* Whether the cell may be in a head: it is empty, or does not begin like a number, "nan" or
 * "inf". */
bool csv_cell_is_name(const csv_cell *cell);

/* Splits off the unit in brackets at the end of a name; both lose the blanks around them. A unit of
 * length 0: there is none. */
void csv_cell_split(const csv_cell *cell, csv_cell *name, csv_cell *unit);

bool csv_cell_equals(const csv_cell *cell, const char *text);

#endif
