/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/ld_interval.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <mpfi.h>
#include <stdint.h>
#include <string.h>

/* The functions of the verifier's intervals
 * =========================================
 * They are those of MPFI, which rounds outward, with as many bits as a double has: operands and
 * results are converted exactly. double_interval.h has the operations. */

static ld_interval taken(mpfi_srcptr x)
{
    if (mpfi_nan_p(x)) return ld_interval_entire();
    return ld_interval_make(mpfr_get_d(&x->left, MPFR_RNDD), mpfr_get_d(&x->right, MPFR_RNDU));
}

typedef int unary(mpfi_ptr, mpfi_srcptr);
/* Results that were computed last, by function and operand: halves of a cell share most of their
 * operands. */
typedef struct memory {
    unary *f; /* NULL: nothing */
    ld_interval x, y;
} memory;

enum { MEMORY_SIZE = 4096 }; /* a power of 2; 160 KiB */

static memory *place_of(unary *f, ld_interval x)
{
    static memory all[MEMORY_SIZE];
    uint64_t bits[2];
    memcpy(bits, &x, sizeof bits);
    const uint64_t mixed = (bits[0] * 3 + bits[1] + (uintptr_t)f) * UINT64_C(0x9e3779b97f4a7c15);
    return &all[mixed >> 52 & (MEMORY_SIZE - 1)];
}

static ld_interval by(unary *f, ld_interval x)
{
    static mpfi_t from, to;
    memory *m = place_of(f, x);
    if (m->f == f && m->x.lo == x.lo && m->x.hi == x.hi) return m->y;
    if (from->left._mpfr_d == NULL) mpfi_init2(from, DBL_MANT_DIG), mpfi_init2(to, DBL_MANT_DIG);
    mpfr_set_d(&from->left, x.lo, MPFR_RNDD);
    mpfr_set_d(&from->right, x.hi, MPFR_RNDU);
    f(to, from);
    *m = (memory){f, x, taken(to)};
    return m->y;
}

/* Reduces x to its part in [lo, hi]. False: there is none. */
static bool clipped(ld_interval *x, double lo, double hi)
{
    const bool some = x->lo <= hi && x->hi >= lo;
    *x = ld_interval_make(x->lo > lo ? x->lo : lo, x->hi < hi ? x->hi : hi);
    return some;
}

/* --- Constants -------------------------------------------------------------------------------- */

static int pi_of(mpfi_ptr y, mpfi_srcptr unused)
{
    (void)unused;
    return mpfi_const_pi(y);
}

ld_interval ld_interval_pi(void) { return by(pi_of, ld_interval_of(0)); }
ld_interval ld_interval_e(void) { return ld_interval_exp(ld_interval_of(1)); }

/* --- Functions -------------------------------------------------------------------------------- */

ld_interval ld_interval_cbrt(ld_interval x) { return by(mpfi_cbrt, x); }

ld_interval ld_interval_exp(ld_interval x) { return by(mpfi_exp, x); }

ld_interval ld_interval_log(ld_interval x)
{
    if (!(x.hi > 0)) return ld_interval_entire();
    const ld_interval y = by(mpfi_log, ld_interval_make(x.lo > 0 ? x.lo : x.hi, x.hi));
    return x.lo > 0 ? y : ld_interval_make(-INFINITY, y.hi);
}

ld_interval ld_interval_asin(ld_interval x)
{
    return clipped(&x, -1, 1) ? by(mpfi_asin, x) : ld_interval_entire();
}

ld_interval ld_interval_acos(ld_interval x)
{
    return clipped(&x, -1, 1) ? by(mpfi_acos, x) : ld_interval_entire();
}

ld_interval ld_interval_atan(ld_interval x) { return by(mpfi_atan, x); }
ld_interval ld_interval_sinh(ld_interval x) { return by(mpfi_sinh, x); }
ld_interval ld_interval_cosh(ld_interval x) { return by(mpfi_cosh, x); }
ld_interval ld_interval_tanh(ld_interval x) { return by(mpfi_tanh, x); }

/* Computes a sine or cosine. For a wide argument the result is [-1, 1]. */
static ld_interval wave(unary *f, ld_interval x)
{
    if (!(x.hi - x.lo < 6.25) || ld_interval_mag(x) > 0x1p40) return ld_interval_make(-1, 1);
    return by(f, x);
}

ld_interval ld_interval_sin(ld_interval x) { return wave(mpfi_sin, x); }
ld_interval ld_interval_cos(ld_interval x) { return wave(mpfi_cos, x); }

ld_interval ld_interval_tan(ld_interval x)
{
    return ld_interval_is_finite(x) ? ld_interval_div(ld_interval_sin(x), ld_interval_cos(x))
                                    : ld_interval_entire();
}

/* --- Powers ----------------------------------------------------------------------------------- */

/* Even powers are those of |x|. Products of few factors: formulas use small powers. */
ld_interval ld_interval_integer_power(ld_interval x, int n)
{
    if (n == 0) return ld_interval_of(1);
    if (n == 1) return x;
    if (n == 2) return ld_interval_sqr(x);
    if (n == INT_MIN) return ld_interval_entire();
    if (n < 0) return ld_interval_inverse(ld_interval_integer_power(x, -n));
    const ld_interval half = ld_interval_integer_power(x, n / 2), most = ld_interval_sqr(half);
    return n % 2 == 0 ? most : ld_interval_mul(most, x);
}

/* x^y = exp(y log x), x >= 0; with 0 in x, from 0 to the greatest value, where y > 0. */
ld_interval ld_interval_power(ld_interval x, ld_interval y)
{
    if (x.hi == 0 && y.lo > 0) return ld_interval_of(0);
    if (!(x.hi > 0) || !ld_interval_is_finite(x) || !ld_interval_is_finite(y))
        return ld_interval_entire();
    const ld_interval positive = {x.lo > 0 ? x.lo : x.hi, x.hi};
    const ld_interval z = ld_interval_exp(ld_interval_mul(y, ld_interval_log(positive)));
    if (x.lo > 0) return z;
    return ld_interval_make(0, y.lo > 0 ? (z.hi > 1 ? z.hi : 1) : INFINITY);
}

/* Chooses the formula by the half plane that the box (x, y) is in; across the cut, or with (0, 0)
 * inside, the result is the whole line. */
ld_interval ld_interval_angle(ld_interval y, ld_interval x)
{
    const ld_interval quarter = ld_interval_mul(ld_interval_pi(), ld_interval_of(0.5));
    if (x.lo > 0) return ld_interval_atan(ld_interval_div(y, x));
    if (y.lo > 0) return ld_interval_sub(quarter, ld_interval_atan(ld_interval_div(x, y)));
    if (y.hi < 0)
        return ld_interval_neg(ld_interval_add(quarter, ld_interval_atan(ld_interval_div(x, y))));
    return ld_interval_entire();
}
