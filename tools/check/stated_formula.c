/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/stated_formula.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/check/values.h"
#include "tools/cli/catalogue.h"

enum { CONSTANTS_MAX = 256 };

typedef struct stated {
    const imp_type_info *type;
    char *text[3];
    size_t count;
    char *name[CONSTANTS_MAX];
    double value[CONSTANTS_MAX];
} stated;

/* --- Parameters ------------------------------------------------------------------------------- */

static void add_constant(stated *s, const char *name, const json_t *value)
{
    if (s->count == CONSTANTS_MAX || !(json_is_number(value) || json_is_boolean(value))) return;
    s->name[s->count] = strdup(name);
    s->value[s->count] = json_is_boolean(value) ? json_is_true(value) : json_number_value(value);
    if (s->name[s->count] != NULL) ++s->count;
}

/* Numbers of nested lists are counted consecutively. */
static void add_list(stated *s, const char *name, const json_t *list, size_t *place)
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

static void add_parameter(stated *s, const imp_parameter *row, json_t *value)
{
    const char *key;
    json_t *entry;
    size_t place = 0;
    add_constant(s, row->name, value);
    add_list(s, row->name, value, &place);
    json_object_foreach(value, key, entry) add_constant(s, key, entry);
    const bool is_coordinate = strlen(row->name) == 1 && strchr("xyz", row->name[0]) != NULL;
    if (is_coordinate && row->kind == IMP_KIND_STRING && json_is_string(value)) {
        char **text = &s->text[row->name[0] - 'x'];
        free(*text);
        *text = strdup(json_string_value(value));
    }
}

/* --- Texts ------------------------------------------------------------------------------------ */

static const char *variables_of(const stated *s)
{
    return s->type->kind == IMP_TYPE_SURFACE ? "uvt" : "xyzt";
}

static formula_scope scope_of(const stated *s, const char *variables)
{
    return (formula_scope){.variables = variables,
                           .count = s->count,
                           .name = (const char *const *)s->name,
                           .value = s->value};
}

static formula *read_stated(const stated *s, const char *variables, char *fault, size_t size)
{
    const char *const text[3] = {s->text[0], s->text[1], s->text[2]};
    const formula_scope scope = scope_of(s, variables);
    if (text[0] == NULL || text[1] == NULL || text[2] == NULL) return NULL;
    return formula_read(&scope, text, fault, size);
}

/* "X; Y; Z", definitions before them. */
static formula *read_given(const stated *s, const char *given, char *fault, size_t size)
{
    formula_range range[FORMULA_VARIABLES];
    const formula_scope scope = scope_of(s, variables_of(s));
    formula *f = formula_read_part(&scope, given, range, fault, size);
    bool is_said = formula_next_part(given) != NULL;
    for (int j = 0; f != NULL && j < BOX_DIMS; ++j) is_said = is_said || range[j].is_said;
    if (f == NULL || !is_said) return f;
    snprintf(fault, size, "expected one part without ranges, which --domain states");
    formula_free(f);
    return NULL;
}

static void gather_constants(stated *s, const imp_registry *registry, const char *stage)
{
    json_t *values = stage_values(registry, s->type->kind, stage);
    for (size_t k = 0; k < s->type->parameter_count; ++k) {
        const imp_parameter *row = catalogue_parameter(s->type, k);
        json_t *value = stage_value(values, row);
        add_parameter(s, row, value);
        json_decref(value);
    }
    json_decref(values);
}

static void stated_free(stated *s)
{
    for (int i = 0; i < 3; ++i) free(s->text[i]);
    for (size_t k = 0; k < s->count; ++k) free(s->name[k]);
}

formula *stated_formula(const imp_registry *registry, const imp_type_info *type, const char *stage,
                        const char *given, char *fault, size_t size)
{
    stated s = {.type = type};
    formula *f = NULL;
    fault[0] = '\0';
    gather_constants(&s, registry, stage);
    f = given != NULL ? read_given(&s, given, fault, size)
                      : read_stated(&s, variables_of(&s), fault, size);
    stated_free(&s);
    return f;
}

/* --- Texts of types --------------------------------------------------------------------------- */

struct stated_scope {
    stated from;
};

stated_scope *stated_scope_new(const imp_registry *registry, const imp_type_info *type,
                               const char *stage)
{
    stated_scope *scope = calloc(1, sizeof *scope);
    if (scope == NULL) return NULL;
    scope->from.type = type;
    gather_constants(&scope->from, registry, stage);
    return scope;
}

formula *stated_scope_read(const stated_scope *scope, const char *text,
                           formula_range range[FORMULA_VARIABLES], char *fault, size_t size)
{
    const formula_scope names = scope_of(&scope->from, variables_of(&scope->from));
    return formula_read_part(&names, text, range, fault, size);
}

void stated_scope_free(stated_scope *scope)
{
    if (scope != NULL) stated_free(&scope->from);
    free(scope);
}

/* --- Domains ---------------------------------------------------------------------------------- */

/* One end, without variables. */
static bool read_end(stated *s, const char *text, size_t length, ld_interval *end, char *fault,
                     size_t size)
{
    const jet none[BOX_DIMS] = {{.n = 0}};
    jet value[3];
    for (int i = 0; i < 3; ++i) {
        free(s->text[i]);
        s->text[i] = i == 0 ? strndup(text, length) : strdup("0");
    }
    formula *f = read_stated(s, "", fault, size);
    if (f == NULL) return false;
    formula_jets(f, none, value);
    *end = value[0].v;
    formula_free(f);
    return true;
}

/* Returns where the text's first piece ends: at one of these characters, outside of parentheses. */
static size_t piece(const char *text, const char *ends)
{
    size_t length = 0;
    for (int depth = 0; text[length] != '\0'; ++length) {
        if (depth == 0 && strchr(ends, text[length]) != NULL) break;
        depth += (text[length] == '(') - (text[length] == ')');
    }
    return length;
}

static bool read_ends(stated *s, said_domain *d, const char *given, char *fault, size_t size)
{
    for (const char *at = given; d->count < 3; ++d->count) {
        const size_t lo = piece(at, ",;"), hi = at[lo] == ',' ? piece(at + lo + 1, ",;") : 0;
        const char *rest = at + lo + 1 + hi;
        if (at[lo] != ',' || *rest == ',') break;
        if (!read_end(s, at, lo, &d->lo[d->count], fault, size) ||
            !read_end(s, at + lo + 1, hi, &d->hi[d->count], fault, size))
            return false;
        at = rest + 1;
        if (*rest == '\0') {
            ++d->count;
            return true;
        }
    }
    d->count = 0;
    return true;
}

bool said_domain_read(said_domain *d, const imp_registry *registry, const imp_type_info *type,
                      const char *stage, const char *given, char *fault, size_t size)
{
    stated s = {.type = type};
    const bool is_map = type->kind == IMP_TYPE_MAP;
    *d = (said_domain){.count = 0};
    fault[0] = '\0';
    gather_constants(&s, registry, stage);
    bool read = read_ends(&s, d, given, fault, size);
    if (read && (is_map ? d->count != 1 : d->count < 2)) {
        snprintf(fault, size, "expected %s", is_map ? "LO,HI of t" : "LO,HI; LO,HI of u and v");
        read = false;
    }
    stated_free(&s);
    return read;
}
