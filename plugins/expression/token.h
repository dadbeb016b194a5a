/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_TOKEN_H
#define PLUGINS_EXPRESSION_TOKEN_H

#include <stdbool.h>
#include <stddef.h>

/* Words of a formula
 * ==================
 * A text is cut into numbers, names and signs, from left to right. */

typedef enum token_kind {
    TOKEN_END,
    TOKEN_NUMBER,
    TOKEN_NAME,
    TOKEN_SIGN /* one character, known or not */
} token_kind;

typedef struct token {
    token_kind kind;
    size_t at, length; /* bytes of the text */
} token;

/* Returns the token that begins at or after `from`. */
token token_next(const char *text, size_t from);

/* Reads the double nearest to the number. Returns what is wrong with it, or NULL. */
const char *token_number(const char *text, token number, double *value);

/* Tells line and column, from 1, of a byte of the text; columns count characters. */
typedef struct text_place {
    size_t line, column;
} text_place;
text_place token_place(const char *text, size_t at);

#endif
