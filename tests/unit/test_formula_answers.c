/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

/* What the macros of <impinge/formula.h> answer for formulas whose answers are known, and how tight
 * models are. */

#include <impinge/formula.h>

#include "tests/support/model_value.h"
#include "tests/support/suite.h"

/* --- Formulas --------------------------------------------------------------------------------- */

typedef struct ball {
    double radius;
} ball;

static void ball_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const ball *b = self;
    imp_model sin_u, cos_u, sin_v, cos_v;
    imp_sincos(u, &sin_u, &cos_u);
    imp_sincos(v, &sin_v, &cos_v);
    out[0] = imp_add(imp_scale(imp_mul(cos_u, cos_v), b->radius), imp_scale(t, 3));
    out[1] = imp_scale(imp_mul(sin_u, cos_v), b->radius);
    out[2] = imp_scale(sin_v, b->radius);
}
IMP_SURFACE_FORMULA(ball_formula)

static void spin_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                         imp_model out[3])
{
    imp_model sine, cosine;
    (void)self;
    imp_sincos(t, &sine, &cosine);
    out[0] = imp_sub(imp_mul(x, cosine), imp_mul(y, sine));
    out[1] = imp_add(imp_mul(x, sine), imp_mul(y, cosine));
    out[2] = z;
}
IMP_MAP_FORMULA(spin_formula)

static void root_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    (void)self;
    out[0] = imp_sqrt(u);
    out[1] = imp_log(v);
    out[2] = t;
}
IMP_SURFACE_FORMULA(root_formula)

static const ball unit = {1};

static imp_region region_of(double u, double v, double t, double half)
{
    const double lo[3] = {u - half, v - half, t - half}, hi[3] = {u + half, v + half, t + half};
    return imp_region_between(lo, hi);
}

/* --- Points ----------------------------------------------------------------------------------- */

START_TEST(points_come_with_their_errors)
{
    const double p[6] = {0.5, 0.25, 0, 2, -1, 10};
    double x[6], error[6];
    ck_assert_int_eq(ball_formula_eval(&unit, 2, p, x, error), IMP_STATUS_OK);
    for (int k = 0; k < 2; k++) {
        double u = p[3 * k], v = p[3 * k + 1], t = p[3 * k + 2];
        const double y[3] = {cos(u) * cos(v) + 3 * t, sin(u) * cos(v), sin(v)};
        for (int i = 0; i < 3; i++) {
            ck_assert(error[3 * k + i] > 0);
            ck_assert(fabs(x[3 * k + i] - y[i]) <= 2 * error[3 * k + i]);
        }
    }
}
END_TEST

START_TEST(the_error_of_a_point_of_a_sphere_is_below_50_units_in_the_last_place)
{
    uint64_t state = suite_seed();
    for (int i = 0; i < suite_times(1000); i++) {
        const double p[3] = {random_between(&state, -4, 4), random_between(&state, -2, 2), 0};
        double x[3], error[3];
        ck_assert_int_eq(ball_formula_eval(&unit, 1, p, x, error), IMP_STATUS_OK);
        for (int k = 0; k < 3; k++)
            ck_assert_msg(error[k] <= 50 * 0x1p-52 * fabs(x[k]), "%g at %g", error[k], x[k]);
    }
}
END_TEST

START_TEST(errors_of_points_may_be_left_out)
{
    const double p[3] = {0.5, 0.25, 1};
    double x[3], y[3], error[3];
    ck_assert_int_eq(ball_formula_eval(&unit, 1, p, x, NULL), IMP_STATUS_OK);
    ck_assert_int_eq(ball_formula_eval(&unit, 1, p, y, error), IMP_STATUS_OK);
    for (int i = 0; i < 3; i++) ck_assert(x[i] == y[i]);
    ck_assert_int_eq(ball_formula_eval(&unit, 0, NULL, NULL, NULL), IMP_STATUS_OK);
}
END_TEST

START_TEST(a_point_without_a_value_is_outside_the_domain)
{
    const double outside[3] = {-1, 1, 0}, pole[3] = {1, 0, 0}, nan[3] = {1, NAN, 0};
    double x[3], error[3];
    ck_assert_int_eq(root_formula_eval(NULL, 1, outside, x, error), IMP_STATUS_DOMAIN);
    ck_assert_int_eq(root_formula_eval(NULL, 1, pole, x, error), IMP_STATUS_DOMAIN);
    ck_assert_int_eq(root_formula_eval(NULL, 1, nan, x, error), IMP_STATUS_DOMAIN);
}
END_TEST

/* --- Regions ---------------------------------------------------------------------------------- */

