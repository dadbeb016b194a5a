/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/common/clock.h"
#include "tools/cli/clearance.h"
#include "tools/cli/explain.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/proof_output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

/* Pairs between two checks for finished answers: some milliseconds. */
#define STEP_PAIRS 2048

typedef struct measuring {
    const arguments *args;
    const imp_scene *scene;
    imp_query *query;
    imp_options options;
    imp_clearance_options asked;
    bool json, each, profile;
    double until;    /* seconds of the clock: the limit of time; INFINITY: none */
    double printing; /* seconds that slices have taken to print */
    clearance_table table;
    size_t beyond, not_examined; /* pairs of bodies of --each */
    explanation why;             /* of one search that is undecided; else empty */
    imp_stats stats;
} measuring;

/* --- Options and operands --------------------------------------------------------------------- */

/* Two operands are surfaces; a file beside something else is often a forgotten "--require". */
static exit_status check_operands(const arguments *args)
{
    if (args->operand_count < 2 || access(args->operands[0], F_OK) != 0) return EXIT_ANSWERED;
    return complain(EXIT_USAGE, args->verb->name,
                    "'%.200s' is a file, which is asked about alone, and '%.100s' is left over; "
                    "--require 2 asks for a distance, and two operands are surfaces",
                    args->operands[0], args->operands[1]);
}

static double required_of(const arguments *args) { return arguments_number(args, "require", 0); }

static exit_status check(const arguments *args)
{
    const exit_status operands = check_operands(args);
    if (operands != EXIT_ANSWERED) return operands;
    const option_value *profile = arguments_option(args, "profile");
    if (profile != NULL && profile->count == 0)
        return complain(EXIT_USAGE, args->verb->name, "--profile must be at least 1, not '%s'",
                        profile->text);
    if (arguments_option(args, "proof") != NULL &&
        (profile != NULL || arguments_option(args, "each") != NULL))
        return complain(EXIT_USAGE, args->verb->name, "--proof and --%s exclude each other",
                        profile != NULL ? "profile" : "each");
    if (profile != NULL && arguments_option(args, "each") != NULL)
        return complain(EXIT_USAGE, args->verb->name, "--each and --profile exclude each other");
    if (arguments_option(args, "threads") != NULL && arguments_option(args, "each") == NULL)
        return complain(EXIT_USAGE, args->verb->name, "--threads belongs to --each");
    if (arguments_option(args, "within") != NULL && arguments_option(args, "each") == NULL)
        return complain(EXIT_USAGE, args->verb->name, "--within belongs to --each");
    if (arguments_number(args, "within", INFINITY) < required_of(args))
        return complain(EXIT_USAGE, args->verb->name,
                        "--within must be at least what --require asks for, %.10g, not %.10g",
                        required_of(args), arguments_number(args, "within", 0));
    return EXIT_ANSWERED;
}

static imp_clearance_options asked_for(const arguments *args)
{
    imp_clearance_options asked = imp_clearance_options_default();
    const option_value *tolerance = arguments_option(args, "tolerance");
    const option_value *profile = arguments_option(args, "profile");
    if (tolerance != NULL) asked.tolerance = tolerance->number[0];
    asked.required = required_of(args);
    asked.decide = tolerance == NULL && profile == NULL;
    if (profile != NULL) asked.slices = profile->count;
    asked.within = arguments_number(args, "within", 0);
    return asked;
}

/* --- While it runs ---------------------------------------------------------------------------- */

static exit_status tell_slice(const measuring *m, const imp_clearance *slice)
{
    if (m->json) return output_json(clearance_slice_json(m->scene, slice), m->args->verb->name);
    clearance_print_csv(m->scene, slice);
    return EXIT_ANSWERED;
}

/* Adds the next answer to the table. */
static exit_status take_answer(measuring *m)
{
    m->table.count += 1;
    const imp_clearance answer = clearance_table_get(&m->table, m->table.count - 1);
    return m->profile ? tell_slice(m, &answer) : EXIT_ANSWERED;
}

