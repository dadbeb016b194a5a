/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/check/job.h"
#include "tools/cli/output.h"
#include "tools/cli/verbs.h"

static const char *const required_labels[] = {"tested", "proved", NULL};

/* --- Running ---------------------------------------------------------------------------------- */

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

/* Returns the command line that repeats the run. Free it. NULL: no memory. */
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
    j.content = child_memory(sizeof *j.content);
    j.answer = child_memory(sizeof *j.answer);
    j.misreading = child_memory(sizeof *j.misreading);
    char *again = command_line(&j);
    j.report = (check_report){
        .as_json = arguments_option(args, "json") != NULL, .again = again, .seed = j.seed};
    const bool ready = j.file != NULL && j.content != NULL && j.answer != NULL &&
                       j.misreading != NULL && again != NULL;
    const exit_status status = ready ? job_run(&j) : complain_of_memory(args->verb->name);
    free(again);
    child_memory_free(j.file, sizeof *j.file);
    child_memory_free(j.content, sizeof *j.content);
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
