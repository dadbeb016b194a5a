/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "file_text.h"
#include "parameters.h"
#include "pipeline.h"
#include "scene.h"
#include "scene_build.h"
#include "scene_file.h"
#include "text.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct builder {
    const imp_registry *registry;
    imp_scene *scene;
    json_t *names; /* of bodies, to their index: finds doubles without searching */
    imp_error *error;
} builder;

/* --- Keys ---------------------------------------------------------------------------- */

static const char *const scene_keys[] = {"time", "gamma",     "clearance", "bodies", "ignore",
                                         "id",   "reference", "note",      NULL};
static const char *const body_keys[] = {"name", "surfaces", "maps", NULL};

static bool is_one_of(const char *const *keys, const char *key)
{
    while (*keys && strcmp(*keys, key) != 0) ++keys;
    return *keys != NULL;
}

static imp_code refuse_key(const char *const *keys, const place *at, const char *key,
                           imp_error *error)
{
    char all[120] = "";
    text_nearest search = {.wanted = key};
    for (; *keys; ++keys) {
        text_nearest_offer(&search, *keys);
        text_append(all, sizeof all, "%s%s", all[0] ? ", " : "", *keys);
    }
    place member = place_key(at, key);
    if (search.best)
        return place_error(&member, error, IMP_ERROR_SCENE,
                           "found an unknown key, did you mean '%s'? Allowed are %s", search.best,
                           all);
    return place_error(&member, error, IMP_ERROR_SCENE, "found an unknown key, allowed are %s",
                       all);
}

static imp_code check_keys(json_t *object, const char *const *keys, const char *what,
                           const place *at, imp_error *error)
{
    if (!json_is_object(object))
        return place_error(at, error, IMP_ERROR_SCENE, "found %s, allowed %s",
                           json_in_words(object).at, what);
    const char *key;
    json_t *unused;
    json_object_foreach(object, key, unused)
    {
        if (!is_one_of(keys, key)) return refuse_key(keys, at, key, error);
    }
    return IMP_SUCCESS;
}

/* The array at `key`, which may be missing only if it may be empty. */
static imp_code find_array(const json_t *object, const char *key, bool required, const place *at,
                           json_t **array, imp_error *error)
{
    *array = json_object_get(object, key);
    if (!*array && !required) return IMP_SUCCESS;
    if (!*array)
        return place_error(at, error, IMP_ERROR_SCENE, "\"%s\" is missing, allowed an array", key);
    if (json_is_array(*array) && (!required || json_array_size(*array) > 0)) return IMP_SUCCESS;
    place member = place_key(at, key);
    return place_error(&member, error, IMP_ERROR_SCENE, "found %s, allowed an array%s",
                       json_in_words(*array).at, required ? " of at least 1" : "");
}

/* --- Settings ------------------------------------------------------------------------ */

/* Rows like those of a type, so that numbers of the scene are read by the same code. */
static const imp_parameter time_row = {.name = "time",
                                       .kind = IMP_NUMBER,
                                       .rank = 1,
                                       .extent = {2},
                                       .min = -INFINITY,
                                       .max = INFINITY};
static const imp_parameter gamma_row = {
    .name = "gamma", .kind = IMP_NUMBER, .flags = IMP_MIN_OPEN, .min = 0, .max = INFINITY};
static const imp_parameter clearance_row = {
    .name = "clearance", .kind = IMP_NUMBER, .min = 0, .max = INFINITY};

/* Reads the numbers at the row's key into to[], if the key is there. */
static imp_code read_numbers(const builder *b, const json_t *object, const imp_parameter *row,
                             const place *at, double *to)
{
    const json_t *json = json_object_get(object, row->name);
    if (!json) return IMP_SUCCESS;
    imp_value value;
    imp_code code = parameters_read_value(row, json, at, &value, b->error);
    if (code != IMP_SUCCESS) return code;
    memcpy(to, value.number, value.count * sizeof *to);
    parameters_clear_value(&value);
    return IMP_SUCCESS;
}

static imp_code read_settings(builder *b, const json_t *root, const place *at)
{
    scene_settings *s = scene_settings_of(b->scene);
    double time[2] = {s->t_start, s->t_end};
    place at_time = place_key(at, "time"), at_gamma = place_key(at, "gamma");
    place at_clearance = place_key(at, "clearance");
    imp_code code = read_numbers(b, root, &time_row, &at_time, time);
    if (code == IMP_SUCCESS) code = read_numbers(b, root, &gamma_row, &at_gamma, &s->gamma);
    if (code == IMP_SUCCESS)
        code = read_numbers(b, root, &clearance_row, &at_clearance, &s->clearance);
    if (code != IMP_SUCCESS) return code;
    s->t_start = time[0];
    s->t_end = time[1];
    if (time[0] > time[1])
        return place_error(
            &at_time, b->error, IMP_ERROR_SCENE,
            "found the empty interval [%s, %s], allowed [start, end] with start <= end",
            text_of_number(time[0]).at, text_of_number(time[1]).at);
    if (s->clearance >= s->gamma)
        return place_error(&at_clearance, b->error, IMP_ERROR_SCENE,
                           "found %s, allowed in [0, %s), below gamma",
                           text_of_number(s->clearance).at, text_of_number(s->gamma).at);
    return IMP_SUCCESS;
}

