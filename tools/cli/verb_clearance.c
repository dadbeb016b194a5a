/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "tools/cli/clearance_measure.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/proof_output.h"
#include "tools/cli/query.h"
#include "tools/cli/scene_values.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

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
    const exit_status proof = proof_output_check(args);
    if (proof != EXIT_ANSWERED) return proof;
    if (profile != NULL && arguments_option(args, "each") != NULL)
        return complain(EXIT_USAGE, args->verb->name, "--each and --profile exclude each other");
    if (arguments_option(args, "over") != NULL && profile == NULL)
        return complain(EXIT_USAGE, args->verb->name, "--over belongs to --profile");
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

static exit_status measure_scene(imp_scene *scene, const arguments *args)
{
    const imp_clearance_options asked = asked_for(args);
    if (survey_is_needed(scene, args)) return survey_clearance(scene, &asked, args);
    const option_value *over = arguments_option(args, "over");
    if (over != NULL)
        return scene_values_complain(scene, "over", over->text, strlen(over->text),
                                     args->verb->name);
    return clearance_measure(scene, &asked, args);
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
    {.name = "over",
     .kind = OPTION_TEXT,
     .argument = "NAME",
     .help = "with --profile: slices of the range of this parameter of the scene instead"},
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
