/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/check/badge.h"
#include "tools/check/list.h"
#include "tools/check/operand.h"
#include "tools/check/report.h"
#include "tools/check/subject.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

/* Choices of --require, in their order. */
enum { REQUIRE_TESTED, REQUIRE_PROVED };
static const char *const required_labels[] = {"tested", "proved", NULL};

/* --- How -------------------------------------------------------------------------------------- */

typedef struct job {
    const arguments *args;
    const char *operand;
    operand_type type;
    double seconds;
    double effort;
    uint64_t seed;
    const option_value *formula, *domain; /* or NULL */
    const option_value *only;             /* NULL: all checks */
    bool in_process;
    uint64_t stop_at; /* the call of --call, or 0 */
    check_report report;
    operand_file *file; /* these are shared with children */
    survey *survey;
    check_answer *answer;
    check_misreading *misreading;
} job;

/* " --NAME VALUE", or nothing if it was not given. Free it. NULL: no memory. */
static char *option_again(const arguments *args, const char *name)
{
    const option_value *value = arguments_option(args, name);
    if (value == NULL) return strdup("");
    char *word = output_shell_word(value->text), *text = NULL;
    if (word != NULL && asprintf(&text, " --%s %s", name, word) < 0) text = NULL;
    free(word);
    return text;
}

/* The command line that repeats the run. Free it. NULL: no memory. */
static char *command_line(const job *j)
{
    static const char *const options[] = {"formula", "domain", "effort", "plugin-path"};
    char *operand = output_shell_word(j->operand), *line = NULL;
    if (operand == NULL ||
        asprintf(&line, "impinge check %s --seed %llu", operand, (unsigned long long)j->seed) < 0)
        line = NULL;
    free(operand);
    for (size_t k = 0; k < sizeof options / sizeof *options && line != NULL; ++k) {
        char *given = option_again(j->args, options[k]), *longer = NULL;
        if (given == NULL || asprintf(&longer, "%s%s", line, given) < 0) longer = NULL;
        free(given);
        free(line);
        line = longer;
    }
    return line;
}

/* The operand, if it has more than a type's name; else NULL. */
static const char *given_stage(const job *j)
{
    const char *type = j->type.name;
    return type[0] != '\0' && strcmp(j->operand, type) != 0 ? j->operand : NULL;
}

static const char *text_or_null(const option_value *value)
{
    return value != NULL ? value->text : NULL;
}

static bool is_wanted(const job *j, size_t check)
{
    return j->only == NULL || strcmp(check_names[check], check_names[j->only->choice]) == 0;
}

/* --- Running ---------------------------------------------------------------------------------- */

/* False after a hang, or a crash in create or destroy: every further check would fail too. */
static bool run_check(job *j, check_task *task, size_t check)
{
    task->check = check;
    progress_show("%s: %s", task->type != NULL ? task->type : j->file->file, check_names[check]);
    const child_fate fate = check_run(task, j->seconds, j->answer);
    progress_wipe();
    report_add(&j->report, check_names[check], check_is_of_bounds(check), j->answer);
    return fate.end == CHILD_DONE || (fate.end != CHILD_LATE && j->answer->call.stage[0] == '\0');
}

static void run_checks(job *j, check_task *task, bool of_file)
{
    bool go_on = true;
    for (size_t k = 0; go_on && check_names[k] != NULL; ++k) {
        if (check_is_of_file(k) != of_file || !is_wanted(j, k)) continue;
        go_on = run_check(j, task, k);
    }
}

static check_task task_of(const job *j)
{
    return (check_task){.file = j->file->file,
                        .seed = j->seed,
                        .effort = j->effort,
                        .in_process = j->in_process,
                        .stop_at = j->stop_at};
}

/* The example in the type's own table does not work: told once, not by every check. */
static void tell_example(job *j, const survey_type *t)
{
    *j->answer = (check_answer){.verdict = CHECK_PASS};
    answer_fail(j->answer, "the type's example does not work: %s", t->example_fault);
    report_add(&j->report, "example", false, j->answer);
}

static void run_type(job *j, const survey_type *t)
{
    check_task task = task_of(j);
    task.kind = t->kind;
    task.type = t->name;
    task.formula = text_or_null(j->formula);
    task.domain = text_or_null(j->domain);
    for (int k = 0; k < CHECK_STAGES; ++k) task.stage[k] = t->stage[k][0] ? t->stage[k] : NULL;
    if (given_stage(j) != NULL) {
        task.stage[0] = given_stage(j);
        task.stage[1] = NULL;
    }
    report_type(&j->report, t->kind, t->name, task.stage);
    if (t->example_fault[0] != '\0' && given_stage(j) == NULL) tell_example(j, t);
    if (task.stage[0] != NULL) run_checks(j, &task, false);
    report_type_end(&j->report);
}

