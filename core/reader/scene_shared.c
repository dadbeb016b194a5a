/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/unconst.h"
#include "core/plugin/kept_instances.h"
#include "core/reader/scene_build.h"

/* Instances that surfaces share: what create made, with its label, note and numbers. */

/* --- Labels ----------------------------------------------------------------------------------- */

/* Writes the value as it would stand on a command line. False: it is too long for that. */
static bool write_value(char *text, size_t size, const json_t *value)
{
    int length = -1;
    if (json_is_number(value))
        length = snprintf(text, size, "%.15g", json_number_value(value));
    else if (json_is_boolean(value))
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

/* " radius=2", or the name alone where the value is long. */
static void label_parameter(char label[INSTANCE_LABEL_MAX], const char *name, const json_t *value)
{
    char text[120];
    const size_t head = (size_t)snprintf(text, sizeof text, " %.40s=", name);
    const size_t room = sizeof text - head;
    if (!(json_is_array(value) ? write_list(text + head, room, value)
                               : write_value(text + head, room, value)))
        memcpy(text + head, "...", 4);
    instance_label_add(label, text);
}

/* "sphere radius=2" */
static void write_label(char label[INSTANCE_LABEL_MAX], const char *type, const json_t *object)
{
    const char *key;
    json_t *value;
    label[0] = '\0';
    instance_label_add(label, type);
    json_object_foreach((json_t *)unconst(object), key, value)
    {
        if (strcmp(key, "type") != 0 && strcmp(key, "maps") != 0)
            label_parameter(label, key, value);
    }
}

/* --- Instances -------------------------------------------------------------------------------- */

/* Counts the bytes of the numbers and texts in the value. */
static size_t bytes_given(const json_t *value)
{
    size_t bytes = json_is_string(value) ? json_string_length(value) : 0, i;
    const char *key;
    json_t *item;
    json_array_foreach(value, i, item) bytes += bytes_given(item);
    json_object_foreach((json_t *)unconst(value), key, item) bytes += bytes_given(item);
    return bytes + (json_is_number(value) ? sizeof(double) : 0);
}

/* Finishes the instance that create made, and takes over what the note holds. */
static imp_code share(const scene_making *m, scene_build_note *note, const json_t *object,
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
    p->given = bytes_given(object) + (size_t)note->bytes;
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

static imp_code make(scene_making *m, const json_t *object, const char *label, const place *at,
                     shared_instance **made, bool *is_repeatable, imp_error *error)
{
    scene_build_note note = {.count = 0};
    const imp_code code = scene_making_create(m, at, &note, error);
    *is_repeatable = note.is_repeatable;
    if (code == IMP_SUCCESS) return share(m, &note, object, label, at, made, error);
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
    write_label(label, m->view.name, object);
    kept_key key = key_of(m, object, label);
    *made = kept_instances_find(kept, &key);
    imp_code code = IMP_SUCCESS;
    if (*made == NULL) code = make(m, object, label, at, made, &is_repeatable, error);
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
