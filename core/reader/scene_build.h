/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_BUILD_H
#define CORE_READER_SCENE_BUILD_H

#include <jansson.h>

#include "core/base/place.h"
#include "core/plugin/registry.h"
#include "core/surface/surface.h"

#include <impinge/examine.h>

/* From {"type": ..., parameters} to an instance of that type
 * ==========================================================
 * The one way by which plugins' create is called: parameters are read by the type's table,
 * complaints get their place, and promises that create breaks become IMP_ERROR_PLUGIN. */

typedef struct scene_source {
    const imp_registry *registry;
    const char
        *folder; /* of the scene file, with '/' at its end: where relative names of files begin;
                           NULL: where the process does */
} scene_source;

/* Makes the surface, without maps, or the map that `object` at `at` asks for. The caller holds
 * *made. */
imp_code scene_build_shared(const scene_source *source, imp_type_kind kind, const json_t *object,
                            const place *at, shared_instance **made, imp_error *error);

/* What create noted without failing (imp_note), and what it took. */
typedef struct scene_build_note {
    uint64_t count; /* 0: nothing */
    char text[340]; /* one line, with the parameter's name in front */
    uint64_t bytes; /* of the files that its parameters name, and of its stand-in if isolated */
    fixed_numbers numbers; /* for its formula; the caller frees numbers.number */
} scene_build_note;

/* Makes an instance that is not shared: the type, and what its create made. The caller owns
 * *instance. `note` may be NULL. */
imp_code scene_build_instance(const scene_source *source, imp_type_kind kind, const json_t *object,
                              const place *at, imp_instance *instance, scene_build_note *note,
                              imp_error *error);

#endif
