/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <impinge/decimal.h>

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

/* Rounds the digits to[first] to to[n - 1] up. False: all are 9. */
static bool round_up(char *to, size_t first, size_t n)
{
    while (n > first && (to[n - 1] == '9' || to[n - 1] == '.')) {
        if (to[n - 1] == '9') to[n - 1] = '0';
        --n;
    }
    if (n > first) ++to[n - 1];
    return n > first;
}

/* Writes the power of ten that ends at `end` as printf does: a sign, and two digits at least.
 * Returns its length. */
static size_t write_power(const char *e, const char *end, char *to)
{
    const char *const digits = e + (e[1] == '-' || e[1] == '+' ? 2 : 1);
    const size_t length = (size_t)(end - digits);
    char *at = to;
    *at++ = 'e';
    *at++ = e[1] == '-' ? '-' : '+';
    if (length < 2) *at++ = '0';
    memcpy(at, digits, length);
    at[length] = '\0';
    return (size_t)(at - to) + length;
}

/* Writes "%.*g" of a number of which the text is "%.17g" as Jansson writes it, 15 <= digits <= 16.
 * Returns the length, or at least `length` if it is not shorter; 0: the text does not tell.
 *
 * Lemma. The number is within half a unit of the 17th digit of the text. What is cut off is a whole
 * number of these units; if it is below half a unit of the last digit that is kept, then by at
 * least one of them, so that the number is rounded down too; if it is above, up. The form is the text's
 * for all three precisions but with more than 14 digits before the point, with the ".0" of a whole
 * number, or if it carries into a new digit. */
static size_t write_rounded(const char *from, size_t length, size_t digits, char to[32])
{
    const char *const power = memchr(from, 'e', length);
    const size_t end = power != NULL ? (size_t)(power - from) : length;
    const char *const point = memchr(from, '.', end);
    const size_t first = strspn(from, "-0.");
    if (point == NULL || point - from > 14 || first >= end || from[end - 1] == '0') return 0;
    const size_t written = end - first - (point > from + first);
    if (written <= digits) return length;
    const size_t cut = written - digits; /* 1 or 2 */
    size_t n = end - cut;
    const int half = cut == 1 ? 5 : 50;
    const int rest = cut == 1 ? from[n] - '0' : 10 * (from[n] - '0') + from[n + 1] - '0';
    if (cut > 2 || rest == half) return 0;
    memcpy(to, from, n);
    if (rest > half && !round_up(to, first, n)) return 0;
    while (to[n - 1] == '0') --n;
    if (to[n - 1] == '.') --n;
    to[n] = '\0';
    return power != NULL ? n + write_power(power, from + length, to + n) : n;
}

static double value_of(const char *text, size_t length)
{
    double x;
    return imp_decimal_number(text, length, &x) ? x : strtod(text, NULL);
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
    const double number = value_of(from, length);
    memmove(to, from, length);
    for (int digits = may_have_15_digits(to, length, number) ? 15 : 16; digits < 17; ++digits) {
        size_t shorter = write_rounded(to, length, (size_t)digits, text);
        if (shorter == 0) shorter = (size_t)snprintf(text, sizeof text, "%.*g", digits, number);
        if (shorter >= length || value_of(text, shorter) != number) continue;
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
