/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/help_topics.h"
#include "tools/cli/verbs.h"

/* `impinge help`: everything it prints about verbs and options comes from their tables. */

enum { HELP_INDENT = 27, HELP_WIDTH = 80, HELP_WIDTH_MIN = 60 };

/* Returns the width of COLUMNS, if it is at least 60; else 80. */
static size_t line_width(void)
{
    const char *columns = getenv("COLUMNS");
    const long width = columns != NULL ? strtol(columns, NULL, 10) : 0;
    if (width <= 0) return HELP_WIDTH;
    return width < HELP_WIDTH_MIN ? HELP_WIDTH_MIN : (size_t)width;
}

/* Prints words, and choices between bars, from column HELP_INDENT on; further lines begin there. */
static void print_wrapped(const char *text)
{
    const size_t width = line_width();
    size_t at = HELP_INDENT, blank = 0;
    while (*text != '\0') {
        size_t word = strcspn(text, " |");
        word += text[word] == '|';
        if (at > HELP_INDENT && at + blank + word > width) {
            printf("\n%*s", HELP_INDENT, "");
            at = HELP_INDENT;
            blank = 0;
        }
        printf("%*s%.*s", (int)blank, "", (int)word, text);
        at += blank + word;
        blank = text[word] == ' ';
        text += word + strspn(text + word, " ");
    }
    putchar('\n');
}

/* Prints the help of an option, with the verb's own limit of pairs instead of the general one,
 * which is none. */
static void format_help(const option *row, uint64_t max_pairs, char *text, size_t size)
{
    static const char usual[] = "(0)";
    const size_t length = strlen(row->help), end = sizeof usual - 1;
    size_t used = 0;
    text[0] = '\0';
    if (row->kind == OPTION_CHOICE)
        for (const char *const *c = row->choices; *c != NULL && used < size; ++c)
            used += (size_t)snprintf(text + used, size - used, "%s%s", *c, c[1] ? "|" : ": ");
    if (used >= size) return;
    if (max_pairs > 0 && strcmp(row->name, "max-pairs") == 0 && length > end &&
        strcmp(row->help + length - end, usual) == 0)
        snprintf(text + used, size - used, "%.*s(%ju)", (int)(length - end), row->help,
                 (uintmax_t)max_pairs);
    else
        snprintf(text + used, size - used, "%s", row->help);
}

static void print_option(const option *row, uint64_t max_pairs)
{
    char left[64], text[512];
    snprintf(left, sizeof left, "--%s%s%s", row->name, row->argument != NULL ? " " : "",
             row->argument != NULL ? row->argument : "");
    printf("  %-24s ", left);
    format_help(row, max_pairs, text, sizeof text);
    print_wrapped(text);
}

static void print_options(const option *const *tables, uint64_t max_pairs)
{
    for (; *tables != NULL; ++tables)
        for (const option *row = *tables; row->name != NULL; ++row) print_option(row, max_pairs);
}

void help_overview(void)
{
    fputs("impinge finds the earliest contact of moving, deforming parametric surfaces,\n"
          "and proves that nothing touched before.\n\n"
          "usage: impinge VERB [OPTION or OPERAND]...\n\n",
          stdout);
    for (const verb *const *v = verbs_all(); *v != NULL; ++v) {
        if ((*v)->is_hidden) continue;
        char left[64];
        snprintf(left, sizeof left, "%s %s", (*v)->name, (*v)->operands);
        printf("  %-24s %s\n", left, (*v)->summary);
    }
    puts("\nCommon options:");
    print_options((const option *const[]){options_registry, options_always, NULL}, 0);
    fputs("\nTopics: ", stdout);
    for (const help_topic *t = help_topics; t->name != NULL; ++t)
        printf("%s%s", t->name, t[1].name != NULL ? ", " : ".\n");
    fputs("\n`impinge help VERB` describes one verb, with an example; topics likewise. Options\n"
          "may stand anywhere.\n"
          "Exit status: 0 answered, 1 contact (with --exit-code), 2 usage, 3 undecided,\n"
          "4 scene, data or file, 5 plugin fault, 6 conformance failure.\n",
          stdout);
}

void help_verb(const verb *v)
{
    printf("usage: impinge %s [OPTION]...%s%s\n\n%s.\n\n%s\n", v->name,
           v->operands[0] != '\0' ? " " : "", v->operands, v->summary, v->details);
    puts("Options:");
    print_options(v->options, v->max_pairs);
    printf("\nExample:\n  %s\n", v->example);
}

static exit_status run(const arguments *args)
{
    if (args->operand_count == 0) {
        help_overview();
        return EXIT_ANSWERED;
    }
    for (const help_topic *t = help_topics; t->name != NULL; ++t)
        if (strcmp(t->name, args->operands[0]) == 0) {
            printf("%s\n\n%s", t->summary, t->text);
            return EXIT_ANSWERED;
        }
    const verb *v = verb_find(args->operands[0]);
    if (v == NULL) return verb_unknown(args->verb->name, args->operands[0]);
    help_verb(v);
    return EXIT_ANSWERED;
}

static const option *const tables[] = {options_always, NULL};

const verb verb_help = {.name = "help",
                        .operands = "[VERB|TOPIC]",
                        .summary = "Show how to use the command, one verb, or a topic",
                        .details = "Prints the verbs and the topics; with VERB, its options and an "
                                   "example that can\n"
                                   "be run; with TOPIC, that topic.\n",
                        .example = "impinge help pair",
                        .operand_max = 1,
                        .options = tables,
                        .run = run};
