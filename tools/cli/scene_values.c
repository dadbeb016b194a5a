/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/scene_values.h"

#include <string.h>

size_t scene_values_find(const imp_scene *scene, const char *name, size_t length)
{
    imp_scene_parameter_info info;
    size_t k = 0;
    while (imp_scene_parameter(scene, k, &info) &&
           !(strlen(info.name) == length && memcmp(info.name, name, length) == 0))
        ++k;
    return k;
}

void scene_values_middle(const imp_scene *scene, double *values)
{
    imp_scene_parameter_info info;
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        values[k] = 0.5 * info.lo + 0.5 * info.hi;
}
