/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/csv_head.h"

#include <stdlib.h>
#include <string.h>

bool csv_has_head(const csv_reader *r)
{
    const char *next = r->text;
    bool named = false;
    for (csv_cell cell; csv_cell_next(&next, r->separator, &cell);) {
        if (!csv_cell_is_name(&cell)) return false;
        named = named || cell.length > 0;
    }
    return named;
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

imp_status csv_find_columns(const csv_reader *r, const char *head, const char *const *name,
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
                          r->width, csv_plural(r->width), to->columns);
    return IMP_STATUS_OK;
}

void csv_take_units(const csv_reader *r, const char *head, csv_numbers *to)
{
    size_t column = 0;
    for (csv_cell cell, name, unit; csv_cell_next(&head, r->separator, &cell); ++column) {
        csv_cell_split(&cell, &name, &unit);
        for (size_t k = 0; k < to->columns; ++k)
            if (to->place[k] == column)
                snprintf(to->unit[k], sizeof to->unit[k], "%.*s", (int)unit.length, unit.text);
    }
}
