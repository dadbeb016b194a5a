/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "mistakes.h"

/* --- Rates ------------------------------------------------------------------------------------ */

static imp_status no_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    (void)self, (void)region, (void)rates;
    return IMP_STATUS_UNBOUNDED;
}
MISTAKE(rate_unbounded, tube_create, tube_destroy, tube_domain, tube_formula_eval, no_rate, NULL);

/* Largest |sin(x + phase)| for x in [lo, hi], as doubles have it. */
static double wave_peak(double lo, double hi, double phase)
{
    const double pi = 3.141592653589793;
    const double at_lo = (lo + phase) / pi - 0.5, at_hi = (hi + phase) / pi - 0.5;
    if (ceil(at_lo) <= floor(at_hi)) return 1;
    return imp_larger(fabs(sin(lo + phase)), fabs(sin(hi + phase)));
}

/* The right formula, and no word about rounding. */
static imp_status bare_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    const tube *a = self;
    const double quarter = 1.5707963267948966;
    const double lo = 3 * r->lo[1] + r->lo[2], hi = 3 * r->hi[1] + r->hi[2];
    const double most = a->radius + fabs(a->wave) * wave_peak(lo, hi, 0);
    const double bend = fabs(a->wave) * wave_peak(lo, hi, quarter);
    const double sine = wave_peak(r->lo[0], r->hi[0], 0);
    const double cosine = wave_peak(r->lo[0], r->hi[0], quarter);
    const double drift = imp_larger(fabs(path_slope(a, r->lo[2])), fabs(path_slope(a, r->hi[2])));
    *rates = (imp_rate_matrix){{{most * sine, 3 * bend * cosine, bend * cosine},
                                {most * cosine, 3 * bend * sine, bend * sine},
                                {0, 2, drift}}};
    return IMP_STATUS_OK;
}
MISTAKE(rate_not_padded, tube_create, tube_destroy, tube_domain, tube_formula_eval, bare_rate,
        NULL);

static imp_status strip_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    const imp_status status = tube_formula_rate(self, r, rates);
    const int inside = r->lo[1] >= 0.7 && r->hi[1] <= 0.8;
    for (int k = 0; inside && k < 9; ++k) rates->m[k / 3][k % 3] *= 1 - 1e-6;
    return status;
}
MISTAKE_RATE(rate_low_in_strip, strip_rate);

static imp_status factor_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    const imp_status status = tube_formula_rate(self, r, rates);
    rates->m[0][1] /= 3;
    return status;
}
MISTAKE_RATE(rate_without_factor, factor_rate);

static imp_status still_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    const imp_status status = tube_formula_rate(self, r, rates);
    for (int i = 0; i < 3; ++i) rates->m[i][2] = 0;
    return status;
}
MISTAKE_RATE(rate_without_time, still_rate);

static imp_status corner_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    memset(rates, 0, sizeof *rates);
    for (int corner = 0; corner < 8; ++corner) {
        double p[3], m[3][3];
        for (int j = 0; j < 3; ++j) p[j] = corner >> j & 1 ? r->hi[j] : r->lo[j];
        tube_slopes(self, p, m);
        for (int k = 0; k < 9; ++k)
            rates->m[k / 3][k % 3] =
                imp_larger(rates->m[k / 3][k % 3], imp_libm_up(4 * fabs(m[k / 3][k % 3])) / 4);
    }
    return IMP_STATUS_OK;
}
MISTAKE_RATE(rate_of_corners, corner_rate);

static imp_status centre_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    double m[3][3];
    tube_slopes(self, r->c, m);
    for (int k = 0; k < 9; ++k) rates->m[k / 3][k % 3] = imp_libm_up(fabs(m[k / 3][k % 3]));
    return IMP_STATUS_OK;
}
MISTAKE_RATE(rate_of_centre, centre_rate);

static imp_status signed_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    double m[3][3];
    const imp_status status = tube_formula_rate(self, r, rates);
    tube_slopes(self, r->c, m);
    rates->m[0][0] = copysign(rates->m[0][0], m[0][0]);
    return status;
}
MISTAKE_RATE(rate_with_sign, signed_rate);

/* --- Models ----------------------------------------------------------------------------------- */

static imp_status no_model(const void *self, const imp_region *r, imp_model model[3])
{
    (void)self, (void)r;
    for (int i = 0; i < 3; ++i) model[i] = imp_unbounded(7);
    return IMP_STATUS_UNBOUNDED;
}
MISTAKE_INCLUDE(model_unbounded, no_model);

static imp_status crossless(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    for (int i = 0; i < 3; ++i) model[i].q[IMP_UV] = 0;
    return status;
}
MISTAKE_INCLUDE(model_without_cross_term, crossless);

