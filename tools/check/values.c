/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/values.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <impinge/examine.h>

json_t *stage_values(const imp_registry *registry, imp_type_kind kind, const char *stage)
{
    char *text = imp_stage_to_json(registry, kind, stage, NULL);
    json_t *values = text != NULL ? json_loads(text, JSON_DECODE_INT_AS_REAL, NULL) : NULL;
    free(text);
    return values;
}

json_t *stage_value(const json_t *values, const imp_parameter *row)
{
    json_t *given = json_object_get(values, row->name);
    if (given != NULL) return json_incref(given);
    return row->default_value != NULL ? json_loads(row->default_value, JSON_DECODE_ANY, NULL)
                                      : NULL;
}

/* "TYPE name=value ...", values as compact JSON. */
static int print_stage(FILE *out, json_t *values)
{
    const char *name;
    json_t *value;
    fputs(json_string_value(json_object_get(values, "type")), out);
    json_object_foreach(values, name, value)
    {
        if (strcmp(name, "type") == 0) continue;
        char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT);
        if (text == NULL) return -1;
        fprintf(out, " %s=%s", name, text);
        free(text);
    }
    return 0;
}

char *stage_with(const imp_registry *registry, imp_type_kind kind, const char *stage,
                 const char *parameter, const char *value)
{
    char *text = NULL;
    size_t size = 0;
    json_t *values = stage_values(registry, kind, stage);
    FILE *out = values != NULL ? open_memstream(&text, &size) : NULL;
    if (out != NULL) {
        json_object_del(values, parameter);
        bool whole = print_stage(out, values) == 0;
        fprintf(out, " %s=%s", parameter, value);
        whole = fclose(out) == 0 && whole;
        if (!whole) {
            free(text);
            text = NULL;
        }
    }
    json_decref(values);
    return text;
}

char *stage_print(json_t *values)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL) return NULL;
    const bool whole = print_stage(out, values) == 0;
    if (fclose(out) == 0 && whole) return text;
    free(text);
    return NULL;
}
