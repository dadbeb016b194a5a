/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/subject.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/input.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/query.h"
#include "tools/cli/reading_limit.h"
#include "tools/cli/verbs.h"
#include "tools/view/at_values.h"
#include "tools/view/nearest.h"
#include "tools/view/recorded.h"

#include <impinge/baseline.h>

/* --- Solving ---------------------------------------------------------------------------------- */

static void take_result(subject *s, const imp_result *r)
{
    const bool contact = r->verdict == IMP_VERDICT_CONTACT;
    s->contact = (stage_contact){.is_known = true,
                                 .verdict = r->verdict,
                                 .t = contact ? r->t : r->t_lower,
                                 .gap = r->gap,
                                 .gamma = r->gamma};
    s->spot = (stage_spot){.is_known = contact, .is_contact = contact};
    if (!contact) return;
    s->spot.t = r->t, s->spot.upper = r->gap;
    s->spot.point[0] = vec_of(r->a.point), s->spot.point[1] = vec_of(r->b.point);
    s->spot.body[0] = r->a.body, s->spot.body[1] = r->b.body;
    s->spot.has_normal = r->has_normal, s->spot.normal = vec_of(r->normal);
}

/* Shares of the time that is left, of search and nearest approach; the picture is made in the
 * rest. */
static const double share_of_search = 0.5, share_of_nearest = 0.5;

/* Searches from t_start to `end`, in place of any search before. */
static exit_status search_until(subject *s, double end, const char *speaker, imp_result *result)
{
    imp_error error = {0};
    imp_options search = s->options;
    search.t_end = end;
    search.max_seconds = allowance_left(&s->allowance, share_of_search);
    imp_query_free(s->query);
    s->query = imp_query_new(s->scene, &search, &error);
    if (s->query == NULL) return complain_of(&error, speaker);
    const imp_code code = query_run(s->query, result, &error);
    return code == IMP_SUCCESS ? EXIT_ANSWERED : complain_of(&error, speaker);
}

/* Returns the first event of a simulation within the time, or the end. The motion has a kink there;
 * where flat faces meet, a search across it splits them all before it splits time. */
static double first_event(const subject *s)
{
    const imp_options *o = &s->options;
    for (size_t k = 0; k < s->events.count; ++k)
        if (s->events.event[k].t > o->t_start && s->events.event[k].t < o->t_end)
            return s->events.event[k].t;
    return o->t_end;
}

static exit_status solve(subject *s, const arguments *args)
{
    imp_result result;
    const char *speaker = args->verb->name;
    s->options = query_options(s->scene, args);
    interrupt_prepare();
    const double first = first_event(s);
    exit_status status = search_until(s, first, speaker, &result);
    if (status == EXIT_ANSWERED && result.verdict == IMP_VERDICT_CLEAR && first < s->options.t_end)
        status = search_until(s, s->options.t_end, speaker, &result);
    if (status == EXIT_ANSWERED) take_result(s, &result);
    return status;
}

imp_code subject_find_nearest(subject *s, imp_error *error)
{
    imp_options options = s->options;
    if (s->spot.is_known || s->has_looked) return IMP_SUCCESS;
    s->has_looked = true;
    options.max_seconds = allowance_left(&s->allowance, share_of_nearest);
    options.max_bytes /= 4; /* 0, which is no limit, stays; the rest is the picture's */
    options.baseline = IMP_BASELINE_NONE;
    return nearest_find(s->scene, &options, &s->spot, error);
}

/* --- Reading ---------------------------------------------------------------------------------- */

static void begin(subject *s, const arguments *args)
{
    *s = (subject){.axis = "t"};
    allowance_begin(&s->allowance, arguments_number(args, "max-seconds", 0),
                    arguments_count(args, "max-bytes", (uint64_t)1 << 30));
    s->allowance.interrupted = interrupt_came;
}

/* Returns a file's name without folders. */
static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL && slash[1] != '\0' ? slash + 1 : path;
}

static void set_title(subject *s, const char *file, const char *const pair[2])
{
    if (file != NULL)
        snprintf(s->title, sizeof s->title, "%.250s", base_of(file));
    else
        snprintf(s->title, sizeof s->title, "%.120s and %.120s", pair[0], pair[1]);
}

/* Stands the scene at values of its parameters, or has one of them in the place of time. */
static exit_status pose(subject *s, const json_t *known, const arguments *args)
{
    const option_value *over = arguments_option(args, "sweep");
    const size_t used = strlen(s->title);
    s->axis = over != NULL ? over->text : "t";
    if (over != NULL)
        snprintf(s->title + used, sizeof s->title - used, ", t is %.60s",
                 message_shown(over->text).text);
    return at_values_pose(&s->scene, known, args, &s->values);
}

