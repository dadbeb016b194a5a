/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_internal.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/common/array.h"
#include "core/scene/default_times.h"

/* --- Building --------------------------------------------------------------------------------- */

imp_scene *scene_new(void)
{
    imp_scene *scene = calloc(1, sizeof *scene);
    if (scene == NULL) return NULL;
    scene->settings = (scene_settings){NAN, NAN, 1e-6, -1};
    scene->t_from = INFINITY, scene->t_to = -INFINITY;
    scene->references = 1;
    return scene;
}

static void member_free(const imp_scene *scene, member *m)
{
    scene_free_trees(scene, m);
    surface_free(m->surface);
}

static void free_all(imp_scene *scene)
{
    for (size_t b = 0; b < scene->count; ++b) {
        for (size_t k = 0; k < scene->bodies[b].count; ++k)
            member_free(scene, &scene->bodies[b].members[k]);
        free(scene->bodies[b].members);
        if (scene->layout != NULL) instance_list_clear(&scene->layout[b].maps);
        free(scene->bodies[b].groups);
        free(scene->bodies[b].name);
    }
    for (size_t g = 0; g < scene->group_count; ++g) free(scene->groups[g]);
    free(scene->groups);
    free(scene->layout);
    free(scene->bodies);
    scene_free_spares(scene);
    map_index_clear(&scene->maps);
    scene_remarks_clear(&scene->remarks);
    named_files_clear(&scene->files);
    key_pairs_clear(&scene->ignored);
    scene_parameters_clear(&scene->parameters);
    free(scene);
}

void scene_begin_use(imp_scene *scene)
{
    atomic_fetch_add_explicit(&scene->references, 1, memory_order_relaxed);
}

void scene_end_use(imp_scene *scene)
{
    if (atomic_fetch_sub_explicit(&scene->references, 1, memory_order_acq_rel) == 1)
        free_all(scene);
}

void imp_scene_free(imp_scene *scene)
{
    if (scene != NULL) scene_end_use(scene);
}

bool scene_note_remarks(const imp_scene *scene, scene_remarks *to)
{
    bool kept = true;
    for (size_t b = 0; b < scene->count && kept; ++b)
        for (size_t k = 0; k < scene->bodies[b].count && kept; ++k)
            kept = scene_remarks_add(to, scene->bodies[b].members[k].surface, b, k);
    return kept;
}

imp_code scene_add_body(imp_scene *scene, const char *name)
{
    scene_body *bodies =
        array_reserve(scene->bodies, scene->count, &scene->capacity, sizeof *bodies);
    if (bodies == NULL) return IMP_ERROR_MEMORY;
    scene->bodies = bodies;
    char *copy = strdup(name);
    if (copy == NULL) return IMP_ERROR_MEMORY;
    bodies[scene->count++] = (scene_body){.name = copy};
    return IMP_SUCCESS;
}

void scene_set_store(imp_scene *scene, arena_store *store) { scene->store = store; }

arena_store *scene_store(const imp_scene *scene) { return scene->store; }

void scene_set_registry(imp_scene *scene, const imp_registry *registry)
{
    scene->registry = registry;
}

const imp_registry *scene_registry(const imp_scene *scene) { return scene->registry; }

named_files *scene_files_of(imp_scene *scene) { return &scene->files; }
const named_files *scene_files_named(const imp_scene *scene) { return &scene->files; }

