/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/arguments.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/spelling.h"
#include "tools/cli/verbs.h"

/* One option as written: `--name`, `--name=value`, or a letter. */
typedef struct spelling {
    const char *name;
    size_t length;
    const char *attached; /* after '=', or NULL */
} spelling;

static bool is_option(const char *word) { return word[0] == '-' && word[1] != '\0'; }

/* Returns the name of the option that has this letter, or NULL. */
static const char *name_of_letter(const char *word)
{
    static const char *const letters[][2] = {{"-h", "help"}, {"-V", "version"}, {"-o", "output"}};
    for (size_t k = 0; k < sizeof letters / sizeof letters[0]; ++k)
        if (strcmp(word, letters[k][0]) == 0) return letters[k][1];
    return NULL;
}

static spelling spell(const char *word)
{
    const char *named = name_of_letter(word);
    if (named != NULL) return (spelling){named, strlen(named), NULL};
    const char *name = strncmp(word, "--", 2) == 0 ? word + 2 : word + 1;
    const char *equals = strchr(name, '=');
    if (equals == NULL) return (spelling){name, strlen(name), NULL};
    return (spelling){name, (size_t)(equals - name), equals + 1};
}

/* Returns any verb's option of that name, or NULL. Before the verb is known, it decides whether the
 * next word is a value: options of one name agree in that. */
static const option *find_anywhere(spelling s)
{
    const option *row = NULL;
    for (const verb *const *v = verbs_all(); row == NULL && *v != NULL; ++v)
        row = option_find((*v)->options, s.name, s.length);
    return row;
}

static bool takes_next(const option *row, spelling s)
{
    return row != NULL && row->kind != OPTION_FLAG && s.attached == NULL;
}

/* Returns the word that is the verb, or NULL. After an option that no verb has it returns NULL,
 * too: whether that option takes a value is unknown. */
static const char *verb_word(int argc, const char *const *argv)
{
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--") == 0) return i + 1 < argc ? argv[i + 1] : NULL;
        if (!is_option(argv[i])) return argv[i];
        const spelling s = spell(argv[i]);
        const option *row = find_anywhere(s);
        if (row == NULL) return NULL;
        if (takes_next(row, s)) ++i;
    }
    return NULL;
}

/* Returns the verb's option; without a verb, that of any verb. */
static const option *find_for(const verb *v, spelling s)
{
    return v != NULL ? option_find(v->options, s.name, s.length) : find_anywhere(s);
}

const option *arguments_find(const verb *v, const char *word, const char **attached)
{
    if (!is_option(word)) return NULL;
    const spelling s = spell(word);
    *attached = s.attached;
    return find_for(v, s);
}

static void offer_options(spelling_search *near, const verb *v)
{
    for (const option *const *t = v->options; *t != NULL; ++t)
        for (const option *row = *t; row->name != NULL; ++row) spelling_offer(near, row->name);
}

static exit_status unknown_option(const verb *v, const char *word, spelling s)
{
    const char *speaker = v != NULL ? v->name : NULL;
    const char *help = v != NULL ? v->name : "";
    char name[64];
    const size_t length = s.length < sizeof name ? s.length : sizeof name - 1;
    memcpy(name, s.name, length);
    name[length] = '\0';
    if (v != NULL && find_anywhere(s) != NULL && (word[1] == '-' || name_of_letter(word) != NULL))
        return complain(EXIT_USAGE, speaker,
                        "this verb takes no --%s (`impinge help %s` shows what "
                        "it takes)",
                        name, help);
    spelling_search near = {.wanted = name};
    if (v != NULL) offer_options(&near, v);
    for (const verb *const *all = verbs_all(); v == NULL && *all != NULL; ++all)
        offer_options(&near, *all);
    if (near.best != NULL)
        return complain(EXIT_USAGE, speaker, "unknown option '%s', did you mean '--%s'?", word,
                        near.best);
    return complain(EXIT_USAGE, speaker, "unknown option '%s' (`impinge help%s%s` shows all)", word,
                    v != NULL ? " " : "", help);
}

