/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/csv.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct csv_reader {
    FILE *file;
    const char *path;
    unsigned long line;
    char *text; /* CSV_LINE_MAX */
    int row;    /* of the parameter, for errors */
    imp_create_error *why;
} csv_reader;

/* Reads a line, without its end ("\n", "\r\n" or "\r"); *length is 0 for an empty one. False: none is left. */
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

/* The next line that counts; *more is false at the end of the file. */
static imp_status csv_next_line(csv_reader *r, bool *more)
{
    for (;;) {
        size_t length = 0;
        *more = csv_read_line(r, &length);
        if (ferror(r->file))
            return imp_reject(r->why, r->row, -1, "'%.120s' cannot be read", r->path);
        if (!*more) return IMP_OK;
        if (length == CSV_LINE_MAX - 1)
            return imp_reject(r->why, r->row, -1, "'%.120s' line %lu is longer than %d bytes",
                              r->path, r->line, CSV_LINE_MAX - 2);
        if (strlen(r->text) != length)
            return imp_reject(r->why, r->row, -1,
                              "'%.120s' line %lu: found a byte 0, allowed is text", r->path,
                              r->line);
        if (r->text[strspn(r->text, " \t")] != '\0' && r->text[0] != '#') return IMP_OK;
    }
}

/* Cuts the field at *next off its line and answers it without blanks around it; NULL: none is left.
 * *next then is the field after it. */
static char *csv_field(char **next)
{
    char *field = *next;
    if (field == NULL) return NULL;
    char *end = field + strcspn(field, ",;\t");
    *next = *end != '\0' ? end + 1 : NULL;
    *end = '\0';
    field += strspn(field, " \"");
    for (end = field + strlen(field); end > field && strchr(" \"", end[-1]) != NULL; --end)
        end[-1] = '\0';
    return field;
}

enum { CSV_NUMBER_MAX = 100 };

/* strtod takes the point of the locale, and names of what is no number. */
static bool csv_number(const char *field, double *number)
{
    char text[CSV_NUMBER_MAX], *end;
    if (strlen(field) >= sizeof text || field[strspn(field, "+-.0123456789eE")] != '\0')
        return false;
    strcpy(text, field);
    char *point = strchr(text, '.');
    if (point != NULL) *point = *localeconv()->decimal_point;
    *number = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*number);
}

/* A copy to cut fields from. NULL: no memory. */
static char *csv_copy(const char *line)
{
    char *copy = malloc(strlen(line) + 1);
    return copy != NULL ? strcpy(copy, line) : NULL;
}

/* Is a field of the line no number? The line stays as it is. False: no memory. */
static bool csv_find_header(const char *line, bool *header)
{
    char *copy = csv_copy(line), *next = copy, *field;
    double unused;
    *header = false;
    while (!*header && (field = csv_field(&next)) != NULL) *header = !csv_number(field, &unused);
    free(copy);
    return copy != NULL;
}

/* Where a header names the column; `place` stays where it does not. False: no memory. */
static bool csv_find_name(const char *header, const char *name, size_t *place, bool *found)
{
    char *copy = csv_copy(header), *next = copy, *field;
    *found = false;
    for (size_t column = 0; !*found && (field = csv_field(&next)) != NULL; ++column) {
        *found = strcmp(field, name) == 0;
        if (*found) *place = column;
    }
    free(copy);
    return copy != NULL;
}

/* Where the columns called name[0 ... count-2] stand: by the header ("" if there is none), or by
 * number, from 1. No names: the second column, the third, .... place[0] is the first column. */
static imp_status csv_find_columns(const csv_reader *r, const char *header, size_t count,
                                   const char *const *name, int name_row, size_t *place)
{
    place[0] = 0;
    for (size_t k = 1; k < count; ++k) {
        bool found;
        place[k] = k;
        if (name == NULL) continue;
        if (!csv_find_name(header, name[k - 1], &place[k], &found)) return IMP_INTERNAL;
        if (found) continue;
        char *end;
        const unsigned long number = strtoul(name[k - 1], &end, 10);
        if (number == 0 || *end != '\0' || number > CSV_LINE_MAX)
            return imp_reject(r->why, name_row, (int64_t)k - 1,
                              "'%.40s' is no column of '%.100s'; allowed are names in its first "
                              "line, and numbers from 1",
                              name[k - 1], r->path);
        place[k] = number - 1;
    }
    return IMP_OK;
}

static imp_status csv_read_row(csv_reader *r, const size_t *place, csv_numbers *to)
{
    double *grown = to->number;
    if (to->rows == to->capacity) {
        to->capacity = 2 * to->capacity + 64;
        grown = realloc(to->number, to->capacity * to->columns * sizeof *grown);
    }
    if (grown == NULL) return IMP_INTERNAL;
    to->number = grown;
    char *next = r->text, *field;
    size_t found = 0;
    for (size_t column = 0; (field = csv_field(&next)) != NULL; ++column)
        for (size_t k = 0; k < to->columns; ++k) {
            if (place[k] != column) continue;
            found += 1;
            if (!csv_number(field, &grown[to->rows * to->columns + k]))
                return imp_reject(
                    r->why, r->row, -1,
                    "'%.100s' line %lu column %zu: found '%.40s', allowed is a number", r->path,
                    r->line, column + 1, field);
        }
    if (found != to->columns)
        return imp_reject(r->why, r->row, -1, "'%.100s' line %lu has too few columns", r->path,
                          r->line);
    to->rows += 1;
    return IMP_OK;
}

static imp_status csv_read_all(csv_reader *r, const char *const *name, int name_row,
                               csv_numbers *to)
{
    size_t place[CSV_COLUMNS_MAX];
    bool more;
    imp_status status = csv_next_line(r, &more);
    if (status != IMP_OK) return status;
    bool header = false;
    if (more && !csv_find_header(r->text, &header)) return IMP_INTERNAL;
    status = csv_find_columns(r, header ? r->text : "", to->columns, name, name_row, place);
    if (status == IMP_OK && header) status = csv_next_line(r, &more);
    while (status == IMP_OK && more) {
        status = csv_read_row(r, place, to);
        if (status == IMP_OK) status = csv_next_line(r, &more);
    }
    return status;
}

/* Only files: a pipe or a device might never end. */
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
    const imp_status status = r.text != NULL ? csv_read_all(&r, name, name_row, to) : IMP_INTERNAL;
    free(r.text);
    fclose(r.file);
    return status;
}
