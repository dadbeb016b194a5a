/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/reader/arguments.h"
#include "core/reader/scene_build.h"
#include "core/scene/scene_change.h"

/* A scene whose numbers change: one instance is made anew, as a builder makes it. */

static imp_code refuse_stage(const imp_scene *scene, scene_stage at, imp_error *error)
{
    if (at.body >= scene_body_count(scene))
        return error_set(error, IMP_ERROR_USAGE, "body %zu: the scene has %zu bodies", at.body,
                         scene_body_count(scene));
    if (at.surface == SIZE_MAX && at.map == SIZE_MAX)
        return error_set(error, IMP_ERROR_USAGE, "neither a surface nor a map is named");
    if (at.surface != SIZE_MAX && at.surface >= scene_surface_count(scene, at.body))
        return error_set(error, IMP_ERROR_USAGE, "body '%.80s' has no surface %zu, but %zu",
                         imp_scene_body_name(scene, at.body), at.surface,
                         scene_surface_count(scene, at.body));
    const char *name = imp_scene_body_name(scene, at.body);
    if (at.surface == SIZE_MAX)
        return error_set(error, IMP_ERROR_USAGE, "body '%.80s' has no map %zu of its own", name,
                         at.map);
    return error_set(error, IMP_ERROR_USAGE, "body '%.80s': surface %zu has no map %zu of its own",
                     name, at.surface, at.map);
}

/* Whether the scene can be changed at all, and there. */
static imp_code check(const imp_scene *scene, scene_stage at, imp_error *error)
{
    if (scene_registry(scene) == NULL)
        return error_set(error, IMP_ERROR_USAGE,
                         "the scene was made by imp_scene_at; change no such scene, but build it");
    if (imp_scene_parameter_count(scene) > 0)
        return error_set(error, IMP_ERROR_USAGE,
                         "the scene has parameters; change no such scene, but build it anew");
    if (scene_users(scene) > 0)
        return error_set(error, IMP_ERROR_USAGE,
                         "the scene has %zu queries or surveys; free them before it is changed",
                         scene_users(scene));
    return scene_stage_at(scene, at) != NULL ? IMP_SUCCESS : refuse_stage(scene, at, error);
}

static imp_code make(imp_scene *scene, const shared_instance *like, const imp_argument *arguments,
                     size_t count, const place *at, shared_instance **made, imp_error *error)
{
    const scene_source source = {
        .registry = scene_registry(scene), .files = scene_files_of(scene), .scene = scene};
    const imp_type_kind kind = like->surface != NULL ? IMP_TYPE_SURFACE : IMP_TYPE_MAP;
    const char *type = kind == IMP_TYPE_SURFACE ? like->surface->name : like->map->name;
    const type_choice choice = {kind, type, like};
    json_t *object;
    imp_code code = scene_build_numbers(&source, &choice, arguments, count, at, made, error);
    if (code != IMP_SUCCESS || *made != NULL) return code;
    code = arguments_to_json(type, arguments, count, at, &object, error);
    if (code != IMP_SUCCESS) return code;
    if (json_object_get(object, "clock") != NULL)
        code = place_error(at, error, IMP_ERROR_SCENE, "clock: the scene has no parameters");
    else
        code = scene_build_shared(&source, kind, object, at, made, error);
    json_decref(object);
    return code;
}

FP_APART static imp_code set_values(imp_scene *scene, scene_stage at, const imp_argument *arguments,
                                    size_t count, imp_error *error)
{
    imp_code code = check(scene, at, error);
    if (code != IMP_SUCCESS) return code;
    const place body = place_named(NULL, "body", imp_scene_body_name(scene, at.body));
    const place of_surface = place_counted(&body, "surface", at.surface);
    const place *whole = at.surface != SIZE_MAX ? &of_surface : &body;
    const place map = place_counted(whole, "map", at.map);
    shared_instance *made = NULL;
    code = make(scene, scene_stage_at(scene, at), arguments, count,
                at.map != SIZE_MAX ? &map : whole, &made, error);
    if (code != IMP_SUCCESS) return code;
    shared_instance *equal = made->map != NULL ? scene_equal_map(scene, made) : NULL;
    if (equal != NULL) {
        instance_hold(equal);
        scene_give_spare(scene, made);
        made = equal;
    }
    shared_instance *old = instance_hold(scene_stage_at(scene, at));
    code = scene_replace(scene, at, made);
    scene_give_spare(scene, made); /* kept if the scene is as it was */
    scene_give_spare(scene, old);
    return code == IMP_SUCCESS ? code : error_set_memory(error);
}

imp_code imp_scene_set_values(imp_scene *scene, size_t body, size_t index, size_t map,
                              const imp_argument *arguments, size_t count, imp_error *error)
{
    if (scene == NULL) return error_set_missing(error, "imp_scene_set_values");
    const fp_environment environment = fp_environment_enter();
    const imp_code code =
        set_values(scene, (scene_stage){body, index, map}, arguments, count, error);
    fp_environment_leave(&environment);
    return code;
}
