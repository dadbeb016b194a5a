/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_H
#define IMPINGE_MODEL_H

/* Arithmetic on Taylor models
 * ====================
 *
 * An imp_model (surface.h) is an order-2 Taylor model of a function g of u, v, t over a region,
 * with a range and rates. It states a quadratic that g follows within e, a range [lo, hi], and
 * bounds of the rates of change of g. The operations here take models of f and h to a model of f +
 * h, f h, sin f and so on. A formula written once with them gives points, rates and the inclusion
 * of a surface; <impinge/formula.h> makes the callbacks. Models are passed by value.
 *
 *   imp_param(region, j)         the parameter u (j = 0), v (1) or t (2) over a region
 *   imp_num(k), imp_const_pi()   the number k; pi
 *   imp_between(lo, hi)          some number in [lo, hi], the same all over the region
 *
 *   imp_add(x, y)  imp_sub  imp_mul  imp_div  imp_neg(x)
 *   imp_shift(x, k) = x + k      imp_scale(x, k) = k x, for a number k
 *   imp_sqr(x)                   not imp_mul(x, x): that does not know that x^2 >= 0
 *   imp_dot3(x, y)               x[0] y[0] + x[1] y[1] + x[2] y[2]
 *   imp_lerp(x, y, t)            x + t (y - x)
 *   imp_poly(coef, n, t)         coef[0] + coef[1] t + ... + coef[n-1] t^(n-1)
 *   imp_powi(x, n)               x^n, n whole
 *
 *   imp_sqrt(x)  imp_pow(x, p)  imp_pow_model(x, y)  imp_exp  imp_log
 *   imp_sin  imp_cos  imp_sincos(x, &s, &c)  imp_tan  imp_asin  imp_acos  imp_atan
 *   imp_atan2(y, x)  imp_sinh  imp_cosh  imp_tanh
 *   imp_abs  imp_min(x, y)  imp_max(x, y)
 *
 * For types that make models by hand:
 *
 *   imp_model_box(...)           from a value and rates
 *   imp_known(a, e)              a number within e of a
 *   imp_unbounded(depends)       anything
 *   imp_model_finish(x)          the last step, after setting fields: clips and tidies
 *   imp_model_within(x, range)   the same, knowing a range of g
 *   imp_model_collapse(x)        its range and rates, without the quadratic
 *   imp_model_range(&x), imp_model_poly_range(&x), imp_model_size(&x), imp_is_point(&x)
 *
 * For a function g that is not listed (<impinge/model_series.h>):
 *
 *   imp_series_around(range)     begins a series of g around the middle of its argument's range
 *   imp_series_taylor(&s, ...)   completes it from derivatives; or set its fields by hand
 *   imp_series_power(&s, p, m^p) that of a power
 *   imp_compose(&x, &s, range, slope)   the model of g(x)
 *   imp_point_within(&x, y, slope, lo, hi)   the same for a constant x, from y = g(x)
 *   imp_libm_exp, imp_libm_pow   libm's, leaving errno alone
 *
 * A model that depends on no parameter is a constant: a number known within e. Operations on
 * constants are faster; points are evaluated with them.
 *
 * If there is no bound, then e, an end of the range, or rates are infinite. No operation returns a
 * NaN. If a formula is undefined in a part of a region, its model holds for the rest; but a formula
 * must be defined on the whole domain of its type. Rounding may put the range of an argument
 * slightly outside a function's domain, as 1 - cos^2 below 0. The part outside counts as the
 * nearest value inside, so no clamp is needed before imp_sqrt.
 *
 * Kinks are allowed: rates bound difference quotients there. Jumps are not: imp_atan2 has no
 * bounded rates on its cut. */

#include <impinge/model_basics.h>

#include <impinge/model_angles.h>
#include <impinge/model_arithmetic.h>
#include <impinge/model_functions.h>
#include <impinge/model_powers.h>

#endif /* IMPINGE_MODEL_H */
