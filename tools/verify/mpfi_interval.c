/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/ld_interval.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <mpfi.h>
#include <stdint.h>

/* The interval arithmetic of the verifier
 * =======================================
 * ld_interval.h by MPFI, with as many bits as a long double has: what goes in and comes out is
 * exact, and MPFI rounds outward. It replaces ld_interval.c; jets and formulas are the same. */

enum { OPERANDS = 3 };

static mpfi_ptr operand(int k)
{
    static mpfi_t at[OPERANDS];
    static bool is_ready = false;
    for (int i = 0; i < OPERANDS && !is_ready; ++i) mpfi_init2(at[i], LDBL_MANT_DIG);
    is_ready = true;
    return at[k];
}

#if LDBL_MANT_DIG == 64 && GMP_NUMB_BITS == 64 && defined __x86_64__

/* A long double of the x87: m 2^(e - 16383 - 63), m with its highest bit, which in MPFR is the
 * significand m / 2^64 with the exponent e - 16382. A third of the time is saved beside
 * mpfr_set_ld and mpfr_get_ld, which other numbers and machines take. */
typedef union extended {
    long double x;
    struct {
        uint64_t m;
        uint16_t e; /* the sign is the highest bit */
    } bits;
} extended;

enum { EXPONENT_BIAS = 16382, EXPONENT_MAX = 32766 };

static void set(mpfr_ptr to, long double x, mpfr_rnd_t round)
{
    const extended u = {x};
    const int e = u.bits.e & 32767;
    if (e < 1 || e > EXPONENT_MAX) {
        mpfr_set_ld(to, x, round);
        return;
    }
    *(uint64_t *)mpfr_custom_get_significand(to) = u.bits.m;
    mpfr_custom_init_set(to, x < 0 ? -MPFR_REGULAR_KIND : MPFR_REGULAR_KIND, e - EXPONENT_BIAS,
                         LDBL_MANT_DIG, mpfr_custom_get_significand(to));
}

static long double get(mpfr_srcptr from, mpfr_rnd_t round)
{
    if (!mpfr_regular_p(from)) return mpfr_get_ld(from, round);
    const mpfr_exp_t e = mpfr_get_exp(from) + EXPONENT_BIAS;
    if (e < 1 || e > EXPONENT_MAX) return mpfr_get_ld(from, round);
    extended u = {.bits = {*(const uint64_t *)mpfr_custom_get_significand(from), (uint16_t)e}};
    return mpfr_sgn(from) < 0 ? -u.x : u.x;
}

#else

static void set(mpfr_ptr to, long double x, mpfr_rnd_t round) { mpfr_set_ld(to, x, round); }
static long double get(mpfr_srcptr from, mpfr_rnd_t round) { return mpfr_get_ld(from, round); }

#endif

/* Sets operand k. */
static mpfi_ptr given(int k, ld_interval x)
{
    mpfi_ptr y = operand(k);
    set(&y->left, x.lo, MPFR_RNDD);
    set(&y->right, x.hi, MPFR_RNDU);
    return y;
}

static ld_interval taken(mpfi_srcptr x)
{
    if (mpfi_nan_p(x)) return ld_interval_entire();
    return ld_interval_make(get(&x->left, MPFR_RNDD), get(&x->right, MPFR_RNDU));
}

typedef int unary(mpfi_ptr, mpfi_srcptr);
typedef int binary(mpfi_ptr, mpfi_srcptr, mpfi_srcptr);

static ld_interval by(unary *f, ld_interval x)
{
    mpfi_ptr to = operand(0);
    f(to, given(1, x));
    return taken(to);
}

static ld_interval by_both(binary *f, ld_interval x, ld_interval y)
{
    mpfi_ptr to = operand(0);
    f(to, given(1, x), given(2, y));
    return taken(to);
}

/* The part of x in [lo, hi]. False: there is none. */
static bool clipped(ld_interval *x, long double lo, long double hi)
{
    const bool some = x->lo <= hi && x->hi >= lo;
    *x = ld_interval_make(x->lo > lo ? x->lo : lo, x->hi < hi ? x->hi : hi);
    return some;
}

