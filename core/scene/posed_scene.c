/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/posed_scene.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/common/array.h"
#include "core/surface/clocked.h"

/* What a clocked instance of the scene becomes at the values; each once, so that maps that surfaces
 * share stay shared. */
typedef struct moved_instance {
    const shared_instance *from;
    shared_instance *to; /* held */
} moved_instance;

typedef struct posing_scene {
    const double *values;
    size_t released;
    double time; /* what follows time is held at; NAN: it is not */
    moved_instance *moved;
    size_t count, capacity;
} posing_scene;

/* Returns the instance at the values, which `p` or the scene holds. NULL: no memory. */
static shared_instance *at_values(posing_scene *p, shared_instance *from)
{
    const bool is_clocked = from->inner != NULL;
    if (!is_clocked && isnan(p->time)) return from;
    if (is_clocked && from->clock == p->released) return from->inner;
    for (size_t k = 0; k < p->count; ++k)
        if (p->moved[k].from == from) return p->moved[k].to;
    moved_instance *grown = array_reserve(p->moved, p->count, &p->capacity, sizeof *grown);
    if (grown == NULL) return NULL;
    p->moved = grown;
    shared_instance *made = is_clocked
                                ? clocked_new(from->inner, from->clock, p->values[from->clock])
                                : clocked_new(from, 0, p->time);
    if (made != NULL) p->moved[p->count++] = (moved_instance){from, made};
    return made;
}

static void clear(posing_scene *p)
{
    for (size_t k = 0; k < p->count; ++k) instance_release(p->moved[k].to);
    free(p->moved);
}

/* NULL: no memory. */
static surface *surface_at_values(posing_scene *p, const surface *s)
{
    shared_instance *type = at_values(p, surface_stage(s, 0));
    surface *made = type != NULL ? surface_new_of(type) : NULL;
    for (size_t k = 1; made != NULL && k <= surface_map_count(s); ++k) {
        shared_instance *map = at_values(p, surface_stage(s, k));
        if (map != NULL && surface_add_instance(made, map) == IMP_SUCCESS) continue;
        surface_free(made);
        return NULL;
    }
    return made;
}

static imp_code add_body(posing_scene *p, const imp_scene *scene, size_t body, imp_scene *to)
{
    const size_t index = scene_body_count(to);
    imp_code code = scene_add_body(to, imp_scene_body_name(scene, body));
    if (code != IMP_SUCCESS) return code;
    scene_set_solid(to, index, scene_is_solid(scene, body));
    for (size_t k = 0; k < scene_surface_count(scene, body) && code == IMP_SUCCESS; ++k) {
        surface *s = surface_at_values(p, scene_surface(scene, body, k));
        code = s != NULL ? scene_add_surface(to, index, s) : IMP_ERROR_MEMORY;
    }
    return code;
}

static imp_code pose(posing_scene p, const imp_scene *scene, const size_t *bodies, size_t count,
                     imp_scene **made)
{
    imp_scene *to = scene_new();
    imp_code code = to != NULL ? IMP_SUCCESS : IMP_ERROR_MEMORY;
    if (to != NULL) scene_set_store(to, scene_store(scene));
    for (size_t k = 0; k < count && code == IMP_SUCCESS; ++k)
        code = add_body(&p, scene, bodies[k], to);
    clear(&p);
    if (code == IMP_SUCCESS) {
        *scene_settings_of(to) = *scene_settings_read(scene);
        code = scene_complete(to);
    }
    if (code == IMP_SUCCESS)
        *made = to;
    else
        imp_scene_free(to);
    return code;
}

imp_code posed_scene_of_bodies(const imp_scene *scene, const double *values, const size_t *bodies,
                               size_t count, size_t released, imp_scene **made)
{
    const posing_scene p = {.values = values, .released = released, .time = NAN};
    return pose(p, scene, bodies, count, made);
}

/* --- Public functions ------------------------------------------------------------------------- */

bool imp_scene_follows(const imp_scene *scene, size_t body, size_t index)
{
    if (scene == NULL || body >= scene_body_count(scene)) return false;
    for (size_t k = 0; k < scene_surface_count(scene, body); ++k) {
        const surface *s = scene_surface(scene, body, k);
        for (size_t stage = 0; stage <= surface_map_count(s); ++stage) {
            const shared_instance *one = surface_stage(s, stage);
            if (one->inner != NULL && one->clock == index) return true;
        }
    }
    return false;
}

