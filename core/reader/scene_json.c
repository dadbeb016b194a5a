/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/scene_json.h"

#include "core/plugin/json_describe.h"
#include "core/reader/json_keys.h"

/* What bodies are made of is for simulations; here it is ignored. */
static const char *const body_keys[] = {"name",        "surfaces", "maps",    "parent", "group",
                                        "solid",       "mass",     "inertia", "center", "friction",
                                        "restitution", "velocity", "spin",    NULL};

/* A motion that is still to be computed is refused: an answer without it would be about another
 * scene. */
static const char *const simulated_keys[] = {"velocity", "spin", NULL};

/* --- Names ------------------------------------------------------------------------------------ */

/* The string at `at`; `allowed` says what it is for. */
static imp_code read_name(const scene_bodies *b, const json_t *json, const char *allowed,
                          const place *at, const char **name)
{
    *name = json_string_value(json);
    if (*name != NULL) return IMP_SUCCESS;
    return place_error(at, b->error, IMP_ERROR_SCENE, "got %s, must be %s", json_describe(json).at,
                       allowed);
}

/* --- One body --------------------------------------------------------------------------------- */

static imp_code begin(scene_bodies *b, const json_t *body, const place *at)
{
    const json_t *json = json_object_get(body, "name");
    if (json == NULL) return scene_bodies_begin(b, NULL, at);
    const char *name;
    const place member = place_key(at, "name");
    const imp_code code = read_name(b, json, "one line of text", &member, &name);
    return code == IMP_SUCCESS ? scene_bodies_begin(b, name, &member) : code;
}

static imp_code join(scene_bodies *b, size_t body, const json_t *json, const place *at)
{
    const char *name;
    const imp_code code = read_name(b, json, "the name of a group", at, &name);
    return code == IMP_SUCCESS ? scene_bodies_join(b, body, name, at) : code;
}

/* One name, or an array of them. */
static imp_code read_groups(scene_bodies *b, size_t index, const json_t *body, const place *at)
{
    const json_t *json = json_object_get(body, "group");
    const place member = place_key(at, "group");
    if (json == NULL) return IMP_SUCCESS;
    if (!json_is_array(json)) return join(b, index, json, &member);
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < json_array_size(json) && code == IMP_SUCCESS; ++i) {
        const place element = place_index(&member, i);
        code = join(b, index, json_array_get(json, i), &element);
    }
    return code;
}

static imp_code read_solid(scene_bodies *b, size_t index, const json_t *body, const place *at)
{
    const json_t *json = json_object_get(body, "solid");
    const place member = place_key(at, "solid");
    if (json == NULL) return IMP_SUCCESS;
    if (!json_is_boolean(json))
        return place_error(&member, b->error, IMP_ERROR_SCENE, "got %s, must be true or false",
                           json_describe(json).at);
    scene_set_solid(b->assembly.scene, index, json_is_true(json));
    return IMP_SUCCESS;
}

static imp_code add_body(scene_bodies *b, json_t *body, const place *at)
{
    json_t *surfaces, *maps;
    const size_t index = b->assembly.count;
    const place at_surfaces = place_key(at, "surfaces"), at_maps = place_key(at, "maps");
    imp_code code = json_keys_check(body, body_keys, "a body, {\"surfaces\": [...]}", at, b->error);
    if (code == IMP_SUCCESS) code = json_keys_refuse(body, simulated_keys, at, b->error);
    if (code == IMP_SUCCESS) code = begin(b, body, at);
    if (code == IMP_SUCCESS) code = read_groups(b, index, body, at);
    if (code == IMP_SUCCESS) code = read_solid(b, index, body, at);
    if (code == IMP_SUCCESS)
        code = json_keys_array(body, "surfaces", false, at, &surfaces, b->error);
    if (code == IMP_SUCCESS) code = json_keys_array(body, "maps", false, at, &maps, b->error);
    if (code != IMP_SUCCESS) return code;
    reading_budget *budget = b->instances.source.budget;
    if (!reading_budget_allows(budget, 0)) return reading_budget_refuse(budget, at, b->error);
    assembly_body *made = &b->assembly.bodies[index];
    code = scene_instances_surfaces(&b->instances, surfaces, &at_surfaces, &made->shapes);
    if (code == IMP_SUCCESS)
        code = scene_instances_maps(&b->instances, maps, &at_maps, &made->maps);
    return code;
}

