/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/examine.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/scene/scene.h"
#include "core/surface/formula_text.h"

/* What the surfaces of a scene are, as formulas. */

size_t imp_piece_stage_count(const imp_scene *scene, imp_place at)
{
    const surface *s = scene_piece(scene, at);
    return s != NULL ? surface_map_count(s) + 1 : 0;
}

static imp_code no_stage(const imp_scene *scene, imp_place at, size_t stage, imp_error *why)
{
    return error_set(why, IMP_ERROR_USAGE,
                     "body %zu, surface %zu, piece %zu has no stage %zu, but %zu", at.body,
                     at.surface, at.piece, stage, imp_piece_stage_count(scene, at));
}

imp_code imp_piece_stage(const imp_scene *scene, imp_place at, size_t stage, imp_stage *info,
                         imp_error *why)
{
    if (scene == NULL || info == NULL) return error_set_missing(why, "imp_piece_stage");
    if (stage >= imp_piece_stage_count(scene, at)) return no_stage(scene, at, stage, why);
    const shared_instance *origin = surface_origin(scene_piece(scene, at), stage);
    *info = (imp_stage){.kind = stage == 0 ? IMP_TYPE_SURFACE : IMP_TYPE_MAP,
                        .type = stage == 0 ? origin->surface->name : origin->map->name,
                        .identity = origin};
    return IMP_SUCCESS;
}

FP_APART static imp_code formula_of(const imp_scene *scene, imp_place at, size_t stage, char **text,
                                    imp_error *why)
{
    const surface *s = scene_piece(scene, at);
    const imp_status status = surface_formula(s, stage, text);
    if (status == IMP_STATUS_OK) return IMP_SUCCESS;
    surface_fault(s, why, ": %s", surface_status_message(s, status).text);
    return surface_set_code(status, why);
}

imp_code imp_piece_formula(const imp_scene *scene, imp_place at, size_t stage, char **text,
                           imp_error *why)
{
    if (scene == NULL || text == NULL) return error_set_missing(why, "imp_piece_formula");
    *text = NULL;
    if (stage >= imp_piece_stage_count(scene, at)) return no_stage(scene, at, stage, why);
    const fp_environment environment = fp_environment_enter();
    const imp_code code = formula_of(scene, at, stage, text, why);
    fp_environment_leave(&environment);
    return code;
}
