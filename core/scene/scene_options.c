/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/scene/default_times.h"
#include "core/scene/scene_internal.h"

void scene_options(const imp_scene *scene, imp_options *options)
{
    const scene_settings *set = &scene->settings;
    *options = (imp_options){.struct_size = (uint32_t)sizeof *options,
                             .t_start = set->t_start,
                             .t_end = set->t_end,
                             .gamma = set->gamma,
                             .gamma_clear = set->gamma_clear,
                             .max_bytes = (uint64_t)1 << 30};
    double time[2];
    if (!isnan(set->t_start) || default_times(scene, time, NULL) != IMP_SUCCESS) return;
    options->t_start = time[0];
    options->t_end = time[1];
}

/* NAN twice stands for the scene's own times, which can be wrong. */
static imp_code check_times(const imp_scene *scene, const imp_options *options, imp_error *error)
{
    double time[2];
    return isnan(options->t_start) && isnan(options->t_end) ? default_times(scene, time, error)
                                                            : IMP_SUCCESS;
}

imp_code scene_check_options(const imp_scene *scene, const imp_options *options, imp_error *error)
{
    if (check_times(scene, options, error) != IMP_SUCCESS) return IMP_ERROR_SCENE;
    if (!(options->t_start <= options->t_end && options->t_start > -INFINITY &&
          options->t_end < INFINITY))
        return error_set(error, IMP_ERROR_USAGE, "time: got [%g, %g], must be finite and not empty",
                         options->t_start, options->t_end);
    if (!(options->max_seconds >= 0))
        return error_set(error, IMP_ERROR_USAGE, "max_seconds: got %g, must be >= 0",
                         options->max_seconds);
    return IMP_SUCCESS;
}

imp_code imp_options_get_default(const imp_scene *scene, imp_options *options, imp_error *error)
{
    if (scene == NULL) return error_set_missing(error, "imp_options_get_default");
    imp_options own;
    scene_options(scene, &own);
    const imp_code code = sized_check("imp_options", options, SCENE_OPTIONS_FIRST, error);
    if (code != IMP_SUCCESS) return code;
    sized_write(options, &own);
    return check_times(scene, &own, error);
}
