/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/examine.h>

#include "core/base/fp_mode.h"
#include "core/base/json_text.h"
#include "core/reader/pipeline.h"
#include "core/reader/scene_build.h"

/* Types one by one, for those who examine them. */

FP_APART static imp_code from_text(imp_registry *registry, imp_type_kind kind, const char *text,
                                   imp_instance *instance, imp_error *error)
{
    if (registry == NULL || text == NULL || instance == NULL)
        return error_set_missing(error, "imp_instance_from_text");
    imp_error own;
    imp_error *why = error != NULL ? error : &own;
    const char *who = kind == IMP_TYPE_SURFACE ? "surface" : "map";
    json_t *stage = pipeline_read_stage(registry, kind, who, text, why);
    if (stage == NULL) return why->code;
    place at = place_argument(NULL, who);
    const scene_source source = {.registry = registry};
    imp_code code = IMP_SUCCESS;
    if (json_object_get(stage, "clock") != NULL) /* there is no scene whose parameter it names */
        code = place_error(&at, why, IMP_ERROR_SCENE, "'clock' belongs to scenes; leave it out");
    if (code == IMP_SUCCESS) code = scene_build_instance(&source, kind, stage, &at, instance, why);
    json_decref(stage);
    return code;
}

imp_code imp_instance_from_text(imp_registry *registry, imp_type_kind kind, const char *text,
                                imp_instance *instance, imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    const imp_code code = from_text(registry, kind, text, instance, error);
    fp_environment_leave(&environment);
    return code;
}

FP_APART static char *stage_to_json(const imp_registry *registry, imp_type_kind kind,
                                    const char *text, imp_error *error)
{
    if (registry == NULL || text == NULL) {
        error_set_missing(error, "imp_stage_to_json");
        return NULL;
    }
    const char *who = kind == IMP_TYPE_SURFACE ? "surface" : "map";
    json_t *stage = pipeline_read_stage(registry, kind, who, text, error);
    if (stage == NULL) return NULL;
    char *json = json_text_of(stage, error);
    json_decref(stage);
    return json;
}

char *imp_stage_to_json(const imp_registry *registry, imp_type_kind kind, const char *text,
                        imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    char *json = stage_to_json(registry, kind, text, error);
    fp_environment_leave(&environment);
    return json;
}

void imp_instance_free(imp_instance *instance)
{
    if (instance == NULL || instance->self == NULL) return;
    if (instance->surface != NULL)
        instance->surface->destroy(instance->self);
    else
        instance->map->destroy(instance->self);
    instance->self = NULL;
}
