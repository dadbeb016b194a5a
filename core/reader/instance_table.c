/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/instance_table.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/hash.h"
#include "core/base/unconst.h"

/* --- Descriptions ----------------------------------------------------------------------------- */

/* A surface's own maps are no value of its instance. */
static bool is_own(const char *key) { return strcmp(key, "maps") != 0; }

/* FNV-1a, from `hash` on. */
static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t count)
{
    const unsigned char *b = bytes;
    for (size_t k = 0; k < count; ++k) hash = (hash ^ b[k]) * UINT64_C(0x100000001b3);
    return hash;
}

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text, strlen(text));
}

static uint64_t hash_json(uint64_t hash, const json_t *json)
{
    const int type = (int)json_typeof(json);
    size_t i;
    const char *key;
    json_t *item;
    hash = hash_word(hash, (uint64_t)type);
    if (json_is_string(json)) return hash_text(hash, json_string_value(json));
    if (json_is_number(json)) {
        const double value = json_number_value(json);
        uint64_t word;
        memcpy(&word, &value, sizeof word);
        return hash_word(hash, word);
    }
    json_array_foreach(json, i, item) hash = hash_json(hash, item);
    uint64_t members = 0; /* a sum, since their order does not matter */
    json_object_foreach((json_t *)unconst(json), key, item)
    {
        if (is_own(key)) members += hash_json(hash_text(hash, key), item);
    }
    return hash + members;
}

static size_t count_own(const json_t *object)
{
    return json_object_size(object) - (json_object_get(object, "maps") != NULL);
}

static bool are_equal(const json_t *x, const json_t *y)
{
    const char *key;
    json_t *item;
    if (count_own(x) != count_own(y)) return false;
    json_object_foreach((json_t *)unconst(x), key, item)
    {
        if (is_own(key) && !json_equal(item, json_object_get(y, key))) return false;
    }
    return true;
}

static bool has_text(const json_t *from)
{
    const char *key;
    json_t *item;
    json_object_foreach((json_t *)unconst(from), key, item)
    {
        if (json_is_string(item) && strcmp(key, "type") != 0) return true;
    }
    return false;
}

static bool is_kept(imp_type_kind kind, const json_t *from)
{
    return json_is_object(from) && (kind == IMP_TYPE_MAP || has_text(from));
}

/* --- The table -------------------------------------------------------------------------------- */

enum { CAPACITY_FIRST = 16 };

instance_key instance_key_of(imp_type_kind kind, const json_t *from)
{
    instance_key key = {.kind = kind, .is_kept = is_kept(kind, from)};
    if (key.is_kept) key.hash = hash_json(UINT64_C(0xcbf29ce484222325) + (uint64_t)kind, from);
    return key;
}

static imp_type_kind kind_of(const shared_instance *p)
{
    return p->map != NULL ? IMP_TYPE_MAP : IMP_TYPE_SURFACE;
}

/* The entry of an equal description, or the empty one where it belongs. */
static instance_entry *find(const instance_table *t, uint64_t hash, imp_type_kind kind,
                            const json_t *from)
{
    size_t k = (size_t)hash & (t->capacity - 1);
    for (;; k = (k + 1) & (t->capacity - 1)) {
        instance_entry *e = &t->at[k];
        if (e->made == NULL) return e;
        if (e->hash == hash && kind_of(e->made) == kind && are_equal(e->from, from)) return e;
    }
}

shared_instance *instance_table_find(const instance_table *t, const instance_key *key,
                                     const json_t *from)
{
    if (t->count == 0 || !key->is_kept) return NULL;
    return find(t, key->hash, key->kind, from)->made;
}

/* At most half full. */
static bool reserve(instance_table *t)
{
    if (2 * (t->count + 1) <= t->capacity) return true;
    instance_table grown = {.count = t->count,
                            .capacity = t->capacity > 0 ? 2 * t->capacity : CAPACITY_FIRST};
    grown.at = calloc(grown.capacity, sizeof *grown.at);
    if (grown.at == NULL) return false;
    for (size_t k = 0; k < t->capacity; ++k) {
        const instance_entry *e = &t->at[k];
        if (e->made != NULL) *find(&grown, e->hash, kind_of(e->made), e->from) = *e;
    }
    free(t->at);
    *t = grown;
    return true;
}

bool instance_table_add(instance_table *t, const instance_key *key, json_t *from,
                        shared_instance *made)
{
    if (!key->is_kept) return true;
    if (!reserve(t)) return false;
    instance_entry *e = find(t, key->hash, key->kind, from);
    if (e->made != NULL) return true;
    *e = (instance_entry){key->hash, json_incref(from), instance_hold(made)};
    t->count += 1;
    return true;
}

void instance_table_clear(instance_table *t)
{
    for (size_t k = 0; k < t->capacity; ++k)
        if (t->at[k].made != NULL) {
            json_decref(t->at[k].from);
            instance_release(t->at[k].made);
        }
    free(t->at);
    *t = (instance_table){0};
}
