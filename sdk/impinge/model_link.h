/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_LINK_H
#define IMPINGE_MODEL_LINK_H

#include <impinge/formula.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Models for other languages
 * ==========================
 *
 * The operations of <impinge/model.h> are inline, which languages other than C and C++ cannot use.
 * The small static library libimpinge-model.a has each of them as a function whose name begins with
 * impinge_ in place of imp_: same arguments, same results to the last bit. Structs go by value as
 * the C ABI of the machine has it. Plugins that link it need nothing else of Impinge; C and C++
 * need only the headers. */

imp_model impinge_num(double k);
imp_model impinge_known(double a, double e);
imp_model impinge_param(const imp_region *region, int j);
imp_model impinge_const_pi(void);
imp_model impinge_between(double lo, double hi);
imp_model impinge_unbounded(uint32_t depends);
imp_model impinge_model_finish(imp_model x);

imp_model impinge_neg(imp_model x);
imp_model impinge_add(imp_model x, imp_model y);
imp_model impinge_sub(imp_model x, imp_model y);
imp_model impinge_mul(imp_model x, imp_model y);
imp_model impinge_div(imp_model x, imp_model y);
imp_model impinge_shift(imp_model x, double k);
imp_model impinge_scale(imp_model x, double k);
imp_model impinge_sqr(imp_model x);
imp_model impinge_lerp(imp_model x, imp_model y, imp_model t);
imp_model impinge_dot3(const imp_model x[3], const imp_model y[3]);
imp_model impinge_poly(const double *coef, size_t n, imp_model t);

imp_model impinge_powi(imp_model x, int n);
imp_model impinge_pow(imp_model x, double p);
imp_model impinge_pow_model(imp_model x, imp_model y);
imp_model impinge_sqrt(imp_model x);
imp_model impinge_exp(imp_model x);
imp_model impinge_log(imp_model x);
imp_model impinge_abs(imp_model x);
imp_model impinge_min(imp_model x, imp_model y);
imp_model impinge_max(imp_model x, imp_model y);
imp_model impinge_sin(imp_model x);
imp_model impinge_cos(imp_model x);
void impinge_sincos(imp_model x, imp_model *sine, imp_model *cosine);
imp_model impinge_tan(imp_model x);
imp_model impinge_asin(imp_model x);
imp_model impinge_acos(imp_model x);
imp_model impinge_atan(imp_model x);
imp_model impinge_atan2(imp_model y, imp_model x);
imp_model impinge_sinh(imp_model x);
imp_model impinge_cosh(imp_model x);
imp_model impinge_tanh(imp_model x);

/* What IMP_SURFACE_FORMULA, IMP_MAP_FORMULA and IMP_DISTANCE_FORMULA make of a formula: bodies of
 * the callbacks eval, rate, include, apply and distance. */
imp_status impinge_surface_eval(imp_surface_formula f, const void *self, size_t n, const double *p,
                                double *x, double *error);
imp_status impinge_surface_rate(imp_surface_formula f, const void *self, const imp_region *region,
                                imp_rate_matrix *rates);
imp_status impinge_surface_include(imp_surface_formula f, const void *self,
                                   const imp_region *region, imp_model model[3]);
imp_status impinge_map_eval(imp_map_formula f, const void *self, size_t n, const double *p,
                            double *x, double *error);
imp_status impinge_map_rate(imp_map_formula f, const void *self, const imp_box4 *box,
                            imp_map_rates *rates);
imp_status impinge_map_apply(imp_map_formula f, const void *self, const imp_model in[4],
                             imp_model out[3]);
imp_status impinge_distance(imp_distance_formula f, const void *self, const imp_model point[4],
                            imp_model *distance);

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_MODEL_LINK_H */
