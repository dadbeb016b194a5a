/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_BUILD_H
#define CORE_READER_SCENE_BUILD_H

#include <jansson.h>

#include "core/base/named_files.h"
#include "core/base/place.h"
#include "core/plugin/isolate.h"
#include "core/plugin/parameters.h"
#include "core/plugin/registry.h"
#include "core/plugin/type_view.h"
#include "core/reader/reading_budget.h"
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
    reading_budget *budget; /* NULL: no limits */
    named_files *files;     /* takes the files that values name; NULL: nobody */
    imp_scene *scene;       /* instances that it is rid of are refilled; NULL: all are new */
} scene_source;

/* Makes the surface, without maps, or the map that `object` at `at` asks for, or finds one that the
 * registry keeps. The caller holds *made. */
imp_code scene_build_shared(const scene_source *source, imp_type_kind kind, const json_t *object,
                            const place *at, shared_instance **made, imp_error *error);

/* A type, by its name. */
typedef struct type_choice {
    imp_type_kind kind;
    const char *name;
    const shared_instance *like; /* an instance of it, made by the same registry; NULL: none */
} type_choice;

/* Makes the surface, without maps, or the map that a type and typed arguments ask for, without the
 * object that a scene file would have: the same instance, from the same numbers. *made NULL: it
 * makes none, because an argument is not numbers, or not as the type's table says; then the object
 * has to be made, which tells what is wrong. */
imp_code scene_build_numbers(const scene_source *source, const type_choice *type,
                             const imp_argument *arguments, size_t count, const place *at,
                             shared_instance **made, imp_error *error);

/* Makes an instance that is not shared: the type, and what its create made. The caller owns
 * *instance. */
imp_code scene_build_instance(const scene_source *source, imp_type_kind kind, const json_t *object,
                              const place *at, imp_instance *instance, imp_error *error);

/* --- In two steps ----------------------------------------------------------------------------- */

/* What create is called with. */
typedef struct scene_making {
    imp_instance instance; /* its `self` is NULL until create has made it */
    type_view view;
    isolated *stand_in;         /* NULL: it is not isolated */
    const scene_source *source; /* outlives it */
    reading_budget *budget;     /* NULL: no limits */
    parameter_values values;
    shared_instance *again; /* an instance to be refilled, held; NULL: create makes one */
} scene_making;

/* What create noted without failing (imp_note), and what it took. */
typedef struct scene_build_note {
    uint64_t count; /* 0: nothing */
    char text[340]; /* one line, with the parameter's name in front */
    uint64_t bytes; /* of the files that its parameters name, and of its stand-in if isolated */
    fixed_numbers numbers; /* for its formula; the caller frees numbers.number */
    bool is_repeatable;    /* equal values and files make an equal instance (imp_repeatable) */
} scene_build_note;

/* Finds the type and reads the values. Clear it unless it fails; it points into `object`. */
imp_code scene_making_begin(scene_making *m, const scene_source *source, imp_type_kind kind,
                            const json_t *object, const place *at, imp_error *error);

/* Finds the type and reads the values, which are numbers, from typed arguments.
 * m->values.value NULL: they do not fit (parameter_numbers_read); then, and if it fails, there is
 * nothing to clear. */
imp_code scene_making_begin_numbers(scene_making *m, const scene_source *source,
                                    const type_choice *type, const imp_argument *arguments,
                                    size_t count, const place *at, imp_error *error);

/* Returns the file of the plugin that the type comes from. */
const char *scene_making_file(const scene_making *m);

/* Refills m->again or, if it is NULL or does not take these values, calls create, and m->again is
 * NULL; the caller then owns m->instance. `note` may be NULL. */
imp_code scene_making_create(scene_making *m, const place *at, scene_build_note *note,
                             imp_error *error);
void scene_making_clear(scene_making *m);

#endif
