/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/kernel/kernel.h"

#include <float.h>
#include <mpfi.h>

#if defined __FAST_MATH__ || FLT_EVAL_METHOD != 0
#error "sums and products must be rounded to double, and not be rearranged"
#endif

range range_both(range x, range y) { return (range){fmax(x.lo, y.lo), fmin(x.hi, y.hi)}; }
range range_hull(range x, range y) { return (range){fmin(x.lo, y.lo), fmax(x.hi, y.hi)}; }
range range_greatest(range x, range y) { return (range){fmax(x.lo, y.lo), fmax(x.hi, y.hi)}; }
double range_middle(range x) { return fmin(fmax(0.5 * x.lo + 0.5 * x.hi, x.lo), x.hi); }

/* Functions go through MPFI with as many bits as a double has, so that doubles are converted
 * exactly. What MPFI cannot say is everything. */
static range by(int f(mpfi_ptr, mpfi_srcptr), range x)
{
    mpfi_t n;
    mpfi_init2(n, DBL_MANT_DIG);
    mpfi_interv_d(n, x.lo, x.hi);
    f(n, n);
    const range r = {mpfr_get_d(&n->left, MPFR_RNDD), mpfr_get_d(&n->right, MPFR_RNDU)};
    mpfi_clear(n);
    return isnan(r.lo) || isnan(r.hi) ? RANGE_ALL : r;
}

/* A result rounded to nearest, and what it lacks. */
typedef struct rounded {
    double x, lacks;
} rounded;

static rounded sum(double a, double b)
{
    const double x = a + b, from_b = x - a;
    return (rounded){x, (a - (x - from_b)) + (b - from_b)};
}

static rounded product(double a, double b) { return (rounded){a * b, fma(a, b, -(a * b))}; }
static rounded quotient(double a, double b) { return (rounded){a / b, fma(-(a / b), b, a) / b}; }

static bool is_plain(double x) { return x == 0 || (fabs(x) > 0x1p-400 && fabs(x) < 0x1p400); }
static bool is_less(rounded a, rounded b) { return a.x < b.x || (a.x == b.x && a.lacks < b.lacks); }

/* Lemma. What a sum (Knuth), product or quotient of plain numbers lacks is a double, but for the
 * division by b, which keeps sign and order; so x, then `lacks`, tell the least of several. What
 * other numbers give is between the two doubles next to it. */
static range outward(rounded lo, rounded hi, range x, range y)
{
    const bool plain = is_plain(x.lo) && is_plain(x.hi) && is_plain(y.lo) && is_plain(y.hi);
    if (isnan(lo.x) || isnan(hi.x)) return RANGE_ALL;
    return (range){plain && lo.lacks >= 0 ? lo.x : nextafter(lo.x, -INFINITY),
                   plain && hi.lacks <= 0 ? hi.x : nextafter(hi.x, INFINITY)};
}

static range by_ends(rounded f(double, double), range x, range y)
{
    const rounded all[] = {f(x.lo, y.lo), f(x.lo, y.hi), f(x.hi, y.lo), f(x.hi, y.hi)};
    rounded lo = all[0], hi = all[0];
    for (int k = 0; k < 4; ++k) {
        if (isnan(all[k].x)) return RANGE_ALL;
        if (is_less(all[k], lo)) lo = all[k];
        if (is_less(hi, all[k])) hi = all[k];
    }
    return outward(lo, hi, x, y);
}

range range_add(range x, range y) { return outward(sum(x.lo, y.lo), sum(x.hi, y.hi), x, y); }
range range_sub(range x, range y) { return range_add(x, range_neg(y)); }
range range_mul(range x, range y) { return by_ends(product, x, y); }
range range_div(range x, range y) { return range_has_0(y) ? RANGE_ALL : by_ends(quotient, x, y); }

range range_square(const range x[3])
{
    range sum_of = range_of(0);
    for (int i = 0; i < 3; ++i) sum_of = range_add(sum_of, range_mul(x[i], x[i]));
    return range_both(sum_of, (range){0, INFINITY});
}

static int put_pi(mpfi_ptr to, mpfi_srcptr from) { return (void)from, mpfi_const_pi(to); }
range range_pi(void) { return by(put_pi, range_of(0)); }

/* Sines of wide or far ranges are anything from -1 to 1. */
static range wave(int f(mpfi_ptr, mpfi_srcptr), range x)
{
    if (!(x.hi - x.lo < 6) || !(x.lo > -0x1p40) || !(x.hi < 0x1p40)) return (range){-1, 1};
    return by(f, x);
}

/* Lemma. x^y = exp(y log x), and 0^y is 0 and x^y grows with x if y > 0. */
range range_power(range x, range y)
{
    x = range_both(x, (range){0, INFINITY});
    if (!(x.lo <= x.hi)) return RANGE_ALL;
    if (x.lo == 0 && !(y.lo > 0)) return (range){0, INFINITY};
    const double most = x.hi == 0 ? 0 : by(mpfi_exp, range_mul(y, by(mpfi_log, range_of(x.hi)))).hi;
    return x.lo == 0 ? (range){0, most} : by(mpfi_exp, range_mul(y, by(mpfi_log, x)));
}

slope slope_fixed(range value) { return (slope){.v = value, .c = value}; }

slope slope_variable(int j, range where, const range *offset)
{
    slope x = {.on = 1u << j, .offset = offset, .v = where, .c = range_of(range_middle(where))};
    x.s[j] = range_of(1);
    return x;
}

