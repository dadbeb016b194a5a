/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/survey.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/clearance.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/survey_boxes.h"
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

exit_status survey_check(const arguments *args)
{
    static const char *const others[] = {"each",    "refine", "explain", "proof",
                                         "profile", "within", NULL};
    for (size_t k = 0; others[k] != NULL; ++k)
        if (arguments_option(args, others[k]) != NULL)
            return complain(
                EXIT_USAGE, args->verb->name,
                "--%s does not go with the parameters that the scene has; ask without it",
                others[k]);
    if (arguments_choice(args, "method", 0) != 0)
        return complain(EXIT_USAGE, args->verb->name, "%s", without_paper);
    return EXIT_ANSWERED;
}

/* --- An answer -------------------------------------------------------------------------------- */

typedef struct survey_run {
    imp_scene *scene;
    const arguments *args;
    imp_survey *survey;
    imp_survey_state state;
    double *values, *lo, *hi; /* one block */
    bool has_values;
} survey_run;

static json_t *values_json(const imp_scene *scene, const double *values)
{
    imp_scene_parameter_info info;
    json_t *object = json_object();
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        if (json_object_set_new(object, info.name, output_json_number(values[k])) != 0)
            return json_decref(object), NULL;
    return object;
}

/* What stands beside an answer as JSON. `known`: the values are those of the answer. */
static int set_state(json_t *object, const survey_run *r, bool known, bool undecided)
{
    int failed = json_object_set_new(object, "boxes", json_integer((json_int_t)r->state.boxes));
    failed |= json_object_set_new(object, "parameters",
                                  known ? values_json(r->scene, r->values) : json_null());
    if (object != NULL) failed |= !result_set_warnings(object, r->scene);
    if (!undecided) return failed;
    failed |= json_object_set_new(object, "proved", output_json_number(r->state.proved));
    if (r->state.has_worst)
        failed |= json_object_set_new(
            object, "worst",
            json_pack("{s:o, s:o, s:o}", "parameters", survey_ranges_json(r->scene, r->lo, r->hi),
                      "time", result_times_json(r->state.worst_time[0], r->state.worst_time[1]),
                      "bodies", survey_bodies_json(r->scene, r->state.worst_body)));
    if (r->has_values && !known)
        failed |=
            json_object_set_new(object, "known",
                                json_pack("{s:o, s:o}", "t", output_json_number(r->state.t_upper),
                                          "parameters", values_json(r->scene, r->values)));
    return failed;
}

static exit_status print_json(const survey_run *r, json_t *object, bool known, bool undecided)
{
    if (object != NULL && (json_object_set_new(object, "scene", query_scene_json(r->args)) != 0 ||
                           set_state(object, r, known, undecided) != 0)) {
        json_decref(object);
        object = NULL;
    }
    return output_json(object, r->args->verb->name);
}

static void print_values(const survey_run *r, const char *label)
{
    imp_scene_parameter_info info;
    result_print_label(label);
    for (size_t k = 0; imp_scene_parameter(r->scene, k, &info); ++k)
        printf("%s%s = %.10g", k > 0 ? ", " : "", message_shown(info.name).text, r->values[k]);
    putchar('\n');
}

static void print_ranges(const survey_run *r, const char *label, const double *lo, const double *hi)
{
    imp_scene_parameter_info info;
    result_print_label(label);
    for (size_t k = 0; imp_scene_parameter(r->scene, k, &info); ++k)
        printf("%s%s from %.10g to %.10g", k > 0 ? ", " : "", message_shown(info.name).text, lo[k],
               hi[k]);
}

static exit_status print_text(const survey_run *r, bool known, bool undecided)
{
    if (known) print_values(r, "values");
    if (undecided) {
        result_print_label("share");
        printf("%s of all values and times is proved\n", output_number_lower(r->state.proved).text);
        if (r->state.has_worst) {
            print_ranges(r, "left", r->lo, r->hi);
            printf(", t from %.10g to %.10g\n", r->state.worst_time[0], r->state.worst_time[1]);
        }
        if (r->has_values && !known) {
            result_print_label("known");
            printf("a contact at t = %.10g, but an earlier one is not excluded\n",
                   r->state.t_upper);
            print_values(r, "values");
        }
    }
    result_print_label("boxes");
    printf("%ju\n", (uintmax_t)r->state.boxes);
    return output_flush(r->args->verb->name);
}