static bool load(job *j)
{
    const child_fate fate = check_survey(j->file->file, j->seconds, j->survey);
    const survey *s = j->survey;
    *j->answer = (check_answer){.verdict = CHECK_PASS};
    if (fate.end != CHILD_DONE)
        answer_fail(j->answer, "the plugin %s when it was loaded or its types were tried",
                    fate_text_of(fate, j->seconds).text);
    else if (!s->is_taken)
        answer_fail(j->answer, "the host rejects it: %s", s->reason);
    else
        answer_pass(j->answer, "%s: %zu type%s", s->plugin, s->count, s->count == 1 ? "" : "s");
    report_add(&j->report, "load", false, j->answer);
    return j->answer->verdict == CHECK_PASS;
}

/* Parameters and formula of the user are read first, so that their errors are not reported as the
 * plugin's. */
static exit_status read_asked(job *j)
{
    const char *speaker = j->args->verb->name, *type = j->type.name;
    const check_task task = {.file = j->file->file,
                             .type = type[0] != '\0' ? type : NULL,
                             .stage = {given_stage(j)},
                             .formula = text_or_null(j->formula),
                             .domain = text_or_null(j->domain)};
    if (task.stage[0] == NULL && task.formula == NULL && task.domain == NULL) return EXIT_ANSWERED;
    check_try(&task, j->seconds, j->misreading);
    if (j->misreading->stage[0] != '\0')
        return complain(EXIT_DATA, speaker, "'%s': %s", j->operand, j->misreading->stage);
    if (j->misreading->formula[0] != '\0')
        return complain(EXIT_USAGE, speaker, "--formula cannot be read: %s",
                        j->misreading->formula);
    if (j->misreading->domain[0] != '\0')
        return complain(EXIT_USAGE, speaker, "--domain cannot be read: %s", j->misreading->domain);
    return EXIT_ANSWERED;
}

/* Writes the badge, and holds the label against the one that is required. */
static exit_status publish(const job *j)
{
    const char *speaker = j->args->verb->name;
    const option_value *badge = arguments_option(j->args, "badge");
    const option_value *required = arguments_option(j->args, "require");
    const badge_facts facts = {j->survey->name, j->survey->version, text_or_null(j->formula)};
    const char *label = badge_label(j->report.root);
    exit_status status = EXIT_ANSWERED;
    if (badge != NULL) status = badge_write(badge->text, j->report.root, &facts, speaker);
    if (status != EXIT_ANSWERED || required == NULL || strcmp(label, "proved") == 0) return status;
    if (required->choice == REQUIRE_TESTED && strcmp(label, "tested") == 0) return status;
    return complain(
        EXIT_CONFORMANCE, speaker, "--require %s: the plugin is %s%s", required->text, label,
        strcmp(label, "tested") == 0 ? ", not proved; state its formula with --formula 'X; Y; Z'"
                                     : "");
}

static exit_status run_all(job *j)
{
    if (!report_begin(&j->report, j->file->file, j->effort))
        return complain_of_memory(j->args->verb->name);
    if (load(j)) {
        check_task task = task_of(j);
        run_checks(j, &task, true);
        for (size_t k = 0; k < j->survey->count; ++k)
            if (j->type.name[0] == '\0' || strcmp(j->type.name, j->survey->type[k].name) == 0)
                run_type(j, &j->survey->type[k]);
    }
    const exit_status found = report_end(&j->report, j->args->verb->name);
    const exit_status published = publish(j);
    report_free(&j->report);
    return found > published ? found : published;
}

static exit_status find_and_run(job *j)
{
    const size_t name = strcspn(j->operand, OPERAND_BLANKS);
    exit_status status;
    if (operand_is_path(j->operand)) {
        status = operand_find_file(j->args, j->operand, j->file);
    } else {
        snprintf(j->type.name, sizeof j->type.name, "%.*s", name < 79 ? (int)name : 79, j->operand);
        status = operand_find_type(j->args, &j->type, j->seconds, j->file);
    }
    if (status == EXIT_ANSWERED) status = read_asked(j);
    return status == EXIT_ANSWERED ? run_all(j) : status;
}

