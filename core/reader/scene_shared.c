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
#include "core/scene/scene_change.h"

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

/* The place of a value among those given: its row, how many numbers or texts there are, and in how
 * many rows, columns and so on. */
typedef struct given_head {
    uint32_t row, count, extent[2]; /* the third extent follows */
} given_head;

/* Writes the values that were given, each behind its head, and returns how many bytes these are.
 * `to` NULL: only counts. */
static size_t write_given(const parameter_values *values, unsigned char *to)
{
    size_t size = 0;
    for (size_t k = 0; k < values->count; ++k) {
        const imp_value *v = &values->value[k];
        const given_head head = {
            (uint32_t)k, (uint32_t)v->count, {(uint32_t)v->extent[0], (uint32_t)v->extent[1]}};
        if (!values->given[k]) continue;
        if (to != NULL) memcpy(to + size, &head, sizeof head);
        size += sizeof head;
        const size_t of_numbers = v->number != NULL ? v->count * sizeof *v->number : 0;
        if (to != NULL && of_numbers > 0) memcpy(to + size, v->number, of_numbers);
        size += of_numbers;
        for (size_t j = 0; v->string != NULL && j < v->count; ++j) {
            const size_t length = strlen(v->string[j]) + 1;
            if (to != NULL) memcpy(to + size, v->string[j], length);
            size += length;
        }
    }
    return size;
}

/* Describes a map by its values, so that equal maps are found; not if a value names a file, whose
 * contents may change. False: no memory. */
static bool describe(shared_instance *p, const scene_making *m)
{
    if (p->map == NULL) return true;
    for (size_t k = 0; k < m->values.count; ++k)
        if (parameter_table_row(&m->view.table, k)->flags & IMP_PARAMETER_FILE &&
            m->values.given[k])
            return true;
    const size_t size = write_given(&m->values, NULL);
    if (p->description == NULL || p->description->size != size) {
        free(p->description);
        p->description = malloc(sizeof *p->description + size);
    }
    if (p->description == NULL) return false;
    p->description->size = size;
    write_given(&m->values, p->description->bytes);
    instance_hash_description(p->description);
    return true;
}

/* Shares what create made, or what renew refilled. NULL: no memory. */
static shared_instance *new_or_renewed(scene_making *m)
{
    shared_instance *again = m->again;
    m->again = NULL;
    if (again != NULL) return instance_renewed(again);
    return m->instance.surface != NULL ? instance_of_surface(m->instance.surface, m->instance.self)
                                       : instance_of_map(m->instance.map, m->instance.self);
}

/* What an instance is made from, in words: a label, or arguments that are all numbers. */
typedef struct made_from {
    const char *label; /* NULL: the arguments */
    const imp_argument *arguments;
    size_t count;
    size_t bytes; /* of the numbers and texts */
} made_from;

/* False: no memory. */
static bool set_label(shared_instance *p, const scene_making *m, const made_from *from)
{
    if (from->label != NULL) return instance_set_label(p, from->label);
    return scene_label_arguments(p, &m->view.table, from->arguments, from->count);
}

/* Finishes the instance, and takes over what the note holds. */
static imp_code share(scene_making *m, scene_build_note *note, const made_from *from,
                      const place *at, shared_instance **made, imp_error *error)
{
    shared_instance *p = new_or_renewed(m);
    if (p == NULL) {
        free(note->numbers.number);
        return error_set_memory(error);
    }
    p->numbers = note->numbers;
    p->given = from->bytes + (size_t)note->bytes;
    const bool noted =
        (note->count == 0 || instance_set_note(p, note->count, note->text)) && describe(p, m);
    if (noted && p->breach == IMP_STATUS_OK && set_label(p, m, from)) {
        *made = p;
        return IMP_SUCCESS;
    }
    imp_code code = error_set_memory(error);
    if (p->breach != IMP_STATUS_OK)
        code = place_error(at, error, IMP_ERROR_PLUGIN, "'%s' (%s) %s", m->view.name,
                           scene_making_file(m), surface_status_of_last(p->breach).text);
    instance_release(p);
    return code;
}

