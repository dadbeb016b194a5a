/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/scene_label.h"

#include <assert.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "core/base/text.h"
#include "core/base/unconst.h"

/* Writes the value as it would stand on a command line. False: it is too long for that. */
static bool write_value(char *text, size_t size, const json_t *value)
{
    int length = -1;
    if (json_is_number(value)) return text_of_fifteen(text, size, json_number_value(value));
    if (json_is_boolean(value))
        length = snprintf(text, size, "%s", json_is_true(value) ? "true" : "false");
    else if (json_is_string(value))
        length = snprintf(text, size, "'%s'", json_string_value(value));
    return length >= 0 && (size_t)length < size;
}

/* Writes a short list as it would stand on a command line: 1,0,0. False: it is too long for
 * that. */
static bool write_list(char *text, size_t size, const json_t *list)
{
    size_t used = 0;
    for (size_t i = 0; i < json_array_size(list); ++i) {
        if (i > 0 && used + 1 < size) text[used++] = ',';
        if (!write_value(text + used, size - used, json_array_get(list, i))) return false;
        used += strlen(text + used);
    }
    return used > 0;
}

void scene_label_object(char label[INSTANCE_LABEL_MAX], const char *type, const json_t *object)
{
    const char *key;
    json_t *value;
    label[0] = '\0';
    instance_label_add(label, type);
    json_object_foreach((json_t *)unconst(object), key, value)
    {
        label_part part;
        if (strcmp(key, "type") == 0 || strcmp(key, "maps") == 0) continue;
        label_part_begin(&part, key);
        char *to = part.at + part.head;
        const size_t room = sizeof part.at - part.head;
        const bool fits =
            json_is_array(value) ? write_list(to, room, value) : write_value(to, room, value);
        label_part_end(&part, fits, label);
    }
}

/* How many numbers of the argument a label shows; a number and its comma take two bytes or more. */
static size_t numbers_shown(const imp_argument *a)
{
    const size_t count = a->rank == 0 ? 1 : a->extent[0];
    return a->rank < 2 && count < LABEL_PART_MAX / 2 ? count : 0;
}

bool scene_label_arguments(shared_instance *p, const parameter_table *table,
                           const imp_argument *arguments, size_t count)
{
    size_t numbers = 0;
    double *number;
    for (size_t k = 0; k < count; ++k) numbers += numbers_shown(&arguments[k]);
    if (!instance_name_arguments(p, count, numbers, &number)) return false;
    for (size_t k = 0; k < count; ++k) {
        const imp_argument *a = &arguments[k];
        const ptrdiff_t row = parameter_table_find(table, a->name);
        assert(row >= 0);
        label_argument *to = &p->named.at[k];
        *to = (label_argument){parameter_table_row(table, (size_t)row)->name, numbers_shown(a)};
        for (size_t i = 0; i < to->count; ++i) *number++ = a->rank == 0 ? a->single : a->number[i];
    }
    return true;
}
