/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_CHANGE_H
#define CORE_SCENE_SCENE_CHANGE_H

#include "core/scene/scene.h"

/* Another instance in a scene that is built
 * =========================================
 * Surfaces that an instance is part of are composed anew, and their trees are dropped; all others
 * stay. What the scene tells of itself is then what it would tell had it been built so, but for the
 * bytes of the instances that it keeps to be refilled. */

/* Where an instance stands: of a surface (map SIZE_MAX), of a surface's own maps, or of a body's
 * maps (surface SIZE_MAX). */
typedef struct scene_stage {
    size_t body, surface, map;
} scene_stage;

/* Returns the instance that stands there; NULL: none. */
shared_instance *scene_stage_at(const imp_scene *scene, scene_stage at);

/* Returns the map of the scene that was made from the same values as this one; NULL: none. Equal
 * maps are one instance, so that the solver sees which motions surfaces have in common. */
shared_instance *scene_equal_map(imp_scene *scene, const shared_instance *map);

/* How many queries and surveys there are. */
size_t scene_users(const imp_scene *scene);

/* Returns an instance of that type, one of both, to be refilled with values of so many bytes (as in
 * shared_instance.given); the caller holds it, and nobody else. NULL: none. */
shared_instance *scene_take_spare(imp_scene *scene, const imp_surface_type *type,
                                  const imp_map_type *map, size_t given);

/* Takes over what the caller holds: kept to be refilled, if nobody else holds it. */
void scene_give_spare(imp_scene *scene, shared_instance *p);

/* Puts an instance of the same type, which the scene then holds, in the place of that one; the
 * caller holds both. Nothing may use the scene. IMP_ERROR_MEMORY: the scene is as it was. */
imp_code scene_replace(imp_scene *scene, scene_stage at, shared_instance *by);

#endif
