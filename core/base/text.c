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

/* A decimal: m / 10^k. */
typedef struct decimal {
    uint64_t m;
    int k;
    double power; /* 10^k */
} decimal;

/* Powers of ten, of which each number of digits up to 31 is a sum without repetition. */
enum { STRIDES = 5 };
static const decimal strides[STRIDES] = {{10000000000000000, 16, 1e16},
                                         {100000000, 8, 1e8},
                                         {10000, 4, 1e4},
                                         {100, 2, 1e2},
                                         {10, 1, 10}};

/* Rounds 1e-4 <= x < 1e15 to 15 digits, ties to even, without zeros behind the point.
 * Lemma. 10^k is a double up to k = 22, and fma gives what the product's rounding leaves, so that
 * product + left is x 10^k exactly. It is below 2^50, and its whole part exact: what is beyond a
 * half is compared exactly. k, at most 19, is chosen by a rounded product: where that reaches 10^15
 * and x 10^k does not, it lies within 1/8 of 10^15, and one digit less writes the same number. Then
 * m has at most 15 zeros that k counts. */
static decimal fifteen_digits(double x)
{
    decimal d = {.k = 0, .power = 1};
    for (int j = 0; j < STRIDES; ++j)
        if (x * (d.power * strides[j].power) < 1e15) {
            d.k += strides[j].k;
            d.power *= strides[j].power;
        }
    const double product = x * d.power, left = fma(x, d.power, -product);
    d.m = (uint64_t)product;
    const double beyond = product - (double)d.m - 0.5;
    if (beyond > -left || (beyond == -left && d.m % 2 == 1)) d.m += 1;
    for (int j = 1; j < STRIDES; ++j)
        if (d.k >= strides[j].k && d.m % strides[j].m == 0) {
            d.m /= strides[j].m;
            d.k -= strides[j].k;
            d.power /= strides[j].power;
        }
    return d;
}

/* Whether x has a decimal as text_fifteen_digits writes it. */
static bool is_plain(double x)
{
    const double size = fabs(x);
    return (size >= 1e-4 && size < 1e15 - 0.5) || (size == 0 && !signbit(x));
}

static decimal decimal_of(double x)
{
    return x == 0 ? (decimal){.power = 1} : fifteen_digits(fabs(x));
}

bool text_fifteen_digits(char to[TEXT_SHORT + 1], double x)
{
    if (!is_plain(x)) return false;
    const decimal d = decimal_of(x);
    write_decimal(to, x < 0, d.m, d.k);
    return true;
}

bool text_of_fifteen(char *to, size_t size, double x)
{
    if (size > TEXT_SHORT && text_fifteen_digits(to, x)) return true;
    const int length = snprintf(to, size, "%.15g", x);
    return length >= 0 && (size_t)length < size;
}

/* Lemma. Let m < 10^15 be whole and k <= 19, so that m and 10^k are doubles (10^19 = 2^19 5^19, and
 * 5^19 < 2^53), and let their quotient round to x. Decimals of 15 digits are farther apart than
 * doubles, so that the one nearest to x is m / 10^k, which "%.15g" writes. */
bool text_short_number(char to[TEXT_SHORT + 1], double x)
{
    if (!is_plain(x)) return false;
    const decimal d = decimal_of(x);
    if ((double)d.m / d.power != fabs(x)) return false;
    write_decimal(to, x < 0, d.m, d.k);
    return true;
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
