/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_KEY_PAIRS_H
#define CORE_SCENE_KEY_PAIRS_H

#include <stdbool.h>
#include <stddef.h>

/* A set of unordered pairs of numbers, kept in order */

typedef struct key_pair {
    size_t key[2]; /* the smaller first */
} key_pair;

typedef struct key_pairs {
    key_pair *at;
    size_t count, capacity;
} key_pairs;

bool key_pairs_add(key_pairs *pairs, size_t x, size_t y); /* false: no memory */
bool key_pairs_have(const key_pairs *pairs, size_t x, size_t y);
void key_pairs_clear(key_pairs *pairs);

#endif
