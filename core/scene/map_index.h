/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_MAP_INDEX_H
#define CORE_SCENE_MAP_INDEX_H

#include "core/surface/instance.h"

/* The maps of a scene by their descriptions
 * =========================================
 * A map that becomes equal to another of the scene becomes that one. In a scene of many bodies, of
 * which all may change before the next query, an equal one is found by the hash of what it was made
 * from. The index lists maps that others hold. */

typedef struct map_index {
    shared_instance **at; /* slots, an empty one NULL; each map is in the first slot that was free
                             from that of its hash on */
    size_t capacity;      /* a power of two, more than twice the count */
    size_t count;
} map_index;

/* Adds a map that has a description, unless it is there. False: no memory, or there is another one
 * that is equal; then the index is as it was. */
bool map_index_add(map_index *index, shared_instance *map);

/* Returns the map that is equal to this one, which has a description; NULL: none. */
shared_instance *map_index_find(const map_index *index, const shared_instance *map);

/* Takes a map out that is there. */
void map_index_remove(map_index *index, const shared_instance *map);

void map_index_clear(map_index *index);

size_t map_index_bytes(const map_index *index);

#endif
