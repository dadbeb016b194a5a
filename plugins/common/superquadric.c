/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/superquadric.h"

/* Lemma (speeds). |dX/db| = |w|^(p-1) h and |dY/db| = h, h = (1 + w^2) G^(p+1), are at most 2. For
 * |w| <= 1 because p >= 1 and G <= 1; and swapping the axes turns w into 1/w. (For p < 1 the first
 * is infinite at w = 0: exponents beyond 2 are refused.)
 *
 * Lemma (p is rounded). Let p = q (1 + d), |d| <= u = 2^-53, and T = |w|^p. Then | T - |w|^q | <= u
 * T |ln T| to first order, which is below u / 2 for T <= 1 and below 8 u T for T <= 2^10; second
 * order is below 2^-40 of that. Therefore |w|^(p-1) is within 2^-40 of |w|^(q-1), relatively,
 * wherever it is above 2^-1000. 1/p = e/2 is exact.
 *
 * Lemma (flat). With L = min(1, 1/|w|): 2^(-1/p) L <= G <= L, because max(1, T) <= 1 + T <= 2
 * max(1, T). It is the only bound used when p is beyond SUPERELLIPSE_SHARP. */

#define SUPERELLIPSE_SHARP 0x1p50
#define SUPERELLIPSE_STEEP 0x1p10 /* greatest T for the smooth way */

imp_status superellipse_check_exponents(const imp_value *exponents, int row, imp_create_error *why)
{
    for (int k = 0; k < 2; ++k)
        if (!(exponents->number[k] <= 2))
            return imp_reject(why, row, k,
                              "got %g, must be in (0, 2]: beyond 2 the radial parametrisation "
                              "(cos a, sin a) / (|cos a|^p + |sin a|^p)^(1/p), p = 2/exponent, "
                              "is not Lipschitz",
                              exponents->number[k]);
    return IMP_STATUS_OK;
}

/* Lemma. For m = min(2, p), d = |p - 2| and r = d / m, z^m (1 - z^d) is greatest where z^d = 1 / (1
 * + r), with the value (1 + r)^(-1/r) r / (1 + r). 2^-50 covers the rounding of p, the rest that of
 * libm. */
static double superellipse_dent_upper(double power)
{
    const double r = power < 2 ? (2 - power) / power : (power - 2) / 2;
    if (!(r > 0 && r < SUPERELLIPSE_SHARP)) return r > 0 ? 1 : 0x1p-50;
    return (exp(-log1p(r) / r) * (r / (1 + r)) + 0x1p-50) * (1 + 0x1p-40);
}

superellipse superellipse_of(double exponent)
{
    const double power = 2 / exponent;
    return (superellipse){exponent, power, superellipse_dent_upper(power)};
}

/* --- T = |w|^p -------------------------------------------------------------------------------- */

static bool superellipse_is_even(const superellipse *s)
{
    return s->power <= 16 && s->power / 2 == floor(s->power / 2);
}

/* Near w = 0, where no series helps: with R the greatest |w| and z = |w| / R, T = R^p z^p is
 * below (p > 2) or above (p < 2) R^p z^2 by at most R^p dent. Rounding: 2^-48 for R^p, 2^-50 for
 * z^2, relative to R^p. The slope of z^2 says nothing of that of T: its rates go. */
static imp_model superellipse_bowl(const superellipse *s, imp_model w, imp_interval range)
{
    const double side = s->power < 2 ? 0.5 : -0.5;
    const double most = imp_interval_mag(imp_model_range(&w));
    imp_model z = imp_scale(w, 1 / most);
    imp_model t = imp_shift(imp_scale(imp_sqr(z), range.hi), side * s->dent * range.hi);
    t.e = (t.e + (0.5 * s->dent + 0x1p-47) * range.hi) * IMP_SLACK;
    t.lo = range.lo, t.hi = range.hi;
    for (int j = 0; j < 3; ++j) t.rate[j] = w.depends >> j & 1 ? INFINITY : 0;
    return imp_model_finish(t);
}

/* |w|^q, whose range is given. */
static imp_model superellipse_power(const superellipse *s, imp_model w, imp_interval range)
{
    if (superellipse_is_even(s)) return imp_powi(w, (int)s->power);
    imp_model t = imp_pow(w.lo > 0 ? w : w.hi < 0 ? imp_neg(w) : imp_abs(w), s->power);
    const bool tiny = imp_interval_mag(imp_model_range(&w)) < 0x1p-300;
    if (imp_is_point(&w) || tiny || t.e <= 0.5 * s->dent * range.hi) return t;
    return superellipse_bowl(s, w, range);
}

/* --- X and Y near an axis --------------------------------------------------------------------- */

/* Returns G where |w|^p is smooth enough for a model. */
static imp_model superellipse_smooth(const superellipse *s, imp_model w, imp_interval range)
{
    imp_model t = superellipse_power(s, w, range);
    const double slip = 0x1p-53 + 0x1p-49 * t.hi;
    t.e += slip;
    t.lo = imp_larger(t.lo - slip, 0);
    t.hi += 2 * slip;
    return imp_pow(imp_shift(imp_model_finish(t), 1), -0.5 * s->exponent);
}

