/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_INTERNAL_H
#define CORE_SCENE_SCENE_INTERNAL_H

#include <stdatomic.h>

#include "core/scene/scene.h"
#include "core/scene/scene_remarks.h"
#include "core/tree/node.h"

/* The scene itself, for the files that read its fields: scene.c builds it and frees it,
 * scene_groups.c holds who ignores whom, scene_trees.c makes the trees of its surfaces. */

/* A surface without its last maps, for trees in a frame that moves with these. */
typedef struct inner {
    struct inner *next;
    surface *surface;
    size_t left_out;
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
    arena_store *store; /* of blocks for trees; not its own; NULL: the heap */
    /* once it is built all but the members' lists of trees is only read */
};

/* Frees the trees of a surface, and the surfaces in frames that they are of. */
void scene_free_trees(member *m);

#endif
