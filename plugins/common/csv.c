/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/csv.h"

#include "plugins/common/csv_cell.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

/* --- Lines ------------------------------------------------------------------------------------ */

/* Reads a line, without its end ("\n", "\r\n" or "\r"); *length is 0 for an empty one. False: none
 * is left. */
static bool csv_read_line(csv_reader *r, size_t *length)
{
    int c = getc(r->file);
    if (c == EOF) return false;
    *length = 0;
    for (; c != EOF && c != '\n' && c != '\r' && *length < CSV_LINE_MAX - 1; c = getc(r->file))
        r->text[(*length)++] = (char)c;
    if (c == '\r') c = getc(r->file);
    if (c != '\n' && c != EOF) ungetc(c, r->file);
    r->text[*length] = '\0';
    r->line += 1;
    return true;
}

/* Passes over the byte order mark that some programs begin UTF-8 with. */
static void csv_skip_mark(csv_reader *r)
{
    char mark[3];
    const bool is_mark = fread(mark, 1, sizeof mark, r->file) == sizeof mark &&
                         memcmp(mark, "\xEF\xBB\xBF", sizeof mark) == 0;
    if (!is_mark) rewind(r->file);
}

/* Reads the next line with cells; *more is false at the end of the file. */
static imp_status csv_next_line(csv_reader *r, bool *more)
{
    for (;;) {
        size_t length = 0;
        *more = csv_read_line(r, &length);
        if (ferror(r->file))
            return imp_reject(r->why, r->row, -1, "'%.120s' cannot be read", r->path);
        if (!*more) return IMP_STATUS_OK;
        if (length == CSV_LINE_MAX - 1)
            return imp_reject(r->why, r->row, -1, "'%.120s' line %lu is longer than %d bytes",
                              r->path, r->line, CSV_LINE_MAX - 2);
        if (strlen(r->text) != length)
            return imp_reject(r->why, r->row, -1,
                              "'%.120s' line %lu: found a byte 0, allowed is text", r->path,
                              r->line);
        if (r->text[strspn(r->text, " \t")] != '\0' && r->text[0] != '#') return IMP_STATUS_OK;
    }
}

/* --- Heads ------------------------------------------------------------------------------------ */

/* Returns the ending of a word for this count. */
static const char *plural(size_t count) { return count == 1 ? "" : "s"; }

static const char *separators_told(char separator)
{
    return separator == ';' ? " between semicolons" : separator == '\t' ? " between tabs" : "";
}

/* A line of names, not all of them empty. */
static bool csv_is_head(const csv_reader *r)
{
    const char *next = r->text;
    bool named = false;
    for (csv_cell cell; csv_cell_next(&next, r->separator, &cell);) {
        if (!csv_cell_is_name(&cell)) return false;
        named = named || cell.length > 0;
    }
    return named;
}

static size_t csv_count(const char *line, char separator)
{
    size_t count = 1;
    for (; *line != '\0'; ++line) count += *line == separator;
    return count;
}

/* The list of columns for a message, cut if it is long. */
typedef struct csv_choice {
    char text[100];
} csv_choice;

static csv_choice choice_of(const csv_reader *r, const char *head)
{
    csv_choice c = {""};
    size_t used = 0;
    if (*head == '\0') {
        snprintf(c.text, sizeof c.text, "it has no head, and columns 1 to %zu", r->width);
        return c;
    }
    for (csv_cell cell, name, unit; csv_cell_next(&head, r->separator, &cell);) {
        csv_cell_split(&cell, &name, &unit);
        const size_t room = sizeof c.text - used;
        const int more = snprintf(c.text + used, room, "%s%.*s", used > 0 ? ", " : "it has ",
                                  (int)name.length, name.text);
        if (more < 0 || (size_t)more >= room) {
            memcpy(c.text + sizeof c.text - 4, "...", 4);
            return c;
        }
        used += (size_t)more;
    }
    return c;
}