START_TEST(the_model_of_a_region_follows_its_points)
{
    imp_region r = region_of(0.5, 0.3, 1, 0.1);
    imp_model m[3];
    uint64_t state = suite_seed();
    ck_assert_int_eq(ball_formula_include(&unit, &r, m), IMP_STATUS_OK);
    for (int k = 0; k < 1000; k++) {
        double s[3], p[3], x[3], error[3];
        for (int j = 0; j < 3; j++) {
            s[j] = random_between(&state, -1, 1);
            p[j] = r.c[j] + r.d[j] * s[j];
        }
        ck_assert_int_eq(ball_formula_eval(&unit, 1, p, x, error), IMP_STATUS_OK);
        for (int i = 0; i < 3; i++) {
            ck_assert(fabs(quadratic_at(&m[i], s) - x[i]) <= m[i].e + 1e-15);
            ck_assert(m[i].lo - 1e-15 <= x[i] && x[i] <= m[i].hi + 1e-15);
        }
    }
}
END_TEST

START_TEST(rates_are_those_of_the_model)
{
    imp_region r = region_of(0.5, 0.3, 1, 0.1);
    imp_model m[3];
    imp_rate_matrix rates;
    ck_assert_int_eq(ball_formula_include(&unit, &r, m), IMP_STATUS_OK);
    ck_assert_int_eq(ball_formula_rate(&unit, &r, &rates), IMP_STATUS_OK);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) ck_assert(rates.m[i][j] == m[i].rate[j]);
    ck_assert(rates.m[0][2] >= 3 && rates.m[0][2] <= 3 + 1e-12);
    ck_assert(rates.m[2][0] == 0 && rates.m[2][1] >= cos(0.2) && rates.m[2][1] <= cos(0.2) + 0.01);
}
END_TEST

START_TEST(what_has_no_bound_is_said_to_have_none)
{
    imp_region at_zero = region_of(0.5, 2, 0, 0.5), below = region_of(2, 0.5, 0, 1);
    imp_model m[3];
    imp_rate_matrix rates;
    ck_assert_int_eq(root_formula_include(NULL, &at_zero, m), IMP_STATUS_UNBOUNDED);
    ck_assert(m[0].lo == 0 && m[0].hi >= 1 && m[0].hi < 1 + 1e-12 && m[0].rate[0] == INFINITY);
    ck_assert_int_eq(root_formula_rate(NULL, &at_zero, &rates), IMP_STATUS_UNBOUNDED);
    ck_assert(rates.m[0][0] == INFINITY && rates.m[1][1] < INFINITY && rates.m[0][1] == 0);
    ck_assert_int_eq(root_formula_include(NULL, &below, m), IMP_STATUS_UNBOUNDED);
    ck_assert(m[1].lo == -INFINITY && m[1].hi >= log(1.5) && m[1].e == INFINITY);
}
END_TEST

START_TEST(regions_made_from_bounds_keep_what_regions_promise)
{
    uint64_t state = suite_seed();
    for (int i = 0; i < suite_times(10000); i++) {
        double lo[3], hi[3];
        for (int j = 0; j < 3; j++) {
            lo[j] = random_power(&state, -1070, 1000) * (random_bits(&state) & 1 ? 1 : -1);
            hi[j] = random_bits(&state) & 3 ? lo[j] + random_power(&state, -1070, 1000) : lo[j];
        }
        imp_region r = imp_region_between(lo, hi);
        for (int j = 0; j < 3; j++) {
            ck_assert(r.lo[j] == lo[j] && r.hi[j] == hi[j]);
            ck_assert(lo[j] <= r.c[j] && r.c[j] <= hi[j]);
            ck_assert((r.d[j] == 0) == (lo[j] == hi[j]));
            ck_assert(r.d[j] >= hi[j] - r.c[j] && r.d[j] >= r.c[j] - lo[j]);
        }
    }
}
END_TEST

/* --- Maps ------------------------------------------------------------------------------------- */

START_TEST(a_map_answers_for_points_boxes_and_models)
{
    const double p[4] = {1, 2, 3, 0.5};
    double x[3], error[3];
    ck_assert_int_eq(spin_formula_eval(NULL, 1, p, x, error), IMP_STATUS_OK);
    ck_assert(fabs(x[0] - (cos(0.5) - 2 * sin(0.5))) <= 1e-15 && error[0] < 1e-14);
    ck_assert(x[2] == 3 && error[2] == 0);
    imp_region r = region_of(1, 2, 0.5, 0.01);
    const imp_model in[4] = {imp_param(&r, 0), imp_param(&r, 1), imp_num(3), imp_param(&r, 2)};
    imp_model out[3];
    ck_assert_int_eq(spin_formula_apply(NULL, in, out), IMP_STATUS_OK);
    ck_assert(fabs(out[0].a - x[0]) < 1e-3 && out[0].lo <= x[0] && x[0] <= out[0].hi);
    ck_assert(out[0].e < 1e-5 && out[0].depends == 7 && out[2].depends == 0);
}
END_TEST

