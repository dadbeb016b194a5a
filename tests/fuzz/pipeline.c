/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/reader/pipeline.h"
#include "tests/fuzz/fuzz_mutate.h"
#include "tests/fuzz/fuzz_registry.h"

#include <string.h>

#include <impinge/examine.h>

/* Whatever bytes a pipeline is made of, it becomes a JSON object or is refused with a line of text.
 * The object, written out and read as a scene file, makes a scene where the pipeline does and is
 * refused where it is. One stage becomes the same JSON by the public function. */

const char fuzz_target[] = "pipeline";

FUZZ_MUTATE_TEXT

static void require_error(const imp_error *error, bool failed)
{
    FUZZ_REQUIRE(failed == (error->code != IMP_SUCCESS));
    FUZZ_REQUIRE(!failed || (text_is_line(error->text) && error->text[0] != '\0'));
}

/* A scene of twice that surface, from its JSON. */
static imp_scene *scene_of(imp_registry *registry, json_t *object, imp_error *error)
{
    json_t *root = json_pack("{s:[{s:s,s:[O]},{s:s,s:[O]}]}", "bodies", "name", "a", "surfaces",
                             object, "name", "b", "surfaces", object);
    FUZZ_REQUIRE(root != NULL);
    char *text = json_dumps(root, JSON_COMPACT | JSON_REAL_PRECISION(17) | JSON_ENCODE_ANY);
    FUZZ_REQUIRE(text != NULL);
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "input", error);
    free(text);
    json_decref(root);
    return scene;
}

static void read_surface(imp_registry *registry, const char *line)
{
    imp_error error = {IMP_SUCCESS, ""}, again = {IMP_SUCCESS, ""};
    json_t *object = pipeline_read(registry, "a", line, &error);
    require_error(&error, object == NULL);
    imp_scene *scene = imp_scene_from_pair(registry, line, line, &again);
    require_error(&again, scene == NULL);
    if (object != NULL) {
        FUZZ_REQUIRE(json_is_string(json_object_get(object, "type")));
        FUZZ_REQUIRE(json_is_array(json_object_get(object, "maps")));
        imp_scene *other = scene_of(registry, object, &error);
        require_error(&error, other == NULL);
        FUZZ_REQUIRE((other == NULL) == (scene == NULL));
        imp_scene_free(other);
    } else {
        FUZZ_REQUIRE(scene == NULL);
    }
    imp_scene_free(scene);
    json_decref(object);
}

static void read_stage(imp_registry *registry, imp_type_kind kind, const char *line)
{
    imp_error error = {IMP_SUCCESS, ""};
    json_t *object = pipeline_read_stage(registry, kind, "a", line, &error);
    require_error(&error, object == NULL);
    char *text = imp_stage_to_json(registry, kind, line, &error);
    FUZZ_REQUIRE((text == NULL) == (object == NULL));
    if (text != NULL) {
        json_error_t unused;
        json_t *back = json_loads(text, 0, &unused);
        FUZZ_REQUIRE(back != NULL && json_object_size(back) == json_object_size(object));
        json_decref(back);
    }
    free(text);
    json_decref(object);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    static imp_registry *registry;
    if (registry == NULL) registry = fuzz_registry(true);
    char *line = strndup((const char *)bytes, length);
    if (line == NULL) return 0;
    read_surface(registry, line);
    read_stage(registry, IMP_TYPE_SURFACE, line);
    read_stage(registry, IMP_TYPE_MAP, line);
    free(line);
    return 0;
}
