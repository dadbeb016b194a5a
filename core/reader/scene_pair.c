/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/base/json_text.h"
#include "core/reader/pipeline.h"
#include "core/reader/scene_bodies.h"
#include "core/reader/scene_file.h"

/* Scenes of two bodies that are written as pipelines, TYPE name=value ! MAP name=value. */

static imp_code add_pipeline(scene_bodies *b, const char *name, const char *line)
{
    json_t *object = pipeline_read(b->instances.source.registry, name, line, b->error);
    if (object == NULL) return b->error != NULL ? b->error->code : IMP_ERROR_SCENE;
    const place at = place_argument(NULL, name);
    imp_code code = scene_bodies_begin(b, name, &at);
    if (code == IMP_SUCCESS)
        code = scene_instances_surface(&b->instances, object, &at,
                                       &b->assembly.bodies[b->assembly.count - 1].shapes);
    json_decref(object);
    return code;
}

FP_APART static imp_scene *from_pair(imp_registry *registry, const char *a, const char *b,
                                     imp_error *error)
{
    if (registry == NULL || a == NULL || b == NULL) {
        error_set_missing(error, "imp_scene_from_pair");
        return NULL;
    }
    scene_bodies scene;
    reading_budget budget = reading_budget_begin(registry);
    const scene_source source = {.registry = registry, .budget = &budget};
    imp_code code = scene_bodies_start(&scene, &source, error);
    if (code == IMP_SUCCESS) code = add_pipeline(&scene, "a", a);
    if (code == IMP_SUCCESS) code = add_pipeline(&scene, "b", b);
    const place at = place_argument(NULL, "b");
    if (code == IMP_SUCCESS) return scene_bodies_finish(&scene, &at);
    scene_bodies_clear(&scene);
    return NULL;
}

imp_scene *imp_scene_from_pair(imp_registry *registry, const char *a, const char *b,
                               imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    imp_scene *scene = from_pair(registry, a, b, error);
    fp_environment_leave(&environment);
    return scene;
}

/* {"name": NAME, "surfaces": [the pipeline's]}; NULL on error. */
static json_t *body_of_pipeline(const imp_registry *registry, const char *name, const char *line,
                                imp_error *error)
{
    json_t *only = pipeline_read(registry, name, line, error);
    if (only == NULL) return NULL;
    json_t *body = json_pack("{s:s, s:[o]}", "name", name, "surfaces", only);
    if (body == NULL) error_set_memory(error);
    return body;
}

FP_APART static char *pair_to_json(const imp_registry *registry, const char *a, const char *b,
                                   imp_error *error)
{
    if (registry == NULL || a == NULL || b == NULL) {
        error_set_missing(error, "imp_pair_to_json");
        return NULL;
    }
    json_t *first = body_of_pipeline(registry, "a", a, error);
    json_t *second = first != NULL ? body_of_pipeline(registry, "b", b, error) : NULL;
    if (second == NULL) {
        json_decref(first);
        return NULL;
    }
    json_t *scene = json_pack("{s:[o, o]}", "bodies", first, second);
    char *text = NULL;
    if (scene != NULL)
        text = json_text_of(scene, error);
    else
        error_set_memory(error);
    json_decref(scene);
    return text;
}

char *imp_pair_to_json(const imp_registry *registry, const char *a, const char *b, imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    char *text = pair_to_json(registry, a, b, error);
    fp_environment_leave(&environment);
    return text;
}
