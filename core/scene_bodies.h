/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_BODIES_H
#define CORE_SCENE_BODIES_H

#include <jansson.h>

#include "place.h"
#include "registry.h"
#include "scene.h"

/* Bodies, put into a scene one after the other */

typedef struct scene_bodies {
    const imp_registry *registry;
    imp_scene *scene;
    json_t *names; /* of the bodies so far, to their index: an empty object at first */
    imp_error *error;
} scene_bodies;

/* Begins a body; its name, or "body0", "body1", ... by position if NULL, must be new. Surfaces
 * go to the last body begun. */
imp_code scene_bodies_begin(scene_bodies *b, const char *name, const place *at);

/* The surface that `object` asks for, under its own maps and then those of the body (an array,
 * or NULL). */
imp_code scene_bodies_add_surface(scene_bodies *b, const json_t *object, const place *at,
                                  json_t *body_maps, const place *body_maps_at);

/* Everything under the key "bodies" of the scene at `at`, and then under "ignore". */
imp_code scene_bodies_add_all(scene_bodies *b, const json_t *root, const place *at);
imp_code scene_bodies_ignore(scene_bodies *b, const json_t *root, const place *at);

#endif
