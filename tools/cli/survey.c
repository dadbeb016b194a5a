/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/survey.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/clearance.h"
#include "tools/cli/clearance_measure.h"
#include "tools/cli/each.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/proof_output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/series.h"
#include "tools/cli/survey_answer.h"
#include "tools/cli/survey_boxes.h"
#include "tools/cli/survey_explain.h"
#include "tools/cli/verbs.h"

const option options_survey[] = {
    {.name = "boxes",
     .kind = OPTION_TEXT,
     .argument = "FILE",
     .help = "write the boxes of parameter values that are proved, and those left, a line each"},
    {.name = "resume",
     .kind = OPTION_TEXT,
     .argument = "FILE",
     .help = "go on from the boxes of FILE, which --boxes or --resume of an earlier run wrote"},
    {.name = "max-boxes",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "ask about at most N boxes of parameter values; 0: no limit (0)"},
    {.name = NULL}};

/* --- Whether it can be answered --------------------------------------------------------------- */

bool survey_is_needed(const imp_scene *scene, const arguments *args)
{
    imp_scene_parameter_info info;
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        if (!info.is_followed)
            remark(args->verb->name,
                   "warning: no surface or map has the parameter '%s' as its clock",
                   message_shown(info.name).text);
    if (imp_scene_parameter_count(scene) > 0) return true;
    for (const option *row = options_survey; row->name != NULL; ++row)
        if (arguments_option(args, row->name) != NULL)
            remark(args->verb->name, "warning: --%s does nothing: the scene has no parameters",
                   row->name);
    return false;
}

static const char without_paper[] =
    "--method paper does not go with the parameters that the scene has";

static imp_code refuse_paper(imp_error *error)
{
    snprintf(error->text, sizeof error->text, "%s", without_paper);
    return IMP_ERROR_USAGE;
}

/* Options that ask several questions, and what to do for the boxes of one. */
static const struct several {
    const char *option, *cure;
} several[] = {
    {"each", "without --each each box names its two bodies"},
    {"profile", "give the --time, or the --parameter, of one slice"},
    {"refine", "give the last --gamma"},
};

static exit_status refuse_several(const arguments *args)
{
    static const char *const files[] = {"boxes", "resume"};
    for (size_t k = 0; k < sizeof several / sizeof *several; ++k)
        for (size_t i = 0; i < sizeof files / sizeof *files; ++i)
            if (arguments_option(args, several[k].option) != NULL &&
                arguments_option(args, files[i]) != NULL)
                return complain(EXIT_USAGE, args->verb->name,
                                "--%s and --%s exclude each other, since the boxes of a file are "
                                "those of one search; %s",
                                several[k].option, files[i], several[k].cure);
    return EXIT_ANSWERED;
}

exit_status survey_check(const arguments *args)
{
    const exit_status status = refuse_several(args);
    if (status != EXIT_ANSWERED) return status;
    if (arguments_choice(args, "method", 0) != 0)
        return complain(EXIT_USAGE, args->verb->name, "%s", without_paper);
    return EXIT_ANSWERED;
}

/* --- An answer -------------------------------------------------------------------------------- */

typedef struct survey_run {
    imp_scene *scene;
    const arguments *args;
    imp_survey *survey;
    survey_answer answer;
} survey_run;

static survey_explaining explaining(const survey_run *r, survey_told told)
{
    return (survey_explaining){.table = arguments_option(r->args, "explain") != NULL,
                               .advice = told.undecided,
                               .goal = told.goal};
}

/* Adds what stands beside an answer as JSON; NULL: no memory. */
static json_t *completed(const survey_run *r, json_t *object, survey_told told)
{
    if (object == NULL) return NULL;
    if (survey_answer_set_json(object, r->scene, &r->answer, told) == 0 &&
        result_set_warnings(object, r->scene) &&
        survey_explain_set_json(object, r->scene, r->survey, explaining(r, told)))
        return object;
    json_decref(object);
    return NULL;
}

static exit_status print_json(const survey_run *r, json_t *object, survey_told told)
{
    object = completed(r, object, told);
    if (object != NULL && json_object_set_new(object, "scene", query_scene_json(r->args)) != 0) {
        json_decref(object);
        object = NULL;
    }
    return output_json(object, r->args->verb->name);
}

static exit_status print_text(const survey_run *r, survey_told told)
{
    survey_answer_print(r->scene, &r->answer, told);
    if (!survey_explain_print(r->scene, r->survey, explaining(r, told)))
        return complain_of_memory(r->args->verb->name);
    return output_flush(r->args->verb->name);
}

static exit_status tell_contact(const survey_run *r)
{
    imp_result result = {.struct_size = (uint32_t)sizeof result};
    imp_survey_get_result(r->survey, &result, NULL);
    const survey_told told = survey_told_of_contact(&result);
    exit_status status;
    if (arguments_option(r->args, "json") != NULL) {
        status = print_json(r, result_json(r->scene, &result), told);
    } else {
        result_print(r->scene, &result);
        status = print_text(r, told);
    }
    return status != EXIT_ANSWERED ? status : query_status(&result, r->args);
}

static exit_status tell_clearance(const survey_run *r)
{
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    imp_survey_get_clearance(r->survey, &answer, NULL);
    const exit_status verdict = clearance_status(&answer);
    const survey_told told = survey_told_of_clearance(&answer);
    exit_status status;
    if (arguments_option(r->args, "json") != NULL) {
        status = print_json(r, clearance_json(r->scene, &answer), told);
    } else {
        clearance_print(r->scene, &answer, query_options(r->scene, r->args).gamma);
        status = print_text(r, told);
    }
    return status != EXIT_ANSWERED ? status : verdict;
}