/* Reduces the values to those that the slopes allow. */
static void narrow(slope *x)
{
    range sum = x->c;
    for (int j = 0; j < SLOPE_VARIABLES; ++j)
        if (slope_has(x, j)) sum = range_add(sum, range_mul(x->s[j], x->offset[j]));
    sum = range_both(sum, x->v);
    if (sum.lo <= sum.hi) x->v = sum;
}

static range times(range g, range s) { return range_is(g, 1) ? s : range_mul(g, s); }

/* Lemma. If g(x, y) - g(cx, cy) = gx (x - cx) + gy (y - cy) for numbers in the ranges gx and gy,
 * its slopes are gx s_x + gy s_y. */
static slope combined(const slope *x, const slope *y, range v, range c, range gx, range gy)
{
    slope r = {.on = x->on | y->on,
               .is_undefined = x->is_undefined || y->is_undefined,
               .offset = x->offset != NULL ? x->offset : y->offset,
               .v = v,
               .c = c};
    for (int j = 0; j < SLOPE_VARIABLES; ++j) {
        if (slope_has(x, j)) r.s[j] = times(gx, x->s[j]);
        if (!slope_has(y, j)) continue;
        const range by = times(gy, y->s[j]);
        r.s[j] = slope_has(x, j) ? range_add(r.s[j], by) : by;
    }
    narrow(&r);
    return r;
}

static const range zero = {0, 0}, one = {1, 1};

slope slope_sum(const slope *x, const slope *y)
{
    return combined(x, y, range_add(x->v, y->v), range_add(x->c, y->c), one, one);
}

slope slope_less(const slope *x, const slope *y)
{
    return combined(x, y, range_sub(x->v, y->v), range_sub(x->c, y->c), one, range_of(-1));
}

/* x y - cx cy = y (x - cx) + cx (y - cy); 0 times a function is 0 wherever that has a value. */
slope slope_product(const slope *x, const slope *y)
{
    slope r = combined(x, y, range_mul(x->v, y->v), range_mul(x->c, y->c), y->v, x->c);
    if ((x->on == 0 && range_is(x->v, 0)) || (y->on == 0 && range_is(y->v, 0)))
        r = (slope){.is_undefined = r.is_undefined};
    return r;
}

/* x / y - cx / cy = (x - cx) / y - (cx / cy) (y - cy) / y */
slope slope_quotient(const slope *x, const slope *y)
{
    const range c = range_div(x->c, y->c);
    slope r = combined(x, y, range_div(x->v, y->v), c, range_div(one, y->v),
                       range_neg(range_div(c, y->v)));
    r.is_undefined = r.is_undefined || range_has_0(y->v);
    return r;
}

/* The slopes are t s_x + (1 - t) s_y, 0 <= t <= 1, where either may be the greater one. */
slope slope_greatest(const slope *x, const slope *y)
{
    const bool is_x = x->v.lo >= y->v.hi, is_y = !is_x && y->v.lo >= x->v.hi;
    const range share = {0, 1}, v = range_greatest(x->v, y->v), c = range_greatest(x->c, y->c);
    return combined(x, y, v, c, is_x ? one : is_y ? zero : share, is_y ? one : is_x ? zero : share);
}

/* A function with values v and c, by its derivative over x->v (mean value theorem). */
static slope composed(const slope *x, range v, range c, range derivative, bool is_total)
{
    const slope nothing = slope_fixed(zero);
    slope r = combined(x, &nothing, v, c, derivative, zero);
    r.is_undefined = r.is_undefined || !is_total;
    return r;
}

slope slope_sin(const slope *x)
{
    return composed(x, wave(mpfi_sin, x->v), wave(mpfi_sin, x->c), wave(mpfi_cos, x->v), true);
}

slope slope_cos(const slope *x)
{
    const range slope_of = range_neg(wave(mpfi_sin, x->v));
    return composed(x, wave(mpfi_cos, x->v), wave(mpfi_cos, x->c), slope_of, true);
}

static slope whole_power(const slope *x, int k)
{
    const slope unit = slope_fixed(one);
    if (k == 0) return composed(x, one, one, zero, true);
    if (k == 1) return *x;
    const slope half = whole_power(x, k < 0 ? -k : k / 2);
    if (k < 0) return slope_quotient(&unit, &half);
    slope r = slope_product(&half, &half);
    if (k % 2 != 0) return slope_product(&r, x);
    if (r.v.lo < 0) r.v.lo = 0;
    return r;
}

/* x^k for x >= 0. What is below 0 by at most 2^-40, as rounding takes 1 - u^2, counts as 0 unless
 * all of x is (core/PROOF.md, section 11), or k may be whole. Powers up to 1 have kinks there. */
static slope real_power(const slope *x, range k)
{
    const bool may_be_0 = x->v.lo >= -0x1p-40 && x->v.hi >= 0 && floor(k.hi) < k.lo;
    const bool is_total = x->v.lo > 0 || (k.lo > 0 && (x->v.lo == 0 || may_be_0));
    const range less = range_power(x->v, range_sub(k, one));
    const range derivative = x->v.lo < 0 && !(k.lo > 1) ? RANGE_ALL : range_mul(k, less);
    return composed(x, range_power(x->v, k), range_power(x->c, k), derivative, is_total);
}

slope slope_raised(const slope *x, const slope *y)
{
    const double k = y->v.lo;
    const bool is_whole = range_is(y->v, k) && floor(k) == k && fabs(k) <= 64;
    slope r = is_whole ? whole_power(x, (int)k) : real_power(x, y->v);
    r.is_undefined = r.is_undefined || y->is_undefined || y->on != 0;
    return r;
}