/* G from the flat lemma: a range, nothing more. */
static imp_model superellipse_flat(const superellipse *s, imp_model w)
{
    const imp_interval size = imp_interval_abs(imp_model_range(&w));
    const double lo = size.hi > 1 ? imp_round_down(1 / size.hi) : 1;
    const double hi = size.lo > 1 ? imp_round_up(1 / size.lo) : 1;
    const imp_interval low = imp_interval_pow(imp_interval_make(2, 2), -0.5 * s->exponent);
    imp_model g = imp_between(imp_round_down(lo * low.lo), hi);
    g.depends = w.depends;
    for (int j = 0; j < 3; ++j) g.rate[j] = w.depends >> j & 1 ? INFINITY : 0;
    return g;
}

/* Speeds by the lemma, from the range of |w| and that of |w|^q. */
static void superellipse_speeds(const superellipse *s, imp_interval size, imp_interval power,
                                double *x_upper, double *y_upper)
{
    const double sec = 1 + size.hi * size.hi, lift = 1 + 0x1p-38;
    double fall = 1, steep = INFINITY;
    if (s->power < SUPERELLIPSE_SHARP) {
        const double base = 1 + power.lo * (1 - 0x1p-40);
        fall = imp_interval_pow(imp_interval_make(base, base), -1 - 0.5 * s->exponent).hi;
        steep = power.hi / size.hi;
    } else if (size.hi < 1) {
        steep = imp_interval_pow(size, SUPERELLIPSE_SHARP / 2).hi;
    }
    *y_upper = imp_smaller(2, sec * fall * lift);
    *x_upper = imp_smaller(2, sec * fall * (steep * lift + IMP_TINY) * lift);
}

/* Applies the bounds that always hold for X and Y: they are in [-1, 1], with bounded speeds. */
static void superellipse_limit(imp_model *x, const imp_model *angle, double speed)
{
    x->lo = imp_larger(x->lo, -1);
    x->hi = imp_smaller(x->hi, 1);
    for (int j = 0; j < 3; ++j)
        x->rate[j] = imp_smaller(x->rate[j], imp_round_up(speed * angle->rate[j]));
}

/* `angle` is from the axis, within +-1.25. */
static void superellipse_near_axis(const superellipse *s, imp_model angle, imp_model *x,
                                   imp_model *y)
{
    const imp_model w = imp_tan(angle);
    const imp_interval size = imp_interval_abs(imp_model_range(&w));
    const bool sharp = !(s->power < SUPERELLIPSE_SHARP);
    const imp_interval power = sharp ? imp_interval_whole() : imp_interval_pow(size, s->power);
    double x_speed, y_speed;
    *x = power.hi < SUPERELLIPSE_STEEP ? superellipse_smooth(s, w, power) : superellipse_flat(s, w);
    *y = imp_mul(w, *x);
    if (!angle.depends) return;
    superellipse_speeds(s, size, power, &x_speed, &y_speed);
    superellipse_limit(x, &angle, x_speed);
    superellipse_limit(y, &angle, y_speed);
}

/* --- X and Y anywhere ------------------------------------------------------------------------- */

/* Lemma. X = r cos a (and Y = r sin a) with 1 / r = (|cos a|^p + |sin a|^p)^(1/p) between the
 * greater of |cos a| and |sin a|, at least 1 / sqrt 2, and |cos a| + |sin a|, at most sqrt 2: so
 * 0.7 < r < 1.5. */
static imp_model superellipse_wide(const imp_model *angle, imp_interval wave)
{
    const double lo = wave.lo < 0 ? 1.5 * wave.lo : 0.7 * wave.lo;
    const double hi = wave.hi > 0 ? 1.5 * wave.hi : 0.7 * wave.hi;
    imp_model x = imp_between(imp_larger(lo, -1), imp_smaller(hi, 1));
    x.depends = angle->depends;
    for (int j = 0; j < 3; ++j) x.rate[j] = 2 * angle->rate[j];
    return x;
}

void superellipse_at(const superellipse *s, imp_model angle, imp_model *x, imp_model *y)
{
    const double quarter = rint(imp_interval_mid(imp_model_range(&angle)) / (IMP_PI_LOWER / 2));
    imp_model near = imp_sub(angle, imp_scale(imp_const_pi(), quarter / 2)), a, b;
    if (s->power == 2) {
        imp_sincos(angle, y, x);
    } else if (!(near.lo > -1.25 && near.hi < 1.25)) {
        *x = superellipse_wide(&angle, imp_interval_cos(imp_model_range(&angle)));
        *y = superellipse_wide(&angle, imp_interval_sin(imp_model_range(&angle)));
    } else {
        superellipse_near_axis(s, near, &a, &b);
        const int turn = (int)fmod(quarter, 4) & 3;
        *x = turn == 0 ? a : turn == 1 ? imp_neg(b) : turn == 2 ? imp_neg(a) : b;
        *y = turn == 0 ? b : turn == 1 ? a : turn == 2 ? imp_neg(b) : imp_neg(a);
    }
}
