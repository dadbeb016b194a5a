/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/output_operands.h"
#include "tools/cli/output_target.h"
#include "tools/cli/verbs.h"
#include "tools/simulate/record.h"

static exit_status report(const simulation *s, const arguments *args, const char *path)
{
    exit_status status = record_write(s, path);
    if (status != EXIT_ANSWERED) return status;
    if (output_is_standard(path)) {
        status = EXIT_ANSWERED; /* the motion alone */
    } else if (arguments_option(args, "json") != NULL) {
        status = output_json(record_json(s, path), args->verb->name);
    } else {
        record_print(s, path);
        status = output_flush(args->verb->name);
    }
    if (status != EXIT_ANSWERED) return status;
    return s->reason == NULL ? EXIT_ANSWERED : EXIT_UNDECIDED;
}

static exit_status simulate(const setup *what, const arguments *args, const char *path)
{
    simulation s;
    interrupt_prepare();
    exit_status status = simulation_run(&s, what, args);
    if (status == EXIT_ANSWERED) status = report(&s, args, path);
    simulation_free(&s);
    return status;
}

static exit_status run(const arguments *args)
{
    setup what;
    const option_value *output = arguments_option(args, "output");
    if (output == NULL)
        return complain(EXIT_USAGE, args->verb->name,
                        "--output FILE is missing: where the motion "
                        "is to be written, as a scene");
    exit_status status = output_spares_operands(args, "output");
    if (status != EXIT_ANSWERED) return status;
    status = setup_read(&what, args);
    if (status == EXIT_ANSWERED) status = simulate(&what, args, output->text);
    setup_free(&what);
    return status;
}

static const option simulate_options[] = {
    {.name = "output",
     .kind = OPTION_TEXT,
     .argument = "FILE",
     .help = "write the motion here, as a scene (also -o FILE; '-': standard output)"},
    {.name = "gamma-clear",
     .kind = OPTION_NUMBER,
     .argument = "LENGTH",
     .help = "no two bodies are ever nearer than this; less than gamma (gamma/2)"},
    {.name = "max-events",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "end after N events (10000)"},
    {.name = NULL}};

static const option *const tables[] = {simulate_options, options_search, options_registry,
                                       options_always, NULL};

const verb verb_simulate = {
    .name = "simulate",
    .operands = "SCENE",
    .summary = "Move bodies by the laws of impact, with proof",
    .details =
        "From contact to contact: each is found with proof, then the bodies get impulses with\n"
        "restitution and friction. SCENE is a scene file whose bodies may have\n"
        "\n"
        "  \"mass\": M              without it a body is fixed, or moves by its own maps; with it\n"
        "                         maps may only place it, and change its shape\n"
        "  \"velocity\", \"spin\"     [x,y,z] at the start; of the centre, and rad/time\n"
        "  \"inertia\", \"center\"    3x3 about the centre of mass; integrated from a closed\n"
        "                         surface unless given\n"
        "  \"restitution\" (1)      of two bodies the smaller one counts\n"
        "  \"friction\" (0)         of two bodies the greater one counts\n"
        "\n"
        "and itself \"gravity\": [x,y,z]. The motion is written to --output as a scene with maps "
        "of\n"
        "type trajectory and the list \"events\": solve, clearance, view and plot take it. At no\n"
        "time are two bodies nearer than gamma_clear. Energy and momentum are printed, and how\n"
        "far they drift beyond what contacts and gravity explain. A budget or a signal ends it\n"
        "early, with status 3 and the motion so far.\n",
    .example =
        "echo '{\"time\": [0,2], \"gravity\": [0,0,-10], \"bodies\": [{\"name\": \"floor\",\n"
        "        \"surfaces\": [{\"type\": \"plane\", \"edge_u\": [4,0,0], \"edge_v\": "
        "[0,4,0]}]},\n"
        "        {\"name\": \"ball\", \"mass\": 1, \"restitution\": 0.8,\n"
        "         \"surfaces\": [{\"type\": \"sphere\", \"center\": [2,2,2]}]}]}' |\n"
        "    impinge simulate - -o motion.json",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};
