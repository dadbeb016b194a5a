/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/subject.h"

#include <stdlib.h>
#include <string.h>

#include "tools/cli/input.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"
#include "tools/view/recorded.h"

static stage_contact contact_of(const imp_result *r)
{
    const bool contact = r->verdict == IMP_CONTACT;
    stage_contact c = {.verdict = r->verdict,
                       .t = contact ? r->t : r->t_lower,
                       .body = {r->a.body, r->b.body},
                       .has_normal = contact && r->has_normal,
                       .normal = vec_of(r->normal),
                       .gap = r->gap,
                       .gamma = r->gamma};
    c.point[0] = vec_of(r->a.point), c.point[1] = vec_of(r->b.point);
    return c;
}

static exit_status solve(subject *s, const arguments *args)
{
    imp_error error = {0};
    imp_result result;
    s->options = query_options(s->scene, args);
    s->query = imp_query_new(s->scene, &s->options, &error);
    if (s->query == NULL) return complain_of(&error, args->verb->name);
    interrupt_prepare();
    if (query_run(s->query, &result, &error) != IMP_SUCCESS)
        return complain_of(&error, args->verb->name);
    s->contact = contact_of(&result);
    return EXIT_ANSWERED;
}

static exit_status read_text(subject *s, const arguments *args, const input_text *t)
{
    imp_error error = {0};
    const char *name = input_name(args->operands[0]);
    recorded answer;
    const exit_status status = recorded_read(t->text, t->length, name, args->verb->name, &answer);
    if (status != EXIT_ANSWERED) return status;
    if (!answer.is_result)
        s->scene = imp_scene_from_json(s->registry, t->text, t->length, name, &error);
    else if (answer.pair[0] != NULL)
        s->scene = imp_scene_from_pair(s->registry, answer.pair[0], answer.pair[1], &error);
    else
        s->scene = imp_scene_from_file(s->registry, answer.scene, &error);
    exit_status done = EXIT_ANSWERED;
    if (s->scene == NULL) {
        done = complain_of(&error, args->verb->name);
    } else if (answer.is_result) {
        s->options = query_options(s->scene, args);
        if (arguments_option(args, "time") == NULL) recorded_times(&answer, &s->options);
        done = query_check_times(s->scene, &s->options, args);
        if (done == EXIT_ANSWERED)
            done = recorded_contact(&answer, s->scene, name, args->verb->name, &s->contact);
    }
    recorded_free(&answer);
    return done;
}

static exit_status read_file(subject *s, const arguments *args)
{
    input_text t = {0};
    FILE *file = input_open(args->operands[0], args->verb->name);
    if (file == NULL) return EXIT_DATA;
    exit_status status = EXIT_DATA;
    if (input_read(file, input_name(args->operands[0]), args->verb->name, &t))
        status = read_text(s, args, &t);
    input_close(file);
    free(t.text);
    return status;
}

exit_status subject_read(subject *s, const arguments *args)
{
    *s = (subject){0};
    exit_status status = query_check(args);
    if (status != EXIT_ANSWERED) return status;
    s->registry = query_registry(args);
    if (s->registry == NULL) return EXIT_DATA;
    if (args->operand_count == 1) {
        status = read_file(s, args);
    } else {
        imp_error error = {0};
        s->scene = imp_scene_from_pair(s->registry, args->operands[0], args->operands[1], &error);
        if (s->scene == NULL) status = complain_of(&error, args->verb->name);
    }
    if (status != EXIT_ANSWERED || s->contact.gamma > 0) return status;
    return solve(s, args);
}

exit_status subject_of_file(subject *s, const char *path, const arguments *args)
{
    imp_error error = {0};
    *s = (subject){.registry = query_registry(args)};
    if (s->registry == NULL) return EXIT_DATA;
    s->scene = imp_scene_from_file(s->registry, path, &error);
    return s->scene != NULL ? solve(s, args) : complain_of(&error, args->verb->name);
}

void subject_free(subject *s)
{
    imp_query_free(s->query);
    imp_scene_free(s->scene);
    query_registry_free(s->registry);
    *s = (subject){0};
}
