/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/ld_interval.h"

#include <float.h>
#include <math.h>

/* --- Rounding outward -----------------------------------------------------------------------
 *
 * Lemma. Let x be the long double nearest to z: |z - x| <= 1/2 LDBL_EPSILON |x|, or LDBL_MIN where
 * it underflows. x - LDBL_EPSILON |x| - LDBL_MIN, itself rounded by no more than another 1/2
 * LDBL_EPSILON |x|, is no greater than z. Infinity less infinity is NaN, which ld_interval_make
 * opens.
 *
 * What libm computes is trusted to 8 units in the last place, 8 LDBL_EPSILON |x|; glibc's are
 * within 4. The code uses twice the trusted value. */

static long double down(long double x) { return x - (LDBL_EPSILON * fabsl(x) + LDBL_MIN); }
static long double up(long double x) { return x + (LDBL_EPSILON * fabsl(x) + LDBL_MIN); }
static long double libm_down(long double x)
{
    return x - (16 * LDBL_EPSILON * fabsl(x) + LDBL_MIN);
}
static long double libm_up(long double x) { return x + (16 * LDBL_EPSILON * fabsl(x) + LDBL_MIN); }

static long double larger(long double a, long double b) { return a > b ? a : b; }
static long double smaller(long double a, long double b) { return a < b ? a : b; }

/* Returns the error of a sum, exact (Knuth); NaN where it overflows. */
static long double sum_error(long double a, long double b, long double sum)
{
    const long double part = sum - a;
    return (a - (sum - part)) + (b - part);
}

static long double sum_down(long double a, long double b)
{
    const long double sum = a + b;
    return sum_error(a, b, sum) >= 0 ? sum : down(sum);
}

static long double sum_up(long double a, long double b)
{
    const long double sum = a + b;
    return sum_error(a, b, sum) <= 0 ? sum : up(sum);
}

/* Returns the upper half of a number's digits (Veltkamp). */
static long double upper_half(long double a)
{
    const long double shifted = a * ((1ull << (LDBL_MANT_DIG + 1) / 2) + 1);
    return shifted - (shifted - a);
}

/* Returns the error of a product, exact (Dekker) unless it might underflow; then, and where the
 * product or what is computed on the way overflows, NaN. */
static long double product_error(long double a, long double b, long double x)
{
    const long double p = upper_half(a), q = a - p, r = upper_half(b), s = b - r;
    if (fabsl(x) < LDBL_MIN / LDBL_EPSILON / LDBL_EPSILON) return NAN;
    return ((p * r - x) + p * s + q * r) + q * s;
}

/* 0 times an infinite end, which is the limit of finite ones, is 0. */
static long double product(long double a, long double b) { return a == 0 || b == 0 ? 0 : a * b; }

static long double product_down(long double a, long double b)
{
    if (a == 0 || b == 0) return 0;
    return product_error(a, b, a * b) >= 0 ? a * b : down(a * b);
}

static long double product_up(long double a, long double b)
{
    if (a == 0 || b == 0) return 0;
    return product_error(a, b, a * b) <= 0 ? a * b : up(a * b);
}

/* --- Constants -------------------------------------------------------------------------------- */

/* The constants are the nearest long doubles, so down and up enclose the exact values. */
ld_interval ld_interval_pi(void)
{
    const long double pi = 3.14159265358979323846264338327950288L;
    return (ld_interval){down(pi), up(pi)};
}

ld_interval ld_interval_e(void)
{
    const long double e = 2.71828182845904523536028747135266250L;
    return (ld_interval){down(e), up(e)};
}

static long double ld_interval_mig(ld_interval x) { return larger(larger(x.lo, -x.hi), 0); }

/* --- Arithmetic ------------------------------------------------------------------------------- */

ld_interval ld_interval_add(ld_interval x, ld_interval y)
{
    if (ld_interval_is(x, 0)) return y;
    if (ld_interval_is(y, 0)) return x;
    return ld_interval_make(sum_down(x.lo, y.lo), sum_up(x.hi, y.hi));
}

