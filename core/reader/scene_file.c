/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/file_text.h"
#include "core/base/fp_mode.h"
#include "core/base/json_text.h"
#include "core/base/text.h"
#include "core/common/json_size.h"
#include "core/plugin/json_describe.h"
#include "core/plugin/parameters.h"
#include "core/reader/json_keys.h"
#include "core/reader/json_quick.h"
#include "core/reader/pipeline.h"
#include "core/reader/required_plugins.h"
#include "core/reader/scene_file.h"
#include "core/reader/scene_json.h"
#include "core/scene/tolerances.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char *const scene_keys[] = {"time",   "gamma",   "gamma_clear", "define", "bodies",
                                         "ignore", "id",      "reference",   "note",   "gravity",
                                         "events", "plugins", "parameters",  NULL};
static const char *const simulated_keys[] = {"gravity", NULL};

/* --- Settings --------------------------------------------------------------------------------- */

/* Rows like those of a type, so that numbers of the scene are read by the same code. */
static const imp_parameter time_row = {.name = "time",
                                       .kind = IMP_KIND_NUMBER,
                                       .rank = 1,
                                       .extent = {2},
                                       .min = -INFINITY,
                                       .max = INFINITY};
static const imp_parameter gamma_row = {.name = "gamma",
                                        .kind = IMP_KIND_NUMBER,
                                        .flags = IMP_PARAMETER_MIN_OPEN,
                                        .min = 0,
                                        .max = INFINITY};
static const imp_parameter gamma_clear_row = {
    .name = "gamma_clear", .kind = IMP_KIND_NUMBER, .min = 0, .max = INFINITY};

/* Reads the numbers at the row's key into to[], if the key is there. */
static imp_code read_numbers(const scene_bodies *b, const json_t *object, const imp_parameter *row,
                             const place *at, double *to)
{
    const json_t *json = json_object_get(object, row->name);
    if (json == NULL) return IMP_SUCCESS;
    imp_value value;
    imp_code code = parameters_read_value(row, json, at, &value, b->error);
    if (code != IMP_SUCCESS) return code;
    memcpy(to, value.number, value.count * sizeof *to);
    parameters_clear_value(&value);
    return IMP_SUCCESS;
}

static imp_code read_settings(scene_bodies *b, const json_t *root, const place *at)
{
    scene_settings *s = scene_settings_of(b->assembly.scene);
    double time[2] = {s->t_start, s->t_end};
    place at_time = place_key(at, "time"), at_gamma = place_key(at, "gamma");
    place at_gamma_clear = place_key(at, "gamma_clear");
    imp_code code = read_numbers(b, root, &time_row, &at_time, time);
    if (code == IMP_SUCCESS) code = read_numbers(b, root, &gamma_row, &at_gamma, &s->gamma);
    if (code == IMP_SUCCESS)
        code = read_numbers(b, root, &gamma_clear_row, &at_gamma_clear, &s->gamma_clear);
    if (code != IMP_SUCCESS) return code;
    s->t_start = time[0];
    s->t_end = time[1];
    if (time[0] > time[1])
        return place_error(
            &at_time, b->error, IMP_ERROR_SCENE,
            "got the empty interval [%s, %s], must be [start, end] with start <= end",
            text_of_number(time[0]).at, text_of_number(time[1]).at);
    return tolerances_check(s->gamma, s->gamma_clear, at, b->error);
}

