/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/assembly.h"

#include <assert.h>
#include <stdlib.h>

#include "core/common/array.h"
#include "core/scene/scene_internal.h"

/* --- Shapes ----------------------------------------------------------------------------------- */

static void shape_clear(shape *s)
{
    instance_release(s->type);
    instance_list_clear(&s->maps);
}

bool shape_list_add(shape_list *list, shared_instance *type, const instance_list *maps)
{
    shape *grown = array_reserve(list->at, list->count, &list->capacity, sizeof *grown);
    if (grown == NULL) return false;
    list->at = grown;
    shape made = {.type = instance_hold(type)};
    if (!instance_list_add_all(&made.maps, maps)) {
        shape_clear(&made);
        return false;
    }
    list->at[list->count++] = made;
    return true;
}

bool shape_list_add_all(shape_list *list, const shape_list *more)
{
    for (size_t k = 0; k < more->count; ++k)
        if (!shape_list_add(list, more->at[k].type, &more->at[k].maps)) return false;
    return true;
}

void shape_list_clear(shape_list *list)
{
    for (size_t k = 0; k < list->count; ++k) shape_clear(&list->at[k]);
    free(list->at);
    *list = (shape_list){.count = 0};
}

/* --- Bodies ----------------------------------------------------------------------------------- */

bool assembly_begin(assembly *a)
{
    *a = (assembly){.scene = scene_new()};
    return a->scene != NULL;
}

void assembly_clear(assembly *a)
{
    for (size_t k = 0; k < a->count; ++k) {
        shape_list_clear(&a->bodies[k].shapes);
        instance_list_clear(&a->bodies[k].maps);
    }
    free(a->bodies);
    imp_scene_free(a->scene);
    *a = (assembly){.scene = NULL};
}

bool assembly_add_body(assembly *a, const char *name)
{
    assembly_body *grown = array_reserve(a->bodies, a->count, &a->capacity, sizeof *grown);
    if (grown == NULL) return false;
    a->bodies = grown;
    if (scene_add_body(a->scene, name) != IMP_SUCCESS) return false;
    a->bodies[a->count++] = (assembly_body){.parent = ASSEMBLY_NO_PARENT};
    return true;
}

/* Walks up from each body until it meets one that an earlier walk has passed. To meet one that the
 * same walk has passed is to walk in a circle. */
assembly_search assembly_find_cycle(const assembly *a, size_t *body)
{
    size_t *passed = calloc(a->count + 1, sizeof *passed); /* by which walk; 0: by none */
    if (passed == NULL) return ASSEMBLY_NO_MEMORY;
    bool found = false;
    for (size_t k = 0; k < a->count && !found; ++k) {
        size_t up = k;
        while (up != ASSEMBLY_NO_PARENT && passed[up] == 0) {
            passed[up] = k + 1;
            up = a->bodies[up].parent;
        }
        found = up != ASSEMBLY_NO_PARENT && passed[up] == k + 1;
        if (found) *body = up;
    }
    free(passed);
    return found ? ASSEMBLY_CYCLE : ASSEMBLY_NO_CYCLE;
}

/* Each link is shortened to the next ancestor that has maps, and so are those on the way to it,
 * which later bodies then need not walk again. */
void assembly_skip_bare_parents(assembly *a)
{
    for (size_t k = 0; k < a->count; ++k) {
        size_t mapped = a->bodies[k].parent, up = k;
        while (mapped != ASSEMBLY_NO_PARENT && a->bodies[mapped].maps.count == 0)
            mapped = a->bodies[mapped].parent;
        while (a->bodies[up].parent != mapped) {
            const size_t next = a->bodies[up].parent;
            a->bodies[up].parent = mapped;
            up = next;
        }
    }
}

bool assembly_is_too_large(const assembly *a)
{
    size_t work = 0;
    for (size_t body = 0; body < a->count; ++body) {
        const shape_list *shapes = &a->bodies[body].shapes;
        for (size_t k = 0; k < shapes->count; ++k) work += shapes->at[k].maps.count;
        for (size_t up = body; up != ASSEMBLY_NO_PARENT; up = a->bodies[up].parent) {
            work += 1 + shapes->count * a->bodies[up].maps.count;
            if (work > ASSEMBLY_WORK_MAX) return true;
        }
    }
    return false;
}

/* --- Bodies of another scene ------------------------------------------------------------------ */

/* The type of a surface, and those of its maps that are its own. */
static bool copy_shape(shape_list *to, const surface *s, size_t own_maps)
{
    instance_list maps = {.count = 0};
    bool copied = true;
    for (size_t k = 1; k <= own_maps && copied; ++k)
        copied = instance_list_add(&maps, surface_stage(s, k));
    copied = copied && shape_list_add(to, surface_stage(s, 0), &maps);
    instance_list_clear(&maps);
    return copied;
}

bool assembly_copy_body(assembly *a, size_t body, const imp_scene *scene)
{
    assembly_body *to = &a->bodies[body];
    const scene_layout *layout = scene->layout != NULL ? &scene->layout[body] : NULL;
    scene_set_solid(a->scene, body, scene_is_solid(scene, body));
    for (size_t k = 0; k < scene_surface_count(scene, body); ++k)
        if (!copy_shape(&to->shapes, scene_surface(scene, body, k), scene_own_maps(scene, body, k)))
            return false;
    if (layout == NULL) return true;
    to->parent = layout->parent;
    return instance_list_add_all(&to->maps, &layout->maps);
}

/* --- Composing -------------------------------------------------------------------------------- */

static bool add_parts(surface *s, const instance_list *maps)
{
    for (size_t k = 0; k < maps->count; ++k)
        if (surface_add_instance(s, maps->at[k]) != IMP_SUCCESS) return false;
    return true;
}

/* Makes the surface of a shape under its own maps, then those of the body and of all its
 * ancestors. */
static surface *compose(const assembly *a, size_t body, const shape *what)
{
    surface *s = surface_new_of(what->type);
    bool done = s != NULL && add_parts(s, &what->maps);
    for (size_t up = body; done && up != ASSEMBLY_NO_PARENT; up = a->bodies[up].parent)
        done = add_parts(s, &a->bodies[up].maps);
    if (done) return s;
    surface_free(s);
    return NULL;
}

imp_scene *assembly_finish(assembly *a)
{
    for (size_t body = 0; body < a->count; ++body) {
        const shape_list *shapes = &a->bodies[body].shapes;
        for (size_t k = 0; k < shapes->count; ++k) {
            surface *s = compose(a, body, &shapes->at[k]);
            if (s == NULL || scene_add_surface(a->scene, body, s) != IMP_SUCCESS) return NULL;
        }
    }
    if (scene_add_layout(a->scene) != IMP_SUCCESS) return NULL;
    for (size_t body = 0; body < a->count; ++body)
        scene_set_maps(a->scene, body, &a->bodies[body].maps, a->bodies[body].parent);
    imp_scene *scene = a->scene;
    a->scene = NULL;
    assembly_clear(a);
    if (scene_complete(scene) == IMP_SUCCESS) return scene;
    imp_scene_free(scene);
    return NULL;
}