/* Finds the column by its name in the head; without it `place` is unchanged. */
static imp_status csv_find_name(const csv_reader *r, const char *head, const char *wanted,
                                int name_row, int64_t element, size_t *place, bool *found)
{
    const char *next = *head != '\0' ? head : NULL;
    size_t column = 0;
    *found = false;
    for (csv_cell cell, name, unit; csv_cell_next(&next, r->separator, &cell); ++column) {
        csv_cell_split(&cell, &name, &unit);
        if (!csv_cell_equals(&cell, wanted) && !csv_cell_equals(&name, wanted)) continue;
        if (*found)
            return imp_reject(r->why, name_row, element,
                              "'%.40s' names columns %zu and %zu of '%.100s'", wanted, *place + 1,
                              column + 1, r->path);
        *found = true;
        *place = column;
    }
    return IMP_STATUS_OK;
}

/* By the head ("" if there is none), or by number, from 1. */
static imp_status csv_find_column(const csv_reader *r, const char *head, const char *wanted,
                                  int name_row, int64_t element, size_t *place)
{
    bool found;
    const imp_status status = csv_find_name(r, head, wanted, name_row, element, place, &found);
    if (status != IMP_STATUS_OK || found) return status;
    char *end;
    const unsigned long number = strtoul(wanted, &end, 10);
    if (number == 0 || *end != '\0' || number > r->width)
        return imp_reject(r->why, name_row, element, "'%.40s' is no column of '%.80s'; %s", wanted,
                          r->path, choice_of(r, head).text);
    *place = number - 1;
    return IMP_STATUS_OK;
}

/* Without names: the second column, the third, .... The first is always the first. */
static imp_status csv_find_columns(const csv_reader *r, const char *head, const char *const *name,
                                   int name_row, csv_numbers *to)
{
    for (size_t k = 0; k < to->columns; ++k) {
        to->place[k] = k;
        if (k == 0 || name == NULL) continue;
        const imp_status status =
            csv_find_column(r, head, name[k - 1], name_row, (int64_t)k - 1, &to->place[k]);
        if (status != IMP_STATUS_OK) return status;
    }
    if (to->columns > r->width)
        return imp_reject(r->why, r->row, -1, "'%.100s' has %zu column%s; %zu are needed", r->path,
                          r->width, plural(r->width), to->columns);
    return IMP_STATUS_OK;
}

static void csv_take_units(const csv_reader *r, const char *head, csv_numbers *to)
{
    size_t column = 0;
    for (csv_cell cell, name, unit; csv_cell_next(&head, r->separator, &cell); ++column) {
        csv_cell_split(&cell, &name, &unit);
        for (size_t k = 0; k < to->columns; ++k)
            if (to->place[k] == column)
                snprintf(to->unit[k], sizeof to->unit[k], "%.*s", (int)unit.length, unit.text);
    }
}

/* --- Rows ------------------------------------------------------------------------------------- */

/* Returns a hint for common mistakes in a cell that is no number. */
static const char *hint_for(const csv_cell *cell)
{
    double number;
    const csv_cell all_but_last = {cell->text, cell->length > 0 ? cell->length - 1 : 0};
    if (memchr(cell->text, ',', cell->length) != NULL) return "; decimals have a point";
    if (cell->length > 1 && !csv_cell_is_name(cell) && !csv_cell_number(&all_but_last, &number))
        return "; a unit belongs into the head, as in 'x [mm]'";
    return "";
}

static imp_status csv_refuse_cell(const csv_reader *r, size_t column, const csv_cell *cell)
{
    if (cell->length == 0)
        return imp_reject(r->why, r->row, -1,
                          "'%.100s' line %lu column %zu: found nothing, allowed is a number",
                          r->path, r->line, column + 1);
    return imp_reject(r->why, r->row, -1,
                      "'%.80s' line %lu column %zu: found '%.*s', allowed is a number%s", r->path,
                      r->line, column + 1, cell->length < 40 ? (int)cell->length : 40, cell->text,
                      hint_for(cell));
}

