/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/solid/shells.h"

/* Bytes of the first release. */
#define CLOSURE_FIRST sizeof(imp_closure)

bool imp_scene_is_solid(const imp_scene *scene, size_t body)
{
    return scene != NULL && body < imp_scene_body_count(scene) && scene_is_solid(scene, body);
}

FP_APART static imp_code find_closure(const imp_scene *scene, size_t body, double t, double slack,
                                      imp_facing *facing, const limit_watch *watch,
                                      imp_closure *closure, imp_error *error)
{
    patches p;
    shells found = {0};
    imp_code code = solid_patches_read(&p, scene, body, t, error);
    if (code == IMP_SUCCESS) code = solid_shells_find(&found, &p, slack, watch, closure, error);
    if (code == IMP_SUCCESS && facing != NULL && closure->verdict == IMP_CLOSURE_CLOSED)
        memcpy(facing, found.facing, p.count * sizeof *facing);
    solid_shells_free(&found);
    solid_patches_free(&p);
    return code;
}

imp_code imp_scene_get_closure(const imp_scene *scene, size_t body, double t, double slack,
                               imp_facing *facing, imp_go_on go_on, void *context,
                               imp_closure *closure, imp_error *error)
{
    if (scene == NULL) return error_set_missing(error, "imp_scene_get_closure");
    imp_code code = sized_check("imp_closure", closure, CLOSURE_FIRST, error);
    if (code != IMP_SUCCESS) return code;
    if (body >= imp_scene_body_count(scene))
        return error_set(error, IMP_ERROR_USAGE, "body: got %zu, must be below %zu", body,
                         imp_scene_body_count(scene));
    if (!(isfinite(t) && slack >= 0 && slack < INFINITY))
        return error_set(error, IMP_ERROR_USAGE,
                         "t and slack: got %g and %g, must be finite, and slack >= 0", t, slack);
    imp_closure own = {.struct_size = (uint32_t)sizeof own};
    const limit_watch watch = {go_on, context};
    const fp_environment environment = fp_environment_enter();
    code = find_closure(scene, body, t, slack, facing, &watch, &own, error);
    fp_environment_leave(&environment);
    if (code == IMP_SUCCESS) sized_write(closure, &own);
    return code;
}
