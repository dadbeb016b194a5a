/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/setup.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/clock.h"
#include "tools/cli/input.h"
#include "tools/cli/json_memory.h"
#include "tools/cli/query.h"
#include "tools/cli/reading_limit.h"
#include "tools/cli/verbs.h"
#include "tools/simulate/actor.h"
#include "tools/simulate/carried.h"
#include "tools/simulate/values.h"

static const char speaker[] = "simulate";

/* Complains if all takes a tenth and 0.1 s longer than --max-seconds, with `more` seconds to come:
 * who reads in less learns more from the motion, even of no time. Time is this thread's, as where
 * the library reads (reading_budget.h): a loaded machine refuses no more. */
static exit_status check_time(const setup *s, double more)
{
    const double used = clock_thread_seconds() - s->begun, limit = s->max_seconds;
    if (limit == 0 || !(used + more > 1.1 * limit + 0.1)) return EXIT_ANSWERED;
    return complain(EXIT_UNDECIDED, speaker,
                    "--max-seconds %g is over before the motion of %.150s begins%s; nothing was "
                    "written; allow more (0: no limit)",
                    limit, s->name, more > 0 ? " if it is to be written in time" : "");
}

/* --- Bodies ----------------------------------------------------------------------------------- */

size_t setup_find(const setup *s, const char *name)
{
    for (size_t i = 0; name != NULL && i < s->count; ++i)
        if (strcmp(s->actors[i].name, name) == 0) return i;
    return SIZE_MAX;
}

static exit_status read_actors(setup *s)
{
    const json_t *stripped = json_object_get(s->stripped, "bodies");
    s->count = imp_scene_body_count(s->still);
    s->actors = calloc(s->count + 1, sizeof *s->actors);
    if (s->actors == NULL) return complain_of_memory(speaker);
    for (size_t i = 0; i < s->count; ++i) {
        s->actors[i].name = imp_scene_body_name(s->still, i);
        s->actors[i].json = json_array_get(stripped, i);
    }
    exit_status status =
        value_vector((value_place){s->name, SIZE_MAX, "gravity"}, s->root, &s->gravity);
    bool moves = false;
    for (size_t i = 0; i < s->count && status == EXIT_ANSWERED; ++i) {
        status = actor_read(s, i);
        moves |= s->actors[i].moves;
        if (!outline_read(&s->actors[i].outline, s->still, &s->options, &s->limits, i))
            return complain_of_memory(speaker);
        if (status == EXIT_ANSWERED) status = carried_check(s, i);
    }
    if (status == EXIT_ANSWERED && !moves)
        return complain(EXIT_DATA, speaker,
                        "%.300s: no body has a \"mass\"; give one to what moves", s->name);
    return status;
}

/* --- The scene ---------------------------------------------------------------------------------
 */

static void strip(json_t *root)
{
    size_t i;
    json_t *body;
    json_object_del(root, "gravity");
    json_object_del(root, "events");
    json_array_foreach(json_object_get(root, "bodies"), i, body) actor_strip(body);
}

/* Errors of syntax are left to the library, which says where they are. */
static exit_status read_json(setup *s, const input_text *text)
{
    imp_error error = {0};
    const int flags = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL;
    const char *given = text->text != NULL ? text->text : "";
    s->root = json_loadb(given, text->length, flags, NULL);
    exit_status status = check_time(s, 0);
    if (status != EXIT_ANSWERED) return status;
    s->stripped = json_deep_copy(s->root);
    if (s->root != NULL && s->stripped == NULL) return complain_of_memory(speaker);
    char *stripped = NULL;
    if (s->stripped != NULL) {
        strip(s->stripped);
        stripped = json_memory_text(s->stripped, JSON_REAL_PRECISION(17));
        if (stripped == NULL) return complain_of_memory(speaker);
        given = stripped;
        status = check_time(s, 0);
    }
    const size_t length = stripped != NULL ? strlen(stripped) : text->length;
    if (status == EXIT_ANSWERED)
        s->still = imp_scene_from_json(s->registry, given, length, s->name, &error);
    free(stripped);
    if (status != EXIT_ANSWERED) return status;
    return s->still != NULL ? check_time(s, 0) : complain_of(&error, speaker);
}