/* Whether the answer is final: it is not running, and no limit has ended it. */
static bool is_there(const imp_clearance *answer)
{
    return answer->reason != IMP_REASON_RUNNING &&
           (answer->reason == IMP_REASON_RESOLUTION || !clearance_is_ended(answer->reason));
}

/* Slices that are printed as JSON are printed once more at the end. */
static bool is_over(const measuring *m)
{
    return interrupt_came() || clock_seconds() + (m->json ? m->printing : 0) >= m->until;
}

/* Takes the finished answers, as long as there is time. */
static exit_status take_answers(measuring *m)
{
    enum { ANSWERS_A_LOOK = 64 };
    const double start = clock_seconds() - m->printing;
    const size_t count = imp_clearance_count(m->query);
    exit_status status = EXIT_ANSWERED;
    while (status == EXIT_ANSWERED && m->table.count < count) {
        const imp_clearance next = clearance_table_get(&m->table, m->table.count);
        if (!is_there(&next)) break;
        if (m->table.count % ANSWERS_A_LOOK == ANSWERS_A_LOOK - 1 && is_over(m)) break;
        status = take_answer(m);
        m->printing = clock_seconds() - start;
    }
    return status == EXIT_ANSWERED ? output_flush(m->args->verb->name) : status;
}

/* Takes the rest after a limit or a signal: the current answer, and one for all that follow. */
static exit_status take_rest(measuring *m)
{
    const size_t count = imp_clearance_count(m->query);
    exit_status status = EXIT_ANSWERED;
    if (m->table.count == count) return EXIT_ANSWERED;
    imp_clearance next = clearance_table_get(&m->table, m->table.count);
    if (next.stats.pairs > 0 || next.lower > 0) status = take_answer(m);
    if (status != EXIT_ANSWERED || m->table.count == count) return status;
    next = clearance_table_get(&m->table, m->table.count);
    const double required = required_of(m->args);
    m->table.has_rest = true;
    m->table.rest =
        (imp_clearance){.reason = m->table.ended,
                        .verdict = required > 0 ? IMP_REQUIREMENT_UNDECIDED : IMP_REQUIREMENT_NONE,
                        .t_start = next.t_start,
                        .t_end = m->options.t_end,
                        .required = required,
                        .body = {SIZE_MAX, SIZE_MAX},
                        .upper = INFINITY,
                        .t = NAN,
                        .t_violated = NAN};
    return take_answer(m);
}

static exit_status run_query(measuring *m)
{
    imp_error error = {0};
    imp_reason reason = IMP_REASON_RUNNING;
    exit_status status = EXIT_ANSWERED;
    while (reason == IMP_REASON_RUNNING && status == EXIT_ANSWERED && !is_over(m)) {
        if (imp_query_step(m->query, STEP_PAIRS, &error) != IMP_SUCCESS)
            return complain_of(&error, m->args->verb->name);
        reason = imp_query_result(m->query).reason;
        status = take_answers(m);
    }
    const bool is_ended = reason != IMP_REASON_RUNNING && reason != IMP_REASON_NONE;
    m->table.ended = interrupt_came() ? IMP_REASON_CANCELLED
                     : is_ended       ? reason
                                      : IMP_REASON_SECONDS;
    return status == EXIT_ANSWERED ? take_rest(m) : status;
}

/* --- At the end ------------------------------------------------------------------------------- */

/* Returns the summary without any answer: with --each, if all pairs are ignored. */
static imp_clearance nothing(const measuring *m)
{
    const double required = required_of(m->args);
    return (imp_clearance){.reason = IMP_REASON_NO_PAIRS,
                           .verdict = required > 0 ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_NONE,
                           .t_start = m->options.t_start,
                           .t_end = m->options.t_end,
                           .required = required,
                           .body = {SIZE_MAX, SIZE_MAX},
                           .lower = INFINITY,
                           .upper = INFINITY,
                           .t = NAN,
                           .t_violated = NAN};
}