/* Reads the option at argv[*i]; leaves *i at its last word. */
static exit_status take_option(arguments *args, int argc, const char *const *argv, int *i)
{
    const char *word = argv[*i], *speaker = args->verb != NULL ? args->verb->name : NULL;
    const spelling s = spell(word);
    const option *row = find_for(args->verb, s);
    const bool one_dash = word[1] != '-' && name_of_letter(word) == NULL;
    if (row == NULL || one_dash) return unknown_option(args->verb, word, s);
    if (row->kind == OPTION_FLAG && s.attached != NULL)
        return complain(EXIT_USAGE, speaker, "--%s takes no value, but '%s' is given", row->name,
                        s.attached);
    const char *text = s.attached;
    if (takes_next(row, s)) {
        if (*i + 1 >= argc)
            return complain(EXIT_USAGE, speaker, "--%s needs a value: --%s %s", row->name,
                            row->name, row->argument);
        text = argv[++*i];
    }
    return option_read(row, text, speaker, &args->values[args->value_count++]);
}

static bool wants_help(const arguments *args)
{
    return arguments_option(args, "help") != NULL || arguments_option(args, "version") != NULL;
}

static exit_status check_operands(const arguments *args)
{
    const verb *v = args->verb;
    const size_t n = args->operand_count;
    if (v == NULL || wants_help(args)) return EXIT_ANSWERED;
    if (n < v->operand_min)
        return complain(EXIT_USAGE, v->name, "something is missing; usage: impinge %s %s", v->name,
                        v->operands);
    if (n > v->operand_max)
        return complain(EXIT_USAGE, v->name,
                        "unexpected argument '%s'; usage: impinge %s%s%s "
                        "(quote what holds blanks)",
                        args->operands[v->operand_max], v->name, v->operands[0] != '\0' ? " " : "",
                        v->operands);
    return EXIT_ANSWERED;
}

exit_status arguments_read(arguments *args, int argc, const char *const *argv)
{
    *args = (arguments){0};
    const size_t most = argc > 0 ? (size_t)argc : 1;
    args->operands = calloc(most, sizeof *args->operands);
    args->values = calloc(most, sizeof *args->values);
    if (args->operands == NULL || args->values == NULL) return complain_of_memory(NULL);

    const char *name = verb_word(argc, argv);
    args->verb = name != NULL ? verb_find(name) : NULL;
    if (name != NULL && args->verb == NULL) return verb_unknown(NULL, name);

    bool options_ended = false, verb_seen = false;
    for (int i = 1; i < argc; ++i) {
        if (!options_ended && strcmp(argv[i], "--") == 0) {
            options_ended = true;
        } else if (!options_ended && is_option(argv[i])) {
            const exit_status status = take_option(args, argc, argv, &i);
            if (status != EXIT_ANSWERED) return status;
        } else if (!verb_seen) {
            verb_seen = true;
        } else {
            args->operands[args->operand_count++] = argv[i];
        }
    }
    return check_operands(args);
}

bool arguments_ask_for_json(int argc, const char *const *argv)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; ++i)
        if (strcmp(argv[i], "--json") == 0) return true;
    return false;
}

void arguments_free(arguments *args)
{
    free(args->operands);
    free(args->values);
    *args = (arguments){0};
}

const option_value *arguments_option(const arguments *args, const char *name)
{
    for (size_t i = args->value_count; i > 0; --i)
        if (strcmp(args->values[i - 1].row->name, name) == 0) return &args->values[i - 1];
    return NULL;
}

double arguments_number(const arguments *args, const char *name, double otherwise)
{
    const option_value *value = arguments_option(args, name);
    return value != NULL ? value->number[0] : otherwise;
}

uint64_t arguments_count(const arguments *args, const char *name, uint64_t otherwise)
{
    const option_value *value = arguments_option(args, name);
    return value != NULL ? value->count : otherwise;
}

size_t arguments_choice(const arguments *args, const char *name, size_t otherwise)
{
    const option_value *value = arguments_option(args, name);
    return value != NULL ? value->choice : otherwise;
}
