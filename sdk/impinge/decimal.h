/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_DECIMAL_H
#define IMPINGE_DECIMAL_H

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Numbers of text files
 * =====================
 *
 *   double x;
 *   if (!imp_decimal_number(word, strlen(word), &x)) complain about the word;
 *
 * reads a decimal number, with a point in every locale, and rounds it to the nearest double, as
 * strtod does in the C locale. Most numbers take a tenth of strtod's time. The rounding mode must
 * be "to nearest". */

/* A number as it was written: digits * 10^exponent, negative if `minus`. */
typedef struct imp_decimal {
    uint64_t digits;
    int exponent;
    size_t before, behind; /* count of digits before and behind the point */
    bool minus, plus;      /* the sign that was written */
    bool has_point;
    bool fits; /* else `digits` or `exponent` overflowed, and only the others are valid */
} imp_decimal;

enum {
    IMP_DECIMAL_DIGITS = 19,  /* 10^19 < 2^64 */
    IMP_DECIMAL_POWER = 27,   /* 5^27 < 2^63 */
    IMP_DECIMAL_LENGTH = 100, /* longest number that imp_decimal_number reads; characters */
};

#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
/* Reads eight characters, the first in the lowest byte. False: one is no digit.
 *
 * Lemma. '0' to '9' are 0x30 to 0x39. A byte whose high half is 3 keeps it when 6 is added if its
 * low half is at most 9; no byte carries then. Each product joins neighbours: digits to numbers
 * below 100, these to numbers below 10^4, these to one below 10^8. Its sums are below 2^8, 2^16 and
 * 2^32, in lanes of as many bits, so that no lane carries. */
static inline bool imp_decimal_eight(const char *at, uint64_t *eight)
{
    const uint64_t highs = UINT64_C(0xf0f0f0f0f0f0f0f0), threes = UINT64_C(0x3030303030303030);
    uint64_t x;
    memcpy(&x, at, sizeof x);
    if ((x & highs) != threes || ((x + UINT64_C(0x0606060606060606)) & highs) != threes)
        return false;
    x -= threes;
    x = (x * (10 * 256 + 1) >> 8) & UINT64_C(0x00ff00ff00ff00ff);
    x = (x * (100 * 65536 + 1) >> 16) & UINT64_C(0x0000ffff0000ffff);
    *eight = (x * (10000 * (UINT64_C(1) << 32) + 1)) >> 32;
    return true;
}
#else
static inline bool imp_decimal_eight(const char *at, uint64_t *eight)
{
    (void)at, (void)eight;
    return false;
}
#endif

/* Appends digits to *all, and returns the first character that is none. */
static inline const char *imp_decimal_digits(const char *at, const char *end, uint64_t *all)
{
    uint64_t eight;
    for (; end - at >= 8 && imp_decimal_eight(at, &eight); at += 8) *all = 100000000 * *all + eight;
    for (; at < end; ++at) {
        const unsigned digit = (unsigned)(unsigned char)*at - '0';
        if (digit > 9) break;
        *all = 10 * *all + digit;
    }
    return at;
}

/* Whether at most IMP_DECIMAL_DIGITS digits follow the leading zeros. */
static inline bool imp_decimal_is_short(const char *first, size_t count)
{
    while (count > IMP_DECIMAL_DIGITS && (*first == '0' || *first == '.')) {
        count -= *first == '0';
        ++first;
    }
    return count <= IMP_DECIMAL_DIGITS;
}

/* Reads what follows an 'e'. NULL: no digits. */
static inline const char *imp_decimal_power(const char *at, const char *end, imp_decimal *d)
{
    uint64_t power = 0;
    const bool minus = at < end && *at == '-';
    if (at < end && (minus || *at == '+')) ++at;
    const char *const stop = imp_decimal_digits(at, end, &power);
    if (stop == at) return NULL;
    if (stop - at > 4) d->fits = false;
    if (d->fits) d->exponent += minus ? -(int)power : (int)power;
    return stop;
}

/* Reads the number that begins at `at`: a sign, digits with a point somewhere, and an exponent,
 * each of which but one digit may be missing. Returns where it ends. NULL: there is none. */
static inline const char *imp_decimal_scan(const char *at, const char *end, imp_decimal *d)
{
    d->digits = 0;
    d->minus = at < end && *at == '-';
    d->plus = at < end && *at == '+';
    if (d->minus || d->plus) ++at;
    const char *const first = at;
    at = imp_decimal_digits(at, end, &d->digits);
    d->before = (size_t)(at - first);
    d->behind = 0;
    d->has_point = at < end && *at == '.';
    if (d->has_point) {
        const char *const point = at + 1;
        at = imp_decimal_digits(point, end, &d->digits);
        d->behind = (size_t)(at - point);
    }
    if (d->before + d->behind == 0) return NULL;
    d->fits = d->before + d->behind <= IMP_DECIMAL_DIGITS ||
              (d->behind < 1000 && imp_decimal_is_short(first, d->before + d->behind));
    d->exponent = d->fits ? -(int)d->behind : 0;
    if (at < end && (*at == 'e' || *at == 'E')) return imp_decimal_power(at + 1, end, d);
    return at;
}

__extension__ typedef unsigned __int128 imp_decimal_wide;