static exit_status tell_contact(const survey_run *r)
{
    imp_result result = {.struct_size = (uint32_t)sizeof result};
    imp_survey_get_result(r->survey, &result, NULL);
    const bool known = result.verdict == IMP_VERDICT_CONTACT;
    const bool undecided = result.verdict == IMP_VERDICT_UNDECIDED;
    exit_status status;
    if (arguments_option(r->args, "json") != NULL) {
        status = print_json(r, result_json(r->scene, &result), known, undecided);
    } else {
        result_print(r->scene, &result);
        status = print_text(r, known, undecided);
    }
    return status != EXIT_ANSWERED ? status : query_status(&result, r->args);
}

static exit_status tell_clearance(const survey_run *r)
{
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    imp_survey_get_clearance(r->survey, &answer, NULL);
    const exit_status verdict = clearance_status(&answer);
    const bool known = answer.has_witness, undecided = verdict == EXIT_UNDECIDED;
    exit_status status;
    if (arguments_option(r->args, "json") != NULL) {
        status = print_json(r, clearance_json(r->scene, &answer), known, undecided);
    } else {
        clearance_print(r->scene, &answer, query_options(r->scene, r->args).gamma);
        status = print_text(r, known, undecided);
    }
    return status != EXIT_ANSWERED ? status : verdict;
}

/* --- Running ---------------------------------------------------------------------------------- */

static imp_code find_answer(survey_run *r, const imp_options *options,
                            const imp_survey_options *how, const imp_clearance_options *asked,
                            imp_error *error)
{
    const size_t count = imp_scene_parameter_count(r->scene);
    r->values = calloc(3 * count + 1, sizeof *r->values);
    if (r->values == NULL) return error->code = IMP_ERROR_MEMORY;
    r->lo = r->values + count, r->hi = r->lo + count;
    r->survey = imp_survey_new(r->scene, options, asked, how, error);
    if (r->survey == NULL || imp_survey_step(r->survey, 0, error) != IMP_SUCCESS)
        return error->code;
    progress_wipe();
    r->state = (imp_survey_state){.struct_size = (uint32_t)sizeof r->state};
    imp_survey_get_state(r->survey, &r->state, NULL);
    r->has_values = imp_survey_values(r->survey, r->values);
    imp_survey_worst(r->survey, r->lo, r->hi);
    return IMP_SUCCESS;
}

static exit_status run_to_end(survey_run *r, const imp_survey_options *how,
                              const imp_clearance_options *asked)
{
    imp_error error = {0};
    imp_options options = query_options(r->scene, r->args);
    crew threads = {query_threads_asked(r->args)};
    query_lend_threads(&options, &threads);
    return find_answer(r, &options, how, asked, &error) == IMP_SUCCESS
               ? EXIT_ANSWERED
               : complain_of(&error, r->args->verb->name);
}

static exit_status run(imp_scene *scene, const imp_clearance_options *asked, const arguments *args)
{
    survey_run r = {.scene = scene, .args = args};
    imp_survey_options how = imp_survey_options_default();
    survey_boxes boxes;
    exit_status status = survey_check(args);
    if (status != EXIT_ANSWERED) return status;
    how.max_boxes = arguments_count(args, "max-boxes", 0);
    status = survey_boxes_begin(&boxes, scene, &how, args);
    if (status == EXIT_ANSWERED) status = run_to_end(&r, &how, asked);
    status = survey_boxes_end(&boxes, r.survey, status);
    if (status == EXIT_ANSWERED) status = asked != NULL ? tell_clearance(&r) : tell_contact(&r);
    imp_survey_free(r.survey);
    free(r.values);
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
        *answer = result_json(scene, result);
        if (*answer != NULL && set_state(*answer, &r, result->verdict == IMP_VERDICT_CONTACT,
                                         result->verdict == IMP_VERDICT_UNDECIDED) != 0) {
            json_decref(*answer);
            *answer = NULL;
        }
    }
    imp_survey_free(r.survey);
    free(r.values);
    return code;
}

exit_status survey_contact(imp_scene *scene, const arguments *args)
{
    interrupt_prepare();
    return run(scene, NULL, args);
}

exit_status survey_clearance(imp_scene *scene, const imp_clearance_options *asked,
                             const arguments *args)
{
    return run(scene, asked, args);
}
