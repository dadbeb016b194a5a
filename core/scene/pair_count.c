/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/scene/scene.h"

/* How many pairs of bodies do not ignore each other, without asking about each: two groups of ten
 * thousand are one question. A unit is a body, or all the bodies that only one group names; it has
 * the number of that key. */

typedef struct counting {
    const imp_scene *scene;
    const key_pairs *ignored;
    size_t keys;              /* keys and units are below this number */
    size_t *weight;           /* bodies of a unit; 0: there is no such unit */
    size_t *stamp;            /* 1 + the unit for which a unit was counted last */
    size_t *first, *partner;  /* the keys that key k ignores: first[k] .. first[k + 1] */
    size_t *head, *next, *of; /* bodies of group key k that are units: a list, whose end is 0 */
} counting;

static bool is_named(const counting *c, size_t key) { return c->first[key] < c->first[key + 1]; }

/* Lists the partners of each key: counts, sums, and fills from the ends. */
static void list_partners(counting *c)
{
    for (size_t k = 0; k < c->ignored->count; ++k) {
        const size_t *key = c->ignored->at[k].key;
        c->first[key[0]] += 1;
        if (key[1] != key[0]) c->first[key[1]] += 1;
    }
    for (size_t k = 0; k < c->keys; ++k) c->first[k + 1] += c->first[k];
    for (size_t k = 0; k < c->ignored->count; ++k) {
        const size_t *key = c->ignored->at[k].key;
        c->partner[--c->first[key[0]]] = key[1];
        if (key[1] != key[0]) c->partner[--c->first[key[1]]] = key[0];
    }
}

/* Makes the units. A body that nobody names is in none. */
static void make_units(counting *c)
{
    size_t entries = 0;
    for (size_t b = 0; b < scene_body_count(c->scene); ++b) {
        const size_t keys = scene_body_key_count(c->scene, b);
        const size_t own = scene_body_key(c->scene, b, 0);
        if (scene_surface_count(c->scene, b) == 0 || (keys == 1 && !is_named(c, own))) continue;
        if (keys == 2 && !is_named(c, own)) {
            c->weight[scene_body_key(c->scene, b, 1)] += 1;
            continue;
        }
        c->weight[own] = 1;
        for (size_t k = 1; k < keys; ++k) {
            const size_t group = scene_body_key(c->scene, b, k);
            entries += 1;
            c->of[entries] = own;
            c->next[entries] = c->head[group];
            c->head[group] = entries;
        }
    }
}

/* Returns the pairs of bodies of units i and j, unless they were counted for i already. */
static size_t pairs_of(counting *c, size_t i, size_t j)
{
    if (j < i || c->stamp[j] == i + 1) return 0;
    c->stamp[j] = i + 1;
    return i == j ? c->weight[i] * (c->weight[i] - 1) / 2 : c->weight[i] * c->weight[j];
}

/* Returns the pairs that unit i ignores because of one of its keys. */
static size_t pairs_by_key(counting *c, size_t i, size_t key)
{
    size_t count = 0;
    for (size_t p = c->first[key]; p < c->first[key + 1]; ++p) {
        const size_t named = c->partner[p];
        if (c->weight[named] > 0) count += pairs_of(c, i, named);
        for (size_t e = c->head[named]; e != 0; e = c->next[e]) count += pairs_of(c, i, c->of[e]);
    }
    return count;
}

static size_t count_ignored(counting *c)
{
    size_t count = 0;
    list_partners(c);
    make_units(c);
    for (size_t i = 0; i < c->keys; ++i) {
        if (c->weight[i] == 0) continue;
        const bool is_body = scene_key_is_of_body(i);
        const size_t body = i / 2, keys = is_body ? scene_body_key_count(c->scene, body) : 1;
        for (size_t k = 0; k < keys; ++k)
            count += pairs_by_key(c, i, is_body ? scene_body_key(c->scene, body, k) : i);
    }
    return count;
}

/* Asks about each pair, where there is no memory for more. */
static size_t count_one_by_one(const imp_scene *scene)
{
    size_t count = 0;
    for (size_t a = 0; a < scene_body_count(scene); ++a)
        for (size_t b = a + 1; b < scene_body_count(scene); ++b)
            count += !imp_scene_ignores(scene, a, b);
    return count;
}

size_t imp_scene_pair_count(const imp_scene *scene)
{
    if (scene == NULL) return 0;
    const key_pairs *ignored = scene_ignored(scene);
    size_t bodies = 0, entries = 1, keys = 2 * scene_group_count(scene);
    if (keys < 2 * scene_body_count(scene)) keys = 2 * scene_body_count(scene);
    for (size_t b = 0; b < scene_body_count(scene); ++b) {
        bodies += scene_surface_count(scene, b) > 0;
        entries += scene_body_key_count(scene, b);
    }
    const size_t all = bodies > 0 ? bodies * (bodies - 1) / 2 : 0;
    if (ignored->count == 0) return all;
    size_t *room = calloc(4 * keys + 1 + 2 * ignored->count + 2 * entries, sizeof *room);
    if (room == NULL) return count_one_by_one(scene);
    counting c = {.scene = scene, .ignored = ignored, .keys = keys, .weight = room};
    c.stamp = c.weight + keys;
    c.head = c.stamp + keys;
    c.first = c.head + keys;
    c.partner = c.first + keys + 1;
    c.next = c.partner + 2 * ignored->count;
    c.of = c.next + entries;
    const size_t count = count_ignored(&c);
    free(room);
    return all - count;
}
