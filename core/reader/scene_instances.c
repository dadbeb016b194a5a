/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/scene_instances.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/text.h"
#include "core/common/spelling.h"
#include "core/plugin/json_describe.h"
#include "core/reader/json_keys.h"
#include "core/reader/scene_parts.h"
#include "core/surface/clocked.h"

/* --- Parameters ------------------------------------------------------------------------------- */

imp_code scene_instances_parameter(scene_instances *p, const char *name, double lo, double hi,
                                   const place *at)
{
    if (!(isfinite(lo) && isfinite(hi) && lo <= hi))
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "got the range [%s, %s], must be finite, [lo, hi] with lo <= hi",
                           text_of_number(lo).at, text_of_number(hi).at);
    if (scene_parameters_find(p->parameters, name) < p->parameters->count)
        return place_error(at, p->error, IMP_ERROR_SCENE, "'%.80s' is given twice", name);
    if (p->parameters->count == SCENE_PARAMETERS_MAX)
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "found more than %d parameters; that is more than a search over all "
                           "values can handle",
                           (int)SCENE_PARAMETERS_MAX);
    return scene_parameters_add(p->parameters, name, lo, hi) ? IMP_SUCCESS
                                                             : error_set_memory(p->error);
}

/* Adds the parameter of "clock": [lo, hi], which is the instance's own. Its name is TYPE#N, with
 * the first N that makes it new; of a part, the type is that of the whole. *k: its index. */
static imp_code add_own_parameter(scene_instances *p, const json_t *object, const json_t *clock,
                                  const place *at, size_t *k)
{
    const json_t *lo = json_array_get(clock, 0), *hi = json_array_get(clock, 1);
    const char *type =
        p->whole != NULL ? p->whole : json_string_value(json_object_get(object, "type"));
    char name[100];
    if (json_array_size(clock) != 2 || !json_is_number(lo) || !json_is_number(hi))
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "got %s, must be the name of one of the scene's \"parameters\", or the "
                           "range [lo, hi] of a parameter of its own",
                           json_describe(clock).at);
    *k = p->parameters->count;
    for (size_t n = 1;; ++n) {
        snprintf(name, sizeof name, "%.70s#%zu", type, n);
        if (scene_parameters_find(p->parameters, name) == *k) break;
    }
    return scene_instances_parameter(p, name, json_number_value(lo), json_number_value(hi), at);
}

/* --- Instances -------------------------------------------------------------------------------- */

static imp_code refuse_clock(const scene_instances *p, const char *name, const place *at)
{
    spelling_search search = {.wanted = name};
    for (size_t k = 0; k < p->parameters->count; ++k)
        spelling_offer(&search, p->parameters->at[k].name);
    if (search.best != NULL)
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "got \"%.80s\", which is not in \"parameters\"; did you mean '%s'?",
                           name, search.best);
    return place_error(at, p->error, IMP_ERROR_SCENE,
                       "got \"%.80s\", which is not a parameter; must be \"time\", a name from "
                       "the scene's \"parameters\": {\"%.80s\": [lo, hi]} (or --parameter "
                       "%.80s=LO,HI), or the range [lo, hi] of a parameter of its own",
                       name, name, name);
}

/* Finds the parameter that a clock other than time names, or adds its own. *k: its index. */
static imp_code find_clock(scene_instances *p, const json_t *object, const json_t *clock,
                           const place *at, size_t *k)
{
    const place member = at->argument ? place_argument(at, "clock") : place_key(at, "clock");
    const char *name = json_string_value(clock);
    if (name == NULL) return add_own_parameter(p, object, clock, &member, k);
    *k = scene_parameters_find(p->parameters, name);
    return *k < p->parameters->count ? IMP_SUCCESS : refuse_clock(p, name, &member);
}

/* Puts what follows a clock, and is held at the middle of its range, in the place of an
 * instance. */
static imp_code follow(scene_instances *p, const json_t *object, const json_t *clock,
                       const place *at, shared_instance **made)
{
    const char *name = json_string_value(clock);
    size_t k = 0;
    if (name != NULL && strcmp(name, "time") == 0) return IMP_SUCCESS;
    const imp_code code = find_clock(p, object, clock, at, &k);
    if (code != IMP_SUCCESS) return code;
    scene_parameter *of = &p->parameters->at[k];
    shared_instance *inner = *made;
    if (!(inner->lo[2] <= of->lo && of->hi <= inner->hi[2]))
        return place_error(at, p->error, IMP_ERROR_SCENE,
                           "follows '%.80s' from %s to %s, but is defined from %s to %s only",
                           of->name, text_of_number(of->lo).at, text_of_number(of->hi).at,
                           text_of_number(inner->lo[2]).at, text_of_number(inner->hi[2]).at);
    of->is_followed = true;
    *made = clocked_new(inner, k, scene_parameter_middle(of->lo, of->hi));
    instance_release(inner);
    return *made != NULL ? IMP_SUCCESS : error_set_memory(p->error);
}

