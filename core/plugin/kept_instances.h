/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_KEPT_INSTANCES_H
#define CORE_PLUGIN_KEPT_INSTANCES_H

#include "core/plugin/parameters.h"
#include "core/surface/instance.h"

/* Instances made of files, kept for the next scenes
 * =================================================
 * The lines of a batch name one mesh in each of their scenes; reading it, and making its hierarchy,
 * takes longer than most answers. Here instances stay when their scene is freed, and a later scene
 * finds them by what they were made of: type, values, and which files these name. A file is told by
 * its device, inode, size and times, the time of its last change included, which nobody can set.
 *
 * Several threads may use it at once. None waits for another, nor does a process that was forked
 * while one used it: who finds it in use does without. */

typedef struct kept_instances kept_instances;

/* Limits of what is kept: instances; their bytes (instance_bytes); and for how many look-ups one
 * stays that nobody asks for. */
enum { KEPT_MAX = 256, KEPT_UNUSED_MAX = 1024 };
#define KEPT_BYTES_MAX ((size_t)256 << 20)

kept_instances *kept_instances_new(void); /* NULL: no memory */
void kept_instances_free(kept_instances *k);

/* What an instance is made of. */
typedef struct kept_key {
    unsigned char *bytes; /* NULL: such an instance is not kept */
    size_t size;
    uint64_t hash;
} kept_key;

/* Makes the key, to be cleared, for an instance of that type as `label` describes it, from these
 * values. There is none where no value names a file, where one is no regular file or
 * was changed in the last two seconds, when another change might not show in its times, where
 * values are large, and where there is no memory. */
kept_key kept_key_of(const void *type, const parameter_table *table, const parameter_values *values,
                     const char *label);
void kept_key_clear(kept_key *key);

/* Returns the instance of that key, held for the caller; NULL: none is kept. */
shared_instance *kept_instances_find(kept_instances *k, const kept_key *key);

/* Keeps an instance, and holds it; `key` becomes empty. `now` is the key made again after the
 * instance: if the two differ, a file changed meanwhile, and nothing is kept. */
void kept_instances_add(kept_instances *k, kept_key *key, const kept_key *now,
                        shared_instance *made);

#endif
