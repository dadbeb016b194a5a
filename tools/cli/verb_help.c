/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <string.h>

#include "tools/cli/verbs.h"

/* `impinge help`: everything it prints about verbs and options comes from their tables. */

static void print_option(const option *row)
{
    char left[64];
    snprintf(left, sizeof left, "--%s%s%s", row->name, row->argument != NULL ? " " : "",
             row->argument != NULL ? row->argument : "");
    printf("  %-24s ", left);
    if (row->kind == OPTION_CHOICE)
        for (const char *const *c = row->choices; *c != NULL; ++c)
            printf("%s%s", *c, c[1] != NULL ? "|" : ": ");
    puts(row->help);
}

static void print_options(const option *const *tables)
{
    for (; *tables != NULL; ++tables)
        for (const option *row = *tables; row->name != NULL; ++row) print_option(row);
}

void help_overview(void)
{
    fputs("impinge finds the earliest contact of moving, deforming parametric surfaces,\n"
          "and proves that nothing touched before.\n\n"
          "usage: impinge VERB [OPTION or OPERAND]...\n\n",
          stdout);
    for (const verb *const *v = verbs_all(); *v != NULL; ++v) {
        char left[64];
        snprintf(left, sizeof left, "%s %s", (*v)->name, (*v)->operands);
        printf("  %-24s %s\n", left, (*v)->summary);
    }
    puts("\nCommon options:");
    print_options((const option *const[]){options_registry, options_always, NULL});
    fputs("\n`impinge help VERB` describes one verb, with an example. Options may stand anywhere.\n"
          "Exit status: 0 answered, 1 contact (with --exit-code), 2 usage, 3 undecided,\n"
          "4 scene, data or file, 5 plugin fault, 6 conformance failure.\n",
          stdout);
}

void help_verb(const verb *v)
{
    printf("usage: impinge %s [OPTION]...%s%s\n\n%s.\n\n%s\n", v->name,
           v->operands[0] != '\0' ? " " : "", v->operands, v->summary, v->details);
    puts("Options:");
    print_options(v->options);
    printf("\nExample:\n  %s\n", v->example);
}

static exit_status run(const arguments *args)
{
    if (args->operand_count == 0) {
        help_overview();
        return EXIT_ANSWERED;
    }
    const verb *v = verb_find(args->operands[0]);
    if (v == NULL) return verb_unknown(args->verb->name, args->operands[0]);
    help_verb(v);
    return EXIT_ANSWERED;
}

static const option *const tables[] = {options_always, NULL};

const verb verb_help = {
    .name = "help",
    .operands = "[VERB]",
    .summary = "Show how to use the command, or one verb of it",
    .details = "Prints the verbs; with VERB, its options and an example that can be run.\n",
    .example = "impinge help pair",
    .operand_max = 1,
    .options = tables,
    .run = run};
