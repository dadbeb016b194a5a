/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>

#include "core/common/clock.h"
#include "tools/cli/each_internal.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/query.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

/* solve --each: what answers each pair of bodies: a part of a divided query or, in a scene with
 * parameters, a survey. */

static void take(void *context, size_t index, imp_query *part)
{
    const each *e = context;
    e->answers[index] = imp_query_result(part);
    e->advice[index] = query_advice(e->scene, part);
}

bool each_is_over(const each *e) { return interrupt_came() || clock_seconds() >= e->until; }

static bool is_over(void *context) { return each_is_over(context); }

/* The parts of a scene with parameters. */
static exit_status begin_surveys(each *e, imp_scene *scene, const arguments *args, size_t threads)
{
    exit_status status = survey_check(args);
    if (status != EXIT_ANSWERED) return status;
    e->survey = calloc(1, sizeof *e->survey);
    if (e->survey == NULL) return complain_of_memory(args->verb->name);
    status = survey_parts_each(e->survey, scene, NULL, args, threads);
    if (status == EXIT_ANSWERED) e->plan.count = e->survey->count;
    return status;
}

/* The parts of a query that is divided. */
static exit_status begin_queries(each *e, imp_scene *scene, const arguments *args, size_t threads)
{
    imp_error error = {0};
    imp_options options = query_options(scene, args);
    query_lend_threads(&options, &e->crew);
    e->plan = (parts_plan){.whole = imp_query_new(scene, &options, &error),
                           .threads = threads,
                           .take = take,
                           .is_over = is_over,
                           .context = e};
    if (e->plan.whole == NULL ||
        imp_query_divide(e->plan.whole, &e->plan.count, &error) != IMP_SUCCESS)
        return complain_of(&error, args->verb->name);
    return EXIT_ANSWERED;
}

exit_status each_begin(each *e, imp_scene *scene, const arguments *args, size_t threads)
{
    const double limit = query_options(scene, args).max_seconds, now = clock_seconds();
    json_object_seed(0); /* before there are threads */
    *e = (each){.args = args,
                .scene = scene,
                .crew = {threads},
                .until = limit > 0 ? now + limit : INFINITY,
                .until_listed = limit > 0 ? now + 1.1 * limit + 0.1 : INFINITY};
    const bool is_survey = imp_scene_parameter_count(scene) > 0;
    const exit_status status =
        is_survey ? begin_surveys(e, scene, args, threads) : begin_queries(e, scene, args, threads);
    if (status != EXIT_ANSWERED) return status;
    e->advice = calloc(e->plan.count + 1, sizeof *e->advice);
    e->answers = is_survey ? e->survey->results : calloc(e->plan.count + 1, sizeof *e->answers);
    return e->answers != NULL && e->advice != NULL ? EXIT_ANSWERED
                                                   : complain_of_memory(args->verb->name);
}

imp_code each_solve_part(each *e, size_t k, imp_error *error)
{
    return e->survey != NULL ? survey_parts_ask(e->survey, k, error)
                             : parts_solve(&e->plan, k, error);
}

bool each_part_bodies(const each *e, size_t k, size_t body[2])
{
    if (e->survey == NULL) return imp_query_part_bodies(e->plan.whole, k, body);
    if (k >= e->survey->count) return false;
    body[0] = e->survey->bodies[k][0], body[1] = e->survey->bodies[k][1];
    return true;
}

void each_end(each *e)
{
    for (size_t k = 0; e->advice != NULL && k < e->plan.count; ++k) free(e->advice[k]);
    free(e->advice);
    if (e->survey != NULL)
        survey_parts_end(e->survey); /* frees the answers */
    else
        free(e->answers);
    free(e->survey);
    imp_query_free(e->plan.whole);
}

imp_result each_answer_of_rest(const each *e)
{
    if (e->survey == NULL) return imp_query_result(e->plan.whole);
    const imp_options *o = &e->survey->options;
    return (imp_result){.struct_size = (uint32_t)sizeof(imp_result),
                        .verdict = IMP_VERDICT_CLEAR,
                        .reason = IMP_REASON_NONE,
                        .t = NAN,
                        .gap = NAN,
                        .t_lower = o->t_end,
                        .t_start = o->t_start,
                        .t_end = o->t_end,
                        .gamma = o->gamma,
                        .gamma_clear = o->gamma_clear < 0 ? 0.5 * o->gamma : o->gamma_clear,
                        .t_examined = {NAN, NAN}};
}
