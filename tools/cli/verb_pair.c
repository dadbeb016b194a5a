/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/proof_output.h"
#include "tools/cli/query.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

static exit_status run(const arguments *args)
{
    const exit_status checked = query_check(args);
    if (checked != EXIT_ANSWERED) return checked;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    imp_error error = {0};
    bool complained;
    imp_scene *scene = query_scene(registry, args, &complained, &error);
    const exit_status status = complained ? EXIT_DATA : query_answer(scene, &error, args);
    query_registry_free(registry);
    return status;
}

static const option *const tables[] = {options_parameters, options_survey, options_explain,
                                       options_proof,      options_search, options_query,
                                       options_registry,   options_always, NULL};

const verb verb_pair = {
    .name = "pair",
    .operands = "A B",
    .summary = "Find the earliest contact of two surfaces",
    .details =
        "A and B are each a surface type with its parameters, then any number of maps behind '!',\n"
        "applied from left to right:\n"
        "\n"
        "  TYPE name=value ... ! MAP name=value ... ! MAP ...\n"
        "\n"
        "Values are JSON without blanks; 1,0,0 is short for [1,0,0]. `impinge list` shows the "
        "types\n"
        "and maps available, `impinge info TYPE` the parameters of one.\n",
    .example = "impinge pair 'sphere radius=1 center=-2,0,0 ! translate velocity=2,0,0' \\\n"
               "               'sphere radius=1 center=2,0,0 ! translate velocity=-2,0,0' "
               "--gamma 1e-4",
    .operand_min = 2,
    .operand_max = 2,
    .options = tables,
    .run = run};