ld_interval ld_interval_sub(ld_interval x, ld_interval y)
{
    return ld_interval_add(x, ld_interval_neg(y));
}

/* The extremes are at corners. Rounding is monotone, so each is among those corners whose rounded
 * products are extreme; products differ that round alike. */
ld_interval ld_interval_mul(ld_interval x, ld_interval y)
{
    const long double a[2] = {x.lo, x.hi}, b[2] = {y.lo, y.hi};
    long double p[2][2], least = INFINITY, most = -INFINITY, lo = INFINITY, hi = -INFINITY;
    if (ld_interval_is(x, 0) || ld_interval_is(y, 0)) return ld_interval_of(0);
    const int m = 1 + (x.lo < x.hi), n = 1 + (y.lo < y.hi);
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            p[i][j] = product(a[i], b[j]);
            if (!(fabsl(p[i][j]) < INFINITY)) return ld_interval_entire();
            least = smaller(p[i][j], least);
            most = larger(p[i][j], most);
        }
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            if (p[i][j] == least) lo = smaller(product_down(a[i], b[j]), lo);
            if (p[i][j] == most) hi = larger(product_up(a[i], b[j]), hi);
        }
    return ld_interval_make(lo, hi);
}

ld_interval ld_interval_scale(ld_interval x, long double k)
{
    return ld_interval_mul(x, ld_interval_of(k));
}

/* Is 1 / a exactly x? */
static bool is_inverse(long double a, long double x)
{
    return a * x == 1 && product_error(a, x, 1) == 0;
}

/* Monotone on either side of 0. */
ld_interval ld_interval_inverse(ld_interval x)
{
    const long double lo = 1 / x.hi, hi = 1 / x.lo;
    if (x.lo > 0)
        return ld_interval_make(is_inverse(x.hi, lo) ? lo : larger(down(lo), 0),
                                is_inverse(x.lo, hi) ? hi : up(hi));
    if (x.hi < 0) return ld_interval_neg(ld_interval_inverse(ld_interval_neg(x)));
    if (x.lo == 0 && x.hi > 0) return ld_interval_make(larger(down(1 / x.hi), 0), INFINITY);
    return ld_interval_entire();
}

ld_interval ld_interval_div(ld_interval x, ld_interval y)
{
    return ld_interval_is(x, 0) ? x : ld_interval_mul(x, ld_interval_inverse(y));
}

ld_interval ld_interval_sqr(ld_interval x)
{
    const long double lo = ld_interval_mig(x), hi = ld_interval_mag(x);
    return ld_interval_make(larger(product_down(lo, lo), 0), product_up(hi, hi));
}

/* --- Functions that grow ---------------------------------------------------------------------- */

static ld_interval growing(ld_interval x, long double (*g)(long double))
{
    return ld_interval_make(libm_down(g(x.lo)), libm_up(g(x.hi)));
}

static ld_interval within(ld_interval x, long double lo, long double hi)
{
    return ld_interval_make(smaller(larger(x.lo, lo), hi), larger(smaller(x.hi, hi), lo));
}

ld_interval ld_interval_sqrt(ld_interval x)
{
    return x.hi >= 0 ? within(growing(within(x, 0, INFINITY), sqrtl), 0, INFINITY)
                     : ld_interval_entire();
}

ld_interval ld_interval_cbrt(ld_interval x) { return growing(x, cbrtl); }

ld_interval ld_interval_exp(ld_interval x) { return within(growing(x, expl), 0, INFINITY); }

ld_interval ld_interval_log(ld_interval x)
{
    if (!(x.hi > 0)) return ld_interval_entire();
    return ld_interval_make(x.lo > 0 ? libm_down(logl(x.lo)) : -INFINITY, libm_up(logl(x.hi)));
}

ld_interval ld_interval_asin(ld_interval x)
{
    return x.lo <= 1 && x.hi >= -1 ? growing(within(x, -1, 1), asinl) : ld_interval_entire();
}

