/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/unconst.h"
#include "core/plugin/kept_instances.h"
#include "core/plugin/parameter_numbers.h"
#include "core/reader/scene_build.h"
#include "core/reader/scene_label.h"

/* Instances that surfaces share: what create made, with its label, note and numbers. */

/* Counts the bytes of the numbers and texts in the value. */
static size_t bytes_given(const json_t *value)
{
    size_t bytes = 0, i;
    const char *key;
    json_t *item;
    switch (json_typeof(value)) {
    case JSON_INTEGER:
    case JSON_REAL:
        return sizeof(double);
    case JSON_STRING:
        return json_string_length(value);
    case JSON_ARRAY:
        json_array_foreach(value, i, item) bytes += bytes_given(item);
        return bytes;
    case JSON_OBJECT:
        json_object_foreach((json_t *)unconst(value), key, item) bytes += bytes_given(item);
        return bytes;
    default:
        return 0;
    }
}

/* Finishes the instance that create made, and takes over what the note holds. It was
 * made from numbers and texts of so many bytes. */
static imp_code share(const scene_making *m, scene_build_note *note, size_t bytes,
                      const char *label, const place *at, shared_instance **made, imp_error *error)
{
    shared_instance *p = m->instance.surface != NULL
                             ? instance_of_surface(m->instance.surface, m->instance.self)
                             : instance_of_map(m->instance.map, m->instance.self);
    if (p == NULL) {
        free(note->numbers.number);
        return error_set_memory(error);
    }
    p->numbers = note->numbers;
    p->given = bytes + (size_t)note->bytes;
    const bool noted = note->count == 0 || instance_set_note(p, note->count, note->text);
    if (noted && p->breach == IMP_STATUS_OK && instance_set_label(p, label)) {
        *made = p;
        return IMP_SUCCESS;
    }
    imp_code code = error_set_memory(error);
    if (p->breach != IMP_STATUS_OK)
        code = place_error(at, error, IMP_ERROR_PLUGIN, "'%s' (%s) %s", m->view.name, m->file,
                           surface_status_of_last(p->breach).text);
    instance_release(p);
    return code;
}

static imp_code make(scene_making *m, size_t bytes, const char *label, const place *at,
                     shared_instance **made, bool *is_repeatable, imp_error *error)
{
    scene_build_note note = {.count = 0};
    const imp_code code = scene_making_create(m, at, &note, error);
    *is_repeatable = note.is_repeatable;
    if (code == IMP_SUCCESS) return share(m, &note, bytes, label, at, made, error);
    free(note.numbers.number);
    return code;
}

/* No key if the instance is isolated: if its process ends, it is lost for all scenes. */
static kept_key key_of(const scene_making *m, const json_t *object, const char *label)
{
    const void *type = m->instance.surface != NULL ? (const void *)m->instance.surface
                                                   : (const void *)m->instance.map;
    if (m->stand_in != NULL) return (kept_key){NULL, 0, 0};
    return kept_key_of(type, &m->view.table, object, &m->values, label);
}

/* Finds the instance among those that the registry keeps, or makes it. */
static imp_code find_or_make(kept_instances *kept, scene_making *m, const json_t *object,
                             const place *at, shared_instance **made, imp_error *error)
{
    char label[INSTANCE_LABEL_MAX];
    bool is_repeatable = false;
    scene_label_object(label, m->view.name, object);
    kept_key key = key_of(m, object, label);
    *made = kept_instances_find(kept, &key);
    imp_code code = IMP_SUCCESS;
    if (*made == NULL) code = make(m, bytes_given(object), label, at, made, &is_repeatable, error);
    if (code == IMP_SUCCESS && is_repeatable && key.bytes != NULL) {
        kept_key now = key_of(m, object, label);
        kept_instances_add(kept, &key, &now, *made);
        kept_key_clear(&now);
    }
    kept_key_clear(&key);
    return code;
}

imp_code scene_build_shared(const scene_source *source, imp_type_kind kind, const json_t *object,
                            const place *at, shared_instance **made, imp_error *error)
{
    scene_making m;
    imp_code code = scene_making_begin(&m, source, kind, object, at, error);
    if (code != IMP_SUCCESS) return code;
    code = find_or_make(registry_kept(source->registry), &m, object, at, made, error);
    scene_making_clear(&m);
    return code;
}

/* The registry keeps instances of files; one made from numbers alone is of none. */
imp_code scene_build_numbers(const scene_source *source, const char *type,
                             const imp_argument *arguments, size_t count, const place *at,
                             shared_instance **made, imp_error *error)
{
    scene_making m;
    char label[INSTANCE_LABEL_MAX];
    bool is_repeatable;
    *made = NULL;
    imp_code code = scene_making_begin_numbers(&m, source, type, arguments, count, at, error);
    if (code != IMP_SUCCESS || m.values.value == NULL) return code;
    size_t bytes = strlen(type);
    for (size_t k = 0; k < count; ++k)
        bytes += parameter_numbers_count(&arguments[k]) * sizeof(double);
    scene_label_arguments(label, type, arguments, count);
    code = make(&m, bytes, label, at, made, &is_repeatable, error);
    scene_making_clear(&m);
    return code;
}
