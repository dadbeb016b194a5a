/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>

#include "tools/cli/output.h"
#include "tools/cli/verbs.h"

#include <impinge/examine.h>

static const char *finding_name(imp_finding finding)
{
    switch (finding) {
    case IMP_FINDING_PASSED:
        return "passed";
    case IMP_FINDING_REFUSED:
        return "refused";
    default:
        return "not reached";
    }
}

static void print_finding(void *context, const char *check, imp_finding finding, const char *text)
{
    (void)context;
    printf("  %-9s %-11s %s\n", check, finding_name(finding), message_shown(text).text);
}

static void add_finding(void *context, const char *check, imp_finding finding, const char *text)
{
    json_array_append_new(context,
                          json_pack("{s:s, s:s, s:o}", "check", check, "finding",
                                    finding_name(finding), "text", output_json_text(text)));
}

static exit_status run(const arguments *args)
{
    const char *path = args->operands[0];
    if (arguments_option(args, "json") != NULL) {
        json_t *checks = json_array();
        const bool good = imp_plugin_examine(path, add_finding, checks);
        const exit_status status =
            output_json(json_pack("{s:o, s:b, s:o}", "file", output_json_text(path), "taken", good,
                                  "checks", checks),
                        args->verb->name);
        return status != EXIT_ANSWERED ? status : good ? EXIT_ANSWERED : EXIT_PLUGIN;
    }
    puts(message_shown(path).text);
    const bool good = imp_plugin_examine(path, print_finding, NULL);
    puts(good ? "This file is accepted." : "This file is rejected.");
    return good ? EXIT_ANSWERED : EXIT_PLUGIN;
}

static const option own[] = {
    {.name = "json", .help = "print one JSON object on one line"},
    {.name = NULL},
};
static const option *const tables[] = {own, options_always, NULL};

const verb verb_why = {
    .name = "why",
    .operands = "FILE",
    .summary = "Show what is checked of a plugin file, and why it is accepted or rejected",
    .details =
        "Every check in its order, with what was found and, where it refuses, the cure. First the\n"
        "file is read, then it is loaded in a child process: it cannot harm this one. Exit status\n"
        "0 if the file is accepted, 5 if not.\n",
    .example = "impinge why \"$(impinge list --json | jq -r '.types[0].file')\"",
    .operand_min = 1,
    .operand_max = 1,
    .options = tables,
    .run = run};
