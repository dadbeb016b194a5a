/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/scene_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/text.h"
#include "core/plugin/type_view.h"
#include "core/reader/pipeline.h"

static const imp_map_type *type_of(const imp_registry *registry, const json_t *object)
{
    const char *name = json_string_value(json_object_get(object, "type"));
    return name != NULL ? registry_find_map(registry, name) : NULL;
}

bool scene_parts_are_named(const imp_registry *registry, const json_t *object)
{
    const imp_map_type *type = type_of(registry, object);
    return type != NULL && IMP_OFFERS(type, parts);
}

/* --- Values ----------------------------------------------------------------------------------- */

/* Writes the value of a parameter, or else its default. False: no memory. */
static bool write_value(FILE *to, const type_view *view, const json_t *object, const char *name)
{
    const ptrdiff_t row = parameter_table_find(&view->table, name);
    const json_t *value = json_object_get(object, name);
    if (value == NULL)
        return fputs(parameter_table_row(&view->table, (size_t)row)->default_value, to) >= 0;
    char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT);
    const bool is_written = text != NULL && fputs(text, to) >= 0;
    free(text);
    return is_written;
}

/* Returns the parts with values in the place of $NAME. NULL: no memory. */
static char *text_of_parts(const type_view *view, const json_t *object)
{
    char *text = NULL, name[TEXT_NAME_MAX + 1];
    size_t size;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL) return NULL;
    bool is_written = true;
    for (const char *at = view->parts; *at != '\0' && is_written;) {
        const size_t plain = strcspn(at, "$");
        is_written = fwrite(at, 1, plain, to) == plain;
        at += plain;
        if (*at == '\0') break;
        const size_t length = parameter_name_length(at + 1);
        snprintf(name, sizeof name, "%.*s", (int)length, at + 1);
        is_written = is_written && write_value(to, view, object, name);
        at += 1 + length;
    }
    if (fclose(to) == 0 && is_written) return text;
    free(text);
    return NULL;
}

/* --- Stages ----------------------------------------------------------------------------------- */

static imp_code refuse(const type_view *view, const place *at, const char *why, imp_error *error)
{
    return place_error(at, error, IMP_ERROR_PLUGIN, "the parts of '%s' cannot be read: %s",
                       view->name, why);
}

/* Whether the clock of a part ranges from 0 to 0. */
static bool stays(const json_t *part)
{
    const json_t *clock = json_object_get(part, "clock");
    return json_array_size(clock) == 2 && json_number_value(json_array_get(clock, 0)) == 0 &&
           json_number_value(json_array_get(clock, 1)) == 0;
}

/* Reads one stage of the text and appends it, but for one that stays. */
static imp_code add_stage(const imp_registry *registry, const type_view *view, const char *stage,
                          const place *at, json_t *list, imp_error *error)
{
    imp_error why = {0};
    json_t *part = pipeline_read_stage(registry, IMP_TYPE_MAP, view->name, stage, &why);
    if (part == NULL && why.code == IMP_ERROR_MEMORY) return error_set_memory(error);
    if (part == NULL) return refuse(view, at, why.text, error);
    if (scene_parts_are_named(registry, part)) {
        json_decref(part);
        return refuse(view, at, "one of them has parts itself", error);
    }
    if (stays(part)) {
        json_decref(part);
        return IMP_SUCCESS;
    }
    return json_array_append_new(list, part) == 0 ? IMP_SUCCESS : error_set_memory(error);
}

/* Values are numbers, so that each '!' stands between two maps. `text` is changed. */
static imp_code add_stages(const imp_registry *registry, const type_view *view, char *text,
                           const place *at, json_t *list, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    char *rest = NULL, *stage = strtok_r(text, "!", &rest);
    if (stage == NULL) return refuse(view, at, "there are none", error);
    for (; stage != NULL && code == IMP_SUCCESS; stage = strtok_r(NULL, "!", &rest))
        code = add_stage(registry, view, stage, at, list, error);
    return code;
}

imp_code scene_parts_list(const imp_registry *registry, const json_t *object, const place *at,
                          json_t **list, imp_error *error)
{
    const type_view view = type_view_of_map(type_of(registry, object));
    char *text = text_of_parts(&view, object);
    *list = json_array();
    const imp_code code = text != NULL && *list != NULL
                              ? add_stages(registry, &view, text, at, *list, error)
                              : error_set_memory(error);
    free(text);
    if (code == IMP_SUCCESS) return code;
    json_decref(*list);
    *list = NULL;
    return code;
}
