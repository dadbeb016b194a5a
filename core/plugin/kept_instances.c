/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/kept_instances.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/base/file_state.h"
#include "core/plugin/value_bytes.h"

/* --- Keys ------------------------------------------------------------------------------------- */

/* Times of files come in steps of up to two seconds, by file system. */
enum { SETTLED_SECONDS = 2 };

/* False: it is no regular file, or changed a moment ago. */
static bool read_state(const char *path, file_state *state)
{
    struct timespec now;
    return clock_gettime(CLOCK_REALTIME, &now) == 0 && file_state_read(path, state) &&
           state->changed_s + SETTLED_SECONDS < (int64_t)now.tv_sec;
}

static bool names_file(const parameter_table *table, const parameter_values *values, size_t k)
{
    return (parameter_table_row(table, k)->flags & IMP_PARAMETER_FILE) != 0 &&
           values->value[k].count > 0;
}

/* FNV-1a. */
static uint64_t hash_of(const unsigned char *bytes, size_t size)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t k = 0; k < size; ++k) hash = (hash ^ bytes[k]) * UINT64_C(0x100000001b3);
    return hash;
}

static unsigned char *put(unsigned char *to, const void *from, size_t size)
{
    memcpy(to, from, size);
    return to + size;
}

/* Writes which values were given, and the state of each file. NULL: a file has none. */
static unsigned char *put_rows(unsigned char *to, const parameter_table *table,
                               const parameter_values *values)
{
    for (size_t k = 0; k < values->count; ++k) {
        file_state state;
        *to++ = values->given[k];
        if (!names_file(table, values, k)) continue;
        if (!read_state(values->value[k].string[0], &state)) return NULL;
        to = put(to, &state, sizeof state);
    }
    return to;
}

kept_key kept_key_of(const void *type, const parameter_table *table, const parameter_values *values,
                     const char *label)
{
    enum { KEY_MAX = 1 << 16 }; /* bytes: with more, comparing takes as long as making */
    size_t files = 0;
    for (size_t k = 0; k < values->count; ++k) files += names_file(table, values, k);
    if (files == 0) return (kept_key){NULL, 0, 0};
    const size_t of_values = value_bytes_size(values->value, values->count);
    const size_t of_label = strlen(label) + 1, of_rows = values->count + files * sizeof(file_state);
    const size_t size = of_values + sizeof type + of_label + of_rows;
    unsigned char *bytes = size <= KEY_MAX ? malloc(size) : NULL;
    if (bytes == NULL) return (kept_key){NULL, 0, 0};
    value_bytes_write(values->value, values->count, bytes);
    unsigned char *end = put(put(bytes + of_values, &type, sizeof type), label, of_label);
    if (put_rows(end, table, values) != NULL) return (kept_key){bytes, size, hash_of(bytes, size)};
    free(bytes);
    return (kept_key){NULL, 0, 0};
}

void kept_key_clear(kept_key *key)
{
    free(key->bytes);
    *key = (kept_key){NULL, 0, 0};
}

static bool is_same(const kept_key *x, const kept_key *y)
{
    return x->hash == y->hash && x->size == y->size && memcmp(x->bytes, y->bytes, x->size) == 0;
}

/* --- The instances ---------------------------------------------------------------------------- */

typedef struct kept_instance {
    kept_key key;
    shared_instance *made; /* held */
    uint64_t asked;        /* the look-up that found it last, or that it was made after */
} kept_instance;

struct kept_instances {
    pthread_mutex_t lock; /* guards all of it */
    uint64_t lookups;
    size_t count, bytes;
    kept_instance at[KEPT_MAX]; /* `count` of them, in no order */
};

kept_instances *kept_instances_new(void)
{
    kept_instances *k = calloc(1, sizeof *k);
    if (k != NULL) pthread_mutex_init(&k->lock, NULL);
    return k;
}

static void release(kept_instance *one)
{
    kept_key_clear(&one->key);
    instance_release(one->made);
}

void kept_instances_free(kept_instances *k)
{
    if (k == NULL) return;
    for (size_t i = 0; i < k->count; ++i) release(&k->at[i]);
    pthread_mutex_destroy(&k->lock);
    free(k);
}

static kept_instance *find(kept_instances *k, const kept_key *key)
{
    for (size_t i = 0; i < k->count; ++i)
        if (is_same(&k->at[i].key, key)) return &k->at[i];
    return NULL;
}

/* Takes out an instance, which the caller releases when the lock is free: destroy is a plugin's. */
static kept_instance take_out(kept_instances *k, size_t i)
{
    const kept_instance one = k->at[i];
    k->bytes -= instance_bytes(one.made);
    k->at[i] = k->at[--k->count];
    return one;
}

static size_t oldest_of(const kept_instances *k)
{
    size_t oldest = 0;
    for (size_t i = 1; i < k->count; ++i)
        if (k->at[i].asked < k->at[oldest].asked) oldest = i;
    return oldest;
}

/* Whether nobody has asked for it for long. */
static bool is_unused(const kept_instances *k, size_t i)
{
    return k->lookups - k->at[i].asked > KEPT_UNUSED_MAX;
}

shared_instance *kept_instances_find(kept_instances *k, const kept_key *key)
{
    kept_instance out = {.made = NULL};
    if (key->bytes == NULL || pthread_mutex_trylock(&k->lock) != 0) return NULL;
    kept_instance *found = find(k, key);
    k->lookups += 1;
    if (found != NULL) found->asked = k->lookups;
    shared_instance *made = found != NULL ? instance_hold(found->made) : NULL;
    const size_t oldest = oldest_of(k);
    if (k->count > 0 && is_unused(k, oldest)) out = take_out(k, oldest);
    pthread_mutex_unlock(&k->lock);
    release(&out);
    return made;
}

static bool is_full(const kept_instances *k, size_t bytes)
{
    return k->count == KEPT_MAX || k->bytes + bytes > KEPT_BYTES_MAX;
}

void kept_instances_add(kept_instances *k, kept_key *key, const kept_key *now,
                        shared_instance *made)
{
    kept_instance out[KEPT_MAX];
    size_t out_count = 0;
    const size_t bytes = instance_bytes(made);
    if (key->bytes == NULL || now->bytes == NULL || !is_same(key, now)) return;
    if (bytes > KEPT_BYTES_MAX || pthread_mutex_trylock(&k->lock) != 0) return;
    if (find(k, key) == NULL) { /* no other thread was faster */
        while (k->count > 0 && is_full(k, bytes)) out[out_count++] = take_out(k, oldest_of(k));
        k->bytes += bytes;
        k->at[k->count++] = (kept_instance){*key, instance_hold(made), k->lookups};
        *key = (kept_key){NULL, 0, 0};
    }
    pthread_mutex_unlock(&k->lock);
    while (out_count > 0) release(&out[--out_count]);
}
