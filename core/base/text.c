/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"

#include <impinge/impinge.h>

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

static bool is_letter_or_digit(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }

bool text_is_name(const char *s, const char *extra)
{
    if (s == NULL || !is_letter(s[0])) return false;
    size_t n = 0;
    for (; s[n] != '\0'; ++n) {
        if (n == TEXT_NAME_MAX) return false;
        if (!is_letter_or_digit(s[n]) && strchr(extra, s[n]) == NULL) return false;
    }
    return true;
}

/* Length in bytes of the character of UTF-8 that s begins with; 0 if it is broken: a stray
 * or missing continuation, an overlong form, a surrogate, or beyond U+10FFFF. */
static size_t character_length(const unsigned char *s)
{
    if (s[0] < 0x80) return 1;
    size_t n = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
    if (s[0] < 0xC2 || s[0] > 0xF4) return 0;
    for (size_t i = 1; i < n; ++i)
        if ((s[i] & 0xC0) != 0x80) return 0;
    bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
    bool surrogate = s[0] == 0xED && s[1] > 0x9F;
    bool beyond = s[0] == 0xF4 && s[1] > 0x8F;
    return overlong || surrogate || beyond ? 0 : n;
}

/* The control characters are C0, DEL, and C1 (U+0080 to U+009F). */
static bool is_control(const unsigned char *s)
{
    return s[0] < 0x20 || s[0] == 0x7F || (s[0] == 0xC2 && s[1] < 0xA0);
}

static bool is_text(const char *s, bool controls_allowed)
{
    const unsigned char *p = (const unsigned char *)s;
    while (*p) {
        size_t n = character_length(p);
        if (n == 0 || (is_control(p) && !controls_allowed)) return false;
        p += n;
    }
    return true;
}

bool text_is_utf8(const char *s) { return is_text(s, true); }

bool text_is_line(const char *s) { return s != NULL && is_text(s, false); }

void text_clean(char *s)
{
    unsigned char *p = (unsigned char *)s;
    while (*p) {
        size_t n = character_length(p);
        if (n == 0 || is_control(p)) {
            memset(p, '?', n == 0 ? 1 : n);
        }
        p += n == 0 ? 1 : n;
    }
}

void text_append(char *buffer, size_t size, const char *format, ...)
{
    size_t used = strlen(buffer);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(buffer + used, size - used, format, arguments);
    va_end(arguments);
}

/* Writes m / 10^k. */
static void write_decimal(char *to, bool minus, uint64_t m, int k)
{
    char digits[24];
    int count = 0;
    for (; m > 0 || count <= k; m /= 10) digits[count++] = (char)('0' + m % 10);
    if (minus) *to++ = '-';
    while (count > k) *to++ = digits[--count];
    if (k > 0) *to++ = '.';
    while (count > 0) *to++ = digits[--count];
    *to = '\0';
}

/* Lemma. Let m < 10^15 be whole and k <= 19, so that m and 10^k are doubles (10^19 = 2^19 5^19, and
 * 5^19 < 2^53), and let their quotient round to x. Decimals of 15 digits are farther apart than
 * doubles, so that the one nearest to x is m / 10^k, which "%.15g" writes: without an exponent from
 * 1e-4 on, and without zeros behind the point, which k being least excludes too. */
bool text_short_number(char to[TEXT_SHORT + 1], double x)
{
    const double size = fabs(x), most = 1e15;
    double power = 1;
    if (!(size >= 1e-4 && size < most) && !(size == 0 && !signbit(x))) return false;
    for (int k = 0; k < 19 && size * power < most - 0.5; ++k, power *= 10) {
        const uint64_t m = (uint64_t)(size * power + 0.5);
        if ((double)m / power != size) continue;
        write_decimal(to, x < 0, m, k);
        return true;
    }
    return false;
}

text_number text_of_number(double x)
{
    text_number text;
    if (text_short_number(text.at, x)) return text;
    for (int digits = 15; digits <= 17; ++digits) {
        snprintf(text.at, sizeof text.at, "%.*g", digits, x);
        if (strtod(text.at, NULL) == x) break;
    }
    char *comma = strchr(text.at, ',');
    if (comma != NULL) *comma = '.';
    return text;
}

size_t text_characters(const char *s, size_t bytes)
{
    size_t n = 0;
    for (size_t i = 0; i < bytes; ++i)
        if (((unsigned char)s[i] & 0xC0) != 0x80) ++n;
    return n;
}