ld_interval ld_interval_acos(ld_interval x)
{
    if (!(x.lo <= 1 && x.hi >= -1)) return ld_interval_entire();
    const ld_interval y = within(x, -1, 1);
    return ld_interval_make(larger(libm_down(acosl(y.hi)), 0), libm_up(acosl(y.lo)));
}

ld_interval ld_interval_atan(ld_interval x) { return growing(x, atanl); }

ld_interval ld_interval_sinh(ld_interval x) { return growing(x, sinhl); }

ld_interval ld_interval_cosh(ld_interval x)
{
    const ld_interval size = ld_interval_abs(x);
    return within(growing(size, coshl), 1, INFINITY);
}

ld_interval ld_interval_tanh(ld_interval x) { return within(growing(x, tanhl), -1, 1); }

/* --- Waves ------------------------------------------------------------------------------------ */

#define TURN 6.28318530717958647692528676655900577L
#define ANGLE_MAX 0x1p40L /* beyond it, the phase is not computed */

static bool is_long(ld_interval x)
{
    return !(x.hi - x.lo < 6.25L && ld_interval_mag(x) < ANGLE_MAX);
}

/* Can x contain a whole number of turns plus `phase`? Lemma: z / TURN - phase is computed within 3
 * LDBL_EPSILON (|z / TURN| + 1): constant, quotient and difference. `yes` is always right. */
static bool may_hold(ld_interval x, long double phase)
{
    const long double lo = x.lo / TURN - phase, hi = x.hi / TURN - phase;
    const long double slack = 4 * LDBL_EPSILON * (ld_interval_mag(x) / TURN + 2);
    return floorl(hi + slack) >= lo - slack;
}

/* Ends and extremes: 1 at whole turns and `top`, -1 half a turn on. */
static ld_interval wave(ld_interval x, long double (*g)(long double), long double top)
{
    if (is_long(x)) return (ld_interval){-1, 1};
    const long double a = g(x.lo), b = g(x.hi);
    return (ld_interval){may_hold(x, top + 0.5L) ? -1 : larger(libm_down(smaller(a, b)), -1),
                         may_hold(x, top) ? 1 : smaller(libm_up(larger(a, b)), 1)};
}

ld_interval ld_interval_sin(ld_interval x) { return wave(x, sinl, 0.25L); }

ld_interval ld_interval_cos(ld_interval x) { return wave(x, cosl, 0); }

/* Between poles, a quarter of a turn off. */
ld_interval ld_interval_tan(ld_interval x)
{
    const bool pole = is_long(x) || may_hold(x, 0.25L) || may_hold(x, -0.25L);
    return pole ? ld_interval_entire() : growing(x, tanl);
}

/* --- Powers ----------------------------------------------------------------------------------- */

static ld_interval odd_power(ld_interval x, int n)
{
    return ld_interval_make(libm_down(powl(x.lo, n)), libm_up(powl(x.hi, n)));
}

ld_interval ld_interval_integer_power(ld_interval x, int n)
{
    if (n == 0) return ld_interval_of(1);
    if (n == 1) return x;
    if (n == 2) return ld_interval_sqr(x);
    if (n < 0) return ld_interval_inverse(ld_interval_integer_power(x, -n));
    return n % 2 != 0 ? odd_power(x, n) : within(odd_power(ld_interval_abs(x), n), 0, INFINITY);
}

/* Monotone in x for each y, and in y for each x: the extremes are at corners. */
ld_interval ld_interval_power(ld_interval x, ld_interval y)
{
    if (!(x.hi >= 0) || isinf(ld_interval_mag(x)) || isinf(ld_interval_mag(y)))
        return ld_interval_entire();
    const ld_interval base = within(x, 0, INFINITY);
    if (base.lo == 0 && !(y.lo > 0)) return ld_interval_make(0, INFINITY);
    const long double a = powl(base.lo, y.lo), b = powl(base.lo, y.hi);
    const long double c = powl(base.hi, y.lo), d = powl(base.hi, y.hi);
    const long double lo = smaller(smaller(a, b), smaller(c, d));
    const long double hi = larger(larger(a, b), larger(c, d));
    return ld_interval_make(larger(libm_down(lo), 0), libm_up(hi));
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
