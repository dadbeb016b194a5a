/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_INTERVAL_FUNCTIONS_H
#define IMPINGE_INTERVAL_FUNCTIONS_H

#include <impinge/interval.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Elementary functions of intervals
 * =================================
 *
 * Each contains all values over the interval, rounded outward. Notation of the lemmas, and (L), the
 * error of libm, are those of <impinge/interval.h>. */

/* The doubles next to pi, and those above pi/2 and 2 pi: ends of domains that contain a whole turn.
 */
#define IMP_PI_LOWER 0x1.921fb54442d18p+1
#define IMP_PI_UPPER 0x1.921fb54442d19p+1
#define IMP_HALF_PI_UPPER 0x1.921fb54442d19p+0
#define IMP_TWO_PI_UPPER 0x1.921fb54442d19p+2

/* e^x, within (L) and IMP_TINY. 0 below 2^-1000 and INFINITY above e^709 keep libm from
 * setting errno. */
static inline double imp_libm_exp(double x) { return x < -694 ? 0 : x > 709 ? INFINITY : exp(x); }

/* x^p without a change of errno. This also holds if the compiler was told that pow never sets errno
 * and would remove the code that restores it. */
static inline double imp_libm_pow(double x, double p)
{
    int saved = errno;
    double y = pow(x, p);
#if defined(__GNUC__)
    __asm__ __volatile__("" : "+m"(y) : : "memory");
#endif
    errno = saved;
    return y;
}

static inline double imp_sinh_(double x)
{
    return x < -709 ? -INFINITY : x > 709 ? INFINITY : sinh(x);
}

static inline double imp_cosh_(double x) { return fabs(x) > 709 ? INFINITY : cosh(x); }

/* Beyond 709 the upper end is infinite and the lower end is that of 709, because the function
 * grows; so 1 / (1 + e^x) is known to tend to 0. The operands of imp_smaller and imp_larger are
 * ordered so that a NaN stays NaN, and imp_interval_make then makes the end infinite. */
static inline imp_interval imp_interval_exp(imp_interval x)
{
    return imp_interval_make(imp_larger(imp_libm_down(imp_libm_exp(imp_smaller(709, x.lo))), 0),
                             imp_libm_up(imp_libm_exp(x.hi)));
}

/* If x contains 0 or a negative number, the lower end is -INFINITY. */
static inline imp_interval imp_interval_log(imp_interval x)
{
    if (!(x.hi > 0)) return imp_interval_whole();
    return imp_interval_make(x.lo > 0 ? imp_libm_down(log(x.lo)) : -INFINITY,
                             imp_libm_up(log(x.hi)));
}

static inline imp_interval imp_interval_sinh(imp_interval x)
{
    return imp_interval_make(imp_libm_down(imp_sinh_(imp_smaller(709, x.lo))),
                             imp_libm_up(imp_sinh_(imp_larger(-709, x.hi))));
}

static inline imp_interval imp_interval_cosh(imp_interval x)
{
    double lo = imp_libm_down(imp_cosh_(imp_smaller(709, imp_interval_mig(x))));
    return imp_interval_make(imp_larger(lo, 1), imp_libm_up(imp_cosh_(imp_interval_mag(x))));
}

static inline imp_interval imp_interval_tanh(imp_interval x)
{
    return imp_interval_make(imp_larger(imp_libm_down(tanh(x.lo)), -1),
                             imp_smaller(imp_libm_up(tanh(x.hi)), 1));
}

static inline imp_interval imp_interval_atan(imp_interval x)
{
    return imp_interval_make(imp_larger(imp_libm_down(atan(x.lo)), -IMP_PI_UPPER / 2),
                             imp_smaller(imp_libm_up(atan(x.hi)), IMP_PI_UPPER / 2));
}

/* The parts of x beyond -1 and 1 count as -1 and 1. If x has no other part, the result is the whole
 * line. */
static inline imp_interval imp_interval_asin(imp_interval x)
{
    if (!(x.lo <= 1 && x.hi >= -1)) return imp_interval_whole();
    double lo = imp_libm_down(asin(imp_larger(x.lo, -1)));
    double hi = imp_libm_up(asin(imp_smaller(x.hi, 1)));
    return imp_interval_make(imp_larger(lo, -IMP_PI_UPPER / 2), imp_smaller(hi, IMP_PI_UPPER / 2));
}

