/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <string.h>

#include "tools/cli/catalogue.h"
#include "tools/cli/command_line.h"
#include "tools/cli/help_topics.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

/* `impinge complete LINE`: what may stand at the end of a command line
 * ====================================================================
 * The completions of shells call it with the line up to the cursor. Everything follows from the
 * tables of verbs and options and from the types that are found. Each output line is a complete
 * word and, after a tab, its meaning; the line ":files" means that file names are possible, too.
 * The verb never complains: for a word that cannot be completed it prints nothing. */

typedef struct completion {
    command_line line;
    const char *word; /* at the cursor */
    size_t kept;      /* so much of it stays: stages of a pipeline that are complete */
    const verb *verb; /* NULL: not given yet */
    size_t first;     /* operand of the verb, among the words */
    imp_registry *registry;
} completion;

/* Prints a word, and its suffix, if the typed text is its beginning. */
static void offer(const completion *c, const char *word, const char *behind, const char *about)
{
    const char *typed = c->word + c->kept;
    if (strncmp(word, typed, strlen(typed)) != 0) return;
    printf("%.*s%s%s\t%s\n", (int)c->kept, c->word, word, behind, message_shown(about).text);
}

static void offer_types(const completion *c, imp_type_kind kind)
{
    imp_type_info info;
    for (size_t i = 0; imp_registry_type(c->registry, i, &info); ++i)
        if (info.kind == kind && info.shadowed_by == NULL) offer(c, info.name, "", info.summary);
}

static void offer_files(const char *operands)
{
    static const char *const files[] = {"FILE", "SCENE", "RESULT", "DIR", "OUT"};
    for (size_t k = 0; k < sizeof files / sizeof files[0]; ++k)
        if (strstr(operands, files[k]) != NULL) {
            puts(":files");
            return;
        }
}

/* --- Options ---------------------------------------------------------------------------------- */

static void offer_options(const completion *c)
{
    static const option *const common[] = {options_registry, options_always, NULL};
    const option *const *tables = c->verb != NULL ? c->verb->options : common;
    char name[80];
    for (; *tables != NULL; ++tables)
        for (const option *row = *tables; row->name != NULL; ++row) {
            snprintf(name, sizeof name, "--%s", row->name);
            offer(c, name, "", row->help);
        }
}

/* Offers values of an option, the word from c->kept on. */
static void offer_values(const completion *c, const option *row)
{
    for (size_t k = 0; row->kind == OPTION_CHOICE && row->choices[k] != NULL; ++k)
        offer(c, row->choices[k], "", row->help);
    if (strcmp(row->name, "isolate") == 0) {
        offer(c, "all", "", "every type");
        offer_types(c, IMP_TYPE_SURFACE);
        offer_types(c, IMP_TYPE_MAP);
    }
    if (row->kind == OPTION_TEXT && row->argument != NULL) offer_files(row->argument);
}

/* --- Pipelines -------------------------------------------------------------------------------- */

/* The last stage of a pipeline, and the parameters that it has already. */
typedef struct stage {
    imp_type_kind kind;
    bool is_any;      /* a type of either kind may stand here, for verbs about types */
    char type[64];    /* "": not given yet */
    char given[1024]; /* "name=..." and so on, each behind a blank */
} stage;

static void stage_token(stage *s, const char *token, size_t length)
{
    if (length == 1 && *token == '!') {
        *s = (stage){.kind = IMP_TYPE_MAP};
    } else if (s->type[0] == '\0') {
        snprintf(s->type, sizeof s->type, "%.*s", (int)length, token);
    } else {
        const size_t used = strlen(s->given);
        snprintf(s->given + used, sizeof s->given - used, " %.*s", (int)length, token);
    }
}

static void stage_text(stage *s, const char *text, size_t length)
{
    for (size_t at = 0, n; at < length; at += n + 1) {
        n = strcspn(text + at, " ");
        if (n > length - at) n = length - at;
        if (n > 0) stage_token(s, text + at, n);
    }
}

static bool is_given(const stage *s, const char *name)
{
    char wanted[80];
    snprintf(wanted, sizeof wanted, " %s=", name);
    return strstr(s->given, wanted) != NULL;
}

static void offer_parameters(const completion *c, const stage *s)
{
    imp_type_info info;
    for (size_t i = 0; imp_registry_type(c->registry, i, &info); ++i) {
        const bool fits = info.kind == s->kind || s->is_any;
        if (!fits || info.shadowed_by != NULL || strcmp(info.name, s->type) != 0) continue;
        for (size_t k = 0; k < info.parameter_count; ++k) {
            const imp_parameter *row = catalogue_parameter(&info, k);
            if (!is_given(s, row->name)) offer(c, row->name, "=", row->doc);
        }
        offer(c, "!", "", "a map follows");
    }
}

