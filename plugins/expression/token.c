/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/token.h"
#include "plugins/expression/names.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t skip_digits(const char *text, size_t at)
{
    while (names_is_digit(text[at])) ++at;
    return at;
}

static size_t number_end(const char *text, size_t at)
{
    at = skip_digits(text, at);
    if (text[at] == '.') at = skip_digits(text, at + 1);
    if (text[at] != 'e' && text[at] != 'E') return at;
    size_t sign = text[at + 1] == '+' || text[at + 1] == '-';
    return names_is_digit(text[at + 1 + sign]) ? skip_digits(text, at + 1 + sign) : at;
}

static size_t name_end(const char *text, size_t at)
{
    while (names_is_letter(text[at]) || names_is_digit(text[at])) ++at;
    return at;
}

static bool is_inside_character(char c) { return ((unsigned char)c & 0xc0) == 0x80; }

/* All bytes of a multibyte character. */
static size_t character_end(const char *text, size_t at)
{
    ++at;
    while (is_inside_character(text[at])) ++at;
    return at;
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

token token_next(const char *text, size_t from)
{
    while (is_blank(text[from])) ++from;
    char c = text[from];
    token t = {TOKEN_END, from, 0};
    if (c == '\0') return t;
    if (names_is_digit(c) || (c == '.' && names_is_digit(text[from + 1]))) {
        t.kind = TOKEN_NUMBER;
        t.length = number_end(text, from) - from;
    } else if (names_is_letter(c)) {
        t.kind = TOKEN_NAME;
        t.length = name_end(text, from) - from;
    } else {
        t.kind = TOKEN_SIGN;
        t.length = character_end(text, from) - from;
    }
    return t;
}

/* strtod expects the decimal point of the locale. */
#define NUMBER_MAX 300

const char *token_number(const char *text, token number, double *value)
{
    const char *point = localeconv()->decimal_point;
    char copy[NUMBER_MAX + 32] = "";
    if (number.length > NUMBER_MAX || strlen(point) > 16)
        return "this number has more than 300 characters";
    const char *begin = text + number.at, *dot = memchr(begin, '.', number.length);
    size_t whole = dot != NULL ? (size_t)(dot - begin) : number.length;
    memcpy(copy, begin, whole);
    if (dot != NULL) strcat(copy, point);
    if (dot != NULL) strncat(copy, dot + 1, number.length - whole - 1);
    *value = strtod(copy, NULL);
    return isfinite(*value) ? NULL : "this number is beyond the largest, 1.8e308";
}

text_place token_place(const char *text, size_t at)
{
    text_place place = {1, 1};
    for (size_t i = 0; i < at; ++i) {
        if (text[i] == '\n') {
            ++place.line;
            place.column = 1;
        } else if (!is_inside_character(text[i])) {
            ++place.column;
        }
    }
    return place;
}