static inline imp_interval imp_interval_acos(imp_interval x)
{
    if (!(x.lo <= 1 && x.hi >= -1)) return imp_interval_whole();
    double lo = imp_libm_down(acos(imp_smaller(x.hi, 1)));
    double hi = imp_libm_up(acos(imp_larger(x.lo, -1)));
    return imp_interval_make(imp_larger(lo, 0), imp_smaller(hi, IMP_PI_UPPER));
}

/* Can x contain 2 pi (k + phase) for an integer k? Lemma: y = x / (2 pi) - phase is computed with
 * an error of at most 4 u |x / (2 pi)| (constant, product, difference) + u (|phase| <= 1/2, for the
 * difference), below the slack of 2^-50 (|y| + 1) by which both ends are widened; "yes" is always a
 * sound answer. */
static inline int imp_interval_holds_phase_(imp_interval x, double phase)
{
    const double turn = 0x1.45f306dc9c883p-3; /* 1 / (2 pi) */
    double lo = x.lo * turn - phase, hi = x.hi * turn - phase;
    return floor(hi + 0x1p-50 * (fabs(hi) + 1)) >= lo - 0x1p-50 * (fabs(lo) + 1);
}

/* Beyond this the phase is not computed. */
#define IMP_ANGLE_MAX 0x1p40

static inline int imp_interval_is_turn_(imp_interval x)
{
    return !(x.hi - x.lo < 6.25 && imp_interval_mag(x) < IMP_ANGLE_MAX);
}

/* Between extremes the function is monotone, so its range over x is spanned by the values at the
 * ends and by the extremes inside: 1 at 2 pi (k + top), -1 half a turn later. */
static inline imp_interval imp_interval_wave_(imp_interval x, double at_lo, double at_hi,
                                              double top)
{
    double lo = imp_larger(imp_libm_down(imp_smaller(at_lo, at_hi)), -1);
    double hi = imp_smaller(imp_libm_up(imp_larger(at_lo, at_hi)), 1);
    if (imp_interval_holds_phase_(x, top)) hi = 1;
    if (imp_interval_holds_phase_(x, top - 0.5)) lo = -1;
    return imp_interval_make(lo, hi);
}

static inline imp_interval imp_interval_sin(imp_interval x)
{
    if (imp_interval_is_turn_(x)) return imp_interval_make(-1, 1);
    return imp_interval_wave_(x, sin(x.lo), sin(x.hi), 0.25);
}

static inline imp_interval imp_interval_cos(imp_interval x)
{
    if (imp_interval_is_turn_(x)) return imp_interval_make(-1, 1);
    return imp_interval_wave_(x, cos(x.lo), cos(x.hi), 0);
}

/* Monotone between poles, which are at odd multiples of pi/2. */
static inline imp_interval imp_interval_tan(imp_interval x)
{
    if (imp_interval_is_turn_(x) || imp_interval_holds_phase_(x, 0.25) ||
        imp_interval_holds_phase_(x, -0.25))
        return imp_interval_whole();
    return imp_interval_make(imp_libm_down(tan(x.lo)), imp_libm_up(tan(x.hi)));
}

/* x^p for x >= 0 (the part below counts as 0) and any real p: monotone in x. */
static inline imp_interval imp_interval_pow(imp_interval x, double p)
{
    if (!(x.hi >= 0) || !(p - p == 0)) return imp_interval_whole();
    if (p == 0) return imp_interval_make(1, 1);
    double lo = imp_larger(p > 0 ? x.lo : x.hi, 0), hi = imp_larger(p > 0 ? x.hi : x.lo, 0);
    return imp_interval_make(imp_larger(imp_libm_down(imp_libm_pow(lo, p)), 0),
                             imp_libm_up(imp_libm_pow(hi, p)));
}

/* x^n for whole n > -2^31: monotone if n is odd, a function of |x| if n is even. */
static inline imp_interval imp_interval_powi(imp_interval x, int n)
{
    if (n == 0) return imp_interval_make(1, 1);
    if (n < 0) return imp_interval_inverse(imp_interval_powi(x, -n));
    if (n % 2 == 0) return imp_interval_pow(imp_interval_abs(x), n);
    return imp_interval_make(imp_libm_down(imp_libm_pow(x.lo, n)),
                             imp_libm_up(imp_libm_pow(x.hi, n)));
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_INTERVAL_FUNCTIONS_H */