START_TEST(rates_of_a_map_cover_space_and_time)
{
    const imp_box4 box = {{-1, 0, 5, 0}, {1, 2, 6, 0.5}};
    imp_map_rates rates;
    ck_assert_int_eq(spin_formula_rate(NULL, &box, &rates), IMP_STATUS_OK);
    ck_assert(rates.m[0][0] >= 1 && rates.m[0][0] < 1 + 1e-6);
    ck_assert(rates.m[0][1] >= sin(0.5) && rates.m[0][1] < sin(0.5) + 5e-3);
    ck_assert(rates.m[0][2] == 0);
    ck_assert(rates.m[0][3] >= sin(0.5) + 2 * cos(0.0) - 0.5 && rates.m[0][3] < 3);
    ck_assert(rates.m[2][0] == 0 && rates.m[2][2] == 1 && rates.m[2][3] == 0);
}
END_TEST

/* --- Known models ----------------------------------------------------------------------------- */

START_TEST(a_parameter_is_its_own_model)
{
    imp_region r = region_of(3, 0, 0, 0.25);
    imp_model u = imp_param(&r, 0);
    ck_assert(u.a == 3 && fabs(u.b[0] - 0.25) <= 0x1p-54 && u.b[1] == 0 && u.e == 0 &&
              u.depends == 1);
    ck_assert(u.lo == 2.75 && u.hi == 3.25 && u.rate[0] == 1 && u.rate[2] == 0);
}
END_TEST

START_TEST(quadratics_are_exact_but_for_rounding)
{
    imp_region r = region_of(0.25, -0.5, 0, 0.5);
    imp_model u = imp_param(&r, 0), v = imp_param(&r, 1);
    imp_model m = imp_add(imp_sqr(u), imp_mul(u, v));
    ck_assert(m.e < 1e-15 && fabs(m.a + 0.0625) < 1e-15);
    ck_assert(fabs(m.b[0]) < 1e-15 && fabs(m.b[1] - 0.125) < 1e-15);
    ck_assert(fabs(m.q[IMP_UU] - 0.25) < 1e-15 && fabs(m.q[IMP_UV] - 0.25) < 1e-15);
    const double coefficients[3] = {1, -3, 2};
    ck_assert(imp_poly(coefficients, 3, u).e < 1e-14);
}
END_TEST

START_TEST(a_square_is_not_a_product)
{
    imp_region r = region_of(0, 0, 0, 1);
    imp_model u = imp_param(&r, 0);
    ck_assert(imp_sqr(u).lo == 0 && imp_sqr(u).hi < 1 + 1e-12);
    ck_assert(imp_powi(u, 4).lo == 0 && imp_abs(u).lo == 0);
}
END_TEST

/* exp(-(u^2 + v^2) / w^2) over a region many w wide. */
START_TEST(a_bump_stays_within_0_and_1_however_far_out)
{
    imp_region r = region_of(0, 0, 0, 50);
    imp_model rr = imp_add(imp_sqr(imp_param(&r, 0)), imp_sqr(imp_param(&r, 1)));
    imp_model bump = imp_exp(imp_scale(rr, -1 / 0.04));
    ck_assert(bump.lo >= 0 && bump.hi <= 1 + 1e-12 && bump.e <= 0.5 + 1e-12);
    ck_assert(bump.rate[0] < INFINITY);
    const double middle[3] = {0, 0, 0}, corner[3] = {1, 1, 0};
    ck_assert(fabs(quadratic_at(&bump, middle) - 1) <= bump.e);
    ck_assert(fabs(quadratic_at(&bump, corner)) <= bump.e);
}
END_TEST

START_TEST(the_remainder_of_a_sine_shrinks_with_the_cube_of_the_width)
{
    for (double half = 0.25; half > 1e-3; half /= 2) {
        imp_region wide = region_of(0.5, 0, 0, half), narrow = region_of(0.5, 0, 0, half / 2);
        double e = imp_sin(imp_param(&wide, 0)).e, e2 = imp_sin(imp_param(&narrow, 0)).e;
        ck_assert_msg(e / e2 > 7 && e / e2 < 9.5, "%g: %g", half, e / e2);
        ck_assert_msg(e < 1.1 * cos(0.5) * half * half * half / 24, "%g: %g", half, e);
    }
}
END_TEST

