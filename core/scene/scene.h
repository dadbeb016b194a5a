/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_H
#define CORE_SCENE_SCENE_H

#include "core/base/arena_store.h"
#include "core/base/named_files.h"
#include "core/scene/key_pairs.h"
#include "core/scene/scene_parameters.h"
#include "core/surface/surface.h"

/* Bodies and their surfaces, the groups they are in, and who ignores whom. Built by assembly, read
 * by the solver. */

imp_scene *scene_new(void); /* NULL: no memory. Free with imp_scene_free. */

/* `name` is copied. Its index is the count before. */
imp_code scene_add_body(imp_scene *scene, const char *name);

/* Whether being inside the body counts as contact; false at first. body < scene_body_count. */
void scene_set_solid(imp_scene *scene, size_t body, bool solid);
bool scene_is_solid(const imp_scene *scene, size_t body);
bool scene_has_solids(const imp_scene *scene); /* whether any body is */

/* Sets where its trees take memory from and give it to; it must outlive the scene. At first, and if
 * NULL, that is the heap. */
void scene_set_store(imp_scene *scene, arena_store *store);
arena_store *scene_store(const imp_scene *scene);

/* Sets the registry that its instances are made by, which must outlive the scene; NULL at first,
 * and in scenes whose values are not changed. */
void scene_set_registry(imp_scene *scene, const imp_registry *registry);
const imp_registry *scene_registry(const imp_scene *scene);

/* The files that the values of its instances name, some of them more than once; those of values
 * that were changed since (imp_scene_set_values), too. */
named_files *scene_files_of(imp_scene *scene);
const named_files *scene_files_named(const imp_scene *scene);

/* Makes room for what scene_set_maps notes. IMP_ERROR_MEMORY, or IMP_SUCCESS. */
imp_code scene_add_layout(imp_scene *scene);

/* Notes which maps at the end of each surface of a body are the body's own, and whose maps come
 * after them; SIZE_MAX: nobody's. Takes over the list. */
void scene_set_maps(imp_scene *scene, size_t body, instance_list *maps, size_t parent);

/* Count the queries and surveys of a scene, which is not changed while there are any, and freed
 * with the last of them if its owner was faster. [any thread] */
void scene_begin_use(imp_scene *scene);
void scene_end_use(imp_scene *scene);

/* Takes over `s`, also when it fails. */
imp_code scene_add_surface(imp_scene *scene, size_t body, surface *s);

/* Adds a group: a common name of bodies, which is copied. Its index is the count of groups before;
 * the name beyond the last is NULL. */
imp_code scene_add_group(imp_scene *scene, const char *name);
size_t scene_group_count(const imp_scene *scene);
const char *scene_group_name(const imp_scene *scene, size_t group);
imp_code scene_join(imp_scene *scene, size_t body, size_t group);

/* A body, or every body of a group. */
typedef struct scene_members {
    bool is_group;
    size_t index;
} scene_members;

/* No body of x is ever tested with one of y; x and y may be the same group. */
imp_code scene_ignore_members(imp_scene *scene, scene_members x, scene_members y);
bool scene_ignores(const imp_scene *scene, size_t a, size_t b);

/* The keys that name a body, its own first, then those of its groups, and the pairs of keys that
 * ignore each other. Keys are below twice the number of bodies or of groups. */
size_t scene_body_key_count(const imp_scene *scene, size_t body);
size_t scene_body_key(const imp_scene *scene, size_t body, size_t k);
bool scene_key_is_of_body(size_t key); /* the body key / 2; else it is of the group key / 2 */
const key_pairs *scene_ignored(const imp_scene *scene);

/* Whether imp_scene_pair_count should be asked before the pairs are looked at one by one: there are
 * many bodies, and some ignore each other. */
bool scene_counts_pairs(const imp_scene *scene);

/* Answer what imp_scene_body_count and imp_scene_surface_count do; body < scene_body_count. */
size_t scene_body_count(const imp_scene *scene);
size_t scene_surface_count(const imp_scene *scene, size_t body);

/* NULL: there is none. */
const surface *scene_surface(const imp_scene *scene, size_t body, size_t index);
const surface *scene_piece(const imp_scene *scene, imp_place at);

/* Estimates the bytes that its bodies and surfaces hold, without their trees. */
uint64_t scene_bytes(const imp_scene *scene);

/* Completes a scene once everything is added: notes what each query asks for, which is its bytes
 * and the times at which all of it is defined, and what types remarked. IMP_ERROR_MEMORY, or
 * IMP_SUCCESS. */
imp_code scene_complete(imp_scene *scene);

/* Whether all types and maps are known to be defined from t_start to t_end. */
bool scene_is_defined(const imp_scene *scene, double t_start, double t_end);

/* Sets what the scene file asks for, which imp_options_default answers. Preset: NAN, NAN, 1e-6, -1.
 * Times that nobody has set are chosen by scene_complete (default_times), and stay NAN where there
 * are none. */
typedef struct scene_settings {
    double t_start, t_end, gamma, gamma_clear;
} scene_settings;
scene_settings *scene_settings_of(imp_scene *scene);
const scene_settings *scene_settings_read(const imp_scene *scene);

/* The parameters of the scene, none at first. */
scene_parameters *scene_parameters_of(imp_scene *scene);
const scene_parameters *scene_parameters_read(const imp_scene *scene);

/* IMP_ERROR_USAGE if the scene has parameters, which `asker` does not handle. */
imp_code scene_refuse_parameters(const imp_scene *scene, const char *asker, imp_error *error);

/* Gives the bodies of `to`, which are those of `from` in the same order, their groups, and copies
 * who ignores whom. */
imp_code scene_copy_relations(const imp_scene *from, imp_scene *to);

/* What imp_options_default answers. */
void scene_options(const imp_scene *scene, imp_options *options);

/* Checks times and max_seconds. IMP_ERROR_SCENE, and why: both times are NAN because the scene has
 * no times to examine. */
imp_code scene_check_options(const imp_scene *scene, const imp_options *options, imp_error *error);

/* Bytes of imp_options in the first release. */
#define SCENE_OPTIONS_FIRST sizeof(imp_options)

#endif
