/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/scene_values.h"

#include <stdio.h>
#include <string.h>

#include "core/common/spelling.h"

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

/* --- Names that no parameter has -------------------------------------------------------------- */

/* Lists the names that may be offered, as far as there is room. */
static const char *offer_names(const scene_values_wrong *wrong, const imp_scene *scene,
                               spelling_search *near, char *list, size_t size)
{
    imp_scene_parameter_info info;
    size_t used = 0;
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k) {
        if (wrong->is_offered != NULL && !wrong->is_offered(wrong->context, scene, k)) continue;
        spelling_offer(near, info.name);
        if (used < size)
            used += (size_t)snprintf(list + used, size - used, "%s%s", used > 0 ? ", " : "",
                                     message_shown(info.name).text);
    }
    return used > 0 ? list : "none";
}

imp_code scene_values_refuse(const scene_values_wrong *wrong, const imp_scene *scene,
                             imp_error *error)
{
    char list[256] = "", name[SPELLING_NAME_MAX + 2];
    snprintf(name, sizeof name, "%.*s", (int)wrong->length, wrong->name);
    spelling_search near = {.wanted = name};
    const char *names = offer_names(wrong, scene, &near, list, sizeof list);
    snprintf(error->text, sizeof error->text,
             "--%s: the scene has no parameter '%.200s'%s%s%s its parameters are: %s",
             wrong->option, message_shown(name).text, near.best != NULL ? "; did you mean '" : "",
             near.best != NULL ? near.best : "", near.best != NULL ? "'?" : ";", names);
    return error->code = IMP_ERROR_USAGE;
}

exit_status scene_values_complain(const imp_scene *scene, const char *option, const char *name,
                                  size_t length, const char *verb)
{
    imp_error error;
    const scene_values_wrong wrong = {.option = option, .name = name, .length = length};
    scene_values_refuse(&wrong, scene, &error);
    return complain(EXIT_USAGE, verb, "%s", error.text);
}
