/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/each.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/proof_output.h"
#include "tools/cli/query.h"
#include "tools/cli/series.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

static exit_status answer(imp_scene *scene, const imp_error *error, const arguments *args)
{
    const bool by_pairs = arguments_option(args, "each") != NULL;
    if (scene == NULL || imp_scene_parameter_count(scene) > 0 || /* a survey answers these */
        !(by_pairs || arguments_option(args, "refine") != NULL))
        return query_answer(scene, error, args);
    interrupt_prepare();
    const exit_status status = by_pairs ? each_answer(scene, args) : series_answer(scene, args);
    imp_scene_free(scene);
    return status;
}

static exit_status run(const arguments *args)
{
    bool complained;
    exit_status status = query_check(args);
    if (status == EXIT_ANSWERED) status = series_check(args);
    if (status != EXIT_ANSWERED) return status;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    imp_error error = {0};
    imp_scene *scene = query_scene(registry, args, &complained, &error);
    status = complained ? EXIT_DATA : answer(scene, &error, args);
    query_registry_free(registry);
    return status;
}

static const option *const tables[] = {
    options_series, options_parameters, options_survey,   options_explain, options_proof,
    options_search, options_query,      options_registry, options_always,  NULL};

const verb verb_solve = {
    .name = "solve",
    .operands = "SCENE",
    .summary = "Find the earliest contact in a scene",
    .details =
        "SCENE is a JSON file ('-': standard input) of bodies, each of surfaces under maps:\n"
        "\n"
        "  { \"time\": [0,1], \"gamma\": 1e-6,\n"
        "    \"bodies\": [\n"
        "      {\"name\": \"ball\", \"surfaces\": [{\"type\": \"sphere\", \"radius\": 0.4}],\n"
        "                       \"maps\": [{\"type\": \"translate\", \"velocity\": [-2,0,0]}]},\n"
        "      ... ],\n"
        "    \"ignore\": [[\"ball\", \"floor\"]] }\n"
        "\n"
        "The surfaces of one body are not tested with each other, nor are two bodies that "
        "'ignore'\n"
        "names together. Options given here override what the scene asks for.\n"
        "\n"
        "A scene with \"parameters\": {\"angle\": [0, 1.5]}, which surfaces and maps follow by\n"
        "\"clock\": \"angle\", is answered for all their values: clear at all, or the earliest "
        "contact of\n"
        "all, with its values.\n"
        "\n"
        "--each prints the first contact of each pair of bodies, in order of time, with --json one "
        "object a\n"
        "line; bodies that never touch come last. --max-pairs and --max-bytes then hold for each "
        "two\n"
        "bodies.\n",
    .example =
        "echo '{\"bodies\": [{\"name\": \"a\", \"surfaces\": [{\"type\": \"sphere\"}]},\n"
        "        {\"name\": \"b\", \"surfaces\": [{\"type\": \"sphere\", \"center\": [3,0,0]}],\n"
        "         \"maps\": [{\"type\": \"translate\", \"velocity\": [-2,0,0]}]}]}' |\n"
        "    impinge solve - --gamma 1e-4",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};
