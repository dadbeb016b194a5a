/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_PARTS_H
#define CORE_READER_SCENE_PARTS_H

#include <jansson.h>

#include "core/base/place.h"
#include "core/plugin/registry.h"

/* Maps that stand for several
 * ===========================
 * A type of map may name the maps that stand for it, with clocks of their own
 * (imp_map_type.parts): a rigid displacement within tolerances is up to six maps, of which each
 * follows a parameter that nobody names. The reader puts them in its place. A part whose clock
 * ranges from 0 to 0 is left out. */

/* Whether the type that the object names has parts. */
bool scene_parts_are_named(const imp_registry *registry, const json_t *object);

/* Returns in *list the parts of the map `object` at `at`, as objects of scene files, perhaps none;
 * the caller frees it. Precondition: the type has parts, and the object has been read without an
 * error. */
imp_code scene_parts_list(const imp_registry *registry, const json_t *object, const place *at,
                          json_t **list, imp_error *error);

#endif