imp_code scene_instances_make(scene_instances *p, imp_type_kind kind, json_t *object,
                              const place *at, shared_instance **made)
{
    const json_t *clock = json_object_get(object, "clock");
    const bool is_own = json_is_array(clock); /* equal objects have parameters that differ */
    const instance_key key = instance_key_of(kind, object);
    shared_instance *known = is_own ? NULL : instance_table_find(&p->made, &key, object);
    if (known != NULL) return *made = instance_hold(known), IMP_SUCCESS;
    imp_code code = scene_build_shared(&p->source, kind, object, at, made, p->error);
    if (code == IMP_SUCCESS && clock != NULL) {
        code = follow(p, object, clock, at, made);
        if (code != IMP_SUCCESS) {
            instance_release(*made);
            *made = NULL;
        }
    }
    if (code != IMP_SUCCESS || is_own || instance_table_add(&p->made, &key, object, *made))
        return code;
    instance_release(*made);
    *made = NULL;
    return error_set_memory(p->error);
}

/* --- Maps ------------------------------------------------------------------------------------- */

static imp_code keep(const scene_instances *p, bool kept)
{
    return kept ? IMP_SUCCESS : error_set_memory(p->error);
}

/* In a document a map stands at its index, on a command line at its stage. */
static place place_of_map(const place *maps, size_t index, const json_t *map)
{
    const char *type = json_string_value(json_object_get(map, "type"));
    return maps->argument && type != NULL ? place_argument(maps, type) : place_index(maps, index);
}

static imp_code refuse_maps(const scene_instances *p, const place *at)
{
    const place member = place_key(at, "maps");
    return place_error(&member, p->error, IMP_ERROR_SCENE,
                       "a map has no maps of its own; list them after it, in the order in which "
                       "they apply");
}

static imp_code add_one_map(scene_instances *p, json_t *object, const place *at, instance_list *to)
{
    shared_instance *made = NULL;
    imp_code code = scene_instances_make(p, IMP_TYPE_MAP, object, at, &made);
    if (code == IMP_SUCCESS) code = keep(p, instance_list_add(to, made));
    instance_release(made);
    return code;
}

/* The instance of the whole is made for what its create refuses. */
static imp_code add_parts(scene_instances *p, json_t *object, const place *at, instance_list *to)
{
    const char *type = json_string_value(json_object_get(object, "type"));
    const place member = at->argument ? place_argument(at, "clock") : place_key(at, "clock");
    shared_instance *whole = NULL;
    json_t *parts = NULL;
    if (json_object_get(object, "clock") != NULL)
        return place_error(&member, p->error, IMP_ERROR_SCENE,
                           "'%s' has clocks of its own; leave it out", type);
    imp_code code = scene_instances_make(p, IMP_TYPE_MAP, object, at, &whole);
    instance_release(whole);
    if (code == IMP_SUCCESS)
        code = scene_parts_list(p->source.registry, object, at, &parts, p->error);
    p->whole = type;
    for (size_t k = 0; k < json_array_size(parts) && code == IMP_SUCCESS; ++k)
        code = add_one_map(p, json_array_get(parts, k), at, to);
    p->whole = NULL;
    json_decref(parts);
    return code;
}

imp_code scene_instances_map(scene_instances *p, json_t *object, const place *at, instance_list *to)
{
    return scene_parts_are_named(p->source.registry, object) ? add_parts(p, object, at, to)
                                                             : add_one_map(p, object, at, to);
}

static imp_code add_map(scene_instances *p, json_t *element, const place *at, instance_list *to)
{
    if (json_is_string(element)) {
        definition *used = NULL;
        const imp_code code =
            scene_instances_use(p, json_string_value(element), IMP_TYPE_MAP, at, &used);
        return code == IMP_SUCCESS ? keep(p, instance_list_add_all(to, &used->maps)) : code;
    }
    if (json_object_get(element, "maps") != NULL) return refuse_maps(p, at);
    return scene_instances_map(p, element, at, to);
}

imp_code scene_instances_maps(scene_instances *p, const json_t *array, const place *at,
                              instance_list *to)
{
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < json_array_size(array) && code == IMP_SUCCESS; ++i) {
        json_t *map = json_array_get(array, i);
        const place element = place_of_map(at, i, map);
        code = add_map(p, map, &element, to);
    }
    return code;
}

/* --- Surfaces --------------------------------------------------------------------------------- */

imp_code scene_instances_surface(scene_instances *p, json_t *object, const place *at,
                                 shape_list *to)
{
    shared_instance *type = NULL;
    instance_list maps = {.count = 0};
    json_t *array = NULL;
    const place member = at->argument ? *at : place_key(at, "maps");
    imp_code code = scene_instances_make(p, IMP_TYPE_SURFACE, object, at, &type);
    if (code == IMP_SUCCESS) code = json_keys_array(object, "maps", false, at, &array, p->error);
    if (code == IMP_SUCCESS) code = scene_instances_maps(p, array, &member, &maps);
    if (code == IMP_SUCCESS) code = keep(p, shape_list_add(to, type, &maps));
    instance_list_clear(&maps);
    instance_release(type);
    return code;
}

imp_code scene_instances_surfaces(scene_instances *p, const json_t *array, const place *at,
                                  shape_list *to)
{
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < json_array_size(array) && code == IMP_SUCCESS; ++i) {
        json_t *element = json_array_get(array, i);
        const place here = place_index(at, i);
        definition *used = NULL;
        if (json_is_string(element)) {
            code =
                scene_instances_use(p, json_string_value(element), IMP_TYPE_SURFACE, &here, &used);
            if (code == IMP_SUCCESS) code = keep(p, shape_list_add_all(to, &used->shapes));
        } else {
            code = scene_instances_surface(p, element, &here, to);
        }
    }
    return code;
}
