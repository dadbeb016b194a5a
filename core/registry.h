/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_REGISTRY_H
#define CORE_REGISTRY_H

#include <impinge/impinge.h>

#include "search_path.h"

/* Types by name
 * =============
 * A registry is filled once, when it is made, and then only read. Surfaces and maps are two
 * name spaces; in each the first type of a name is the one that is found, later ones are
 * shadowed. Plugins stay loaded until imp_registry_free. */

/* As imp_registry_open, from these directories only. NULL: no memory. */
imp_registry *registry_scan(const search_path *path, unsigned flags);

/* NULL: there is none. */
const imp_surface_type *registry_find_surface(const imp_registry *registry, const char *name);
const imp_map_type *registry_find_map(const imp_registry *registry, const char *name);

/* Path of the plugin the type of that name comes from; NULL: there is none. */
const char *registry_find_file(const imp_registry *registry, imp_type_sort sort, const char *name);

/* Whether instances of that type are to live in a process of their own. */
bool registry_isolates(const imp_registry *registry, const char *name);

/* The name of that sort nearest to `name`; NULL: none is near. */
const char *registry_nearest(const imp_registry *registry, imp_type_sort sort, const char *name);

#endif