/* --- Surfaces ------------------------------------------------------------------------ */

/* In a document a map stands at its index, on a command line at its stage. */
static place place_of_map(const place *maps, size_t index, const json_t *map)
{
    const char *type = json_string_value(json_object_get(map, "type"));
    return maps->argument && type ? place_argument(maps, type) : place_index(maps, index);
}

static imp_code add_maps(const builder *b, json_t *maps, const place *at, surface *s)
{
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < json_array_size(maps) && code == IMP_SUCCESS; ++i) {
        json_t *map = json_array_get(maps, i);
        place element = place_of_map(at, i, map);
        code = scene_build_map(b->registry, map, &element, s, b->error);
    }
    return code;
}

/* body_maps may be NULL. */
static imp_code add_surface(builder *b, const json_t *object, const place *at, json_t *body_maps,
                            const place *body_maps_at)
{
    surface *s = NULL;
    json_t *maps = NULL;
    imp_code code = scene_build_surface(b->registry, object, at, &s, b->error);
    if (code != IMP_SUCCESS) return code;
    place member = at->argument ? *at : place_key(at, "maps");
    code = find_array(object, "maps", false, at, &maps, b->error);
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

/* Adds a body of that name, or of its position's if NULL. */
static imp_code begin_body(builder *b, const char *name, const place *at)
{
    size_t index = imp_scene_body_count(b->scene);
    char preset[40];
    snprintf(preset, sizeof preset, SCENE_FILE_BODY_NAME, index);
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

static imp_code read_name(const builder *b, const json_t *body, const place *at, const char **name)
{
    const json_t *json = json_object_get(body, "name");
    *name = NULL;
    if (!json) return IMP_SUCCESS;
    *name = json_string_value(json);
    if (*name && **name && text_is_line(*name)) return IMP_SUCCESS;
    return place_error(at, b->error, IMP_ERROR_SCENE, "found %s, allowed one line of text",
                       json_in_words(json).at);
}

static imp_code add_body(builder *b, json_t *body, const place *at)
{
    const char *name;
    json_t *surfaces, *maps;
    place at_name = place_key(at, "name"), at_maps = place_key(at, "maps");
    place at_surfaces = place_key(at, "surfaces");
    imp_code code = check_keys(body, body_keys, "a body, {\"surfaces\": [...]}", at, b->error);
    if (code == IMP_SUCCESS) code = read_name(b, body, &at_name, &name);
    if (code == IMP_SUCCESS) code = begin_body(b, name, name ? &at_name : at);
    if (code == IMP_SUCCESS) code = find_array(body, "surfaces", true, at, &surfaces, b->error);
    if (code == IMP_SUCCESS) code = find_array(body, "maps", false, at, &maps, b->error);
    if (code != IMP_SUCCESS) return code;
    for (size_t i = 0; i < json_array_size(surfaces) && code == IMP_SUCCESS; ++i) {
        place element = place_index(&at_surfaces, i);
        code = add_surface(b, json_array_get(surfaces, i), &element, maps, &at_maps);
    }
    return code;
}

static imp_code add_bodies(builder *b, const json_t *root, const place *at)
{
    json_t *bodies;
    place member = place_key(at, "bodies");
    imp_code code = find_array(root, "bodies", true, at, &bodies, b->error);
    if (code != IMP_SUCCESS) return code;
    for (size_t i = 0; i < json_array_size(bodies) && code == IMP_SUCCESS; ++i) {
        place element = place_index(&member, i);
        code = add_body(b, json_array_get(bodies, i), &element);
    }
    return code;
}

/* --- Who ignores whom ---------------------------------------------------------------- */

static imp_code find_body(const builder *b, const json_t *json, const place *at, size_t *index)
{
    const char *name = json_string_value(json);
    const json_t *found = name ? json_object_get(b->names, name) : NULL;
    if (found) {
        *index = (size_t)json_integer_value(found);
        return IMP_SUCCESS;
    }
    text_nearest search = {.wanted = name ? name : ""};
    for (size_t i = 0; i < imp_scene_body_count(b->scene); ++i)
        text_nearest_offer(&search, imp_scene_body_name(b->scene, i));
    if (search.best)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "found %s, which is no body; did you mean '%s'?", json_in_words(json).at,
                           search.best);
    return place_error(at, b->error, IMP_ERROR_SCENE, "found %s, allowed the name of a body",
                       json_in_words(json).at);
}

static imp_code add_ignored_pair(builder *b, const json_t *pair, const place *at)
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

static imp_code add_ignored(builder *b, const json_t *root, const place *at)
{
    json_t *pairs;
    place member = place_key(at, "ignore");
    imp_code code = find_array(root, "ignore", false, at, &pairs, b->error);
    for (size_t i = 0; code == IMP_SUCCESS && i < json_array_size(pairs); ++i) {
        place element = place_index(&member, i);
        code = add_ignored_pair(b, json_array_get(pairs, i), &element);
    }
    return code;
}

/* --- Scenes -------------------------------------------------------------------------- */

static imp_code begin(builder *b, const imp_registry *registry, imp_error *error)
{
    *b = (builder){registry, scene_new(), json_object(), error};
    return b->scene && b->names ? IMP_SUCCESS : error_set_memory(error);
}

/* The scene if all went well, else NULL. */
static imp_scene *finish(builder *b, imp_code code)
{
    json_decref(b->names);
    if (code == IMP_SUCCESS) return b->scene;
    if (b->scene) imp_scene_free(b->scene);
    return NULL;
}

static imp_scene *scene_of(const imp_registry *registry, json_t *root, const place *at,
                           imp_error *error)
{
    builder b;
    imp_code code = begin(&b, registry, error);
    if (code == IMP_SUCCESS)
        code = check_keys(root, scene_keys, "a scene, {\"bodies\": [...]}", at, error);
    if (code == IMP_SUCCESS) code = read_settings(&b, root, at);
    if (code == IMP_SUCCESS) code = add_bodies(&b, root, at);
    if (code == IMP_SUCCESS) code = add_ignored(&b, root, at);
    return finish(&b, code);
}

static void refuse_syntax(const char *name, const json_error_t *fault, imp_error *error)
{
    if (fault->text[0] == '\0')
        error_set_memory(error);
    else if (fault->line < 1)
        error_set(error, IMP_ERROR_SCENE, "%.400s: %s", name, fault->text);
    else
        error_set(error, IMP_ERROR_SCENE, "%.400s:%d:%d: %s", name, fault->line, fault->column,
                  fault->text);
    if (error) text_clean(error->text);
}

static bool is_blank(const char *text, size_t length)
{
    while (length > 0 && strchr(" \t\r\n", text[length - 1]) && text[length - 1]) --length;
    return length == 0;
}

imp_scene *imp_scene_from_json(imp_registry *registry, const char *text, size_t length,
                               const char *name, imp_error *error)
{
    if (!registry || !text || !name) {
        error_set(error, IMP_ERROR_USAGE, "imp_scene_from_json: an argument is NULL");
        return NULL;
    }
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) { /* a byte order mark */
        text += 3;
        length -= 3;
    }
    if (is_blank(text, length)) {
        error_set(error, IMP_ERROR_SCENE, "%.400s: is empty, allowed a scene, {\"bodies\": [...]}",
                  name);
        return NULL;
    }
    json_error_t fault;
    json_t *root = json_loadb(text, length, PARAMETERS_JSON_FLAGS, &fault);
    if (!root) {
        refuse_syntax(name, &fault, error);
        return NULL;
    }
    place at = place_document(name);
    imp_scene *scene = scene_of(registry, root, &at, error);
    json_decref(root);
    return scene;
}

