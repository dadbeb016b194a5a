/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>
#include <string.h>

#include "input.h"
#include "query.h"
#include "verbs.h"

/* Files are read by the library; standard input is read here, whole. */
static exit_status solve_standard_input(imp_registry *registry, const arguments *args)
{
    input_text t = {0};
    exit_status status = EXIT_DATA;
    const char *name = input_name("-");
    if (input_read(stdin, name, args->verb->name, &t)) {
        imp_error error = {0};
        imp_scene *scene = imp_scene_from_json(registry, t.text, t.length, name, &error);
        status = query_answer(scene, &error, args);
    }
    free(t.text);
    return status;
}

static exit_status run(const arguments *args)
{
    const exit_status checked = query_check(args);
    if (checked != EXIT_ANSWERED) return checked;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    const exit_status status = strcmp(args->operands[0], "-") == 0
                                   ? solve_standard_input(registry, args)
                                   : query_answer_file(registry, args->operands[0], args);
    imp_registry_free(registry);
    return status;
}

static const option *const tables[] = {options_query, options_registry, options_always, NULL};

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
        "names together. Options given here override what the scene asks for.\n",
    .example =
        "echo '{\"bodies\": [{\"name\": \"a\", \"surfaces\": [{\"type\": \"sphere\"}]},\n"
        "        {\"name\": \"b\", \"surfaces\": [{\"type\": \"sphere\", \"center\": [3,0,0]}],\n"
        "         \"maps\": [{\"type\": \"translate\", \"velocity\": [-2,0,0]}]}]}' |\n"
        "    impinge solve - --gamma 1e-4",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};
