/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/scene_label.h"

#include <stdio.h>
#include <string.h>

#include "core/base/text.h"
#include "core/base/unconst.h"

/* Writes a number as "%.15g" does. False: it is too long. */
static bool write_number(char *text, size_t size, double x)
{
    if (size > TEXT_SHORT && text_fifteen_digits(text, x)) return true;
    const int length = snprintf(text, size, "%.15g", x);
    return length >= 0 && (size_t)length < size;
}

/* Writes the value as it would stand on a command line. False: it is too long for that. */
static bool write_value(char *text, size_t size, const json_t *value)
{
    int length = -1;
    if (json_is_number(value)) return write_number(text, size, json_number_value(value));
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

/* Writes a short list of an argument's numbers, or its only one, likewise. False: it is too long,
 * or a list of lists. */
static bool write_argument(char *text, size_t size, const imp_argument *a)
{
    size_t used = 0;
    if (a->rank == 0) return write_number(text, size, a->single);
    for (size_t i = 0; i < a->extent[0] && a->rank == 1; ++i) {
        if (i > 0 && used + 1 < size) text[used++] = ',';
        if (!write_number(text + used, size - used, a->number[i])) return false;
        used += strlen(text + used);
    }
    return used > 0;
}

/* Appends " radius=2", or " radius=..." where the value is long: exactly one of value and argument
 * is given. */
static void label_parameter(char label[INSTANCE_LABEL_MAX], const char *name, const json_t *value,
                            const imp_argument *argument)
{
    char text[120];
    const size_t length = strlen(name), most = 40, head = 2 + (length < most ? length : most);
    text[0] = ' ';
    memcpy(text + 1, name, head - 2);
    strcpy(text + head - 1, "=");
    const size_t room = sizeof text - head;
    const bool fits = argument != NULL       ? write_argument(text + head, room, argument)
                      : json_is_array(value) ? write_list(text + head, room, value)
                                             : write_value(text + head, room, value);
    if (!fits) memcpy(text + head, "...", 4);
    instance_label_add(label, text);
}

void scene_label_object(char label[INSTANCE_LABEL_MAX], const char *type, const json_t *object)
{
    const char *key;
    json_t *value;
    label[0] = '\0';
    instance_label_add(label, type);
    json_object_foreach((json_t *)unconst(object), key, value)
    {
        if (strcmp(key, "type") != 0 && strcmp(key, "maps") != 0)
            label_parameter(label, key, value, NULL);
    }
}

void scene_label_arguments(char label[INSTANCE_LABEL_MAX], const char *type,
                           const imp_argument *arguments, size_t count)
{
    label[0] = '\0';
    instance_label_add(label, type);
    for (size_t k = 0; k < count; ++k)
        label_parameter(label, arguments[k].name, NULL, &arguments[k]);
}