/* --- Parents, when all bodies have their names ------------------------------------------------ */

static imp_code set_parents(scene_bodies *b, const json_t *bodies, const place *at)
{
    for (size_t i = 0; i < json_array_size(bodies); ++i) {
        const json_t *json = json_object_get(json_array_get(bodies, i), "parent");
        const place element = place_index(at, i), member = place_key(&element, "parent");
        const char *name;
        if (json == NULL) continue;
        imp_code code = read_name(b, json, "the name of a body", &member, &name);
        if (code == IMP_SUCCESS) code = scene_bodies_set_parent(b, i, name, &member);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

static imp_code check_parents(const scene_bodies *b, const place *at)
{
    size_t body = 0;
    switch (assembly_find_cycle(&b->assembly, &body)) {
    case ASSEMBLY_NO_CYCLE:
        return IMP_SUCCESS;
    case ASSEMBLY_NO_MEMORY:
        return error_set_memory(b->error);
    case ASSEMBLY_CYCLE:
        break;
    }
    const place element = place_index(at, body), member = place_key(&element, "parent");
    return scene_bodies_refuse_cycle(b, body, &member);
}

/* Frees what is not asked for again, so that the values of all bodies, which take more than the
 * bodies, are not held beside these: of a body that was added only its parent is left to read. */
static void drop_body(json_t *bodies, size_t i)
{
    json_t *body = json_array_get(bodies, i);
    if (json_object_get(body, "parent") == NULL) {
        json_array_set_new(bodies, i, json_null());
        return;
    }
    json_object_del(body, "surfaces");
    json_object_del(body, "maps");
}

static imp_code add_bodies(scene_bodies *b, const json_t *root, const place *at)
{
    json_t *bodies;
    const place member = place_key(at, "bodies");
    imp_code code = json_keys_array(root, "bodies", true, at, &bodies, b->error);
    if (code != IMP_SUCCESS) return code;
    for (size_t i = 0; i < json_array_size(bodies) && code == IMP_SUCCESS; ++i) {
        const place element = place_index(&member, i);
        code = add_body(b, json_array_get(bodies, i), &element);
        if (code == IMP_SUCCESS) drop_body(bodies, i);
    }
    if (code == IMP_SUCCESS) code = set_parents(b, bodies, &member);
    if (code == IMP_SUCCESS) code = check_parents(b, &member);
    return code;
}

/* --- Who ignores whom ------------------------------------------------------------------------- */

static imp_code ignore_pair(scene_bodies *b, const json_t *pair, const place *at)
{
    if (!json_is_array(pair) || json_array_size(pair) != 2)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "got %s, must be two names of bodies or groups", json_describe(pair).at);
    const char *name[2];
    const place element[2] = {place_index(at, 0), place_index(at, 1)};
    for (size_t i = 0; i < 2; ++i) {
        const imp_code code = read_name(b, json_array_get(pair, i), "the name of a body or group",
                                        &element[i], &name[i]);
        if (code != IMP_SUCCESS) return code;
    }
    return scene_bodies_ignore(b, name[0], &element[0], name[1], &element[1]);
}

static imp_code ignore_pairs(scene_bodies *b, const json_t *root, const place *at)
{
    json_t *pairs;
    const place member = place_key(at, "ignore");
    reading_budget *budget = b->instances.source.budget;
    imp_code code = json_keys_array(root, "ignore", false, at, &pairs, b->error);
    for (size_t i = 0; code == IMP_SUCCESS && i < json_array_size(pairs); ++i) {
        const place element = place_index(&member, i);
        code = ignore_pair(b, json_array_get(pairs, i), &element);
        if (code == IMP_SUCCESS && !reading_budget_allows(budget, 0))
            code = reading_budget_refuse(budget, &element, b->error);
    }
    return code;
}

imp_code scene_json_read(scene_bodies *b, json_t *root, const place *at)
{
    imp_code code = scene_instances_begin(&b->instances, root, at);
    if (code == IMP_SUCCESS) code = add_bodies(b, root, at);
    if (code == IMP_SUCCESS) code = scene_instances_finish(&b->instances);
    if (code == IMP_SUCCESS) code = ignore_pairs(b, root, at);
    return code;
}
