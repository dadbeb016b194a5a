/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/later_pairs.h"

#include <string.h>

later_pairs *later_pairs_new(arena_store *store, double until)
{
    later_pairs *later = arena_store_room(store, sizeof *later);
    if (later != NULL) *later = (later_pairs){.store = store, .until = until};
    return later;
}

void later_pairs_free(later_pairs *later)
{
    if (later == NULL) return;
    for (ready_candidates *r = later->ready, *next; r != NULL; r = next) {
        next = r->next;
        for (size_t k = 0; k < r->count; ++k) arena_store_free_room(later->store, r->at[k].half);
        arena_store_free_room(later->store, r->at);
        arena_store_free_room(later->store, r);
    }
    arena_store_free_room(later->store, later->pair);
    arena_store_free_room(later->store, later);
}

uint64_t later_pairs_bytes(const later_pairs *later)
{
    if (later == NULL) return 0;
    return sizeof *later + later->capacity * sizeof *later->pair +
           later->ready_count * sizeof(candidate);
}

bool later_pairs_add(later_pairs *later, size_t first, size_t second)
{
    uint32_t(*grown)[2] = arena_store_reserve(later->store, later->pair, later->count,
                                              &later->capacity, sizeof *grown);
    if (grown == NULL) return false;
    later->pair = grown;
    later->pair[later->count][0] = (uint32_t)first;
    later->pair[later->count++][1] = (uint32_t)second;
    return true;
}

/* --- Sorting ---------------------------------------------------------------------------------- */

/* What pairs are sorted by: the number of one side's candidate, or that of its body. */
typedef struct pass_key {
    const candidate *candidates; /* NULL: the number itself */
    int side;
} pass_key;

static size_t key_of(const uint32_t pair[2], const pass_key *by)
{
    const size_t k = pair[by->side];
    return by->candidates != NULL ? by->candidates[k].body : k;
}

/* A stable counting sort from one array into another; `start` has room for two more than keys. */
static void sort_pass(uint32_t (*from)[2], uint32_t (*to)[2], size_t count, const pass_key *by,
                      size_t *start, size_t keys)
{
    memset(start, 0, (keys + 1) * sizeof *start);
    for (size_t k = 0; k < count; ++k) start[key_of(from[k], by) + 1] += 1;
    for (size_t k = 0; k < keys; ++k) start[k + 1] += start[k];
    for (size_t k = 0; k < count; ++k)
        memcpy(to[start[key_of(from[k], by)]++], from[k], sizeof *to);
}

/* Four passes, the least significant key first, by which the pairs are back in their array. */
bool later_pairs_sort(later_pairs *later, const candidate *candidates, size_t count)
{
    const pass_key keys[] = {{NULL, 1}, {NULL, 0}, {candidates, 1}, {candidates, 0}};
    const size_t last = count > 0 ? candidates[count - 1].body + 1 : 0;
    const size_t most = last > count ? last : count;
    uint32_t(*other)[2] = arena_store_room(later->store, (later->count + 1) * sizeof *other);
    size_t *start = arena_store_room(later->store, (most + 2) * sizeof *start);
    const bool ok = other != NULL && start != NULL;
    for (int k = 0; ok && k < 4; ++k)
        sort_pass(k % 2 == 0 ? later->pair : other, k % 2 == 0 ? other : later->pair, later->count,
                  &keys[k], start, most);
    arena_store_free_room(later->store, other);
    arena_store_free_room(later->store, start);
    return ok;
}

size_t later_pairs_next(const later_pairs *later, const candidate *candidates, size_t k)
{
    const size_t a = candidates[later->pair[k][0]].body, b = candidates[later->pair[k][1]].body;
    do ++k;
    while (k < later->count && candidates[later->pair[k][0]].body == a &&
           candidates[later->pair[k][1]].body == b);
    return k;
}
