/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/map_index.h"

#include <assert.h>
#include <stdlib.h>

static size_t slot_of(const map_index *index, const shared_instance *map)
{
    return (size_t)map->description->hash & (index->capacity - 1);
}

static size_t next_of(const map_index *index, size_t slot)
{
    return (slot + 1) & (index->capacity - 1);
}

/* Returns the slot of the map that is equal to this one, or the empty one where it would be. */
static size_t seek(const map_index *index, const shared_instance *map)
{
    size_t slot = slot_of(index, map);
    while (index->at[slot] != NULL && !instance_is_equal_map(index->at[slot], map))
        slot = next_of(index, slot);
    return slot;
}

/* Makes room for another map. False: no memory. */
static bool reserve(map_index *index)
{
    if (2 * (index->count + 1) < index->capacity) return true;
    if (index->capacity > SIZE_MAX / 4 / sizeof *index->at) return false;
    map_index grown = {.capacity = index->capacity > 0 ? 2 * index->capacity : 64};
    grown.at = calloc(grown.capacity, sizeof *grown.at);
    if (grown.at == NULL) return false;
    for (size_t k = 0; k < index->capacity; ++k)
        if (index->at[k] != NULL) grown.at[seek(&grown, index->at[k])] = index->at[k];
    grown.count = index->count;
    free(index->at);
    *index = grown;
    return true;
}

bool map_index_add(map_index *index, shared_instance *map)
{
    assert(map->description != NULL);
    if (!reserve(index)) return false;
    const size_t slot = seek(index, map);
    if (index->at[slot] != NULL) return index->at[slot] == map;
    index->at[slot] = map;
    index->count += 1;
    return true;
}

shared_instance *map_index_find(const map_index *index, const shared_instance *map)
{
    assert(map->description != NULL);
    return index->count > 0 ? index->at[seek(index, map)] : NULL;
}

/* Lemma. Behind the emptied slot, up to the next empty one, stand maps that were put off from slots
 * before them. One whose own slot is not behind the emptied slot moves there, and leaves an empty
 * slot to fill; so each map can be reached from its own slot again. */
void map_index_remove(map_index *index, const shared_instance *map)
{
    size_t empty = seek(index, map);
    const size_t mask = index->capacity - 1;
    assert(index->at[empty] == map);
    for (size_t k = next_of(index, empty); index->at[k] != NULL; k = next_of(index, k)) {
        const size_t put_off = (k - slot_of(index, index->at[k])) & mask;
        if (put_off < ((k - empty) & mask)) continue;
        index->at[empty] = index->at[k];
        empty = k;
    }
    index->at[empty] = NULL;
    index->count -= 1;
}

size_t map_index_bytes(const map_index *index) { return index->capacity * sizeof *index->at; }

void map_index_clear(map_index *index)
{
    free(index->at);
    *index = (map_index){.at = NULL};
}