static imp_code make(scene_making *m, const made_from *from, const place *at,
                     shared_instance **made, bool *is_repeatable, imp_error *error)
{
    scene_build_note note = {.count = 0};
    if (m->again != NULL) note.numbers = instance_take_numbers(m->again);
    const imp_code code = scene_making_create(m, at, &note, error);
    *is_repeatable = note.is_repeatable;
    if (code == IMP_SUCCESS) return share(m, &note, from, at, made, error);
    free(note.numbers.number);
    return code;
}

/* No key if the instance is isolated: if its process ends, it is lost for all scenes. */
static kept_key key_of(const scene_making *m, const char *label)
{
    const void *type = m->instance.surface != NULL ? (const void *)m->instance.surface
                                                   : (const void *)m->instance.map;
    if (m->stand_in != NULL) return (kept_key){NULL, 0, 0};
    return kept_key_of(type, &m->view.table, &m->values, label);
}

/* Finds the instance among those that the registry keeps, or makes it. */
static imp_code find_or_make(kept_instances *kept, scene_making *m, const json_t *object,
                             const place *at, shared_instance **made, imp_error *error)
{
    char label[INSTANCE_LABEL_MAX];
    bool is_repeatable = false;
    scene_label_object(label, m->view.name, object);
    kept_key key = key_of(m, label);
    *made = kept_instances_find(kept, &key);
    imp_code code = IMP_SUCCESS;
    if (*made == NULL) {
        const made_from from = {.label = label, .bytes = bytes_given(object)};
        code = make(m, &from, at, made, &is_repeatable, error);
    }
    if (code == IMP_SUCCESS && is_repeatable && key.bytes != NULL) {
        kept_key now = key_of(m, label);
        kept_instances_add(kept, &key, &now, *made);
        kept_key_clear(&now);
    }
    kept_key_clear(&key);
    return code;
}

/* Notes the files that the values name. False: no memory. */
static bool note_files(const scene_source *source, const scene_making *m)
{
    bool kept = true;
    for (size_t k = 0; k < m->values.count && source->files != NULL && kept; ++k) {
        const imp_value *v = &m->values.value[k];
        if (parameter_table_row(&m->view.table, k)->flags & IMP_PARAMETER_FILE && v->count > 0)
            kept = named_files_add(source->files, v->string[0], source->folder);
    }
    if (source->files != NULL && kept) kept = named_files_copy(&m->values.files, source->files);
    return kept;
}

imp_code scene_build_shared(const scene_source *source, imp_type_kind kind, const json_t *object,
                            const place *at, shared_instance **made, imp_error *error)
{
    scene_making m;
    imp_code code = scene_making_begin(&m, source, kind, object, at, error);
    if (code != IMP_SUCCESS) return code;
    code = note_files(source, &m)
               ? find_or_make(registry_kept(source->registry), &m, object, at, made, error)
               : error_set_memory(error);
    scene_making_clear(&m);
    if (code == IMP_SUCCESS) reading_budget_take(source->budget, instance_bytes(*made));
    return code;
}

/* The registry keeps instances of files; one made from numbers alone is of none. */
imp_code scene_build_numbers(const scene_source *source, const type_choice *type,
                             const imp_argument *arguments, size_t count, const place *at,
                             shared_instance **made, imp_error *error)
{
    scene_making m;
    bool is_repeatable;
    *made = NULL;
    imp_code code = scene_making_begin_numbers(&m, source, type, arguments, count, at, error);
    if (code != IMP_SUCCESS || m.values.value == NULL) return code;
    made_from from = {.arguments = arguments, .count = count, .bytes = strlen(type->name)};
    for (size_t k = 0; k < count; ++k)
        from.bytes += parameter_numbers_count(&arguments[k]) * sizeof(double);
    if (source->scene != NULL && m.view.renew != NULL && m.stand_in == NULL)
        m.again = scene_take_spare(source->scene, m.instance.surface, m.instance.map, from.bytes);
    code = make(&m, &from, at, made, &is_repeatable, error);
    scene_making_clear(&m);
    return code;
}