START_TEST(down_to_one_unit_in_the_last_place_the_remainder_is_rounding)
{
    const double lo[3] = {0.5, 0, 0}, hi[3] = {nextafter(0.5, 1), 0, 0};
    imp_region r = imp_region_between(lo, hi);
    imp_model u = imp_param(&r, 0);
    ck_assert(imp_sin(u).e < 20 * 0x1p-53 && imp_exp(u).e < 40 * 0x1p-53);
    ck_assert(imp_div(imp_num(1), u).e < 40 * 0x1p-53 && imp_sqrt(u).e < 30 * 0x1p-53);
}
END_TEST

static imp_model angle_of(double y_lo, double y_hi, double x_lo, double x_hi)
{
    const double lo[3] = {x_lo, y_lo, 0}, hi[3] = {x_hi, y_hi, 0};
    imp_region r = imp_region_between(lo, hi);
    return imp_atan2(imp_param(&r, 1), imp_param(&r, 0));
}

START_TEST(angles_jump_at_the_cut_and_nowhere_else)
{
    imp_model below = angle_of(-1, 0, -3, -2), across = angle_of(-1, 1, -3, -2);
    imp_model above = angle_of(0, 1, -3, -2), origin = angle_of(-1, 1, -1, 1);
    ck_assert(below.rate[1] == INFINITY && below.lo <= -3.1 && below.hi >= 3.1);
    ck_assert(across.rate[0] == INFINITY && across.lo <= -3.1 && across.hi >= 3.1);
    ck_assert(origin.rate[0] == INFINITY && origin.lo <= -3.1 && origin.hi >= 3.1);
    ck_assert(above.rate[1] <= 0.501 && above.lo > 2.6 && above.hi >= 3.14);
    imp_model right = angle_of(-1, 1, 2, 3), up = angle_of(2, 3, -1, 1),
              down = angle_of(-3, -2, -1, 1);
    ck_assert(right.rate[1] <= 0.501 && right.lo > -0.5 && right.hi < 0.5);
    ck_assert(up.rate[0] <= 0.501 && up.lo > 1 && up.hi < 2.2);
    ck_assert(down.rate[0] <= 0.501 && down.lo > -2.2 && down.hi < -1);
}
END_TEST

START_TEST(a_value_and_rates_make_a_model)
{
    const double rate[3] = {2, 0, 0.5}, d[3] = {0.25, 1, 2};
    imp_model m = imp_model_box(10, 1e-3, rate, d);
    ck_assert(m.a == 10 && m.e >= 1.501 && m.e < 1.5010001);
    ck_assert(m.lo <= 10 - m.e && m.hi >= 10 + m.e);
    ck_assert(m.depends == 5 && m.rate[0] == 2 && m.rate[1] == 0 && m.b[0] == 0);
    const double endless[3] = {INFINITY, 0, 0};
    m = imp_model_box(10, 0, endless, d);
    ck_assert(m.e == INFINITY && m.rate[0] == INFINITY && m.depends == 1);
}
END_TEST

START_TEST(an_exponential_whose_middle_underflows_reaches_its_upper_end)
{
    imp_model bump = imp_exp(imp_between(-1385, -32));
    ck_assert(bump.hi >= 1.2664165549094175e-14 && bump.lo >= 0 && bump.hi < 1.3e-14);
    ck_assert(bump.a - bump.e <= 0 && bump.a + bump.e >= 1.2664165549094175e-14);
    bump = imp_exp(imp_between(-2000, -1900));
    ck_assert(bump.lo == 0 && bump.hi >= 0 && bump.hi < 1e-300 && bump.e < 1e-300);
}
END_TEST

SUITE_MAIN("formula answers", points_come_with_their_errors,
           the_error_of_a_point_of_a_sphere_is_below_50_units_in_the_last_place,
           errors_of_points_may_be_left_out, a_point_without_a_value_is_outside_the_domain,
           the_model_of_a_region_follows_its_points, rates_are_those_of_the_model,
           what_has_no_bound_is_said_to_have_none,
           regions_made_from_bounds_keep_what_regions_promise,
           a_map_answers_for_points_boxes_and_models, rates_of_a_map_cover_space_and_time,
           a_parameter_is_its_own_model, quadratics_are_exact_but_for_rounding,
           a_square_is_not_a_product, a_bump_stays_within_0_and_1_however_far_out,
           an_exponential_whose_middle_underflows_reaches_its_upper_end,
           the_remainder_of_a_sine_shrinks_with_the_cube_of_the_width,
           down_to_one_unit_in_the_last_place_the_remainder_is_rounding,
           angles_jump_at_the_cut_and_nowhere_else, a_value_and_rates_make_a_model)