/* --sweep asks about a scene: a result is one at values. */
static exit_status check_sweep(const recorded *answer, const arguments *args)
{
    if (answer->kind == RECORDED_NOTHING || arguments_option(args, "sweep") == NULL)
        return EXIT_ANSWERED;
    return complain(EXIT_USAGE, args->verb->name,
                    "--sweep draws a scene, not a result; name the scene's file");
}

/* A scene, or a result of one. */
static exit_status read_text(subject *s, const arguments *args, const input_text *t)
{
    imp_error error = {0};
    const char *name = input_name(args->operands[0]);
    json_t *json = json_loadb(t->text, t->length, 0, NULL);
    recorded answer;
    exit_status status = recorded_read(json, name, args->verb->name, &answer);
    if (status == EXIT_ANSWERED) {
        if (answer.kind == RECORDED_NOTHING)
            s->scene = imp_scene_from_json(s->registry, t->text, t->length, name, &error);
        else if (answer.pair[0] != NULL)
            s->scene = imp_scene_from_pair(s->registry, answer.pair[0], answer.pair[1], &error);
        else
            s->scene = imp_scene_from_file(s->registry, answer.scene, &error);
        set_title(s,
                  answer.pair[0] != NULL ? NULL
                  : answer.scene != NULL ? answer.scene
                                         : name,
                  answer.pair);
        if (s->scene == NULL) status = complain_of(&error, args->verb->name);
    }
    if (status == EXIT_ANSWERED) status = check_sweep(&answer, args);
    if (status == EXIT_ANSWERED) status = pose(s, json_object_get(json, "parameters"), args);
    if (status == EXIT_ANSWERED && !events_read(json, &s->events))
        status = complain_of_memory(args->verb->name);
    if (status == EXIT_ANSWERED && answer.kind != RECORDED_NOTHING) {
        s->options = query_options(s->scene, args);
        s->has_looked = answer.kind == RECORDED_CLEARANCE;
        if (arguments_option(args, "time") == NULL) recorded_times(&answer, &s->options);
        status = query_check_times(s->scene, &s->options, args);
    }
    if (status == EXIT_ANSWERED && answer.kind != RECORDED_NOTHING) {
        status = recorded_answer(&answer, s->scene, &s->options, name, args->verb->name,
                                 &s->contact, &s->spot);
    }
    json_decref(json);
    return status;
}

static exit_status read_file(subject *s, const arguments *args)
{
    input_text t = {.most = reading_limit_most(args)};
    FILE *file = input_open(args->operands[0], args->verb->name);
    if (file == NULL) return EXIT_DATA;
    exit_status status = EXIT_DATA;
    if (input_read(file, input_name(args->operands[0]), args->verb->name, &t))
        status = reading_limit_check(args, &t, 2);
    if (t.is_too_long) status = EXIT_UNDECIDED;
    if (status == EXIT_ANSWERED) status = read_text(s, args, &t);
    input_close(file);
    free(t.text);
    return status;
}

static exit_status read_pair(subject *s, const arguments *args)
{
    imp_error error = {0};
    s->scene = imp_scene_from_pair(s->registry, args->operands[0], args->operands[1], &error);
    set_title(s, NULL, args->operands);
    return s->scene != NULL ? pose(s, NULL, args) : complain_of(&error, args->verb->name);
}

exit_status subject_read(subject *s, const arguments *args)
{
    begin(s, args);
    exit_status status = query_check(args);
    if (status != EXIT_ANSWERED) return status;
    s->registry = query_registry(args);
    if (s->registry == NULL) return EXIT_DATA;
    reading_limit_begin(args, NULL);
    status = args->operand_count == 1 ? read_file(s, args) : read_pair(s, args);
    reading_limit_end();
    /* The text may be a result, which needs no search. */
    if (status != EXIT_ANSWERED || s->contact.gamma > 0) return status;
    return solve(s, args);
}

exit_status subject_of_file(subject *s, const char *path, const arguments *args)
{
    imp_error error = {0};
    begin(s, args);
    s->registry = query_registry(args);
    if (s->registry == NULL) return EXIT_DATA;
    reading_limit_begin(args, NULL);
    s->scene = imp_scene_from_file(s->registry, path, &error);
    reading_limit_end();
    set_title(s, path, NULL);
    return s->scene != NULL ? solve(s, args) : complain_of(&error, args->verb->name);
}

void subject_free(subject *s)
{
    imp_query_free(s->query);
    imp_scene_free(s->scene);
    events_free(&s->events);
    query_registry_free(s->registry);
    *s = (subject){0};
}
