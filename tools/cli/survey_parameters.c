/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/scene_values.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

/* --parameter NAME=LO,HI: parameters that the command line puts into a scene. */

const option options_parameters[] = {
    {.name = "parameter",
     .kind = OPTION_RANGE,
     .argument = "NAME=LO,HI",
     .help = "a parameter of the scene, or another range of one; as often as needed"},
    {.name = NULL}};

/* *declared: how many the scene itself has. */
static exit_status set_parameters(json_t *scene, const arguments *args, size_t *declared)
{
    json_t *all = json_object_get(scene, "parameters");
    *declared = json_object_size(all);
    if (all == NULL) {
        all = json_object();
        if (json_object_set_new(scene, "parameters", all) != 0)
            return complain_of_memory(args->verb->name);
    }
    for (size_t k = 0; k < args->value_count; ++k) {
        const option_value *value = &args->values[k];
        if (strcmp(value->row->name, "parameter") != 0) continue;
        if (!json_is_object(all)) return EXIT_ANSWERED; /* the reader complains */
        char *name = strndup(value->text, (size_t)(strchr(value->text, '=') - value->text));
        json_t *range = json_pack("[f,f]", value->number[0], value->number[1]);
        const bool is_set = json_object_set_new(all, name, range) == 0; /* name may be NULL */
        free(name);
        if (!is_set) return complain_of_memory(args->verb->name);
    }
    return EXIT_ANSWERED;
}

char *survey_add_parameters(char *text, size_t *length, size_t *declared, const arguments *args)
{
    *declared = 0;
    json_t *scene = json_loadb(text, *length, JSON_REJECT_DUPLICATES, NULL);
    if (!json_is_object(scene)) return json_decref(scene), text;
    const exit_status status = set_parameters(scene, args, declared);
    free(text);
    text = status == EXIT_ANSWERED ? json_dumps(scene, JSON_COMPACT) : NULL;
    json_decref(scene);
    if (text == NULL && status == EXIT_ANSWERED) complain_of_memory(args->verb->name);
    if (text != NULL) *length = strlen(text);
    return text;
}

static bool is_given(const char *name, const arguments *args)
{
    const size_t length = strlen(name);
    for (size_t k = 0; k < args->value_count; ++k) {
        const option_value *value = &args->values[k];
        if (strcmp(value->row->name, "parameter") == 0 && strncmp(value->text, name, length) == 0 &&
            value->text[length] == '=')
            return true;
    }
    return false;
}

/* What the scene declares, or what the command line gives and a surface or map follows. */
typedef struct known_names {
    size_t declared;
    const arguments *args;
} known_names;

/* Not parameters that surfaces and maps have of their own. */
static bool is_known(const void *context, const imp_scene *scene, size_t k)
{
    const known_names *known = context;
    imp_scene_parameter_info info;
    return imp_scene_parameter(scene, k, &info) &&
           (k < known->declared || (info.is_followed && is_given(info.name, known->args)));
}

imp_code survey_check_parameters(const imp_scene *scene, size_t declared, const arguments *args,
                                 imp_error *error)
{
    imp_scene_parameter_info info;
    const known_names known = {declared, args};
    for (size_t k = declared; imp_scene_parameter(scene, k, &info); ++k) {
        if (info.is_followed || !is_given(info.name, args)) continue;
        const scene_values_wrong wrong = {"parameter", info.name, strlen(info.name), is_known,
                                          &known};
        return scene_values_refuse(&wrong, scene, error);
    }
    return IMP_SUCCESS;
}
