/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_INSTANCES_H
#define CORE_READER_SCENE_INSTANCES_H

#include "core/reader/instance_table.h"
#include "core/reader/scene_build.h"
#include "core/scene/assembly.h"

/* Surfaces and maps as a scene file writes them
 * =============================================
 * In an array of surfaces or of maps, each element is an object with a type and its parameters, or
 * the name of a definition: then everything in that stands in its place. Definitions,
 *
 *     "define": {"NAME": [surfaces] or [maps], ...}
 *
 * may use each other. What one holds is created once and shared. Uses within uses are limited, so
 * that no small file stands for a scene without end. */

#define SCENE_INSTANCES_DEPTH_MAX 32u
#define SCENE_INSTANCES_SHARED_MAX 4194304u

typedef enum definition_state {
    DEFINITION_UNREAD,
    DEFINITION_BEING_READ,
    DEFINITION_READ
} definition_state;

typedef struct definition {
    const char *name;
    json_t *array;
    definition_state state;
    imp_type_kind kind; /* once it is not UNREAD; the list of the other kind stays empty */
    shape_list shapes;
    instance_list maps;
} definition;

typedef struct scene_instances {
    scene_source source;
    scene_parameters *parameters; /* of the scene, which their clocks may name */
    instance_table made;
    definition *definitions;
    size_t count;
    json_t *names;     /* of definitions, to their index */
    const char *whole; /* type of the map whose parts are being made; NULL: none are */
    unsigned depth;    /* of definitions that are being read */
    size_t shared;     /* how much definitions have put into the scene, and into each other */
    place root;        /* the scene's */
    imp_error *error;
} scene_instances;

/* Notes the definitions. The scene `root` at `at` must live as long. */
imp_code scene_instances_begin(scene_instances *p, const json_t *root, const place *at);
void scene_instances_clear(scene_instances *p);

/* Finds the definition of a name, which must be of that kind, and reads it if that is not done. */
imp_code scene_instances_use(scene_instances *p, const char *name, imp_type_kind kind,
                             const place *at, definition **used);

/* Adds a parameter to the scene, by a name that it may have. */
imp_code scene_instances_parameter(scene_instances *p, const char *name, double lo, double hi,
                                   const place *at);

/* Gets the instance that the object describes: an equal one that was made before, or a new one; one
 * that has a clock of its own is always new. The caller releases it. */
imp_code scene_instances_make(scene_instances *p, imp_type_kind kind, json_t *object,
                              const place *at, shared_instance **made);

/* Adds the map that the object describes, or the parts that stand for it (scene_parts.h). */
imp_code scene_instances_map(scene_instances *p, json_t *object, const place *at,
                             instance_list *to);

/* Adds what the array at `at` asks for; NULL is an empty one. */
imp_code scene_instances_maps(scene_instances *p, const json_t *array, const place *at,
                              instance_list *to);
imp_code scene_instances_surfaces(scene_instances *p, const json_t *array, const place *at,
                                  shape_list *to);

/* Adds one surface under its maps, written as one object. */
imp_code scene_instances_surface(scene_instances *p, json_t *object, const place *at,
                                 shape_list *to);

/* Reads the definitions that nobody used, for their errors. */
imp_code scene_instances_finish(scene_instances *p);

#endif
