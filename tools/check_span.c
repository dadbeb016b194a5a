/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "check_span.h"

#include <float.h>
#include <math.h>

/* --- Rounding outward -----------------------------------------------------------------------
 *
 * Lemma. Let x be the long double nearest to z: |z - x| <= 1/2 LDBL_EPSILON |x|, or LDBL_MIN where
 * it underflows. x - LDBL_EPSILON |x| - LDBL_MIN, itself rounded by no more than another
 * 1/2 LDBL_EPSILON |x|, is no greater than z. Infinity less infinity is NaN, which span_make opens.
 *
 * What libm computes is trusted to 8 units in the last place, 8 LDBL_EPSILON |x|; glibc's are
 * within 4. Twice that is taken. */

static long double down(long double x) { return x - (LDBL_EPSILON * fabsl(x) + LDBL_MIN); }
static long double up(long double x) { return x + (LDBL_EPSILON * fabsl(x) + LDBL_MIN); }
static long double libm_down(long double x)
{
    return x - (16 * LDBL_EPSILON * fabsl(x) + LDBL_MIN);
}
static long double libm_up(long double x) { return x + (16 * LDBL_EPSILON * fabsl(x) + LDBL_MIN); }

static long double larger(long double a, long double b) { return a > b ? a : b; }
static long double smaller(long double a, long double b) { return a < b ? a : b; }

/* The error of a sum, exact (Knuth); NaN where it overflows. */
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

/* The upper half of a number's digits (Veltkamp). */
static long double upper_half(long double a)
{
    const long double shifted = a * ((1ull << (LDBL_MANT_DIG + 1) / 2) + 1);
    return shifted - (shifted - a);
}

/* The error of a product, exact (Dekker) unless it might underflow; then, and where the product or
 * what is computed on the way overflows, NaN. */
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

/* --- Making and asking ----------------------------------------------------------------------- */

span span_make(long double lo, long double hi)
{
    return (span){lo > -INFINITY ? lo : -INFINITY, hi < INFINITY ? hi : INFINITY};
}

span span_of(long double x) { return span_make(x, x); }

span span_whole(void) { return (span){-INFINITY, INFINITY}; }

/* The constants are the nearest there are, so down and up enclose what they stand for. */
span span_pi(void)
{
    const long double pi = 3.14159265358979323846264338327950288L;
    return (span){down(pi), up(pi)};
}

span span_e(void)
{
    const long double e = 2.71828182845904523536028747135266250L;
    return (span){down(e), up(e)};
}

bool span_is_within(span x, span limits) { return x.lo >= limits.lo && x.hi <= limits.hi; }

bool span_is(span x, long double value) { return x.lo == value && x.hi == value; }

long double span_mag(span x) { return larger(fabsl(x.lo), fabsl(x.hi)); }

static long double span_mig(span x) { return larger(larger(x.lo, -x.hi), 0); }

long double span_mid(span x) { return smaller(larger(0.5L * x.lo + 0.5L * x.hi, x.lo), x.hi); }

span span_hull(span x, span y) { return span_make(smaller(x.lo, y.lo), larger(x.hi, y.hi)); }

span span_meet(span x, span y) { return span_make(larger(x.lo, y.lo), smaller(x.hi, y.hi)); }

span span_plus_minus(long double size) { return span_make(-size, size); }

/* --- Arithmetic ----------------------------------------------------------------------------- */

span span_neg(span x) { return (span){-x.hi, -x.lo}; }

span span_add(span x, span y)
{
    if (span_is(x, 0)) return y;
    if (span_is(y, 0)) return x;
    return span_make(sum_down(x.lo, y.lo), sum_up(x.hi, y.hi));
}

span span_sub(span x, span y) { return span_add(x, span_neg(y)); }

/* The extremes are at corners. Rounding is monotone, so each is among those corners whose rounded
 * products are extreme; products differ that round alike. */
span span_mul(span x, span y)
{
    const long double a[2] = {x.lo, x.hi}, b[2] = {y.lo, y.hi};
    long double p[2][2], least = INFINITY, most = -INFINITY, lo = INFINITY, hi = -INFINITY;
    if (span_is(x, 0) || span_is(y, 0)) return span_of(0);
    const int m = 1 + (x.lo < x.hi), n = 1 + (y.lo < y.hi);
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            p[i][j] = product(a[i], b[j]);
            if (!(fabsl(p[i][j]) < INFINITY)) return span_whole();
            least = smaller(p[i][j], least);
            most = larger(p[i][j], most);
        }
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            if (p[i][j] == least) lo = smaller(product_down(a[i], b[j]), lo);
            if (p[i][j] == most) hi = larger(product_up(a[i], b[j]), hi);
        }
    return span_make(lo, hi);
}

span span_scale(span x, long double k) { return span_mul(x, span_of(k)); }

/* Is 1 / a exactly x? */
static bool is_inverse(long double a, long double x)
{
    return a * x == 1 && product_error(a, x, 1) == 0;
}

/* Monotone on either side of 0. */
span span_inverse(span x)
{
    const long double lo = 1 / x.hi, hi = 1 / x.lo;
    if (x.lo > 0)
        return span_make(is_inverse(x.hi, lo) ? lo : larger(down(lo), 0),
                         is_inverse(x.lo, hi) ? hi : up(hi));
    if (x.hi < 0) return span_neg(span_inverse(span_neg(x)));
    if (x.lo == 0 && x.hi > 0) return span_make(larger(down(1 / x.hi), 0), INFINITY);
    return span_whole();
}

span span_div(span x, span y) { return span_is(x, 0) ? x : span_mul(x, span_inverse(y)); }

