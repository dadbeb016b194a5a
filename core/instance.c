/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "pipeline.h"
#include "scene_build.h"

/* Types one by one, for those who examine them. */

imp_code imp_instance_from_text(imp_registry *registry, imp_type_sort sort, const char *text,
                                imp_instance *instance, imp_error *error)
{
    if (!registry || !text || !instance)
        return error_set(error, IMP_ERROR_USAGE, "imp_instance_from_text: an argument is NULL");
    imp_error own;
    imp_error *why = error ? error : &own;
    const char *who = sort == IMP_SORT_SURFACE ? "surface" : "map";
    json_t *stage = pipeline_read_stage(registry, sort, who, text, why);
    if (!stage) return why->code;
    place at = place_argument(NULL, who);
    imp_code code = scene_build_instance(registry, sort, stage, &at, instance, why);
    json_decref(stage);
    return code;
}

void imp_instance_free(imp_instance *instance)
{
    if (!instance || !instance->self) return;
    if (instance->surface)
        instance->surface->destroy(instance->self);
    else
        instance->map->destroy(instance->self);
    instance->self = NULL;
}
