/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/survey_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/clock.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/query.h"
#include "tools/cli/scene_values.h"
#include "tools/cli/verbs.h"

/* --- Their list ------------------------------------------------------------------------------- */

/* Threads show no search of their own: answers are counted. */
static bool goes_on(void *context, const imp_progress *progress)
{
    (void)context, (void)progress;
    return !interrupt_came();
}

static exit_status prepare(survey_parts *p, imp_scene *scene, const imp_clearance_options *asked,
                           const arguments *args, size_t count)
{
    const size_t room = survey_answer_room(scene);
    *p = (survey_parts){.scene = scene,
                        .args = args,
                        .options = query_options(scene, args),
                        .asked = asked,
                        .threads = 1,
                        .count = count,
                        .over = SIZE_MAX,
                        .rest = SIZE_MAX};
    p->until =
        p->options.max_seconds > 0 ? clock_seconds() + p->options.max_seconds : (double)INFINITY;
    p->bodies = calloc(count + 1, sizeof *p->bodies);
    p->results = calloc(count + 1, sizeof *p->results);
    p->nearest = calloc(count + 1, sizeof *p->nearest);
    p->answers = calloc(count + 1, sizeof *p->answers);
    p->numbers = calloc(count + 1, room * sizeof *p->numbers);
    if (p->bodies == NULL || p->results == NULL || p->nearest == NULL || p->answers == NULL ||
        p->numbers == NULL)
        return complain_of_memory(args->verb->name);
    for (size_t k = 0; k < count; ++k) p->answers[k].numbers = p->numbers + k * room;
    return EXIT_ANSWERED;
}

exit_status survey_parts_each(survey_parts *p, imp_scene *scene, const imp_clearance_options *asked,
                              const arguments *args, size_t threads)
{
    const size_t bodies = imp_scene_body_count(scene);
    const exit_status status = prepare(p, scene, asked, args, imp_scene_pair_count(scene));
    p->threads = threads;
    p->options.progress = goes_on;
    size_t k = 0;
    for (size_t a = 0; a < bodies && status == EXIT_ANSWERED; ++a)
        for (size_t b = a + 1; b < bodies; ++b) {
            if (imp_scene_ignores(scene, a, b)) continue;
            p->bodies[k][0] = a;
            p->bodies[k++][1] = b;
        }
    return status;
}

/* Finds the parameter of --over. */
static exit_status find_over(survey_parts *p)
{
    const option_value *over = arguments_option(p->args, "over");
    imp_scene_parameter_info info;
    if (over == NULL) return EXIT_ANSWERED;
    p->over = scene_values_find(p->scene, over->text, strlen(over->text));
    if (imp_scene_parameter(p->scene, p->over, &info)) return EXIT_ANSWERED;
    return scene_values_complain(p->scene, "over", over->text, strlen(over->text),
                                 p->args->verb->name);
}

exit_status survey_parts_slices(survey_parts *p, imp_scene *scene,
                                const imp_clearance_options *asked, const arguments *args)
{
    exit_status status = prepare(p, scene, asked, args, (size_t)asked->slices);
    if (status == EXIT_ANSWERED) status = query_check_times(scene, &p->options, args);
    free(p->bodies);
    p->bodies = NULL;
    return status == EXIT_ANSWERED ? find_over(p) : status;
}

void survey_parts_end(survey_parts *p)
{
    free(p->bodies);
    free(p->results);
    free(p->nearest);
    free(p->answers);
    free(p->numbers);
}

size_t survey_parts_find(const survey_parts *p, const size_t body[2])
{
    size_t from = 0, to = p->count;
    while (to - from > 1) {
        const size_t mid = from + (to - from) / 2, *at = p->bodies[mid];
        if (at[0] < body[0] || (at[0] == body[0] && at[1] <= body[1]))
            from = mid;
        else
            to = mid;
    }
    return from;
}

/* --- Asking ----------------------------------------------------------------------------------- */

/* Slices share their ends. */
static double end_of_slice(double lo, double hi, size_t k, size_t count)
{
    return k == count ? hi : lo + (hi - lo) * ((double)k / (double)count);
}

value_range survey_parts_slice(const survey_parts *p, size_t k)
{
    imp_scene_parameter_info info;
    value_range all = {p->options.t_start, p->options.t_end};
    if (imp_scene_parameter(p->scene, p->over, &info)) all = (value_range){info.lo, info.hi};
    return (value_range){end_of_slice(all.lo, all.hi, k, p->count),
                         k == p->rest ? all.hi : end_of_slice(all.lo, all.hi, k + 1, p->count)};
}

/* A question with the numbers that its options point to. */
typedef struct question {
    imp_options options;
    imp_survey_options how;
    imp_clearance_options asked;
    double *lo; /* ranges, where a parameter is sliced; else NULL */
} question;

