/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>

#include "core/base/fp_mode.h"
#include "core/reader/arguments.h"
#include "core/reader/builder_internal.h"

/* Surfaces and maps that a program builds. A surface's arguments that are numbers become its values
 * at once (scene_build_numbers). Others, and those that do not fit the type, go the way of scene
 * files: they become the JSON object that a file would have (arguments.h), never text. */

/* Makes the surface of a type's name and arguments. */
static imp_code make(imp_builder *b, const char *type, const imp_argument *arguments, size_t count,
                     const place *at, shared_instance **made, imp_error *error)
{
    const type_choice choice = {IMP_TYPE_SURFACE, type, NULL};
    json_t *object;
    imp_code code = IMP_SUCCESS;
    if (type != NULL)
        code = scene_build_numbers(&b->bodies.instances.source, &choice, arguments, count, at, made,
                                   error);
    if (code != IMP_SUCCESS || *made != NULL) return code;
    code = arguments_to_json(type, arguments, count, at, &object, error);
    if (code != IMP_SUCCESS) return code;
    code = scene_instances_make(&b->bodies.instances, IMP_TYPE_SURFACE, object, at, made);
    json_decref(object);
    return code;
}

static FP_APART imp_code add_surface(imp_builder *b, size_t body, const char *type,
                                     const imp_argument *arguments, size_t count, imp_error *error)
{
    shape_list *shapes = &b->bodies.assembly.bodies[body].shapes;
    const body_words words = builder_body_words(b, body);
    char surface_words[40];
    snprintf(surface_words, sizeof surface_words, "surface %zu", shapes->count);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, surface_words);
    const instance_list no_maps = {.count = 0};
    shared_instance *made = NULL;
    imp_code code = make(b, type, arguments, count, &at, &made, error);
    if (code == IMP_SUCCESS && !shape_list_add(shapes, made, &no_maps))
        code = error_set_memory(error);
    instance_release(made);
    return code;
}

imp_code imp_builder_surface(imp_builder *b, size_t body, const char *type,
                             const imp_argument *arguments, size_t count, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    const fp_environment environment = fp_environment_enter();
    code = add_surface(b, body, type, arguments, count, error);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_builder_surface_of(imp_builder *b, size_t body, const imp_scene *scene,
                                size_t its_body, size_t its_surface, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    if (scene == NULL) return error_set(error, IMP_ERROR_USAGE, "the scene is NULL");
    const surface *s =
        its_body < scene_body_count(scene) ? scene_surface(scene, its_body, its_surface) : NULL;
    if (s == NULL)
        return error_set(error, IMP_ERROR_USAGE, "the scene has no surface %zu of a body %zu",
                         its_surface, its_body);
    shared_instance *shared = surface_share(s);
    if (shared->inner != NULL) { /* here it follows time */
        shared_instance *inner = instance_hold(shared->inner);
        instance_release(shared);
        shared = inner;
    }
    const instance_list no_maps = {.count = 0};
    if (registry_find_surface(b->registry, shared->surface->name) != shared->surface)
        code = error_set(error, IMP_ERROR_USAGE,
                         "the scene's surface is of a type '%s' that the builder's registry does "
                         "not have",
                         shared->surface->name);
    else if (!shape_list_add(&b->bodies.assembly.bodies[body].shapes, shared, &no_maps))
        code = error_set_memory(error);
    instance_release(shared);
    return code;
}

/* On top of the maps in the list, which are of what `whose` says. Maps are looked up by what they
 * were made from (instance_table.h), which takes an object. */
static FP_APART imp_code add_map(imp_builder *b, size_t body, const char *whose,
                                 instance_list *maps, const char *type,
                                 const imp_argument *arguments, size_t count, imp_error *error)
{
    const body_words words = builder_body_words(b, body);
    char map_words[80];
    snprintf(map_words, sizeof map_words, "%smap %zu", whose, maps->count);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, map_words);
    json_t *object;
    imp_code code = arguments_to_json(type, arguments, count, &at, &object, error);
    if (code != IMP_SUCCESS) return code;
    code = scene_instances_map(&b->bodies.instances, object, &at, maps);
    json_decref(object);
    return code;
}

imp_code imp_builder_map(imp_builder *b, size_t body, const char *type,
                         const imp_argument *arguments, size_t count, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    const fp_environment environment = fp_environment_enter();
    code =
        add_map(b, body, "", &b->bodies.assembly.bodies[body].maps, type, arguments, count, error);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_builder_surface_map(imp_builder *b, size_t body, size_t index, const char *type,
                                 const imp_argument *arguments, size_t count, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    shape_list *shapes = &b->bodies.assembly.bodies[body].shapes;
    if (index >= shapes->count)
        return error_set(error, IMP_ERROR_USAGE, "%s has no surface %zu",
                         builder_body_words(b, body).at, index);
    char whose[60];
    snprintf(whose, sizeof whose, "surface %zu: ", index);
    const fp_environment environment = fp_environment_enter();
    code = add_map(b, body, whose, &shapes->at[index].maps, type, arguments, count, error);
    fp_environment_leave(&environment);
    return code;
}