static exit_status read_text(setup *s, const arguments *args)
{
    input_text text = {.most = reading_limit_most(args)};
    FILE *file = input_open(args->operands[0], speaker);
    if (file == NULL) return EXIT_DATA;
    exit_status status = EXIT_DATA;
    if (input_read(file, s->name, speaker, &text)) status = reading_limit_check(args, &text, 3);
    if (text.is_too_long) status = EXIT_UNDECIDED;
    if (status == EXIT_ANSWERED) status = read_json(s, &text);
    input_close(file);
    free(text.text);
    return status;
}

/* A motion is one, with its impacts; a parameter would make it many. */
static exit_status check_parameters(const setup *s)
{
    imp_scene_parameter_info first;
    if (!imp_scene_parameter(s->still, 0, &first)) return EXIT_ANSWERED;
    return complain(EXIT_DATA, speaker,
                    "%.300s: found the parameter \"%.80s\", must be none; simulate finds one "
                    "motion: leave \"parameters\" and \"clock\" out, and write their values into "
                    "what follows them",
                    s->name, first.name);
}

static exit_status check_options(setup *s)
{
    imp_options *o = &s->options;
    if (o->gamma_clear < 0) o->gamma_clear = o->gamma / 2;
    if (!(o->gamma_clear < o->gamma))
        return complain(EXIT_USAGE, speaker, "gamma_clear, %g, must be less than gamma, %g",
                        o->gamma_clear, o->gamma);
    if (!(o->gamma <= VALUE_MAX))
        return complain(EXIT_USAGE, speaker, "gamma, %g, must be at most %g", o->gamma, VALUE_MAX);
    if (!(o->t_start < o->t_end))
        return complain(EXIT_USAGE, speaker, "the time from %g to %g is empty; must be longer",
                        o->t_start, o->t_end);
    if (o->t_start >= -VALUE_MAX && o->t_end <= VALUE_MAX) return EXIT_ANSWERED;
    return value_refuse((value_place){s->name, SIZE_MAX, "time"},
                        "got the time from %g to %g, must be from %g to %g at most", o->t_start,
                        o->t_end, -VALUE_MAX, VALUE_MAX);
}

/* What the motion of a body takes to write and to free: 1.5e-5 s were measured. */
static const double writing_seconds = 2e-5;

exit_status setup_read(setup *s, const arguments *args)
{
    *s = (setup){.name = input_name(args->operands[0]),
                 .begun = clock_thread_seconds(),
                 .max_seconds = arguments_number(args, "max-seconds", 0)};
    s->limits = limits_begin(s->max_seconds, 0);
    s->registry = query_registry(args);
    if (s->registry == NULL) return EXIT_DATA;
    reading_limit_begin(args, NULL);
    exit_status status = read_text(s, args);
    reading_limit_end();
    if (status != EXIT_ANSWERED) return status;
    status = check_parameters(s);
    if (status != EXIT_ANSWERED) return status;
    s->options = query_options(s->still, args);
    s->limits.max_pairs = s->options.max_pairs;
    status = query_check_times(s->still, &s->options, args);
    if (status == EXIT_ANSWERED) status = check_options(s);
    const double writing = writing_seconds * (double)imp_scene_body_count(s->still);
    if (status == EXIT_ANSWERED) status = check_time(s, writing);
    limits_reserve(&s->limits, writing);
    if (status == EXIT_ANSWERED) status = read_actors(s);
    return status;
}

void setup_free(setup *s)
{
    for (size_t i = 0; s->actors != NULL && i < s->count; ++i) outline_free(&s->actors[i].outline);
    free(s->actors);
    imp_scene_free(s->still);
    query_registry_free(s->registry);
    json_decref(s->root);
    json_decref(s->stripped);
}