static json_t *whole_json(const measuring *m, const imp_clearance *all)
{
    json_t *object = clearance_json(m->scene, all);
    int failed = json_object_set_new(object, "scene", query_scene_json(m->args));
    if (arguments_option(m->args, "within") != NULL)
        failed |= json_object_set_new(object, "beyond", json_integer((json_int_t)m->beyond));
    if (m->not_examined > 0)
        failed |=
            json_object_set_new(object, "not_examined", json_integer((json_int_t)m->not_examined));
    if (object != NULL) failed |= !result_set_warnings(object, m->scene);
    if (object != NULL) failed |= !explain_set_json(object, m->scene, &m->why);
    if (!failed) return object;
    json_decref(object);
    return NULL;
}

static exit_status print(const measuring *m, const imp_clearance *all)
{
    const char *speaker = m->args->verb->name;
    if (m->json && (m->profile || m->each))
        return clearance_print_json(whole_json(m, all), &m->table, m->profile, speaker);
    if (m->json) return output_json(whole_json(m, all), speaker);
    if (m->profile) return EXIT_ANSWERED;
    clearance_print(m->scene, all, m->options.gamma);
    explain_print(m->scene, &m->why);
    if (m->each && m->table.count > 0) clearance_print_pairs(&m->table);
    if (m->beyond > 0)
        printf("never within %.10g: %zu pairs of bodies\n", m->asked.within, m->beyond);
    if (m->not_examined > 0) printf("not examined: %zu pairs of bodies\n", m->not_examined);
    return output_flush(speaker);
}

/* Prints the answers. `told` is the table, or the table with one more answer, for pairs that are
 * not listed. */
static exit_status conclude(const measuring *m, const clearance_table *told)
{
    imp_clearance all = told->count > 0 ? clearance_summary(told) : nothing(m);
    all.stats = m->stats;
    const exit_status status = print(m, &all);
    return status != EXIT_ANSWERED ? status : clearance_status(&all);
}

static exit_status measure_each(measuring *m)
{
    imp_error error = {0};
    json_object_seed(0); /* before there are threads */
    const clearance_each of = {.scene = m->scene,
                               .query = m->query,
                               .required = m->asked.required,
                               .within = m->asked.within,
                               .threads = query_threads(m->args),
                               .max_bytes = m->options.max_bytes,
                               .until = m->until};
    clearance_answers found;
    const imp_code code = clearance_each_run(&of, &found, &error);
    m->beyond = found.beyond, m->not_examined = found.not_examined, m->stats = found.stats;
    clearance_sort(found.list, found.count);
    m->table.answers = found.list, m->table.count = found.count;
    m->table.advice = found.advice, m->table.advice_count = found.advice_count;
    clearance_table told = m->table;
    told.count += found.has_rest;
    const exit_status status =
        code == IMP_SUCCESS ? conclude(m, &told) : complain_of(&error, m->args->verb->name);
    clearance_answers_free(&found);
    return status;
}

/* Keeps the advice about a search that a limit ended. */
static exit_status explain(measuring *m)
{
    const imp_clearance all = m->table.count > 0 ? clearance_summary(&m->table) : nothing(m);
    const explain_goal goal = explain_goal_of(all.verdict);
    if (!clearance_is_undecided(&all)) return EXIT_ANSWERED;
    return explain_query(m->query, all.reason, goal, &m->why)
               ? EXIT_ANSWERED
               : complain_of_memory(m->args->verb->name);
}

static exit_status measure(measuring *m)
{
    if (m->profile && !m->json) clearance_print_csv_head();
    exit_status status = run_query(m);
    m->stats = imp_query_result(m->query).stats;
    if (status == EXIT_ANSWERED) status = proof_output_write(m->query, m->scene, m->args);
    if (status == EXIT_ANSWERED) status = explain(m);
    if (status == EXIT_ANSWERED) status = conclude(m, &m->table);
    explain_free(&m->why);
    return status;
}

