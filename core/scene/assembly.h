/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_ASSEMBLY_H
#define CORE_SCENE_ASSEMBLY_H

#include "core/scene/scene.h"
#include "core/surface/instance.h"

/* From instances to a scene
 * =========================
 * Bodies are described one by one: what they consist of, their maps, their parents. When all of
 * that is known, each surface is composed: first its own maps, then those of its body, then those
 * of its body's parent, of the parent's parent, and so on. The instances stay shared. */

/* A surface type's instance under maps of its own. */
typedef struct shape {
    shared_instance *type; /* held */
    instance_list maps;
} shape;

typedef struct shape_list {
    shape *at;
    size_t count, capacity;
} shape_list;

bool shape_list_add(shape_list *list, shared_instance *type,
                    const instance_list *maps); /* false: no memory */
bool shape_list_add_all(shape_list *list, const shape_list *more);
void shape_list_clear(shape_list *list);

#define ASSEMBLY_NO_PARENT SIZE_MAX

/* One body's description; shapes and maps may be added to until the scene is composed. */
typedef struct assembly_body {
    shape_list shapes;
    instance_list maps;
    size_t parent;
} assembly_body;

typedef struct assembly {
    imp_scene *scene; /* its bodies have names and groups already, but no surfaces */
    assembly_body *bodies;
    size_t count, capacity;
} assembly;

bool assembly_begin(assembly *a); /* false: no memory; clear it all the same */
void assembly_clear(assembly *a);

/* Adds a body of that name, which is copied, at the end of a->bodies. False: no memory. */
bool assembly_add_body(assembly *a, const char *name);

/* Gives a body without surfaces, maps and parent those that the body of that number has in a scene,
 * whether it is solid, and shares the instances. False: no memory. */
bool assembly_copy_body(assembly *a, size_t body, const imp_scene *scene);

/* Finds a body that is its own ancestor, in *body. False: there is none. */
typedef enum assembly_search {
    ASSEMBLY_NO_CYCLE,
    ASSEMBLY_CYCLE,
    ASSEMBLY_NO_MEMORY
} assembly_search;
assembly_search assembly_find_cycle(const assembly *a, size_t *body);

/* Leaves out ancestors without maps: they change nothing, and long chains of them are walked
 * through for each body. Precondition: no cycle. */
void assembly_skip_bare_parents(assembly *a);

/* Limits of the maps put on all surfaces together, and of the ancestors walked through for it: a
 * small file of parents and shared lists of maps could otherwise multiply them without end. */
#define ASSEMBLY_WORK_MAX 4194304u
bool assembly_is_too_large(const assembly *a);

/* Makes the scene, which the caller owns. Precondition: no cycle, not too large. NULL: no
 * memory. */
imp_scene *assembly_finish(assembly *a);

#endif