static exit_status run(const arguments *args)
{
    static const char *const of_all[] = {"badge", "require"};
    const option_value *stop_at = arguments_option(args, "call");
    job j = {.args = args, .operand = args->operands[0], .type = {.args = args}};
    j.seconds = arguments_number(args, "max-seconds", 60);
    j.effort = arguments_number(args, "effort", 1);
    j.seed = arguments_count(args, "seed", 1);
    j.formula = arguments_option(args, "formula");
    j.domain = arguments_option(args, "domain");
    j.only = arguments_option(args, "only");
    j.stop_at = arguments_count(args, "call", 0);
    j.in_process = stop_at != NULL || arguments_option(args, "in-process") != NULL;
    if (stop_at != NULL && j.only == NULL)
        return complain(EXIT_USAGE, args->verb->name,
                        "--call counts the calls of one check: add --only CHECK");
    for (int k = 0; k < 2 && j.only != NULL; ++k)
        if (arguments_option(args, of_all[k]) != NULL)
            return complain(EXIT_USAGE, args->verb->name,
                            "--%s is about all checks: leave out --only", of_all[k]);
    j.file = child_memory(sizeof *j.file);
    j.survey = child_memory(sizeof *j.survey);
    j.answer = child_memory(sizeof *j.answer);
    j.misreading = child_memory(sizeof *j.misreading);
    char *again = command_line(&j);
    j.report = (check_report){
        .as_json = arguments_option(args, "json") != NULL, .again = again, .seed = j.seed};
    const bool ready = j.file != NULL && j.survey != NULL && j.answer != NULL &&
                       j.misreading != NULL && again != NULL;
    const exit_status status = ready ? find_and_run(&j) : complain_of_memory(args->verb->name);
    free(again);
    child_memory_free(j.file, sizeof *j.file);
    child_memory_free(j.survey, sizeof *j.survey);
    child_memory_free(j.answer, sizeof *j.answer);
    child_memory_free(j.misreading, sizeof *j.misreading);
    return status;
}

/* --- Options ---------------------------------------------------------------------------------- */

static const option options_check[] = {
    {.name = "seed",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "what everything is drawn from; the same seed, the same search (1)"},
    {.name = "effort",
     .kind = OPTION_NUMBER,
     .argument = "N",
     .min_open = true,
     .help = "search N times as long (1)"},
    {.name = "formula",
     .kind = OPTION_TEXT,
     .argument = "X;Y;Z",
     .help =
         "what the surface or map is said to be, in the language of the type formula: prove it"},
    {.name = "domain",
     .kind = OPTION_TEXT,
     .argument = "U;V;T",
     .help = "what u, v and perhaps t are said to run over, as in '0,2*pi; -1,1'; of a map, t"},
    {.name = "only",
     .kind = OPTION_CHOICE,
     .argument = "CHECK",
     .choices = check_names,
     .help = "run this check alone"},
    {.name = "badge",
     .kind = OPTION_TEXT,
     .argument = "FILE",
     .help = "write what a repository can publish: verdicts and tightness, as JSON"},
    {.name = "require",
     .kind = OPTION_CHOICE,
     .argument = "LABEL",
     .choices = required_labels,
     .help = "exit with status 6 unless all types earn that label"},
    {.name = "in-process",
     .kind = OPTION_FLAG,
     .help = "run the checks in this process, for debuggers and sanitizers: a crash ends it"},
    {.name = "call",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "with --only, in this process: stop in the debugger before call N into the plugin"},
    {.name = "max-seconds",
     .kind = OPTION_NUMBER,
     .argument = "S",
     .min_open = true,
     .help = "a check that takes longer than S seconds has failed (60)"},
    {.name = NULL},
};

static const option *const tables[] = {options_check, options_registry, options_always, NULL};

const verb verb_check = {
    .name = "check",
    .operands = "FILE|TYPE",
    .summary = "Try to refute what a plugin claims, and all else the ABI asks of it",
    .details =
        "Runs named checks on a plugin's file, or on one type by its name, each in a child "
        "process:\n"
        "a plugin that crashes or hangs has failed a check. Types are tried as in their example\n"
        "and with all defaults; 'TYPE name=value ...' tries that surface or map instead.\n"
        "\n"
        "Rates, inclusions and errors are claims. Looking from outside can refute them: a type is\n"
        "labelled tested(comparisons, seed) or refuted, with a counterexample and a command line\n"
        "that finds it again. Where the formula is known, from --formula or because the type "
        "states\n"
        "it, branch and bound in intervals proves them, region by region, whatever the plugin\n"
        "computes: proved(claims, seed).\n"
        "\n"
        "The domain is compared with --domain; else ends that almost meet are pointed out, as a "
        "note.\n"
        "A mistake that shows in several checks is reported once, and the others are named.\n"
        "\n"
        "Exit status: 0 nothing failed, 2 the formula or domain cannot be read, 4 no such file or "
        "type or "
        "wrong\n"
        "parameters, 6 a check failed, or --require is not met.\n",
    .example = "impinge check sphere",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};
