/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/fp_mode.h"
#include "core/reader/arguments.h"
#include "core/reader/scene_bodies.h"
#include "core/reader/scene_build.h"
#include "core/scene/tolerances.h"

/* Scenes that a program builds. A surface's arguments that are numbers become its values at once
 * (scene_build_numbers). Others, and those that do not fit the type, go the way of scene files:
 * they become the JSON object that a file would have (arguments.h), never text. */

struct imp_builder {
    const imp_registry *registry;
    scene_bodies bodies;
    bool finished;
};

/* --- Creation and destruction ----------------------------------------------------------------- */

imp_builder *imp_builder_new(imp_registry *registry)
{
    imp_builder *b = registry != NULL ? calloc(1, sizeof *b) : NULL;
    if (b == NULL) return NULL;
    b->registry = registry;
    const scene_source source = {.registry = registry};
    if (scene_bodies_start(&b->bodies, &source, NULL) == IMP_SUCCESS) return b;
    imp_builder_free(b);
    return NULL;
}

static FP_APART void clear(imp_builder *b) { scene_bodies_clear(&b->bodies); }

void imp_builder_free(imp_builder *b)
{
    if (b == NULL) return;
    const fp_environment environment = fp_environment_enter();
    if (!b->finished) clear(b);
    fp_environment_leave(&environment);
    free(b);
}

/* Every call begins so: errors go to `error`, and a builder that is done takes nothing more. */
static imp_code enter(imp_builder *b, imp_error *error)
{
    if (b == NULL) return error_set(error, IMP_ERROR_USAGE, "the builder is NULL");
    if (b->finished)
        return error_set(error, IMP_ERROR_USAGE, "this builder has made its scene already");
    b->bodies.error = b->bodies.instances.error = error;
    return IMP_SUCCESS;
}

static imp_code check_body(const imp_builder *b, size_t body, imp_error *error)
{
    if (body < b->bodies.assembly.count) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_USAGE, "body %zu: there are only %zu bodies so far", body,
                     b->bodies.assembly.count);
}

/* "body 'arm'", for errors. */
typedef struct body_words {
    char at[100];
} body_words;

static body_words words_of(const imp_builder *b, size_t body)
{
    body_words words;
    snprintf(words.at, sizeof words.at, "body '%.80s'",
             imp_scene_body_name(b->bodies.assembly.scene, body));
    return words;
}

/* --- Settings --------------------------------------------------------------------------------- */

imp_code imp_builder_time(imp_builder *b, double start, double end, imp_error *error)
{
    const imp_code code = enter(b, error);
    if (code != IMP_SUCCESS) return code;
    if (!(isfinite(start) && isfinite(end) && start <= end))
        return error_set(error, IMP_ERROR_USAGE,
                         "time: got [%.17g, %.17g], must be finite with start <= end", start, end);
    scene_settings *s = scene_settings_of(b->bodies.assembly.scene);
    s->t_start = start;
    s->t_end = end;
    return IMP_SUCCESS;
}

imp_code imp_builder_gamma(imp_builder *b, double gamma, double gamma_clear, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = tolerances_check(gamma, gamma_clear, NULL, error);
    if (code != IMP_SUCCESS) return code;
    scene_settings *s = scene_settings_of(b->bodies.assembly.scene);
    s->gamma = gamma;
    s->gamma_clear = gamma_clear;
    return IMP_SUCCESS;
}

imp_code imp_builder_parameter(imp_builder *b, const char *name, double lo, double hi,
                               imp_error *error)
{
    imp_code code = enter(b, error);
    if (code != IMP_SUCCESS) return code;
    if (name == NULL) return error_set(error, IMP_ERROR_USAGE, "parameter: the name is NULL");
    const place at = place_argument(NULL, "parameter");
    const fp_environment environment = fp_environment_enter();
    code = scene_bodies_parameter(&b->bodies, name, lo, hi, &at);
    fp_environment_leave(&environment);
    return code;
}

/* --- Bodies ----------------------------------------------------------------------------------- */

imp_code imp_builder_body(imp_builder *b, const char *name, size_t *body, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code != IMP_SUCCESS) return code;
    const size_t index = b->bodies.assembly.count;
    const place at = place_argument(NULL, "name");
    code = scene_bodies_begin(&b->bodies, name, &at);
    if (code == IMP_SUCCESS && body != NULL) *body = index;
    return code;
}

imp_code imp_builder_solid(imp_builder *b, size_t body, bool solid, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = check_body(b, body, error);
    if (code == IMP_SUCCESS) scene_set_solid(b->bodies.assembly.scene, body, solid);
    return code;
}

/* Makes the instance of a type's name and arguments. Maps are looked up by what they were made from
 * (instance_table.h), which takes the object. */
static imp_code make(imp_builder *b, imp_type_kind kind, const char *type,
                     const imp_argument *arguments, size_t count, const place *at,
                     shared_instance **made, imp_error *error)
{
    json_t *object;
    imp_code code = IMP_SUCCESS;
    if (kind == IMP_TYPE_SURFACE && type != NULL)
        code = scene_build_numbers(&b->bodies.instances.source, kind, type, arguments, count, at,
                                   made, error);
    if (code != IMP_SUCCESS || *made != NULL) return code;
    code = arguments_to_json(type, arguments, count, at, &object, error);
    if (code != IMP_SUCCESS) return code;
    code = scene_instances_make(&b->bodies.instances, kind, object, at, made);
    json_decref(object);
    return code;
}

