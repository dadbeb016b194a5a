/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_INSTANCE_TABLE_H
#define CORE_READER_INSTANCE_TABLE_H

#include <jansson.h>

#include "core/surface/instance.h"

/* Instances made so far, by what they were made from
 * ==================================================
 * A scene may write one map many times. Equal descriptions get one instance, so that the solver
 * sees which motions surfaces have in common, and a file that several bodies name is read once.
 * Maps are kept, and surfaces with a text among their values, such as the name of a file; control
 * points are seldom the same twice. */

typedef struct instance_entry {
    uint64_t hash;
    json_t *from;          /* held */
    shared_instance *made; /* held */
} instance_entry;

typedef struct instance_table {
    instance_entry *at; /* open addressing; capacity is a power of two, or 0 */
    size_t count, capacity;
} instance_table; /* begins as {0} */

/* What a description is found by, computed once. */
typedef struct instance_key {
    imp_type_kind kind;
    bool is_kept; /* instances of such descriptions are; else the hash is not set */
    uint64_t hash;
} instance_key;

instance_key instance_key_of(imp_type_kind kind, const json_t *from);

/* Returns the instance that was made from an equal description, or NULL. The table still owns
 * it. */
shared_instance *instance_table_find(const instance_table *t, const instance_key *key,
                                     const json_t *from);

/* Keeps an instance, if it is of a kind that is kept. False: no memory. */
bool instance_table_add(instance_table *t, const instance_key *key, json_t *from,
                        shared_instance *made);

void instance_table_clear(instance_table *t);

#endif
