/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_FORMULA_TEXT_H
#define IMPINGE_FORMULA_TEXT_H

#include <impinge/surface.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Printing formulas
 * =================
 * For the callback write_formula of a type whose formula depends on lists, or has pieces; most
 * types have a constant text instead. Define the numbers by names, then print the text that uses
 * them:
 *
 *   static imp_status plate_write_formula(const void *self, const imp_text_sink *to)
 *   {
 *       const plate *p = self;
 *       for (size_t k = 0; k < 9; k++) imp_define_at(to, "p", k, p->corner[k]);
 *       imp_add_text(to, "u in [0, 1]; v in [0, 1]; p0 + p3*u + p6*v; p1 + p4*u + p7*v; "
 *                        "p2 + p5*u + p8*v");
 *       return IMP_STATUS_OK;
 *   }
 *
 * Numbers are exact: who reads one has the same double again. The locale has no influence. */

static inline void imp_add_text(const imp_text_sink *to, const char *text)
{
    to->add(to, text, strlen(text));
}

static inline void imp_add_whole(const imp_text_sink *to, uint64_t n)
{
    char digits[24];
    size_t at = sizeof digits;
    do digits[--at] = (char)('0' + n % 10);
    while ((n /= 10) > 0);
    to->add(to, digits + at, sizeof digits - at);
}

/* Writes a point and `count` digits, at most 14, without the zeros at their end. */
static inline void imp_add_fraction_(const imp_text_sink *to, uint64_t digits, int count,
                                     unsigned base)
{
    char text[16] = ".";
    for (int k = count; k > 0; k--, digits /= base) text[k] = "0123456789abcdef"[digits % base];
    while (count > 0 && text[count] == '0') count--;
    if (count > 0) to->add(to, text, (size_t)count + 1);
}

/* 0x1.8p-3: a leading 1, the other 52 bits, and the power of 2. size > 0. */
static inline void imp_add_hexadecimal_(const imp_text_sink *to, double size)
{
    int power;
    const uint64_t bits = (uint64_t)ldexp(frexp(size, &power), 53);
    imp_add_text(to, "0x1");
    imp_add_fraction_(to, bits & (((uint64_t)1 << 52) - 1), 13, 16);
    imp_add_text(to, power < 1 ? "p-" : "p");
    imp_add_whole(to, (uint64_t)(power < 1 ? 1 - power : power - 1));
}

/* Writes a size: 3, 0.375, 0x1.999999999999ap-4 or inf. */
static inline void imp_add_size_(const imp_text_sink *to, double size)
{
    const double sixtyfourths = size * 64;
    if (size > 0x1p1023 * 1.9999999999999998) {
        imp_add_text(to, "inf");
    } else if (size < 0x1p40 && sixtyfourths == floor(sixtyfourths)) {
        imp_add_whole(to, (uint64_t)size);
        imp_add_fraction_(to, (uint64_t)((size - floor(size)) * 1000000), 6, 10);
    } else {
        imp_add_hexadecimal_(to, size);
    }
}

/* Writes a number that is not NaN; what is negative in parentheses. */
static inline void imp_add_number(const imp_text_sink *to, double x)
{
    if (x < 0) imp_add_text(to, "(-");
    imp_add_size_(to, fabs(x));
    if (x < 0) imp_add_text(to, ")");
}

/* Writes "name = x; ", and with a place behind the name "name3 = x; ". */
static inline void imp_define(const imp_text_sink *to, const char *name, double x)
{
    imp_add_text(to, name);
    imp_add_text(to, " = ");
    imp_add_number(to, x);
    imp_add_text(to, "; ");
}

static inline void imp_define_at(const imp_text_sink *to, const char *name, size_t place, double x)
{
    imp_add_text(to, name);
    imp_add_whole(to, place);
    imp_add_text(to, " = ");
    imp_add_number(to, x);
    imp_add_text(to, "; ");
}

/* Writes "t in [lo, hi]; " for another variable, too; ends may be infinite. */
static inline void imp_add_range(const imp_text_sink *to, const char *variable, double lo,
                                 double hi)
{
    const double end[2] = {lo, hi};
    imp_add_text(to, variable);
    imp_add_text(to, " in [");
    for (int k = 0; k < 2; k++) {
        if (k > 0) imp_add_text(to, ", ");
        if (end[k] < 0) imp_add_text(to, "-");
        imp_add_size_(to, fabs(end[k]));
    }
    imp_add_text(to, "]; ");
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_FORMULA_TEXT_H */