static FP_APART imp_code add_surface(imp_builder *b, size_t body, const char *type,
                                     const imp_argument *arguments, size_t count, imp_error *error)
{
    shape_list *shapes = &b->bodies.assembly.bodies[body].shapes;
    const body_words words = words_of(b, body);
    char surface_words[40];
    snprintf(surface_words, sizeof surface_words, "surface %zu", shapes->count);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, surface_words);
    const instance_list no_maps = {.count = 0};
    shared_instance *made = NULL;
    imp_code code = make(b, IMP_TYPE_SURFACE, type, arguments, count, &at, &made, error);
    if (code == IMP_SUCCESS && !shape_list_add(shapes, made, &no_maps))
        code = error_set_memory(error);
    instance_release(made);
    return code;
}

imp_code imp_builder_surface(imp_builder *b, size_t body, const char *type,
                             const imp_argument *arguments, size_t count, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    const fp_environment environment = fp_environment_enter();
    code = add_surface(b, body, type, arguments, count, error);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_builder_surface_of(imp_builder *b, size_t body, const imp_scene *scene,
                                size_t its_body, size_t its_surface, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = check_body(b, body, error);
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

/* On top of the maps in the list, which are of what `whose` says. */
static FP_APART imp_code add_map(imp_builder *b, size_t body, const char *whose,
                                 instance_list *maps, const char *type,
                                 const imp_argument *arguments, size_t count, imp_error *error)
{
    const body_words words = words_of(b, body);
    char map_words[80];
    snprintf(map_words, sizeof map_words, "%smap %zu", whose, maps->count);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, map_words);
    shared_instance *made = NULL;
    imp_code code = make(b, IMP_TYPE_MAP, type, arguments, count, &at, &made, error);
    if (code == IMP_SUCCESS && !instance_list_add(maps, made)) code = error_set_memory(error);
    instance_release(made);
    return code;
}

imp_code imp_builder_map(imp_builder *b, size_t body, const char *type,
                         const imp_argument *arguments, size_t count, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = check_body(b, body, error);
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
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    shape_list *shapes = &b->bodies.assembly.bodies[body].shapes;
    if (index >= shapes->count)
        return error_set(error, IMP_ERROR_USAGE, "%s has no surface %zu", words_of(b, body).at,
                         index);
    char whose[60];
    snprintf(whose, sizeof whose, "surface %zu: ", index);
    const fp_environment environment = fp_environment_enter();
    code = add_map(b, body, whose, &shapes->at[index].maps, type, arguments, count, error);
    fp_environment_leave(&environment);
    return code;
}

/* --- Relations -------------------------------------------------------------------------------- */

imp_code imp_builder_parent(imp_builder *b, size_t body, size_t parent, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = check_body(b, body, error);
    if (code == IMP_SUCCESS) code = check_body(b, parent, error);
    if (code == IMP_SUCCESS) b->bodies.assembly.bodies[body].parent = parent;
    return code;
}

imp_code imp_builder_group(imp_builder *b, size_t body, const char *group, imp_error *error)
{
    imp_code code = enter(b, error);
    if (code == IMP_SUCCESS) code = check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    if (group == NULL) return error_set(error, IMP_ERROR_USAGE, "group: the name is NULL");
    const body_words words = words_of(b, body);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, "group");
    return scene_bodies_join(&b->bodies, body, group, &at);
}

imp_code imp_builder_ignore(imp_builder *b, const char *x, const char *y, imp_error *error)
{
    const imp_code code = enter(b, error);
    if (code != IMP_SUCCESS) return code;
    if (x == NULL || y == NULL) return error_set(error, IMP_ERROR_USAGE, "ignore: a name is NULL");
    const place at = place_argument(NULL, "ignore");
    return scene_bodies_ignore(&b->bodies, x, &at, y, &at);
}

/* --- Done ------------------------------------------------------------------------------------- */

/* There is a body, and none is its own ancestor. */
static imp_code check_all(const imp_builder *b, imp_error *error)
{
    const assembly *a = &b->bodies.assembly;
    if (a->count == 0) return error_set(error, IMP_ERROR_SCENE, "the scene has no bodies");
    size_t body = 0;
    const assembly_search search = assembly_find_cycle(a, &body);
    if (search == ASSEMBLY_NO_CYCLE) return IMP_SUCCESS;
    if (search == ASSEMBLY_NO_MEMORY) return error_set_memory(error);
    const body_words words = words_of(b, body);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, "parent");
    return scene_bodies_refuse_cycle(&b->bodies, body, &at);
}

static FP_APART imp_scene *finish(imp_builder *b, imp_error *error)
{
    if (enter(b, error) != IMP_SUCCESS || check_all(b, error) != IMP_SUCCESS) return NULL;
    const place at = place_argument(NULL, "scene");
    b->finished = true;
    return scene_bodies_finish(&b->bodies, &at);
}

imp_scene *imp_builder_finish(imp_builder *b, imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    imp_scene *scene = finish(b, error);
    fp_environment_leave(&environment);
    return scene;
}
