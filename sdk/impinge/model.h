/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_H
#define IMPINGE_MODEL_H

/* Arithmetic on models
 * ====================
 *
 * An imp_model (surface.h) says three things about a function g of u, v, t over a region: a
 * quadratic that g follows within e, a range [lo, hi], and bounds of its rates of change. The
 * operations here take models of f and h to a model of f + h, f h, sin f ..., so that a formula
 * written once in them yields point, rates and inclusion of a surface. <impinge/formula.h> does
 * the rest. Models go in and out by value.
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
 *   imp_model_range(&x), imp_model_poly_range(&x), imp_model_size(&x), imp_is_point(&x)
 *
 * A model that depends on no parameter is a constant: a number known within e. Operations on
 * constants take a short way, which is how points are evaluated.
 *
 * What cannot be bounded is unbounded: e, an end of the range, or rates are infinite. No
 * operation answers a NaN. Over a region where a formula is undefined in part, its model speaks
 * about the rest; but a formula must be defined on its type's whole domain. Rounding may put the
 * range of an argument slightly outside a function's domain, as that of 1 - cos^2 below 0: the
 * part outside counts as the nearest value inside, so no clamp is needed before imp_sqrt.
 *
 * Kinks are allowed: rates bound difference quotients there. Jumps are not: imp_atan2 has no
 * bounded rates on its cut. */

#include <impinge/model_angles.h>
#include <impinge/model_arithmetic.h>
#include <impinge/model_functions.h>

#endif /* IMPINGE_MODEL_H */