span span_sqr(span x)
{
    const long double lo = span_mig(x), hi = span_mag(x);
    return span_make(larger(product_down(lo, lo), 0), product_up(hi, hi));
}

span span_abs(span x) { return span_make(span_mig(x), span_mag(x)); }

span span_min(span x, span y) { return span_make(smaller(x.lo, y.lo), smaller(x.hi, y.hi)); }

span span_max(span x, span y) { return span_make(larger(x.lo, y.lo), larger(x.hi, y.hi)); }

/* --- Functions that grow -------------------------------------------------------------------- */

static span growing(span x, long double (*g)(long double))
{
    return span_make(libm_down(g(x.lo)), libm_up(g(x.hi)));
}

static span within(span x, long double lo, long double hi)
{
    return span_make(smaller(larger(x.lo, lo), hi), larger(smaller(x.hi, hi), lo));
}

span span_sqrt(span x)
{
    return x.hi >= 0 ? within(growing(within(x, 0, INFINITY), sqrtl), 0, INFINITY) : span_whole();
}

span span_cbrt(span x) { return growing(x, cbrtl); }

span span_exp(span x) { return within(growing(x, expl), 0, INFINITY); }

span span_log(span x)
{
    if (!(x.hi > 0)) return span_whole();
    return span_make(x.lo > 0 ? libm_down(logl(x.lo)) : -INFINITY, libm_up(logl(x.hi)));
}

span span_asin(span x)
{
    return x.lo <= 1 && x.hi >= -1 ? growing(within(x, -1, 1), asinl) : span_whole();
}

span span_acos(span x)
{
    if (!(x.lo <= 1 && x.hi >= -1)) return span_whole();
    const span y = within(x, -1, 1);
    return span_make(larger(libm_down(acosl(y.hi)), 0), libm_up(acosl(y.lo)));
}

span span_atan(span x) { return growing(x, atanl); }

span span_sinh(span x) { return growing(x, sinhl); }

span span_cosh(span x)
{
    const span size = span_abs(x);
    return within(growing(size, coshl), 1, INFINITY);
}

span span_tanh(span x) { return within(growing(x, tanhl), -1, 1); }

/* --- Waves ---------------------------------------------------------------------------------- */

#define TURN 6.28318530717958647692528676655900577L
#define ANGLE_MAX 0x1p40L /* beyond it, the phase is not told */

static bool is_long(span x) { return !(x.hi - x.lo < 6.25L && span_mag(x) < ANGLE_MAX); }

/* May x have a whole number of turns and `phase` inside? Lemma: z / TURN - phase is computed within
 * 3 LDBL_EPSILON (|z / TURN| + 1): constant, quotient and difference. `yes` is always right. */
static bool may_hold(span x, long double phase)
{
    const long double lo = x.lo / TURN - phase, hi = x.hi / TURN - phase;
    const long double slack = 4 * LDBL_EPSILON * (span_mag(x) / TURN + 2);
    return floorl(hi + slack) >= lo - slack;
}

/* Ends and extremes: 1 at whole turns and `top`, -1 half a turn on. */
static span wave(span x, long double (*g)(long double), long double top)
{
    if (is_long(x)) return (span){-1, 1};
    const long double a = g(x.lo), b = g(x.hi);
    return (span){may_hold(x, top + 0.5L) ? -1 : larger(libm_down(smaller(a, b)), -1),
                  may_hold(x, top) ? 1 : smaller(libm_up(larger(a, b)), 1)};
}

span span_sin(span x) { return wave(x, sinl, 0.25L); }

span span_cos(span x) { return wave(x, cosl, 0); }

/* Between poles, a quarter of a turn off. */
span span_tan(span x)
{
    const bool pole = is_long(x) || may_hold(x, 0.25L) || may_hold(x, -0.25L);
    return pole ? span_whole() : growing(x, tanl);
}

/* --- Powers --------------------------------------------------------------------------------- */

static span odd_power(span x, int n)
{
    return span_make(libm_down(powl(x.lo, n)), libm_up(powl(x.hi, n)));
}

span span_whole_power(span x, int n)
{
    if (n == 0) return span_of(1);
    if (n == 1) return x;
    if (n == 2) return span_sqr(x);
    if (n < 0) return span_inverse(span_whole_power(x, -n));
    return n % 2 != 0 ? odd_power(x, n) : within(odd_power(span_abs(x), n), 0, INFINITY);
}

/* Monotone in x for each y, and in y for each x: the extremes are at corners. */
span span_power(span x, span y)
{
    if (!(x.hi >= 0) || isinf(span_mag(x)) || isinf(span_mag(y))) return span_whole();
    const span base = within(x, 0, INFINITY);
    if (base.lo == 0 && !(y.lo > 0)) return span_make(0, INFINITY);
    const long double a = powl(base.lo, y.lo), b = powl(base.lo, y.hi);
    const long double c = powl(base.hi, y.lo), d = powl(base.hi, y.hi);
    const long double lo = smaller(smaller(a, b), smaller(c, d));
    const long double hi = larger(larger(a, b), larger(c, d));
    return span_make(larger(libm_down(lo), 0), libm_up(hi));
}

/* By the half plane that the point is in; across the cut, or with (0, 0) inside, anything. */
span span_angle(span y, span x)
{
    const span quarter = span_mul(span_pi(), span_of(0.5L));
    if (x.lo > 0) return span_atan(span_div(y, x));
    if (y.lo > 0) return span_sub(quarter, span_atan(span_div(x, y)));
    if (y.hi < 0) return span_neg(span_add(quarter, span_atan(span_div(x, y))));
    return span_whole();
}