/* Offers types, or the parameters of the type that the word, or words before it, name. Pipelines
 * are one word, in quotes; those that are typed without are completed all the same, and a type may
 * follow, the second surface. */
static void offer_pipeline(completion *c, bool is_any)
{
    stage s = {.kind = IMP_TYPE_SURFACE, .is_any = is_any};
    const char *blank = strrchr(c->word, ' ');
    bool has_words = false;
    c->kept = blank != NULL ? (size_t)(blank + 1 - c->word) : 0;
    if (blank == NULL && !c->line.is_quoted)
        for (size_t k = c->first; k + 1 < c->line.count; ++k) {
            const char *word = c->line.words[k];
            has_words = strchr(word, ' ') == NULL && word[0] != '-';
            if (has_words)
                stage_text(&s, word, strlen(word));
            else
                s = (stage){.kind = IMP_TYPE_SURFACE, .is_any = is_any};
        }
    stage_text(&s, c->word, c->kept);
    if (s.type[0] != '\0') offer_parameters(c, &s);
    if (s.type[0] == '\0' || (has_words && s.kind == IMP_TYPE_SURFACE)) offer_types(c, s.kind);
    if (s.type[0] == '\0' && s.is_any) offer_types(c, IMP_TYPE_MAP);
}

/* --- Operands --------------------------------------------------------------------------------- */

static void offer_verbs(const completion *c)
{
    for (const verb *const *v = verbs_all(); *v != NULL; ++v)
        if (!(*v)->is_hidden) offer(c, (*v)->name, "", (*v)->summary);
}

static void offer_operands(completion *c)
{
    const char *operands = c->verb->operands;
    for (size_t k = 0; c->verb->operand_word != NULL && c->verb->operand_word(k) != NULL; ++k)
        offer(c, c->verb->operand_word(k), "", "");
    if (strstr(operands, "VERB") != NULL) {
        offer_verbs(c);
        for (const help_topic *t = help_topics; t->name != NULL; ++t)
            offer(c, t->name, "", t->summary);
    }
    const bool is_any = strstr(operands, "TYPE") != NULL;
    if (is_any || strstr(operands, "A B") != NULL) offer_pipeline(c, is_any);
    offer_files(operands);
}

/* Finds the verb. True: the word at the cursor is a value of *row. */
static bool find_verb(completion *c, const option **row)
{
    *row = NULL;
    for (size_t k = 1; k + 1 < c->line.count; ++k) {
        const char *word = c->line.words[k], *attached = NULL;
        *row = arguments_find(c->verb, word, &attached);
        if (*row != NULL && (*row)->kind != OPTION_FLAG && attached == NULL) {
            if (k + 2 == c->line.count) return true;
            ++k;
        } else if (word[0] != '-' && c->verb == NULL) {
            c->verb = verb_find(word);
            c->first = k + 1;
        }
    }
    return false;
}

static void complete(completion *c)
{
    const option *row;
    const char *attached = NULL;
    c->word = c->line.words[c->line.count - 1];
    if (find_verb(c, &row)) {
        offer_values(c, row);
    } else if (c->word[0] == '-' && (row = arguments_find(c->verb, c->word, &attached)) != NULL &&
               attached != NULL) {
        c->kept = (size_t)(attached - c->word);
        offer_values(c, row);
    } else if (c->word[0] == '-') {
        offer_options(c);
    } else if (c->verb == NULL) {
        offer_verbs(c);
    } else {
        offer_operands(c);
    }
}

static exit_status run(const arguments *args)
{
    completion c = {0};
    c.registry = query_registry(args);
    const bool made = c.registry != NULL && command_line_split(args->operands[0], &c.line);
    if (made) complete(&c);
    command_line_free(&c.line);
    query_registry_free(c.registry);
    return made ? EXIT_ANSWERED : complain_of_memory(args->verb->name);
}

static const option *const tables[] = {options_registry, options_always, NULL};

const verb verb_complete = {
    .name = "complete",
    .operands = "LINE",
    .summary = "Tell shells what may stand at the end of a command line",
    .details = "LINE is what has been typed so far, from the name of the command on. Each line of "
               "the answer\n"
               "is a word and, behind a tab, what it means; `:files` says that names of files will "
               "do.\n",
    .example = "impinge complete 'impinge pair torus '",
    .operand_min = 1,
    .operand_max = 1,
    .is_hidden = true,
    .options = tables,
    .run = run};
