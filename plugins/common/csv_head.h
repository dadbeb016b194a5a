/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_CSV_HEAD_H
#define PLUGINS_COMMON_CSV_HEAD_H

#include "plugins/common/csv.h"
#include "plugins/common/csv_cell.h"

#include <stdbool.h>
#include <stdio.h>

/* The head of a file of columns, and the columns that are chosen by it. */

typedef struct csv_reader {
    FILE *file;
    const char *path;
    unsigned long line, first_line; /* numbers from 1; the first that counts */
    char *text;                     /* CSV_LINE_MAX */
    char separator;                 /* that of the first line */
    size_t width;                   /* cells of the first line; 0: it is not read yet */
    int row;                        /* of the parameter, for errors */
    imp_create_error *why;
} csv_reader;

/* Whether the line is one of names, not all of them empty. */
bool csv_has_head(const csv_reader *r);

/* Finds the columns by the head ("" if there is none), or by number, from 1. Without names: the
 * second column, the third, .... The first is always the first. */
imp_status csv_find_columns(const csv_reader *r, const char *head, const char *const *name,
                            int name_row, csv_numbers *to);

/* Takes the units that the head gives in brackets. */
void csv_take_units(const csv_reader *r, const char *head, csv_numbers *to);

/* Returns the ending of a word for this count. */
static inline const char *csv_plural(size_t count) { return count == 1 ? "" : "s"; }

#endif
