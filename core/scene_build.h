/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_BUILD_H
#define CORE_SCENE_BUILD_H

#include <jansson.h>

#include "place.h"
#include "registry.h"
#include "surface.h"

/* From {"type": ..., parameters} to an instance of that type
 * ==========================================================
 * The one way by which plugins' create is called: parameters are read by the type's table,
 * complaints get their place, and promises that create breaks become IMP_ERROR_PLUGIN. */

/* The surface that `object` at `at` asks for, without maps. The caller owns *s. */
imp_code scene_build_surface(const imp_registry *registry, const json_t *object, const place *at,
                             surface **s, imp_error *error);

/* Puts the map that `object` at `at` asks for on top of those `s` is under. On failure s may
 * only be freed. */
imp_code scene_build_map(const imp_registry *registry, const json_t *object, const place *at,
                         surface *s, imp_error *error);

/* What both of them begin with: the type and what its create made. The caller owns *instance. */
imp_code scene_build_instance(const imp_registry *registry, imp_type_sort sort,
                              const json_t *object, const place *at, imp_instance *instance,
                              imp_error *error);

#endif