/* Returns 2^k for -1022 <= k <= 1023. */
static inline double imp_decimal_power_of_2(int k)
{
    const uint64_t bits = (uint64_t)(1023 + k) << 52;
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Lemma. The result is the double nearest to w * 2^k, ties to even, where w >= 2^62, and w is
 * `whole` plus less than 1, of which `is_more` tells whether it is above 0. Of the 63 or 64 bits of
 * `whole` a double has 53, so that the last bit is at least 9 places below the last that is kept:
 * set where there is more, it moves w off a tie and past no other double. The conversion rounds w
 * once. |k| < 200, so that the product is exact. */
static inline double imp_decimal_rounded(uint64_t whole, bool is_more, int k)
{
    return (double)(whole | (uint64_t)is_more) * imp_decimal_power_of_2(k);
}

/* Returns 5^k for 0 <= k <= IMP_DECIMAL_POWER, which is below 2^63. */
static inline uint64_t imp_decimal_power_of_5(int k)
{
    static const uint64_t power[] = {
        UINT64_C(1),
        UINT64_C(5),
        UINT64_C(25),
        UINT64_C(125),
        UINT64_C(625),
        UINT64_C(3125),
        UINT64_C(15625),
        UINT64_C(78125),
        UINT64_C(390625),
        UINT64_C(1953125),
        UINT64_C(9765625),
        UINT64_C(48828125),
        UINT64_C(244140625),
        UINT64_C(1220703125),
        UINT64_C(6103515625),
        UINT64_C(30517578125),
        UINT64_C(152587890625),
        UINT64_C(762939453125),
        UINT64_C(3814697265625),
        UINT64_C(19073486328125),
        UINT64_C(95367431640625),
        UINT64_C(476837158203125),
        UINT64_C(2384185791015625),
        UINT64_C(11920928955078125),
        UINT64_C(59604644775390625),
        UINT64_C(298023223876953125),
        UINT64_C(1490116119384765625),
        UINT64_C(7450580596923828125),
    };
    return power[k];
}

/* Lemma. w * 10^k = (w 5^k) 2^k, and w 5^k < 2^64 2^63 is computed exactly; it is shifted so that
 * 64 bits are above the point. */
static inline double imp_decimal_times(uint64_t w, int k)
{
    const imp_decimal_wide product = (imp_decimal_wide)w * imp_decimal_power_of_5(k);
    const uint64_t high = (uint64_t)(product >> 64), low = (uint64_t)product;
    if (high == 0) return (double)low * imp_decimal_power_of_2(k);
    const int room = __builtin_clzll(high);
    const imp_decimal_wide top = product << room;
    return imp_decimal_rounded((uint64_t)(top >> 64), (uint64_t)top != 0, 64 - room + k);
}

/* Lemma. With a and b such that n = w 2^a and d = 5^k 2^b are in [2^63, 2^64),
 * w / 10^k = (n 2^63 / d) 2^(b - a - k - 63). The quotient is in (2^62, 2^64); its whole part and
 * whether there is a rest are computed exactly. */
static inline double imp_decimal_over(uint64_t w, int k)
{
    const uint64_t power = imp_decimal_power_of_5(k);
    const int a = __builtin_clzll(w), b = __builtin_clzll(power);
    const uint64_t d = power << b;
    const imp_decimal_wide n = (imp_decimal_wide)(w << a) << 63;
    const uint64_t quotient = (uint64_t)(n / d);
    const bool is_more = (uint64_t)n != quotient * d; /* modulo 2^64, and the rest is below d */
    return imp_decimal_rounded(quotient, is_more, b - a - k - 63);
}

/* Computes the double nearest to the number. False: it has too many digits or too large an
 * exponent for this.
 *
 * Lemma. Below 2^53 the digits are a double exactly, and so is a power of ten up to 10^22: their
 * quotient, rounded once, is the nearest double. */
static inline bool imp_decimal_value(const imp_decimal *d, double *x)
{
    static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const int k = d->exponent;
    double size;
    if (!d->fits || k > IMP_DECIMAL_POWER || k < -IMP_DECIMAL_POWER) return false;
    if (d->digits >> 53 == 0 && k <= 0 && k >= -22)
        size = (double)d->digits / power[-k];
    else if (d->digits == 0)
        size = 0;
    else
        size = k < 0 ? imp_decimal_over(d->digits, -k) : imp_decimal_times(d->digits, k);
    *x = d->minus ? -size : size;
    return true;
}

/* Reads what imp_decimal_value does not. False: it is too long or too large. */
static inline bool imp_decimal_by_strtod(const char *text, size_t length, double *x)
{
    char copy[IMP_DECIMAL_LENGTH], *end;
    if (length >= sizeof copy) return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    char *point = strchr(copy, '.');
    if (point != NULL) *point = *localeconv()->decimal_point;
    *x = strtod(copy, &end);
    return end == copy + length && isfinite(*x);
}

/* Reads a text that is a number, all of it. False: it is none, or too large for a double. */
static inline bool imp_decimal_number(const char *text, size_t length, double *x)
{
    imp_decimal d = {0, 0, 0, 0, false, false, false, false};
    if (length >= IMP_DECIMAL_LENGTH || imp_decimal_scan(text, text + length, &d) != text + length)
        return false;
    return imp_decimal_value(&d, x) || imp_decimal_by_strtod(text, length, x);
}

#ifdef __cplusplus
}
#endif

#endif