static exit_status measure_scene(imp_scene *scene, const arguments *args)
{
    imp_error error = {0};
    if (survey_is_needed(scene, args)) {
        const imp_clearance_options asked = asked_for(args);
        return survey_clearance(scene, &asked, args);
    }
    const imp_options options = query_options(scene, args);
    measuring m = {.args = args,
                   .scene = scene,
                   .options = options,
                   .asked = asked_for(args),
                   .until =
                       options.max_seconds > 0 ? clock_seconds() + options.max_seconds : INFINITY,
                   .json = arguments_option(args, "json") != NULL,
                   .each = arguments_option(args, "each") != NULL,
                   .profile = arguments_option(args, "profile") != NULL};
    m.query = imp_clearance_new(scene, &options, &m.asked, &error);
    if (m.query == NULL) return complain_of(&error, args->verb->name);
    m.table = (clearance_table){.scene = scene, .query = m.query, .ended = IMP_REASON_RUNNING};
    exit_status status = proof_output_begin(m.query, args);
    if (status == EXIT_ANSWERED) status = m.each ? measure_each(&m) : measure(&m);
    imp_query_free(m.query);
    return status;
}

static exit_status run(const arguments *args)
{
    const exit_status checked = check(args);
    if (checked != EXIT_ANSWERED) return checked;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    imp_error error = {0};
    bool complained;
    imp_scene *scene = query_scene(registry, args, &complained, &error);
    exit_status status = EXIT_DATA;
    interrupt_prepare();
    if (scene != NULL)
        status = measure_scene(scene, args);
    else if (!complained)
        status = complain_of(&error, args->verb->name);
    imp_scene_free(scene);
    query_registry_free(registry);
    return status;
}

static const option clearance_options[] = {
    {.name = "tolerance",
     .kind = OPTION_NUMBER,
     .argument = "R",
     .min = 1e-9,
     .help = "done when upper - lower is at most R times upper; below 1 (1e-3)"},
    {.name = "require",
     .kind = OPTION_NUMBER,
     .argument = "DISTANCE",
     .min_open = true,
     .help = "say whether bodies always stay so far apart; exit 0, 1 or 3"},
    {.name = "each", .help = "measure each pair of bodies that do not ignore each other"},
    {.name = "within",
     .kind = OPTION_NUMBER,
     .argument = "DISTANCE",
     .min_open = true,
     .help = "with --each: only count the pairs of bodies that never come nearer than this"},
    {.name = "threads",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "with --each: N threads; the answers are the same (all processors)"},
    {.name = "profile",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "measure N equal slices of time, as CSV or, with --json, JSON lines"},
    {.name = NULL}};

static const option *const tables[] = {
    clearance_options, options_parameters, options_survey, options_proof,
    options_search,    options_registry,   options_always, NULL};

const verb verb_clearance = {
    .name = "clearance",
    .operands = "SCENE | A B",
    .summary = "Find how near bodies come, with proof",
    .details =
        "The minimum distance over the interval and over all pairs of bodies of a scene file\n"
        "('-': standard input), or of two pipelines as of `impinge pair`. The answer is a "
        "bracket:\n"
        "nearer than its lower end bodies never come, which is proved; its upper end is the\n"
        "distance of two points of them at one time. What is no farther apart than gamma touches.\n"
        "\n"
        "Where a scene has parameters the answer is about all their values.\n"
        "\n"
        "--require D answers holds, violated, with the earliest time, or undecided. It ends as "
        "soon\n"
        "as that is known, with the bracket as it is then; with --tolerance or --profile it goes "
        "on.\n"
        "Where the minimum lies between D (1 - 1e-6) and D, both holds and violated are right.\n",
    .example = "impinge clearance 'sphere' 'sphere center=-3,3,0 ! translate velocity=6,0,0' \\\n"
               "               --require 0.9",
    .operand_min = 1,
    .operand_max = 2,
    .options = tables,
    .run = run};
