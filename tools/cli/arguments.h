/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_ARGUMENTS_H
#define TOOLS_CLI_ARGUMENTS_H

#include "tools/cli/options.h"

/* The command line, parsed
 * ========================
 *
 *   impinge [OPTION]... VERB [OPTION or OPERAND]... [-- OPERAND...]
 *
 * The first word that is neither an option nor an option's value is the verb. An option's value
 * follows it, or '='; any text is a value, negative numbers included. If an option is given twice,
 * the last wins. "--" ends the options; "-" is an operand (standard input). */

struct verb;

typedef struct arguments {
    const struct verb *verb; /* NULL: none given */
    const char **operands;
    size_t operand_count;
    option_value *values; /* in the order given */
    size_t value_count;
} arguments;

/* Sorts argv into *arguments, checks every value, and that the verb takes that many operands
 * (unless
 * --help or --version is among the options). Strings stay argv's. Call arguments_free in any case.
 */
exit_status arguments_read(arguments *args, int argc, const char *const *argv);
/* Whether --json is among the words, even after a word at which arguments_read failed. */
bool arguments_ask_for_json(int argc, const char *const *argv);

void arguments_free(arguments *args);

/* Returns the verb's option that a word names, or any verb's if `v` is NULL; NULL: none. *attached
 * becomes the text after '=', or NULL. */
const option *arguments_find(const struct verb *v, const char *word, const char **attached);

/* Returns the last value given for the option, or NULL. */
const option_value *arguments_option(const arguments *args, const char *name);

/* Return the last value given for the option, or `otherwise`: a number, a count, the index of a
 * choice. */
double arguments_number(const arguments *args, const char *name, double otherwise);
uint64_t arguments_count(const arguments *args, const char *name, uint64_t otherwise);
size_t arguments_choice(const arguments *args, const char *name, size_t otherwise);

#endif
