/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_NAMES_H
#define PLUGINS_EXPRESSION_NAMES_H

#include "plugins/expression/expression.h"

/* The names of the language
 * =========================
 * Functions with their number of arguments and their meaning; discontinuous functions of other
 * languages, with the reason why they are rejected; and the search for the nearest name of a
 * misspelt one. Names in a text are not terminated, so each is passed with its length. */

typedef struct function_name {
    const char *name;
    int meaning;        /* expression_rules.h */
    size_t least, most; /* arguments */
} function_name;

/* NULL: no such function. */
const function_name *names_function(const char *name, size_t length);

/* Why the language has no such function or sign; NULL: unknown. */
const char *names_refusal(const char *name, size_t length);

bool names_are_equal(const char *name, size_t length, const char *other);

bool names_is_letter(char c);
bool names_is_digit(char c);

/* Writes what the name may have meant and what there is, as ", did you mean 'x'?; known: u, v, ..."
 * Functions are offered if `functions`, variables and constants if not. */
void names_hint(const expression_scope *scope, bool functions, const char *name, size_t length,
                char *to, size_t size);

/* Reports constants whose names are invalid, given twice or already used. */
bool names_check_constants(const expression_scope *scope, expression_error *error);

#endif
