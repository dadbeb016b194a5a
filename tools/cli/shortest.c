/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/shortest.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <impinge/decimal.h>

/* --- 17 digits -------------------------------------------------------------------------------- */

enum { DIGITS = 17 };
#define LEAST UINT64_C(10000000000000000) /* of the whole numbers of 17 digits */

/* Finds the 17 digits nearest to x > 0, and the power of ten of the first of them. False: x is not
 * in the range, about 1e-11 to 1e16, for which 128 bits are enough.
 *
 * Lemma. x = m 2^(e - 53), m < 2^53, and x 10^k = (m 5^k) 2^(e + k - 53). m 5^k < 2^53 2^63 is
 * computed exactly, and so are its whole part and its rest after the shift; halves are rounded to
 * even, as printf does. */
static bool digits_of_17(double x, uint64_t *digits, int *power)
{
    enum { MANTISSA = 53 };
    int e;
    const uint64_t m = (uint64_t)ldexp(frexp(x, &e), MANTISSA);
    int k = DIGITS - 1 - (int)floor((e - 1) * 0.30102999566398120); /* log10(x), or one below */
    for (int tries = 0; tries < 2; ++tries, --k) {
        const int shift = MANTISSA - e - k;
        if (k < 0 || k > IMP_DECIMAL_POWER || shift < 1 || shift > 127) return false;
        const imp_decimal_wide product = (imp_decimal_wide)m * imp_decimal_power_of_5(k);
        const imp_decimal_wide whole = product >> shift, rest = product - (whole << shift);
        const imp_decimal_wide half = (imp_decimal_wide)1 << (shift - 1);
        *digits = (uint64_t)whole + (rest > half || (rest == half && (uint64_t)whole % 2 == 1));
        *power = DIGITS - 1 - k;
        if (*digits < 10 * LEAST) return *digits >= LEAST;
    }
    return false;
}

/* Writes the first `count` digits in Jansson's form, for -99 <= power <= 15. Returns the length. */
static size_t place_point(const char *digits, int count, int power, char *to)
{
    const bool has_power = power < -4;
    const int before = has_power ? 1 : power + 1; /* the point */
    char *at = to;
    int k = 0;
    if (before <= 0) *at++ = '0';
    for (; k < before; ++k) *at++ = k < count ? digits[k] : '0';
    if (!has_power || count > 1) *at++ = '.';
    for (int zeros = before; zeros < 0; ++zeros) *at++ = '0';
    for (; k < count; ++k) *at++ = digits[k];
    if (!has_power && count <= before) *at++ = '0';
    if (has_power) {
        *at++ = 'e';
        *at++ = '-';
        if (power <= -10) *at++ = (char)('0' + -power / 10);
        *at++ = (char)('0' + -power % 10);
    }
    *at = '\0';
    return (size_t)(at - to);
}

/* Gives a number that printf wrote the form that Jansson has: a point in whole numbers, no plus and
 * no zeros in front of a power of ten. Returns the length. */
static size_t form_as_jansson(char *text, size_t length)
{
    char *power = strchr(text, 'e');
    if (power == NULL && strchr(text, '.') != NULL) return length;
    if (power == NULL) {
        strcpy(text + length, ".0");
        return length + 2;
    }
    power += power[1] == '-' ? 2 : 1;
    const size_t more = strspn(power, "+0");
    memmove(power, power + more, strlen(power + more) + 1);
    return length - more;
}

/* Writes "%.17g" in Jansson's form. */
static size_t write_17(double number, char to[SHORTEST_SIZE])
{
    uint64_t digits;
    int power, count = DIGITS;
    char all[DIGITS];
    if (number == 0 || !digits_of_17(fabs(number), &digits, &power) || power >= 15)
        return form_as_jansson(to, (size_t)snprintf(to, SHORTEST_SIZE, "%.17g", number));
    for (int k = DIGITS - 1; k >= 0; --k, digits /= 10) all[k] = (char)('0' + digits % 10);
    while (count > 1 && all[count - 1] == '0') --count;
    const size_t minus = number < 0;
    *to = '-';
    return minus + place_point(all, count, power, to + minus);
}

/* --- Fewer ------------------------------------------------------------------------------------ */

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
 * least one of them, so that the number is rounded down too; if it is above, up. All three
 * precisions have the form of the text, but if there are more than 14 digits before the point, if
 * a whole number has ".0", or if the rounding carries into a new digit. */
static size_t write_rounded(const char *from, size_t length, size_t digits, char to[SHORTEST_SIZE])
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

static bool reads_back(const char *text, size_t length, double number)
{
    double x;
    return (imp_decimal_number(text, length, &x) ? x : strtod(text, NULL)) == number;
}

/* A text of up to 15 characters is one of 15 digits already, perhaps with the ".0" of whole
 * numbers. */
size_t shortest_write(double number, char to[SHORTEST_SIZE])
{
    const size_t length = write_17(number, to);
    char text[SHORTEST_SIZE];
    if (length <= 15) {
        const bool whole = length > 2 && memcmp(to + length - 2, ".0", 2) == 0;
        to[whole ? length - 2 : length] = '\0';
        return whole ? length - 2 : length;
    }
    for (int digits = may_have_15_digits(to, length, number) ? 15 : 16; digits < 17; ++digits) {
        size_t shorter = write_rounded(to, length, (size_t)digits, text);
        if (shorter == 0) shorter = (size_t)snprintf(text, sizeof text, "%.*g", digits, number);
        if (shorter >= length || !reads_back(text, shorter, number)) continue;
        memcpy(to, text, shorter + 1);
        return shorter;
    }
    return length;
}
