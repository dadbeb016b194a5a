/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/csv_cell.h"

#include <string.h>
#include <strings.h>

#include <impinge/decimal.h>

char csv_separator_of(const char *line)
{
    if (strchr(line, ';') != NULL) return ';';
    return strchr(line, '\t') != NULL ? '\t' : ',';
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '"'; }

static csv_cell trimmed(const char *from, const char *end)
{
    while (from < end && is_blank(*from)) ++from;
    while (end > from && is_blank(end[-1])) --end;
    return (csv_cell){from, (size_t)(end - from)};
}

bool csv_cell_next(const char **next, char separator, csv_cell *cell)
{
    const char *from = *next;
    if (from == NULL) return false;
    const char *end = strchr(from, separator);
    *next = end != NULL ? end + 1 : NULL;
    *cell = trimmed(from, end != NULL ? end : from + strlen(from));
    return true;
}

bool csv_cell_number(const csv_cell *cell, double *number)
{
    return imp_decimal_number(cell->text, cell->length, number);
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool csv_cell_is_name(const csv_cell *cell)
{
    const char *at = cell->text, *end = cell->text + cell->length;
    if (at < end && (*at == '+' || *at == '-')) ++at;
    const size_t length = (size_t)(end - at);
    if (length >= 1 && is_digit(*at)) return false;
    if (length >= 2 && *at == '.' && is_digit(at[1])) return false;
    if (length == 3 && (strncasecmp(at, "nan", 3) == 0 || strncasecmp(at, "inf", 3) == 0))
        return false;
    return !(length == 8 && strncasecmp(at, "infinity", 8) == 0);
}

void csv_cell_split(const csv_cell *cell, csv_cell *name, csv_cell *unit)
{
    *name = *cell;
    *unit = (csv_cell){cell->text, 0};
    if (cell->length == 0) return;
    const char *last = cell->text + cell->length - 1;
    const char open = *last == ']' ? '[' : *last == ')' ? '(' : '\0';
    const char *at = last;
    while (open != '\0' && at > cell->text && *at != open) --at;
    if (open == '\0' || *at != open) return;
    *name = trimmed(cell->text, at);
    *unit = trimmed(at + 1, last);
}

bool csv_cell_equals(const csv_cell *cell, const char *text)
{
    return strlen(text) == cell->length && memcmp(text, cell->text, cell->length) == 0;
}