imp_code scene_add_layout(imp_scene *scene)
{
    scene->layout = calloc(scene->count + 1, sizeof *scene->layout);
    for (size_t b = 0; b < scene->count && scene->layout != NULL; ++b)
        scene->layout[b].parent = SIZE_MAX;
    return scene->layout != NULL ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

void scene_set_maps(imp_scene *scene, size_t body, instance_list *maps, size_t parent)
{
    assert(body < scene->count && scene->layout != NULL);
    scene->layout[body].maps = *maps;
    scene->layout[body].parent = parent;
    if (parent != SIZE_MAX) scene->layout[parent].is_parent = true;
    *maps = (instance_list){.count = 0};
}

void scene_set_solid(imp_scene *scene, size_t body, bool is_solid)
{
    assert(body < scene->count);
    scene->solids += is_solid;
    scene->solids -= scene->bodies[body].solid;
    scene->bodies[body].solid = is_solid;
}

bool scene_has_solids(const imp_scene *scene) { return scene->solids > 0; }

bool scene_is_solid(const imp_scene *scene, size_t body)
{
    assert(body < scene->count);
    return scene->bodies[body].solid;
}

/* Makes room for another surface: most bodies of large scenes have one. False: no memory. */
static bool reserve_member(scene_body *b)
{
    if (b->count > 0) {
        member *grown = array_reserve(b->members, b->count, &b->capacity, sizeof *grown);
        if (grown != NULL) b->members = grown;
        return grown != NULL;
    }
    if (b->capacity == 0) b->members = malloc(sizeof *b->members);
    b->capacity = b->members != NULL;
    return b->members != NULL;
}

imp_code scene_add_surface(imp_scene *scene, size_t index, surface *s)
{
    assert(index < scene->count);
    scene_body *b = &scene->bodies[index];
    if (!reserve_member(b) || surface_divide(s) != IMP_SUCCESS) {
        surface_free(s);
        return IMP_ERROR_MEMORY;
    }
    surface_set_body(s, b->name, b->count);
    b->members[b->count++] = (member){.surface = s};
    return IMP_SUCCESS;
}

/* --- Once it is built ------------------------------------------------------------------------- */

void scene_note_times(imp_scene *scene)
{
    scene->t_from = -INFINITY, scene->t_to = INFINITY;
    for (size_t b = 0; b < scene->count; ++b)
        for (size_t k = 0; k < scene->bodies[b].count; ++k) {
            double lo[3], hi[3];
            surface_domain(scene->bodies[b].members[k].surface, lo, hi);
            if (!(lo[2] <= scene->t_from)) scene->t_from = lo[2];
            if (!(hi[2] >= scene->t_to)) scene->t_to = hi[2];
        }
}

void scene_choose_times(imp_scene *scene)
{
    double time[2];
    if (!scene->chooses_times) return;
    default_times(scene, time, NULL); /* NAN where there are none */
    scene->settings.t_start = time[0];
    scene->settings.t_end = time[1];
}

imp_code scene_complete(imp_scene *scene)
{
    if (scene_count_bytes(scene) != IMP_SUCCESS) return IMP_ERROR_MEMORY;
    scene->chooses_times = isnan(scene->settings.t_start);
    scene_note_times(scene);
    if (!scene_note_remarks(scene, &scene->remarks)) return IMP_ERROR_MEMORY;
    scene_choose_times(scene);
    return IMP_SUCCESS;
}

bool imp_scene_remark(const imp_scene *scene, size_t index, imp_remark *remark)
{
    return scene != NULL && scene_remarks_tell(&scene->remarks, index, remark);
}

bool scene_is_defined(const imp_scene *scene, double t_start, double t_end)
{
    return scene->t_from <= t_start && t_end <= scene->t_to;
}

/* --- Asking ----------------------------------------------------------------------------------- */

scene_settings *scene_settings_of(imp_scene *scene) { return &scene->settings; }

const scene_settings *scene_settings_read(const imp_scene *scene) { return &scene->settings; }

scene_parameters *scene_parameters_of(imp_scene *scene) { return &scene->parameters; }

const scene_parameters *scene_parameters_read(const imp_scene *scene) { return &scene->parameters; }

imp_code scene_refuse_parameters(const imp_scene *scene, const char *asker, imp_error *error)
{
    if (scene->parameters.count == 0) return IMP_SUCCESS;
    return error_set(
        error, IMP_ERROR_USAGE,
        "the scene has parameters ('%.80s'), and %s asks about one pose: ask about all "
        "values (impinge solve, impinge clearance; imp_survey_new), or about the "
        "scene at some (imp_scene_at)",
        scene->parameters.at[0].name, asker);
}

size_t imp_scene_parameter_count(const imp_scene *scene)
{
    return scene != NULL ? scene->parameters.count : 0;
}

bool imp_scene_parameter(const imp_scene *scene, size_t index, imp_scene_parameter_info *info)
{
    if (index >= imp_scene_parameter_count(scene) || info == NULL) return false;
    const scene_parameter *p = &scene->parameters.at[index];
    *info = (imp_scene_parameter_info){p->name, p->lo, p->hi, p->is_followed};
    return true;
}

size_t scene_body_count(const imp_scene *scene) { return scene->count; }

size_t scene_surface_count(const imp_scene *scene, size_t body)
{
    assert(body < scene->count);
    return scene->bodies[body].count;
}

size_t imp_scene_body_count(const imp_scene *scene) { return scene != NULL ? scene->count : 0; }

const char *imp_scene_body_name(const imp_scene *scene, size_t body)
{
    return body < imp_scene_body_count(scene) ? scene->bodies[body].name : NULL;
}

size_t imp_scene_surface_count(const imp_scene *scene, size_t body)
{
    return body < imp_scene_body_count(scene) ? scene->bodies[body].count : 0;
}

const surface *scene_surface(const imp_scene *scene, size_t body, size_t index)
{
    if (scene == NULL || body >= scene->count || index >= scene->bodies[body].count) return NULL;
    return scene->bodies[body].members[index].surface;
}