/* {"NAME": [lo, hi], ...} */
static imp_code read_parameters(scene_bodies *b, json_t *root, const place *at)
{
    json_t *object = json_object_get(root, "parameters"), *range;
    const place member = place_key(at, "parameters");
    const char *name;
    imp_code code = IMP_SUCCESS;
    if (object == NULL) return IMP_SUCCESS;
    if (!json_is_object(object))
        return place_error(&member, b->error, IMP_ERROR_SCENE,
                           "got %s, must be an object, {\"NAME\": [lo, hi], ...}",
                           json_describe(object).at);
    json_object_foreach(object, name, range)
    {
        double to[2] = {0, 0};
        imp_parameter row = time_row;
        row.name = name;
        const place element = place_key(&member, name);
        code = read_numbers(b, object, &row, &element, to);
        if (code == IMP_SUCCESS) code = scene_bodies_parameter(b, name, to[0], to[1], &element);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

/* --- Scenes ----------------------------------------------------------------------------------- */

static imp_scene *scene_of(const scene_source *source, json_t *root, const place *at,
                           imp_error *error)
{
    scene_bodies b;
    imp_code code = scene_bodies_start(&b, source, error);
    if (code == IMP_SUCCESS)
        code = json_keys_check(root, scene_keys, "a scene, {\"bodies\": [...]}", at, error);
    if (code == IMP_SUCCESS) code = json_keys_refuse(root, simulated_keys, at, error);
    if (code == IMP_SUCCESS) code = required_plugins_check(source->registry, root, at, error);
    if (code == IMP_SUCCESS) code = read_settings(&b, root, at);
    if (code == IMP_SUCCESS) code = read_parameters(&b, root, at);
    if (code == IMP_SUCCESS) code = scene_json_read(&b, root, at);
    if (code == IMP_SUCCESS) return scene_bodies_finish(&b, at);
    scene_bodies_clear(&b);
    return NULL;
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
    if (error != NULL) text_clean(error->text);
}

static bool is_blank(const char *text, size_t length)
{
    while (length > 0 && strchr(" \t\r\n", text[length - 1]) != NULL && text[length - 1]) --length;
    return length == 0;
}

/* `name` is a path, or words without '/': then there is no folder. */
static imp_scene *scene_of_text(const imp_registry *registry, json_t *root, const char *name,
                                reading_budget *budget, imp_error *error)
{
    const char *slash = strrchr(name, '/');
    char *folder = slash != NULL ? strndup(name, (size_t)(slash - name) + 1) : NULL;
    if (slash != NULL && folder == NULL) {
        error_set_memory(error);
        return NULL;
    }
    const scene_source source = {.registry = registry, .folder = folder, .budget = budget};
    const place at = place_document(name);
    imp_scene *scene = scene_of(&source, root, &at, error);
    free(folder);
    return scene;
}

/* A text that is handed to the parser in parts. */
typedef struct parted_text {
    const char *at;
    size_t left;
    reading_budget *budget;
} parted_text;

static size_t next_part(void *to, size_t size, void *context)
{
    parted_text *text = context;
    const size_t n = size < text->left ? size : text->left;
    if (text->budget->limits.bytes > 0)
        reading_budget_take(text->budget, json_size_parsed(text->at, n));
    if (!reading_budget_allows(text->budget, 0)) return (size_t)-1;
    memcpy(to, text->at, n);
    text->at += n;
    text->left -= n;
    return n;
}

static json_t *parse(const char *text, size_t length, const char *name, reading_budget *budget,
                     imp_error *error)
{
    json_error_t fault = {.line = 0};
    json_quick_end end;
    parted_text parts = {text, length, budget};
    reading_budget_take(budget, length);
    json_t *root = json_quick_parse(text, length, budget, &end);
    errno = 0; /* jansson tells a few failed allocations as errors of syntax */
    if (end == JSON_QUICK_LEFT)
        root = json_load_callback(next_part, &parts, PARAMETERS_JSON_FLAGS, &fault);
    if (root != NULL) return root;
    const place at = place_document(name);
    if (reading_budget_is_over(budget))
        reading_budget_refuse(budget, &at, error);
    else if (errno == ENOMEM || end == JSON_QUICK_NO_MEMORY)
        error_set_memory(error);
    else
        refuse_syntax(name, &fault, error);
    return NULL;
}

static json_t *parse_scene(const char *text, size_t length, const char *name,
                           reading_budget *budget, imp_error *error)
{
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) { /* a byte order mark */
        text += 3;
        length -= 3;
    }
    if (!is_blank(text, length)) return parse(text, length, name, budget, error);
    error_set(error, IMP_ERROR_SCENE, "%.400s: is empty, must be a scene, {\"bodies\": [...]}",
              name);
    return NULL;
}

/* Frees `owned`, which may be the text, once it is parsed. */
FP_APART static imp_scene *from_json(imp_registry *registry, const char *text, size_t length,
                                     const char *name, char *owned, imp_error *error)
{
    reading_budget budget = reading_budget_begin(registry);
    json_t *root = parse_scene(text, length, name, &budget, error);
    free(owned);
    if (root == NULL) return NULL;
    imp_scene *scene = scene_of_text(registry, root, name, &budget, error);
    json_decref(root);
    return scene;
}

imp_scene *imp_scene_from_json(imp_registry *registry, const char *text, size_t length,
                               const char *name, imp_error *error)
{
    if (registry == NULL || text == NULL || name == NULL) {
        error_set_missing(error, "imp_scene_from_json");
        return NULL;
    }
    const fp_environment environment = fp_environment_enter();
    imp_scene *scene = from_json(registry, text, length, name, NULL, error);
    fp_environment_leave(&environment);
    return scene;
}

/* Returns the length of a regular file, else 0. */
static uint64_t file_bytes(const char *path)
{
    struct stat file;
    return stat(path, &file) == 0 && S_ISREG(file.st_mode) ? (uint64_t)file.st_size : 0;
}

imp_scene *imp_scene_from_file(imp_registry *registry, const char *path, imp_error *error)
{
    if (registry == NULL || path == NULL) {
        error_set_missing(error, "imp_scene_from_file");
        return NULL;
    }
    char *text;
    size_t length;
    const place at = place_document(path);
    reading_budget budget = reading_budget_begin(registry);
    if (!reading_budget_allows(&budget, file_bytes(path))) {
        reading_budget_refuse(&budget, &at, error);
        return NULL;
    }
    if (file_text_read(path, &text, &length, error) != IMP_SUCCESS) return NULL;
    const fp_environment environment = fp_environment_enter();
    imp_scene *scene = from_json(registry, text, length, path, text, error);
    fp_environment_leave(&environment);
    return scene;
}
