/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/at_values.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/scene_values.h"
#include "tools/cli/verbs.h"

/* --- The parts of --at ------------------------------------------------------------------------ */

/* A part between commas: NAME=VALUE, a time or a word. */
typedef struct at_part {
    const char *at, *equals; /* NULL: there is no '=' */
    size_t length;
} at_part;

/* Moves to the next part. False: there is none. */
static bool next_part(const char **text, at_part *part)
{
    if (**text == '\0') return false;
    part->at = *text;
    part->length = strcspn(*text, ",");
    part->equals = memchr(part->at, '=', part->length);
    *text += part->length + (part->at[part->length] == ',');
    return true;
}

bool at_values_time(const char *text, char *copy, size_t size)
{
    at_part part;
    bool found = false;
    copy[0] = '\0';
    while (next_part(&text, &part)) {
        if (part.equals != NULL) continue;
        if (found || part.length >= size) return false;
        memcpy(copy, part.at, part.length);
        copy[part.length] = '\0';
        found = true;
    }
    return true;
}

/* --- Values ----------------------------------------------------------------------------------- */

/* Returns the index of the parameter of --sweep; SIZE_MAX: it is not given. */
static size_t swept(const imp_scene *scene, const arguments *args)
{
    const option_value *over = arguments_option(args, "sweep");
    return over != NULL ? scene_values_find(scene, over->text, strlen(over->text)) : SIZE_MAX;
}

/* --at time=T, with --sweep; the name belongs to no parameter. */
static bool is_time(const at_part *part, const arguments *args)
{
    return arguments_option(args, "sweep") != NULL && part->equals == part->at + 4 &&
           memcmp(part->at, "time", 4) == 0;
}

static exit_status set_value(const imp_scene *scene, const at_part *part, double *values,
                             const arguments *args)
{
    imp_scene_parameter_info info;
    const size_t length = (size_t)(part->equals - part->at);
    char *end;
    const double value = strtod(part->equals + 1, &end);
    const bool is_number = end != part->equals + 1 && end == part->at + part->length;
    const size_t count = imp_scene_parameter_count(scene);
    const size_t k = scene_values_find(scene, part->at, length);
    if (is_number && is_time(part, args)) return values[count] = value, EXIT_ANSWERED;
    if (!imp_scene_parameter(scene, k, &info))
        return scene_values_complain(scene, "at", part->at, length, args->verb->name);
    if (!is_number || !(value >= info.lo && value <= info.hi))
        return complain(EXIT_USAGE, args->verb->name,
                        "--at: '%s' must be from %.10g to %.10g, not '%.*s'", info.name, info.lo,
                        info.hi, (int)(part->length - length - 1), part->equals + 1);
    values[k] = value;
    return EXIT_ANSWERED;
}

static exit_status read_values(const imp_scene *scene, const char *text, double *values,
                               const arguments *args)
{
    at_part part;
    exit_status status = EXIT_ANSWERED;
    while (status == EXIT_ANSWERED && next_part(&text, &part))
        if (part.equals != NULL) status = set_value(scene, &part, values, args);
    return status;
}

/* Sets the values of a result, or the middle of each range; behind them the time at which the scene
 * begins. */
static void usual_values(const imp_scene *scene, const json_t *known, double *values)
{
    imp_scene_parameter_info info;
    values[imp_scene_parameter_count(scene)] = imp_options_default(scene).t_start;
    scene_values_middle(scene, values);
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k) {
        const json_t *one = json_object_get(known, info.name);
        const double value = json_is_number(one) ? json_number_value(one) : NAN;
        if (value >= info.lo && value <= info.hi) values[k] = value;
    }
}

/* Names all values but that of the parameter that is swept. */
static values_text name_values(const imp_scene *scene, const double *values, const arguments *args)
{
    imp_scene_parameter_info info;
    const size_t over = swept(scene, args);
    values_text names = {""};
    size_t used = 0;
    for (size_t k = 0; imp_scene_parameter(scene, k, &info) && used < sizeof names.text; ++k)
        if (k != over)
            used += (size_t)snprintf(names.text + used, sizeof names.text - used, "%s%s = %.5g",
                                     used > 0 ? ", " : "", info.name, values[k]);
    return names;
}

/* Refuses --sweep of a name that is not a parameter of the scene. */
static exit_status check_sweep(const imp_scene *scene, const arguments *args)
{
    const option_value *over = arguments_option(args, "sweep");
    if (over == NULL || swept(scene, args) < imp_scene_parameter_count(scene)) return EXIT_ANSWERED;
    return scene_values_complain(scene, "sweep", over->text, strlen(over->text), args->verb->name);
}

/* Returns the scene at the values, or the one that sweeps a parameter. NULL: it complained. */
static imp_scene *pose(const imp_scene *scene, const double *values, const arguments *args)
{
    const size_t over = swept(scene, args), count = imp_scene_parameter_count(scene);
    imp_error error = {0};
    imp_scene *posed = over == SIZE_MAX
                           ? imp_scene_at(scene, values, &error)
                           : imp_scene_sweep(scene, over, values, values[count], &error);
    if (posed == NULL) complain_of(&error, args->verb->name);
    return posed;
}

exit_status at_values_pose(imp_scene **scene, const json_t *known, const arguments *args,
                           values_text *names)
{
    const option_value *at = arguments_option(args, "at");
    const size_t count = imp_scene_parameter_count(*scene);
    double *values = calloc(count + 1, sizeof *values);
    if (values == NULL) return complain_of_memory(args->verb->name);
    usual_values(*scene, known, values);
    exit_status status = check_sweep(*scene, args);
    if (status == EXIT_ANSWERED && at != NULL) status = read_values(*scene, at->text, values, args);
    if (status == EXIT_ANSWERED && count > 0) {
        *names = name_values(*scene, values, args);
        if (names->text[0] != '\0' && (at == NULL || strchr(at->text, '=') == NULL))
            remark(args->verb->name, "drawn at %s; --at NAME=VALUE,... shows others",
                   message_shown(names->text).text);
        imp_scene *posed = pose(*scene, values, args);
        if (posed != NULL) imp_scene_free(*scene), *scene = posed;
        if (posed == NULL) status = EXIT_USAGE;
    }
    free(values);
    return status;
}