static imp_status csv_check_width(const csv_reader *r, size_t width)
{
    if (width == r->width) return IMP_STATUS_OK;
    return imp_reject(r->why, r->row, -1, "'%.100s': line %lu has %zu column%s, line %lu has %zu%s",
                      r->path, r->line, width, plural(width), r->first_line, r->width,
                      separators_told(r->separator));
}

/* Reserves memory for one more row, and asks every 1024 rows whether reading goes on. False: no
 * memory, or a limit is reached. */
static bool csv_reserve(csv_reader *r, csv_numbers *to)
{
    const size_t row = to->columns * sizeof *to->number;
    const bool is_full = to->rows == to->capacity;
    const size_t capacity = is_full ? 2 * to->capacity + 64 : to->capacity;
    if ((is_full || to->rows % 1024 == 0) && !imp_goes_on(r->why, capacity * row)) return false;
    if (!is_full) return true;
    double *grown = realloc(to->number, capacity * row);
    if (grown == NULL) return false;
    to->number = grown;
    to->capacity = capacity;
    return true;
}

static imp_status csv_read_row(csv_reader *r, csv_numbers *to)
{
    if (!csv_reserve(r, to)) return IMP_STATUS_INTERNAL;
    double *row = to->number + to->rows * to->columns, number;
    const char *next = r->text;
    const imp_status status = csv_check_width(r, csv_count(r->text, r->separator));
    size_t column = 0;
    for (csv_cell cell; status == IMP_STATUS_OK && csv_cell_next(&next, r->separator, &cell);
         ++column) {
        if (!csv_cell_number(&cell, &number)) return csv_refuse_cell(r, column, &cell);
        for (size_t k = 0; k < to->columns; ++k)
            if (to->place[k] == column) row[k] = number;
    }
    to->rows += status == IMP_STATUS_OK;
    return status;
}

/* --- All -------------------------------------------------------------------------------------- */

/* Takes the first line as the head, if it is one, and else leaves it to be read as a row. */
static imp_status csv_begin(csv_reader *r, const char *const *name, int name_row, csv_numbers *to,
                            bool *more)
{
    r->first_line = r->line;
    r->separator = csv_separator_of(r->text);
    r->width = csv_count(r->text, r->separator);
    const bool has_head = csv_is_head(r);
    imp_status status = csv_find_columns(r, has_head ? r->text : "", name, name_row, to);
    if (status != IMP_STATUS_OK || !has_head) return status;
    csv_take_units(r, r->text, to);
    return csv_next_line(r, more);
}

static imp_status csv_read_all(csv_reader *r, const char *const *name, int name_row,
                               csv_numbers *to)
{
    bool more;
    csv_skip_mark(r);
    imp_status status = csv_next_line(r, &more);
    if (status == IMP_STATUS_OK && more) status = csv_begin(r, name, name_row, to, &more);
    while (status == IMP_STATUS_OK && more) {
        status = csv_read_row(r, to);
        if (status == IMP_STATUS_OK) status = csv_next_line(r, &more);
    }
    return status;
}

/* Opens regular files only: a pipe or a device might never end. */
static FILE *csv_open(const char *path)
{
    struct stat facts;
    return stat(path, &facts) == 0 && S_ISREG(facts.st_mode) ? fopen(path, "re") : NULL;
}

imp_status csv_read(const char *path, int row, const char *const *name, int name_row,
                    csv_numbers *to, imp_create_error *why)
{
    csv_reader r = {.path = path, .row = row, .why = why, .file = csv_open(path)};
    if (r.file == NULL) return imp_reject(why, row, -1, "'%.180s' cannot be read", path);
    r.text = malloc(CSV_LINE_MAX);
    const imp_status status =
        r.text != NULL ? csv_read_all(&r, name, name_row, to) : IMP_STATUS_INTERNAL;
    free(r.text);
    fclose(r.file);
    if (status == IMP_STATUS_OK) imp_repeatable(why);
    return status;
}
