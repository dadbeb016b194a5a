/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_NAMES_H
#define PLUGINS_EXPRESSION_NAMES_H

#include "expression.h"

/* The names of the language
 * =========================
 * Functions with their number of arguments and their meaning; functions of other languages
 * that jump, to say why they are refused; and the search for what a misspelt name meant. Names in a
 * text are not terminated, so all here come with their length. */

typedef struct function_name {
    const char *name;
    int meaning;        /* expression_rules.h */
    size_t least, most; /* arguments */
} function_name;

/* NULL: no such function. */
const function_name *names_function(const char *name, size_t length);

/* Why the language has no such function or sign; NULL: nothing is known of it. */
const char *names_refusal(const char *name, size_t length);

bool names_are_equal(const char *name, size_t length, const char *other);

bool names_is_letter(char c);
bool names_is_digit(char c);

/* Writes what the name may have meant and what there is, as ", did you mean 'x'?; known: u, v, ..."
 * Functions are offered if `functions`, variables and constants if not. */
void names_hint(const expression_scope *scope, bool functions, const char *name, size_t length,
                char *to, size_t size);

/* Complains of constants whose names are no names, are given twice or mean something else. */
bool names_check_constants(const expression_scope *scope, expression_error *error);

#endif