imp_scene *imp_scene_from_file(imp_registry *registry, const char *path, imp_error *error)
{
    if (!registry || !path) {
        error_set(error, IMP_ERROR_USAGE, "imp_scene_from_file: an argument is NULL");
        return NULL;
    }
    char *text;
    size_t length;
    if (file_text_read(path, &text, &length, error) != IMP_SUCCESS) return NULL;
    imp_scene *scene = imp_scene_from_json(registry, text, length, path, error);
    free(text);
    return scene;
}

static imp_code add_pipeline(builder *b, const char *name, const char *line)
{
    json_t *object = pipeline_read(b->registry, name, line, b->error);
    if (!object) return b->error ? b->error->code : IMP_ERROR_SCENE;
    place at = place_argument(NULL, name);
    imp_code code = begin_body(b, name, &at);
    if (code == IMP_SUCCESS) code = add_surface(b, object, &at, NULL, &at);
    json_decref(object);
    return code;
}

imp_scene *imp_scene_from_pair(imp_registry *registry, const char *a, const char *b,
                               imp_error *error)
{
    if (!registry || !a || !b) {
        error_set(error, IMP_ERROR_USAGE, "imp_scene_from_pair: an argument is NULL");
        return NULL;
    }
    builder scene;
    imp_code code = begin(&scene, registry, error);
    if (code == IMP_SUCCESS) code = add_pipeline(&scene, "a", a);
    if (code == IMP_SUCCESS) code = add_pipeline(&scene, "b", b);
    return finish(&scene, code);
}
