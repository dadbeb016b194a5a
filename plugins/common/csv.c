/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/csv_head.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

static const char *separators_told(char separator)
{
    return separator == ';' ? " between semicolons" : separator == '\t' ? " between tabs" : "";
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

static size_t csv_count(const char *line, char separator)
{
    size_t count = 1;
    for (; *line != '\0'; ++line) count += *line == separator;
    return count;
}

static imp_status csv_check_width(const csv_reader *r, size_t width)
{
    if (width == r->width) return IMP_STATUS_OK;
    return imp_reject(r->why, r->row, -1, "'%.100s': line %lu has %zu column%s, line %lu has %zu%s",
                      r->path, r->line, width, csv_plural(width), r->first_line, r->width,
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
    const bool has_head = csv_has_head(r);
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
