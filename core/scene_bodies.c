/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "json_keys.h"
#include "json_words.h"
#include "scene_bodies.h"
#include "scene_build.h"
#include "text.h"

#include <stdio.h>

static const char *const body_keys[] = {"name", "surfaces", "maps", NULL};

/* --- Surfaces ------------------------------------------------------------------------ */

/* In a document a map stands at its index, on a command line at its stage. */
static place place_of_map(const place *maps, size_t index, const json_t *map)
{
    const char *type = json_string_value(json_object_get(map, "type"));
    return maps->argument && type ? place_argument(maps, type) : place_index(maps, index);
}

static imp_code add_maps(const scene_bodies *b, json_t *maps, const place *at, surface *s)
{
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < json_array_size(maps) && code == IMP_SUCCESS; ++i) {
        json_t *map = json_array_get(maps, i);
        place element = place_of_map(at, i, map);
        code = scene_build_map(b->registry, map, &element, s, b->error);
    }
    return code;
}

imp_code scene_bodies_add_surface(scene_bodies *b, const json_t *object, const place *at,
                                  json_t *body_maps, const place *body_maps_at)
{
    surface *s = NULL;
    json_t *maps = NULL;
    imp_code code = scene_build_surface(b->registry, object, at, &s, b->error);
    if (code != IMP_SUCCESS) return code;
    place member = at->argument ? *at : place_key(at, "maps");
    code = json_keys_array(object, "maps", false, at, &maps, b->error);
    if (code == IMP_SUCCESS) code = add_maps(b, maps, &member, s);
    if (code == IMP_SUCCESS) code = add_maps(b, body_maps, body_maps_at, s);
    if (code != IMP_SUCCESS) {
        surface_free(s);
        return code;
    }
    code = scene_add_surface(b->scene, s);
    return code == IMP_SUCCESS ? code : error_set_memory(b->error);
}

/* --- Bodies -------------------------------------------------------------------------- */

imp_code scene_bodies_begin(scene_bodies *b, const char *name, const place *at)
{
    size_t index = imp_scene_body_count(b->scene);
    char preset[40];
    snprintf(preset, sizeof preset, "body%zu", index);
    if (!name) name = preset;
    const json_t *earlier = json_object_get(b->names, name);
    if (earlier)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "found the name '%.80s', which body %lld has; allowed are unique names",
                           name, (long long)json_integer_value(earlier));
    if (json_object_set_new(b->names, name, json_integer((json_int_t)index)) != 0 ||
        scene_add_body(b->scene, name) != IMP_SUCCESS)
        return error_set_memory(b->error);
    return IMP_SUCCESS;
}

static imp_code read_name(const scene_bodies *b, const json_t *body, const place *at,
                          const char **name)
{
    const json_t *json = json_object_get(body, "name");
    *name = NULL;
    if (!json) return IMP_SUCCESS;
    *name = json_string_value(json);
    if (*name && **name && text_is_line(*name)) return IMP_SUCCESS;
    return place_error(at, b->error, IMP_ERROR_SCENE, "found %s, allowed one line of text",
                       json_in_words(json).at);
}

static imp_code add_body(scene_bodies *b, json_t *body, const place *at)
{
    const char *name;
    json_t *surfaces, *maps;
    place at_name = place_key(at, "name"), at_maps = place_key(at, "maps");
    place at_surfaces = place_key(at, "surfaces");
    imp_code code = json_keys_check(body, body_keys, "a body, {\"surfaces\": [...]}", at, b->error);
    if (code == IMP_SUCCESS) code = read_name(b, body, &at_name, &name);
    if (code == IMP_SUCCESS) code = scene_bodies_begin(b, name, name ? &at_name : at);
    if (code == IMP_SUCCESS)
        code = json_keys_array(body, "surfaces", true, at, &surfaces, b->error);
    if (code == IMP_SUCCESS) code = json_keys_array(body, "maps", false, at, &maps, b->error);
    if (code != IMP_SUCCESS) return code;
    for (size_t i = 0; i < json_array_size(surfaces) && code == IMP_SUCCESS; ++i) {
        place element = place_index(&at_surfaces, i);
        code = scene_bodies_add_surface(b, json_array_get(surfaces, i), &element, maps, &at_maps);
    }
    return code;
}

imp_code scene_bodies_add_all(scene_bodies *b, const json_t *root, const place *at)
{
    json_t *bodies;
    place member = place_key(at, "bodies");
    imp_code code = json_keys_array(root, "bodies", true, at, &bodies, b->error);
    if (code != IMP_SUCCESS) return code;
    for (size_t i = 0; i < json_array_size(bodies) && code == IMP_SUCCESS; ++i) {
        place element = place_index(&member, i);
        code = add_body(b, json_array_get(bodies, i), &element);
    }
    return code;
}

/* --- Who ignores whom ---------------------------------------------------------------- */

static imp_code find_body(const scene_bodies *b, const json_t *json, const place *at, size_t *index)
{
    const char *name = json_string_value(json);
    const json_t *found = name ? json_object_get(b->names, name) : NULL;
    if (found) {
        *index = (size_t)json_integer_value(found);
        return IMP_SUCCESS;
    }
    imp_nearest search = {.wanted = name ? name : ""};
    for (size_t i = 0; i < imp_scene_body_count(b->scene); ++i)
        imp_nearest_offer(&search, imp_scene_body_name(b->scene, i));
    if (search.best)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "found %s, which is no body; did you mean '%s'?", json_in_words(json).at,
                           search.best);
    return place_error(at, b->error, IMP_ERROR_SCENE, "found %s, allowed the name of a body",
                       json_in_words(json).at);
}

static imp_code add_ignored_pair(scene_bodies *b, const json_t *pair, const place *at)
{
    if (!json_is_array(pair) || json_array_size(pair) != 2)
        return place_error(at, b->error, IMP_ERROR_SCENE, "found %s, allowed two names of bodies",
                           json_in_words(pair).at);
    size_t index[2];
    for (size_t i = 0; i < 2; ++i) {
        place element = place_index(at, i);
        imp_code code = find_body(b, json_array_get(pair, i), &element, &index[i]);
        if (code != IMP_SUCCESS) return code;
    }
    if (index[0] == index[1])
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "found the same body twice, allowed two bodies; surfaces of one body "
                           "are never tested with each other");
    imp_code code = scene_ignore(b->scene, index[0], index[1]);
    return code == IMP_SUCCESS ? code : error_set_memory(b->error);
}

imp_code scene_bodies_ignore(scene_bodies *b, const json_t *root, const place *at)
{
    json_t *pairs;
    place member = place_key(at, "ignore");
    imp_code code = json_keys_array(root, "ignore", false, at, &pairs, b->error);
    for (size_t i = 0; code == IMP_SUCCESS && i < json_array_size(pairs); ++i) {
        place element = place_index(&member, i);
        code = add_ignored_pair(b, json_array_get(pairs, i), &element);
    }
    return code;
}
