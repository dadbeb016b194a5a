/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/common/spelling.h"
#include "core/plugin/json_describe.h"
#include "core/reader/json_keys.h"
#include "core/reader/scene_instances.h"

/* --- Definitions: which there are ------------------------------------------------------------- */

imp_code scene_instances_begin(scene_instances *p, const json_t *root, const place *at)
{
    json_t *define = json_object_get(root, "define"), *array;
    const place member = place_key(at, "define");
    p->root = *at;
    if (define == NULL) return IMP_SUCCESS;
    if (!json_is_object(define))
        return place_error(&member, p->error, IMP_ERROR_SCENE,
                           "got %s, must be an object, {\"NAME\": [...], ...}",
                           json_describe(define).at);
    p->definitions = calloc(json_object_size(define) + 1, sizeof *p->definitions);
    p->names = json_object();
    if (p->definitions == NULL || p->names == NULL) return error_set_memory(p->error);
    const char *name;
    json_object_foreach(define, name, array)
    {
        const imp_code code = json_keys_array(define, name, true, &member, &array, p->error);
        if (code != IMP_SUCCESS) return code;
        if (json_object_set_new(p->names, name, json_integer((json_int_t)p->count)) != 0)
            return error_set_memory(p->error);
        p->definitions[p->count++] = (definition){.name = name, .array = array};
    }
    return IMP_SUCCESS;
}

void scene_instances_clear(scene_instances *p)
{
    for (size_t k = 0; k < p->count; ++k) {
        shape_list_clear(&p->definitions[k].shapes);
        instance_list_clear(&p->definitions[k].maps);
    }
    instance_table_clear(&p->made);
    free(p->definitions);
    json_decref(p->names);
    p->definitions = NULL;
    p->names = NULL;
    p->count = 0;
}

static definition *find(const scene_instances *p, const char *name)
{
    const json_t *index = json_object_get(p->names, name);
    return index != NULL ? &p->definitions[json_integer_value(index)] : NULL;
}

static imp_code refuse_name(const scene_instances *p, const char *name, const place *at)
{
    spelling_search search = {.wanted = name};
    for (size_t k = 0; k < p->count; ++k) spelling_offer(&search, p->definitions[k].name);
    if (search.best != NULL)
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "got \"%.80s\", which is not in \"define\"; did you mean '%s'?", name,
                           search.best);
    return place_error(at, p->error, IMP_ERROR_SCENE,
                       "got \"%.80s\", which is not in \"define\"; must be a name from there, or "
                       "an object like {\"type\": ...}",
                       name);
}

/* --- Definitions: what they hold -------------------------------------------------------------- */

static const char *kind_words(imp_type_kind kind)
{
    return kind == IMP_TYPE_SURFACE ? "surfaces" : "maps";
}

/* The kind of what it begins with; `otherwise` where that does not tell. */
static imp_type_kind kind_of(const scene_instances *p, const definition *d, imp_type_kind otherwise)
{
    const json_t *first = json_array_get(d->array, 0);
    if (json_is_string(first)) {
        const definition *used = find(p, json_string_value(first));
        return used != NULL && used->state == DEFINITION_READ ? used->kind : otherwise;
    }
    const char *type = json_string_value(json_object_get(first, "type"));
    if (type == NULL) return otherwise;
    const bool is_surface = registry_find_surface(p->source.registry, type) != NULL;
    const bool is_map = registry_find_map(p->source.registry, type) != NULL;
    if (is_surface == is_map) return otherwise;
    return is_surface ? IMP_TYPE_SURFACE : IMP_TYPE_MAP;
}

static imp_code read_definition(scene_instances *p, definition *d, imp_type_kind otherwise)
{
    const place define = place_key(&p->root, "define"), at = place_key(&define, d->name);
    d->kind = kind_of(p, d, otherwise);
    d->state = DEFINITION_BEING_READ;
    p->depth += 1;
    const imp_code code = d->kind == IMP_TYPE_SURFACE
                              ? scene_instances_surfaces(p, d->array, &at, &d->shapes)
                              : scene_instances_maps(p, d->array, &at, &d->maps);
    p->depth -= 1;
    d->state = DEFINITION_READ;
    return code;
}

imp_code scene_instances_use(scene_instances *p, const char *name, imp_type_kind kind,
                             const place *at, definition **used)
{
    definition *d = find(p, name);
    if (d == NULL) return refuse_name(p, name, at);
    if (d->state == DEFINITION_BEING_READ)
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "got \"%.80s\", which is being defined here: a definition may not use "
                           "itself, nor what uses it",
                           name);
    if (p->depth == SCENE_INSTANCES_DEPTH_MAX)
        return place_error(
            at, p->error, IMP_ERROR_SCENE,
            "got a definition in a definition in a definition: must be at most %u deep",
            SCENE_INSTANCES_DEPTH_MAX);
    imp_code code = IMP_SUCCESS;
    if (d->state == DEFINITION_UNREAD) code = read_definition(p, d, kind);
    if (code != IMP_SUCCESS) return code;
    if (d->kind != kind)
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "got \"%.80s\", a definition of %s; must be %s", name,
                           kind_words(d->kind), kind_words(kind));
    *used = d;
    p->shared += d->shapes.count + d->maps.count;
    for (size_t k = 0; k < d->shapes.count; ++k) p->shared += d->shapes.at[k].maps.count;
    if (p->shared <= SCENE_INSTANCES_SHARED_MAX) return IMP_SUCCESS;
    return place_error(
        at, p->error, IMP_ERROR_SCENE,
        "definitions used so often that they stand for more than %u surfaces and maps",
        SCENE_INSTANCES_SHARED_MAX);
}

imp_code scene_instances_finish(scene_instances *p)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < p->count && code == IMP_SUCCESS; ++k)
        if (p->definitions[k].state == DEFINITION_UNREAD)
            code = read_definition(p, &p->definitions[k], IMP_TYPE_SURFACE);
    return code;
}
