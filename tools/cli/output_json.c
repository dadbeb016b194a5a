/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/json_memory.h"
#include "tools/cli/output.h"

/* JSON as a line: numbers in the fewest digits, no character that controls a terminal. */

/* Characters of the number that the text begins with. */
static size_t number_length(const char *text) { return strspn(text, "+-.0123456789eE"); }

/* Returns the last two of the 17 digits that "%.17g" rounded a number to, whose trailing zeros the
 * text may lack. */
static int last_two_of_17(const char *text, size_t length)
{
    int last = 0, before = 0, digits = 0;
    for (size_t k = 0; k < length && text[k] != 'e' && text[k] != 'E'; ++k) {
        if (text[k] < '0' || text[k] > '9' || (digits == 0 && text[k] == '0')) continue;
        before = last;
        last = text[k] - '0';
        digits += 1;
    }
    return digits == 17 ? 10 * before + last : digits == 16 ? 10 * last : 0;
}

/* Whether 15 digits may read back as the number that the 17 digits of the text stand for. Let U be
 * the unit of the 17th digit, so that abs(x) < 1e17 U. Lemma: if S of 15 digits reads back as x,
 * which is normal, then
 *     abs(S - x) <= ulp(x) / 2 <= 2^-53 abs(x) < 11.2 U,
 *     abs(D - x) <= U / 2 for the 17 digits D,
 * and abs(S - D) <= 11 U, since S and D are whole multiples of U; S is one of 100 U, or ends a
 * decade below D, which then ends in 00 to 11. */
static bool may_have_15_digits(const char *text, size_t length, double number)
{
    const int last = last_two_of_17(text, length);
    return last <= 11 || last >= 89 || fabs(number) < DBL_MIN;
}

/* Writes the number at the beginning of `from` to `to`, in the fewest digits that read back
 * exactly. Returns the number of characters written: at most those read. A text of up to 15
 * characters is one of 15 digits already, perhaps with a ".0" that Jansson adds to whole
 * numbers. */
static size_t write_shortest(const char *from, char *to)
{
    const size_t length = number_length(from);
    char text[32];
    if (length <= 15 || (memchr(from, '.', length) == NULL && memchr(from, 'e', length) == NULL)) {
        const bool whole = length > 2 && memcmp(from + length - 2, ".0", 2) == 0;
        memmove(to, from, length);
        return whole ? length - 2 : length;
    }
    const double number = strtod(from, NULL);
    memmove(to, from, length);
    for (int digits = may_have_15_digits(to, length, number) ? 15 : 16; digits < 17; ++digits) {
        const size_t shorter = (size_t)snprintf(text, sizeof text, "%.*g", digits, number);
        if (shorter >= length || strtod(text, NULL) != number) continue;
        memcpy(to, text, shorter);
        return shorter;
    }
    return length;
}

/* Jansson writes all numbers in one precision: 17 digits are always enough, and seldom needed. */
static void shorten_numbers(char *text)
{
    char *to = text;
    bool quoted = false;
    while (*text != '\0') {
        if (*text == '"') quoted = !quoted;
        if (quoted && *text == '\\') *to++ = *text++;
        if (!quoted && (*text == '-' || (*text >= '0' && *text <= '9'))) {
            const size_t length = number_length(text);
            to += write_shortest(text, to);
            text += length;
        } else {
            *to++ = *text++;
        }
    }
    *to = '\0';
}

/* Returns the next character that controls a terminal and that Jansson does not escape: DEL, or one
 * of C1 (U+0080 to U+009F), which is two bytes in UTF-8. NULL: there is none. */
static const char *next_control(const char *text)
{
    while ((text = strpbrk(text, "\x7f\xc2")) != NULL && *text == '\xc2' &&
           (unsigned char)text[1] >= 0xA0)
        text += 1;
    return text;
}

/* Copies the text with such characters written as \u009b; NULL: no memory. */
static char *escape_controls(const char *text)
{
    char *escaped = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&escaped, &length);
    if (out == NULL) return NULL;
    for (const char *control; (control = next_control(text)) != NULL;) {
        const bool single = *control == '\x7f';
        const unsigned code = single ? 0x7F : (unsigned char)control[1];
        fprintf(out, "%.*s\\u%04x", (int)(control - text), text, code);
        text = control + (single ? 1 : 2);
    }
    fputs(text, out);
    if (fclose(out) == 0) return escaped;
    free(escaped);
    return NULL;
}

char *output_json_line(json_t *object)
{
    const size_t flags = JSON_COMPACT | JSON_REAL_PRECISION(17) | JSON_ENCODE_ANY;
    char *text = json_memory_text(object, flags);
    json_decref(object);
    if (text == NULL) return NULL;
    shorten_numbers(text);
    if (next_control(text) == NULL) return text;
    char *escaped = escape_controls(text);
    free(text);
    return escaped;
}
