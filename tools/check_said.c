/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "check_said.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue.h"
#include "check_table.h"

enum { CONSTANTS_MAX = 256 };

typedef struct said {
    const imp_type_info *type;
    const char *stage;
    char *text[3];
    size_t count;
    char *name[CONSTANTS_MAX];
    double value[CONSTANTS_MAX];
} said;

/* --- Parameters ----------------------------------------------------------------------------- */

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* As JSON wants it, of what people may type: .5, 5. and +5, and lists without brackets. Free it. */
static char *written_out(const char *text, bool is_list)
{
    char *copy = malloc(3 * strlen(text) + 3), *to = copy;
    bool quoted = false;
    if (copy == NULL) return NULL;
    if (is_list) *to++ = '[';
    for (const char *c = text; *c != '\0'; ++c) {
        const char last = c > text ? c[-1] : '\0';
        quoted ^= *c == '"';
        if (*c == '+' && !quoted && (last | 0x20) != 'e') continue;
        if (*c == '.' && !quoted && !is_digit(last)) *to++ = '0';
        *to++ = *c;
        if (*c == '.' && !quoted && !is_digit(c[1])) *to++ = '0';
    }
    if (is_list) *to++ = ']';
    *to = '\0';
    return copy;
}

/* NULL: not to be read. */
static json_t *read_value(const imp_parameter *row, const char *text)
{
    if (row->kind == IMP_STRING && text[0] != '"') return json_string(text);
    char *json = written_out(text, row->rank > 0 && text[0] != '[');
    json_t *value =
        json != NULL ? json_loads(json, JSON_DECODE_ANY | JSON_DECODE_INT_AS_REAL, NULL) : NULL;
    free(json);
    return value;
}

/* NULL: absent. */
static json_t *value_of(const said *s, const imp_parameter *row)
{
    char *text = stage_value(s->stage, row->name);
    json_t *json = text != NULL          ? read_value(row, text)
                   : row->preset != NULL ? json_loads(row->preset, JSON_DECODE_ANY, NULL)
                                         : NULL;
    free(text);
    return json;
}

static void add_constant(said *s, const char *name, const json_t *value)
{
    if (s->count == CONSTANTS_MAX || !json_is_number(value)) return;
    s->name[s->count] = strdup(name);
    s->value[s->count] = json_number_value(value);
    if (s->name[s->count] != NULL) ++s->count;
}

/* Numbers of a list inside lists are counted on. */
static void add_list(said *s, const char *name, const json_t *list, size_t *place)
{
    char numbered[200];
    for (size_t k = 0; k < json_array_size(list); ++k) {
        const json_t *value = json_array_get(list, k);
        if (json_is_array(value)) {
            add_list(s, name, value, place);
            continue;
        }
        snprintf(numbered, sizeof numbered, "%s%zu", name, (*place)++);
        add_constant(s, numbered, value);
    }
}

static void add_parameter(said *s, const imp_parameter *row, json_t *value)
{
    const char *key;
    json_t *entry;
    size_t place = 0;
    add_constant(s, row->name, value);
    add_list(s, row->name, value, &place);
    json_object_foreach(value, key, entry) add_constant(s, key, entry);
    const bool is_coordinate = strlen(row->name) == 1 && strchr("xyz", row->name[0]) != NULL;
    if (is_coordinate && row->kind == IMP_STRING && json_is_string(value)) {
        char **text = &s->text[row->name[0] - 'x'];
        free(*text);
        *text = strdup(json_string_value(value));
    }
}

/* --- Texts ---------------------------------------------------------------------------------- */

/* "X; Y; Z". False: not three of them. */
static bool take_given(said *s, const char *given)
{
    for (int i = 0; i < 3; ++i) {
        const size_t length = strcspn(given, ";");
        free(s->text[i]);
        s->text[i] = strndup(given, length);
        given += length;
        if ((i < 2) != (*given == ';')) return false;
        ++given;
    }
    return true;
}

static formula *read_said(const said *s, char *fault, size_t size)
{
    const char *const text[3] = {s->text[0], s->text[1], s->text[2]};
    const formula_scope scope = {.variables = s->type->sort == IMP_SORT_SURFACE ? "uvt" : "xyzt",
                                 .count = s->count,
                                 .name = (const char *const *)s->name,
                                 .value = s->value};
    if (text[0] == NULL || text[1] == NULL || text[2] == NULL) return NULL;
    return formula_read(&scope, text, fault, size);
}

formula *said_formula(const imp_type_info *type, const char *stage, const char *given, char *fault,
                      size_t size)
{
    said s = {.type = type, .stage = stage};
    formula *f = NULL;
    fault[0] = '\0';
    for (size_t k = 0; k < type->parameter_count; ++k) {
        const imp_parameter *row = catalogue_parameter(type, k);
        json_t *value = value_of(&s, row);
        add_parameter(&s, row, value);
        json_decref(value);
    }
    if (given == NULL || take_given(&s, given))
        f = read_said(&s, fault, size);
    else
        snprintf(fault, size, "expected three formulas with ';' between them");
    for (int i = 0; i < 3; ++i) free(s.text[i]);
    for (size_t k = 0; k < s.count; ++k) free(s.name[k]);
    return f;
}
