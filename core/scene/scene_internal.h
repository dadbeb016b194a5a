/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_INTERNAL_H
#define CORE_SCENE_SCENE_INTERNAL_H

#include <stdatomic.h>

#include "core/scene/map_index.h"
#include "core/scene/scene.h"
#include "core/scene/scene_remarks.h"
#include "core/tree/node.h"

/* The scene itself, for the files that read its fields: scene.c builds it and frees it,
 * scene_groups.c holds who ignores whom, scene_memory.c counts its bytes, scene_options.c checks
 * what is asked of it, scene_trees.c makes the trees of its surfaces. */

/* A surface without its last maps, for trees in a frame that moves with these, and with its first
 * maps held (core/surface/held.h), or some set aside (core/surface/aside.h). */
typedef struct inner {
    struct inner *next;
    surface *surface;
    size_t left_out;
    held_maps held;
    maps_aside aside;
} inner;

typedef struct member {
    surface *surface;
    /* the first of either list, to whose front threads add */
    _Atomic(tree *) trees;
    _Atomic(inner *) inners;
} member;

typedef struct scene_body {
    char *name;
    bool solid;
    member *members;
    size_t count, capacity;
    size_t *groups;
    size_t group_count, group_capacity;
} scene_body;

/* What bodies have in common with their surfaces and their parents, for scenes that may change. */
typedef struct scene_layout {
    instance_list maps; /* of the body itself, which come after those of each surface */
    size_t parent;      /* whose maps come after its own; SIZE_MAX: none */
    bool is_parent;
} scene_layout;

/* Instances that wait to be refilled: a step of a simulation changes few types. */
enum { SCENE_SPARES = 4 };

struct imp_scene {
    scene_body *bodies;
    size_t count, capacity;
    size_t solids; /* how many bodies are solid */
    char **groups; /* names */
    size_t group_count, group_capacity;
    key_pairs ignored;
    scene_settings settings;
    scene_parameters parameters;
    uint64_t bytes;      /* 0: not complete: then without instances */
    double t_from, t_to; /* when all surfaces are defined; not known yet: never */
    scene_remarks remarks;
    named_files files;
    arena_store *store;           /* of blocks for trees; not its own; NULL: the heap */
    scene_layout *layout;         /* of each body; NULL: the scene is not changed */
    const imp_registry *registry; /* whose types its instances are of; NULL: it has no layout */
    shared_instance *spare[SCENE_SPARES]; /* spare_count of them, held by nobody else */
    size_t spare_count;
    map_index maps;             /* of a scene that is changed and has many bodies; else empty */
    bool indexes_maps;          /* it lists all that have descriptions */
    bool cannot_index;          /* no memory, or some of them are equal */
    bool chooses_times;         /* nobody has set those to examine */
    _Atomic(size_t) references; /* queries and surveys of it, and its owner */
    /* once it is built all but the members' lists of trees is only read, but by scene_change.c */
};

/* Counts the maps of surface k of a body alone, which come before those of bodies. */
size_t scene_own_maps(const imp_scene *scene, size_t body, size_t k);

/* Sets t_from and t_to. */
void scene_note_times(imp_scene *scene);

/* Sets `bytes`, when all of it is built. IMP_ERROR_MEMORY: no memory to count. */
imp_code scene_count_bytes(imp_scene *scene);

/* Chooses the times to examine, if nobody has set them. */
void scene_choose_times(imp_scene *scene);

/* Collects what types remarked, in `to`. False: no memory. */
bool scene_note_remarks(const imp_scene *scene, scene_remarks *to);

void scene_free_spares(imp_scene *scene);

/* Frees the trees of a surface, and the surfaces in frames that they are of. */
void scene_free_trees(const imp_scene *scene, member *m);

#endif