static imp_code check_values(const imp_scene *scene, const double *values, imp_error *error)
{
    const scene_parameters *parameters = scene_parameters_read(scene);
    for (size_t k = 0; k < parameters->count; ++k) {
        const scene_parameter *p = &parameters->at[k];
        if (values[k] >= p->lo && values[k] <= p->hi) continue;
        return error_set(error, IMP_ERROR_USAGE,
                         "parameter '%.80s': got %.17g, must be from %.17g to %.17g", p->name,
                         values[k], p->lo, p->hi);
    }
    return IMP_SUCCESS;
}

/* Makes the scene of all bodies. */
static imp_code pose_all(posing_scene p, const imp_scene *scene, imp_scene **made, imp_error *error)
{
    const size_t count = scene_body_count(scene);
    imp_code code = check_values(scene, p.values, error);
    if (code != IMP_SUCCESS) return code;
    size_t *bodies = malloc((count + 1) * sizeof *bodies);
    if (bodies == NULL) return error_set_memory(error);
    for (size_t b = 0; b < count; ++b) bodies[b] = b;
    code = pose(p, scene, bodies, count, made);
    free(bodies);
    if (code == IMP_SUCCESS) {
        code = scene_copy_relations(scene, *made);
        if (code != IMP_SUCCESS) imp_scene_free(*made);
    }
    return code == IMP_SUCCESS ? code : error_set_memory(error);
}

imp_scene *imp_scene_at(const imp_scene *scene, const double *values, imp_error *error)
{
    imp_scene *made = NULL;
    if (scene == NULL || (values == NULL && imp_scene_parameter_count(scene) > 0)) {
        error_set_missing(error, "imp_scene_at");
        return NULL;
    }
    const fp_environment environment = fp_environment_enter();
    const posing_scene p = {.values = values, .released = SIZE_MAX, .time = NAN};
    const imp_code code = pose_all(p, scene, &made, error);
    fp_environment_leave(&environment);
    return code == IMP_SUCCESS ? made : NULL;
}

/* --- A parameter in the place of time --------------------------------------------------------- */

static imp_code check_instance(const shared_instance *one, double t, const char *body,
                               imp_error *error)
{
    if (one->inner != NULL || (one->lo[2] <= t && t <= one->hi[2])) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_USAGE,
                     "t: got %.17g, but body '%.80s' has a surface or map that follows time and is "
                     "defined from %.17g to %.17g only",
                     t, body, one->lo[2], one->hi[2]);
}

/* Checks that everything that follows time is defined at t. */
static imp_code check_held(const imp_scene *scene, double t, imp_error *error)
{
    imp_code code = isfinite(t) ? IMP_SUCCESS
                                : error_set(error, IMP_ERROR_USAGE, "t: got %g, must be finite", t);
    for (size_t b = 0; b < scene_body_count(scene); ++b)
        for (size_t k = 0; k < scene_surface_count(scene, b); ++k) {
            const surface *s = scene_surface(scene, b, k);
            for (size_t stage = 0; stage <= surface_map_count(s) && code == IMP_SUCCESS; ++stage)
                code = check_instance(surface_stage(s, stage), t, imp_scene_body_name(scene, b),
                                      error);
        }
    return code;
}

static imp_code sweep(const imp_scene *scene, size_t index, const double *values, double t,
                      imp_scene **made, imp_error *error)
{
    const scene_parameters *parameters = scene_parameters_read(scene);
    if (index >= parameters->count)
        return error_set(error, IMP_ERROR_USAGE, "index: got %zu, must be below %zu", index,
                         parameters->count);
    imp_code code = check_held(scene, t, error);
    const posing_scene p = {.values = values, .released = index, .time = t};
    if (code == IMP_SUCCESS) code = pose_all(p, scene, made, error);
    if (code != IMP_SUCCESS) return code;
    scene_settings_of(*made)->t_start = parameters->at[index].lo;
    scene_settings_of(*made)->t_end = parameters->at[index].hi;
    return IMP_SUCCESS;
}

imp_scene *imp_scene_sweep(const imp_scene *scene, size_t index, const double *values, double t,
                           imp_error *error)
{
    imp_scene *made = NULL;
    if (scene == NULL || values == NULL) return error_set_missing(error, "imp_scene_sweep"), NULL;
    const fp_environment environment = fp_environment_enter();
    const imp_code code = sweep(scene, index, values, t, &made, error);
    fp_environment_leave(&environment);
    return code == IMP_SUCCESS ? made : NULL;
}