static imp_code set_ranges(const survey_parts *p, size_t k, question *q)
{
    const size_t count = imp_scene_parameter_count(p->scene);
    imp_scene_parameter_info info;
    q->lo = calloc(2 * count, sizeof *q->lo);
    if (q->lo == NULL) return IMP_ERROR_MEMORY;
    for (size_t j = 0; imp_scene_parameter(p->scene, j, &info); ++j)
        q->lo[j] = info.lo, q->lo[count + j] = info.hi;
    const value_range slice = survey_parts_slice(p, k);
    q->lo[p->over] = slice.lo, q->lo[count + p->over] = slice.hi;
    q->how.lo = q->lo, q->how.hi = q->lo + count;
    return IMP_SUCCESS;
}

static imp_code make_question(const survey_parts *p, size_t k, question *q)
{
    *q = (question){.options = p->options, .how = imp_survey_options_default()};
    q->how.max_boxes = arguments_count(p->args, "max-boxes", 0);
    if (p->until < INFINITY) {
        q->options.max_seconds = p->until - clock_seconds();
        if (!(q->options.max_seconds > 0)) q->options.max_seconds = 0x1p-1000;
    }
    if (p->asked != NULL) q->asked = *p->asked;
    q->asked.slices = 1;
    q->asked.within = 0;
    if (p->bodies != NULL) {
        memcpy(q->how.body, p->bodies[k], sizeof q->how.body);
        return IMP_SUCCESS;
    }
    if (p->over != SIZE_MAX) return set_ranges(p, k, q);
    const value_range times = survey_parts_slice(p, k);
    q->options.t_start = times.lo;
    q->options.t_end = times.hi;
    return IMP_SUCCESS;
}

static imp_code ask(survey_parts *p, size_t k, const question *q, imp_error *error)
{
    imp_survey *survey =
        imp_survey_new(p->scene, &q->options, p->asked != NULL ? &q->asked : NULL, &q->how, error);
    if (survey == NULL) return error->code;
    if (interrupt_came()) imp_survey_cancel(survey);
    const imp_code code = imp_survey_step(survey, 0, error);
    if (code == IMP_SUCCESS) {
        survey_answer_read(p->scene, survey, &p->answers[k]);
        p->results[k].struct_size = (uint32_t)sizeof *p->results;
        p->nearest[k].struct_size = (uint32_t)sizeof *p->nearest;
        if (p->asked != NULL)
            imp_survey_get_clearance(survey, &p->nearest[k], NULL);
        else
            imp_survey_get_result(survey, &p->results[k], NULL);
    }
    imp_survey_free(survey);
    return code;
}

/* Bodies that never come within W need no bracket. It is decided whether they do with W enlarged,
 * so that what a requirement may be answered either way about is above W: (1 + 1e-5) (1 - 1e-6)
 * > 1. */
static double enlarged(double within) { return within * (1 + 1e-5); }

static imp_code ask_within(survey_parts *p, size_t k, const question *q, imp_error *error)
{
    question first = *q;
    first.asked.required = enlarged(p->asked->within);
    first.asked.decide = true;
    imp_clearance *c = &p->nearest[k];
    imp_code code = ask(p, k, &first, error);
    if (code == IMP_SUCCESS && c->verdict == IMP_REQUIREMENT_VIOLATED) {
        const uint64_t pairs = c->stats.pairs, boxes = p->answers[k].state.boxes;
        code = ask(p, k, q, error);
        c->stats.pairs += pairs, p->answers[k].state.boxes += boxes;
        return code;
    }
    if (code != IMP_SUCCESS) return code;
    const bool holds = c->verdict == IMP_REQUIREMENT_HOLDS;
    if (holds) c->lower = p->asked->within;
    c->required = p->asked->required;
    c->verdict = !(c->required > 0) ? IMP_REQUIREMENT_NONE
                 : holds            ? IMP_REQUIREMENT_HOLDS
                                    : IMP_REQUIREMENT_UNDECIDED;
    return code;
}

imp_code survey_parts_ask(survey_parts *p, size_t k, imp_error *error)
{
    question q;
    imp_code code = make_question(p, k, &q);
    if (code == IMP_SUCCESS)
        code = p->asked != NULL && p->asked->within > 0 ? ask_within(p, k, &q, error)
                                                        : ask(p, k, &q, error);
    else
        error->code = code;
    free(q.lo);
    return code;
}

bool survey_parts_are_over(const survey_parts *p)
{
    return interrupt_came() || clock_seconds() >= p->until;
}

/* --- Telling ---------------------------------------------------------------------------------- */

static survey_told told_of(const survey_parts *p, size_t k)
{
    return p->asked != NULL ? survey_told_of_clearance(&p->nearest[k])
                            : survey_told_of_contact(&p->results[k]);
}

int survey_parts_set_json(json_t *object, const survey_parts *p, size_t k)
{
    return survey_answer_set_json(object, p->scene, &p->answers[k], told_of(p, k));
}

void survey_parts_print_values(const survey_parts *p, size_t k)
{
    if (p->answers[k].state.struct_size == 0 || !told_of(p, k).known) return;
    fputs(", at ", stdout);
    survey_answer_print_values(p->scene, p->answers[k].numbers);
}