static bool is_finite(ld_interval x) { return ld_interval_mag(x) < INFINITY; }

/* --- Constants and sums ----------------------------------------------------------------------- */

ld_interval ld_interval_pi(void)
{
    mpfi_const_pi(operand(0));
    return taken(operand(0));
}

ld_interval ld_interval_e(void) { return ld_interval_exp(ld_interval_of(1)); }

ld_interval ld_interval_add(ld_interval x, ld_interval y)
{
    if (ld_interval_is(x, 0)) return y;
    return ld_interval_is(y, 0) ? x : by_both(mpfi_add, x, y);
}

ld_interval ld_interval_sub(ld_interval x, ld_interval y)
{
    return ld_interval_add(x, ld_interval_neg(y));
}

/* 0 times an infinite end is 0: jets use it for what does not depend on a variable. */
ld_interval ld_interval_mul(ld_interval x, ld_interval y)
{
    if (ld_interval_is(x, 0) || ld_interval_is(y, 0)) return ld_interval_of(0);
    if (ld_interval_is(x, 1)) return y;
    if (ld_interval_is(y, 1)) return x;
    return is_finite(x) && is_finite(y) ? by_both(mpfi_mul, x, y) : ld_interval_entire();
}

ld_interval ld_interval_scale(ld_interval x, long double k)
{
    return ld_interval_mul(x, ld_interval_of(k));
}

ld_interval ld_interval_inverse(ld_interval x)
{
    return x.lo > 0 || x.hi < 0 ? by(mpfi_inv, x) : ld_interval_entire();
}

ld_interval ld_interval_div(ld_interval x, ld_interval y)
{
    if (ld_interval_is(x, 0)) return x;
    if (!(y.lo > 0 || y.hi < 0) || !is_finite(x)) return ld_interval_entire();
    return by_both(mpfi_div, x, y);
}

ld_interval ld_interval_sqr(ld_interval x) { return by(mpfi_sqr, x); }

/* --- Functions -------------------------------------------------------------------------------- */

ld_interval ld_interval_sqrt(ld_interval x)
{
    return clipped(&x, 0, INFINITY) ? by(mpfi_sqrt, x) : ld_interval_entire();
}

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

/* A wave is in [-1, 1]; where the argument is long, that is all. */
static ld_interval wave(unary *f, ld_interval x)
{
    if (!(x.hi - x.lo < 6.25L) || ld_interval_mag(x) > 0x1p40L) return ld_interval_make(-1, 1);
    return by(f, x);
}

ld_interval ld_interval_sin(ld_interval x) { return wave(mpfi_sin, x); }
ld_interval ld_interval_cos(ld_interval x) { return wave(mpfi_cos, x); }

ld_interval ld_interval_tan(ld_interval x)
{
    return is_finite(x) ? ld_interval_div(ld_interval_sin(x), ld_interval_cos(x))
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
    if (!(x.hi > 0) || !is_finite(x) || !is_finite(y)) return ld_interval_entire();
    const ld_interval positive = {x.lo > 0 ? x.lo : x.hi, x.hi};
    const ld_interval z = ld_interval_exp(ld_interval_mul(y, ld_interval_log(positive)));
    if (x.lo > 0) return z;
    return ld_interval_make(0, y.lo > 0 ? (z.hi > 1 ? z.hi : 1) : INFINITY);
}

/* By the half plane of the point; across the cut, or with (0, 0) inside, all angles. */
ld_interval ld_interval_angle(ld_interval y, ld_interval x)
{
    const ld_interval quarter = ld_interval_mul(ld_interval_pi(), ld_interval_of(0.5L));
    if (x.lo > 0) return ld_interval_atan(ld_interval_div(y, x));
    if (y.lo > 0) return ld_interval_sub(quarter, ld_interval_atan(ld_interval_div(x, y)));
    if (y.hi < 0)
        return ld_interval_neg(ld_interval_add(quarter, ld_interval_atan(ld_interval_div(x, y))));
    return ld_interval_entire();
}