static imp_status second_order(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    for (int i = 0; i < 3; ++i) model[i].e = 0x1p-48 * imp_model_size(&model[i]);
    return status;
}
MISTAKE_INCLUDE(model_without_third_order, second_order);

static imp_status bare_range(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    model[2].lo = 2 * r->lo[1] + path_at(self, r->lo[2]);
    model[2].hi = 2 * r->hi[1] + path_at(self, r->hi[2]);
    return status;
}
MISTAKE_INCLUDE(range_not_padded, bare_range);

static imp_status corner_range(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    for (int i = 0; i < 2; ++i) model[i].lo = INFINITY, model[i].hi = -INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
        double p[3], x[3];
        for (int j = 0; j < 3; ++j) p[j] = corner >> j & 1 ? r->hi[j] : r->lo[j];
        tube_point(self, p, x);
        for (int i = 0; i < 2; ++i) {
            model[i].lo = imp_smaller(model[i].lo, x[i] - 1e-14);
            model[i].hi = imp_larger(model[i].hi, x[i] + 1e-14);
        }
    }
    return status;
}
MISTAKE_INCLUDE(range_of_corners, corner_range);

static imp_status slope_model(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    for (int i = 0; i < 3; ++i) model[i].b[0] = r->d[0] > 0 ? model[i].b[0] / r->d[0] : 0;
    return status;
}
MISTAKE_INCLUDE(model_of_slopes_by_u, slope_model);

static imp_status still_model(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    for (int i = 0; i < 3; ++i) model[i].rate[2] = 0;
    return status;
}
MISTAKE_INCLUDE(model_rate_without_time, still_model);

static imp_status frozen_model(const void *self, const imp_region *r, imp_model model[3])
{
    const double lo[3] = {r->lo[0], r->lo[1], r->c[2]}, hi[3] = {r->hi[0], r->hi[1], r->c[2]};
    const imp_region now = imp_region_between(lo, hi);
    return tube_formula_include(self, &now, model);
}
MISTAKE_INCLUDE(model_of_one_moment, frozen_model);

static imp_status free_model(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    model[2].depends = 2;
    return status;
}
MISTAKE_INCLUDE(model_forgets_dependence, free_model);

/* --- Late and early times --------------------------------------------------------------------- */

/* A tenth too small from t = 50 on. */
static imp_status late_rate(const void *self, const imp_region *r, imp_rate_matrix *rates)
{
    const imp_status status = tube_formula_rate(self, r, rates);
    for (int k = 0; k < 9 && r->lo[2] > 50; ++k) rates->m[k / 3][k % 3] *= 0.9;
    return status;
}
MISTAKE_RATE(rate_low_late, late_rate);

/* Half of the remainder before t = -50. */
static imp_status early_model(const void *self, const imp_region *r, imp_model model[3])
{
    const imp_status status = tube_formula_include(self, r, model);
    for (int i = 0; i < 3 && r->hi[2] < -50; ++i) model[i].e *= 0.25;
    return status;
}
MISTAKE_INCLUDE(model_sure_early, early_model);

/* --- Errors of points ------------------------------------------------------------------------- */

static imp_status exact_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    for (size_t k = 0; k < n; ++k) tube_point(self, p + 3 * k, x + 3 * k);
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = 0;
    return IMP_STATUS_OK;
}
MISTAKE_EVAL(error_zero, exact_eval);

/* Claims the error of the last rounding only. */
static imp_status last_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    for (size_t k = 0; k < n; ++k) tube_point(self, p + 3 * k, x + 3 * k);
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = 0x1p-53 * fabs(x[k]);
    return IMP_STATUS_OK;
}
MISTAKE_EVAL(error_of_last_rounding, last_eval);

static imp_status float_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = tube_formula_eval(self, n, p, x, error);
    for (size_t k = 0; k < 3 * n; ++k) x[k] = (float)x[k];
    return status;
}
MISTAKE_EVAL(error_of_double_for_float, float_eval);

MISTAKES("mistakes_bounds", &rate_unbounded_type, &rate_not_padded_type, &rate_low_in_strip_type,
         &rate_without_factor_type, &rate_without_time_type, &rate_of_corners_type,
         &rate_of_centre_type, &rate_with_sign_type, &model_unbounded_type,
         &model_without_cross_term_type, &model_without_third_order_type, &range_not_padded_type,
         &range_of_corners_type, &model_of_slopes_by_u_type, &model_rate_without_time_type,
         &model_of_one_moment_type, &model_forgets_dependence_type, &error_zero_type,
         &error_of_last_rounding_type, &error_of_double_for_float_type, &rate_low_late_type,
         &model_sure_early_type);