/* --- Running ---------------------------------------------------------------------------------- */

static imp_code step(survey_run *r, imp_error *error)
{
    const imp_code code = imp_survey_step(r->survey, 0, error);
    if (code != IMP_SUCCESS) return error->code = code;
    progress_wipe();
    survey_answer_read(r->scene, r->survey, &r->answer);
    return code;
}

static imp_code begin(survey_run *r, const imp_options *options, const imp_survey_options *how,
                      const imp_clearance_options *asked, imp_error *error)
{
    r->answer.numbers = calloc(survey_answer_room(r->scene), sizeof *r->answer.numbers);
    if (r->answer.numbers == NULL) return error->code = IMP_ERROR_MEMORY;
    r->survey = imp_survey_new(r->scene, options, asked, how, error);
    return r->survey != NULL ? IMP_SUCCESS : error->code;
}

static imp_code find_answer(survey_run *r, const imp_options *options,
                            const imp_survey_options *how, const imp_clearance_options *asked,
                            imp_error *error)
{
    const imp_code code = begin(r, options, how, asked, error);
    return code == IMP_SUCCESS ? step(r, error) : code;
}

static void run_end(survey_run *r)
{
    imp_survey_free(r->survey);
    free(r->answer.numbers);
}

static exit_status run_to_end(survey_run *r, const imp_survey_options *how,
                              const imp_clearance_options *asked)
{
    imp_error error = {0};
    imp_options options = query_options(r->scene, r->args);
    crew threads = {query_threads_asked(r->args)};
    query_lend_threads(&options, &threads);
    if (begin(r, &options, how, asked, &error) != IMP_SUCCESS)
        return complain_of(&error, r->args->verb->name);
    const exit_status status = proof_output_begin_survey(r->survey, r->args);
    if (status != EXIT_ANSWERED) return status;
    if (step(r, &error) != IMP_SUCCESS) return complain_of(&error, r->args->verb->name);
    return proof_output_write_survey(r->survey, r->scene, r->args);
}

static exit_status run(imp_scene *scene, const imp_clearance_options *asked, const arguments *args)
{
    survey_run r = {.scene = scene, .args = args};
    imp_survey_options how = imp_survey_options_default();
    survey_boxes boxes;
    how.max_boxes = arguments_count(args, "max-boxes", 0);
    exit_status status = survey_boxes_begin(&boxes, scene, &how, args);
    if (status == EXIT_ANSWERED) status = run_to_end(&r, &how, asked);
    status = survey_boxes_end(&boxes, r.survey, status);
    if (status == EXIT_ANSWERED) status = asked != NULL ? tell_clearance(&r) : tell_contact(&r);
    run_end(&r);
    return status;
}

/* Answers at each gamma; an undecided answer is the last. */
static exit_status tell_refined(survey_run *r)
{
    const char *text = arguments_option(r->args, "refine")->text;
    imp_error error = {0};
    exit_status status = tell_contact(r);
    series_next_gamma(&text, INFINITY);
    while ((status == EXIT_ANSWERED || status == EXIT_CONTACT) && *text != '\0') {
        if (imp_survey_refine(r->survey, series_next_gamma(&text, INFINITY), -1, &error) !=
                IMP_SUCCESS ||
            step(r, &error) != IMP_SUCCESS)
            return complain_of(&error, r->args->verb->name);
        status = tell_contact(r);
    }
    return status;
}

static exit_status run_refined(imp_scene *scene, const arguments *args)
{
    survey_run r = {.scene = scene, .args = args};
    imp_survey_options how = imp_survey_options_default();
    imp_options options = query_options(scene, args);
    crew threads = {query_threads_asked(args)};
    imp_error error = {0};
    const char *text = arguments_option(args, "refine")->text;
    query_lend_threads(&options, &threads);
    options.gamma = series_next_gamma(&text, INFINITY);
    options.gamma_clear = -1;
    how.max_boxes = arguments_count(args, "max-boxes", 0);
    const exit_status status = find_answer(&r, &options, &how, NULL, &error) == IMP_SUCCESS
                                   ? tell_refined(&r)
                                   : complain_of(&error, args->verb->name);
    run_end(&r);
    return status;
}

imp_code survey_solve(imp_scene *scene, const arguments *args, imp_result *result, json_t **answer,
                      imp_error *error)
{
    survey_run r = {.scene = scene, .args = args};
    const imp_options options = query_options(scene, args);
    if (arguments_choice(args, "method", 0) != 0) return error->code = refuse_paper(error);
    const imp_code code = find_answer(&r, &options, NULL, NULL, error);
    if (code == IMP_SUCCESS) {
        *result = (imp_result){.struct_size = (uint32_t)sizeof *result};
        imp_survey_get_result(r.survey, result, NULL);
        *answer = completed(&r, result_json(scene, result), survey_told_of_contact(result));
    }
    run_end(&r);
    return code;
}

exit_status survey_contact(imp_scene *scene, const arguments *args)
{
    const exit_status status = survey_check(args);
    interrupt_prepare();
    if (status != EXIT_ANSWERED) return status;
    if (arguments_option(args, "each") != NULL) return each_answer(scene, args);
    return arguments_option(args, "refine") != NULL ? run_refined(scene, args)
                                                    : run(scene, NULL, args);
}

exit_status survey_clearance(imp_scene *scene, const imp_clearance_options *asked,
                             const arguments *args)
{
    const exit_status status = survey_check(args);
    if (status != EXIT_ANSWERED) return status;
    return arguments_option(args, "each") != NULL || arguments_option(args, "profile") != NULL
               ? clearance_survey(scene, asked, args)
               : run(scene, asked, args);
}
