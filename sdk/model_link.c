/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* The functions of <impinge/model_link.h>: the inline ones by names that can be linked. */

#include <impinge/model_link.h>

#define OF_ONE(NAME)                                                                               \
    imp_model impinge_##NAME(imp_model x) { return imp_##NAME(x); }
#define OF_TWO(NAME)                                                                               \
    imp_model impinge_##NAME(imp_model x, imp_model y) { return imp_##NAME(x, y); }
#define OF_NUMBER(NAME)                                                                            \
    imp_model impinge_##NAME(imp_model x, double k) { return imp_##NAME(x, k); }

OF_ONE(model_finish)
OF_ONE(neg)
OF_ONE(sqr)
OF_ONE(sqrt)
OF_ONE(exp)
OF_ONE(log)
OF_ONE(abs)
OF_ONE(sin)
OF_ONE(cos)
OF_ONE(tan)
OF_ONE(asin)
OF_ONE(acos)
OF_ONE(atan)
OF_ONE(sinh)
OF_ONE(cosh)
OF_ONE(tanh)
OF_TWO(add)
OF_TWO(sub)
OF_TWO(mul)
OF_TWO(div)
OF_TWO(pow_model)
OF_TWO(min)
OF_TWO(max)
OF_TWO(atan2)
OF_NUMBER(shift)
OF_NUMBER(scale)
OF_NUMBER(pow)

imp_model impinge_num(double k) { return imp_num(k); }
imp_model impinge_known(double a, double e) { return imp_known(a, e); }
imp_model impinge_param(const imp_region *region, int j) { return imp_param(region, j); }
imp_model impinge_const_pi(void) { return imp_const_pi(); }
imp_model impinge_between(double lo, double hi) { return imp_between(lo, hi); }
imp_model impinge_unbounded(uint32_t depends) { return imp_unbounded(depends); }
imp_model impinge_lerp(imp_model x, imp_model y, imp_model t) { return imp_lerp(x, y, t); }
imp_model impinge_dot3(const imp_model x[3], const imp_model y[3]) { return imp_dot3(x, y); }
imp_model impinge_poly(const double *coef, size_t n, imp_model t) { return imp_poly(coef, n, t); }
imp_model impinge_powi(imp_model x, int n) { return imp_powi(x, n); }

void impinge_sincos(imp_model x, imp_model *sine, imp_model *cosine)
{
    imp_sincos(x, sine, cosine);
}

imp_status impinge_surface_eval(imp_surface_formula f, const void *self, size_t n, const double *p,
                                double *x, double *error)
{
    return imp_surface_formula_eval_(f, self, n, p, x, error);
}

imp_status impinge_surface_rate(imp_surface_formula f, const void *self, const imp_region *region,
                                imp_rate_matrix *rates)
{
    return imp_surface_formula_rate_(f, self, region, rates);
}

imp_status impinge_surface_include(imp_surface_formula f, const void *self,
                                   const imp_region *region, imp_model model[3])
{
    return imp_surface_formula_include_(f, self, region, model);
}

imp_status impinge_map_eval(imp_map_formula f, const void *self, size_t n, const double *p,
                            double *x, double *error)
{
    return imp_map_formula_eval_(f, self, n, p, x, error);
}

imp_status impinge_map_rate(imp_map_formula f, const void *self, const imp_box4 *box,
                            imp_map_rates *rates)
{
    return imp_map_formula_rate_(f, self, box, rates);
}

imp_status impinge_map_apply(imp_map_formula f, const void *self, const imp_model in[4],
                             imp_model out[3])
{
    return imp_map_formula_apply_(f, self, in, out);
}

imp_status impinge_distance(imp_distance_formula f, const void *self, const imp_model point[4],
                            imp_model *distance)
{
    return imp_distance_formula_(f, self, point, distance);
}
