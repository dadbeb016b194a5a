/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_REGISTRY_H
#define CORE_PLUGIN_REGISTRY_H

#include <impinge/impinge.h>

#include "core/base/arena_store.h"
#include "core/common/search_path.h"
#include "core/plugin/reading_limits.h"
#include "core/plugin/worker_pool.h"

/* Types by name
 * =============
 * A registry is filled when it is made, and by imp_registry_add; else it is only read. Surfaces and
 * maps are two name spaces; in each the first type of a name is the one that is found, later ones
 * are shadowed. Plugins stay loaded until imp_registry_free. */

/* Makes a registry as imp_registry_open does, from these directories only. NULL: no memory. */
imp_registry *registry_scan(const search_path *path, unsigned flags);

/* Returns the memory that scenes made by the registry share; it lives as long as that. */
arena_store *registry_store(const imp_registry *registry);

/* Returns the instances that are kept for the next scenes of the same files (kept_instances.h). */
struct kept_instances;
struct kept_instances *registry_kept(const imp_registry *registry);

/* Returns the limits of imp_registry_limit_reading. */
reading_limits registry_reading_limits(const imp_registry *registry);

/* Find a type by its name. NULL: not found. */
const imp_surface_type *registry_find_surface(const imp_registry *registry, const char *name);
const imp_map_type *registry_find_map(const imp_registry *registry, const char *name);

/* Path of the plugin that the type of that name comes from, or IMP_LINKED_IN; NULL: unknown
 * type. */
const char *registry_find_file(const imp_registry *registry, imp_type_kind kind, const char *name);

/* Returns the pool in which instances of that type are isolated; NULL: they are not. */
worker_pool *registry_isolation(const imp_registry *registry, const char *name);

/* Whether any type is, or was, to be isolated: then instances may be of stand-ins' types. */
bool registry_has_isolated(const imp_registry *registry);

/* Why a name may be unknown: "; 2 files were left out, such as '/a/b.so': <reason>", or "" if none
 * was. A file called NAME.so comes first. */
typedef struct registry_text {
    char text[700];
} registry_text;
registry_text registry_left_out(const imp_registry *registry, const char *name);

/* The name of that kind nearest to `name`; NULL: none is near. */
const char *registry_nearest(const imp_registry *registry, imp_type_kind kind, const char *name);

#endif
