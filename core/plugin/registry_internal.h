/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_REGISTRY_INTERNAL_H
#define CORE_PLUGIN_REGISTRY_INTERNAL_H

#include "core/plugin/plugin_file.h"
#include "core/plugin/registry.h"
#include "core/plugin/type_view.h"

/* The inside of a registry
 * ========================
 * For its two files: registry_scan.c fills it; registry.c finds what is there. */

typedef struct loaded_plugin {
    char *path; /* absolute; IMP_LINKED_IN */
    plugin_file file;
} loaded_plugin;

/* A file that was examined, accepted or not: when reached again it is ignored. */
typedef struct file_identity {
    uint64_t device, inode;
} file_identity;

typedef struct found_type {
    imp_type_kind kind;
    type_view view;
    const void *type;                 /* imp_surface_type or imp_map_type */
    const loaded_plugin *from;        /* who offers it */
    const loaded_plugin *shadowed_by; /* NULL: it is the one found */
    char capabilities[64];            /* as in imp_type_info */
} found_type;

/* A file or directory and what is to be said of it. */
typedef struct remark {
    char *file, *text;
} remark;

typedef struct remarks {
    remark *all;
    size_t count, capacity;
} remarks;

struct imp_registry {
    loaded_plugin **plugin; /* each on its own, since types point to them */
    size_t plugin_count, plugin_capacity;
    file_identity *seen;
    size_t seen_count, seen_capacity;
    found_type *type;
    size_t type_count, type_capacity;
    remarks refusals, warnings;
    load_cache *cache; /* while scanning */
    bool secure;
    char *isolated; /* names between commas, ",a,b,"; "" for all; NULL for none */
    arena_store *store;
    struct kept_instances *kept;
    reading_limits reading;
    worker_pool *workers; /* where isolated types run; NULL: none was isolated yet */
};

/* The first type of that kind and name; NULL: not found. */
const found_type *registry_find(const imp_registry *r, imp_type_kind kind, const char *name);

#endif
