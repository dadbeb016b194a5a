/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <fenv.h>
#include <string.h>

#include "tests/support/alloc_failure.h"
#include "tests/support/comma_locale.h"
#include "tests/support/expression_kit.h"

/* The language of formulas: what texts mean. What is said of wrong ones: test_expression_faults.c.
 * Bounds: test_expression_bounds.c. */

/* --- Meaning ---------------------------------------------------------------------------------- */

#define E 2.718281828459045
#define PI 3.141592653589793

static const struct meaning {
    const char *text;
    double value; /* as C computes it */
} meanings[] = {
    {"1", 1},
    {".5", 0.5},
    {"5.", 5},
    {"1e-3", 1e-3},
    {"2.5E+2", 250},
    {"pi", PI},
    {"e", E},
    {"a", 3},
    {"radius", 0.1},
    {"u", U},
    {" u\t+\n v ", U + V},
    {"1-2-3", -4},
    {"8/4/2", 1},
    {"2+3*4", 14},
    {"(2+3)*4", 20},
    {"2*3^2", 18},
    {"-2^2", -4},
    {"(-2)^2", 4},
    {"2^3^2", 512},
    {"(2^3)^2", 64},
    {"2^-1", 0.5},
    {"2^-2^2", 0.0625},
    {"-u^2", -U *U},
    {"2*-3", -6},
    {"--u", U},
    {"+-+u", -U},
    {"1 - -1", 2},
    {"-(1+2)^2", -9},
    {"u/v/t", U / V / T},
    {"u/(v/t)", U / (V / T)},
    {"u-v+t", U - V + T},
    {"u-(v+t)", U - (V + T)},
    {"u^2", U *U},
    {"u*u*u", U *U *U},
    {"t^3", T *T *T},
    {"t^-3", 1 / (T * T * T)},
    {"v^0.5", 1.118033988749895},
    {"v^(1/3)", 1.0772173450159418},
    {"v^pi", 2.015820163273421},
    {"v^u", 1.087279638020491},
    {"e^u", 1.4549914146182013},
    {"2^u", 1.2968395546510096},
    {"u^0", 1},
    {"u^1", U},
    {"pow(v,2)", V *V},
    {"abs(t)", 2.5},
    {"fabs(t)", 2.5},
    {"sq(t)", 6.25},
    {"sqr(t)", 6.25},
    {"sqrt(v)", 1.118033988749895},
    {"sqrt(t^2)", 2.5},
    {"cbrt(t)", -1.3572088082974532},
    {"exp(u)", 1.4549914146182013},
    {"exp2(u)", 1.2968395546510096},
    {"log(v)", 0.22314355131420976},
    {"ln(v)", 0.22314355131420976},
    {"log2(8)", 3},
    {"log10(1000)", 3},
    {"sin(u)", 0.36627252908604757},
    {"cos(u)", 0.9305076219123143},
    {"tan(u)", 0.3936265759256327},
    {"asin(u)", 0.38439677449563906},
    {"acos(u)", 1.1863995522992576},
    {"atan(t)", -1.1902899496825317},
    {"atan2(u,t)", 2.992702705980296},
    {"atan2(u,v)", 0.2914567944778671},
    {"sinh(u)", 0.38385106791361456},
    {"cosh(u)", 1.0711403467045868},
    {"tanh(u)", 0.35835739835078595},
    {"min(u,v)", U},
    {"max(u,v,t,1.5)", 1.5},
    {"fmin(u,v,t)", T},
    {"fmax(u,v)", V},
    {"hypot(3,4)", 5},
    {"hypot(u,v)", 1.3050383136138187},
    {"hypot(u,v,t)", 2.8201285431696195},
    {"sqrt(u^2+v^2)", 1.3050383136138187},
    {"hypot(u,v)^2", U *U + V *V},
    {"clamp(t,-1,1)", -1},
    {"clamp(v,-1,1)", 1},
    {"clamp(u,-1,1)", U},
    {"lerp(u,v,1/4)", U + (V - U) / 4},
    {"copysign(2,v)", 2},
    {"copysign(v,-v)", -V},
    {"copysign(t,t)", T},
    {"copysign(abs(t)^1.5,t)", -3.9528470752104745},
    {"u-u", 0},
    {"0*t", 0},
    {"a*u+radius", 3 * U + 0.1},
};

START_TEST(every_operator_and_function_means_what_it_does_elsewhere)
{
    for (size_t i = 0; i < sizeof meanings / sizeof meanings[0]; ++i) {
        const struct meaning *m = &meanings[i];
        double x, error;
        ck_assert_int_eq(value_at(m->text, U, V, T, &x, &error), IMP_STATUS_OK);
        ck_assert_msg(fabs(x - m->value) <= error + 4e-16 * fabs(m->value),
                      "%s: %.17g +- %g, not %.17g", m->text, x, error, m->value);
        ck_assert_msg(error <= 1e-14 * (1 + fabs(x)), "%s: error %g", m->text, error);
    }
}
END_TEST

START_TEST(exact_arithmetic_with_constants_stays_exact)
{
    static const char *const texts[] = {"2*3/4+1",    "1/8",   "(1+2)^5-3", "sqrt(9)",
                                        "-(2-6)*0.5", "10^15", "min(1,2)",  "abs(-3)"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        double x, error;
        ck_assert_int_eq(value_at(texts[i], U, V, T, &x, &error), IMP_STATUS_OK);
        ck_assert_msg(error == 0, "%s: error %g", texts[i], error);
    }
}
END_TEST

/* Whatever point the locale has, formulas have '.'. */
START_TEST(numbers_are_read_alike_in_every_locale)
{
    const sandbox box = sandbox_new();
    if (comma_locale_make(&box)) ck_assert_ptr_nonnull(setlocale(LC_NUMERIC, COMMA_LOCALE));
    double x, error;
    ck_assert_int_eq(value_at("1.5+.25", U, V, T, &x, &error), IMP_STATUS_OK);
    ck_assert_double_eq(x, 1.75);
    comma_locale_remove(&box);
}
END_TEST

/* --- Compiled form ---------------------------------------------------------------------------- */

static const struct compiled_length {
    const char *text;
    size_t length; /* for x, y and z alike */
} lengths[] = {
    {"u", 0},       {"7", 1},   {"2*pi*u", 1},    {"u*2*pi", 1},        {"u/3", 1},
    {"1+u+2", 1},   {"u*u", 1}, {"u*u*u*u", 1},   {"--u", 0},           {"u+0", 0},
    {"1*u", 0},     {"u^1", 0}, {"sqrt(u^2)", 1}, {"sin(u)*sin(u)", 2}, {"cos(u)+v*cos(u)", 3},
    {"u*v-v*u", 1},
};

START_TEST(what_formulas_have_in_common_is_computed_once)
{
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; ++i)
        ck_assert_msg(length_of(lengths[i].text) == lengths[i].length, "%s: %zu operations",
                      lengths[i].text, length_of(lengths[i].text));
}
END_TEST

/* --- Where formulas are undefined ------------------------------------------------------------- */

static const struct point {
    const char *text;
    double u, v, t;
} outside[] =
    {
        {"sqrt(u)", -0.25, 0, 0},
        {"log(u)", -0.5, 0, 0},
        {"log(u)", 0, 0, 0},
        {"1/u", 0, 0, 0},
        {"u^-2", 0, 0, 0},
        {"u^0.3", -1, 0, 0},
        {"u^-0.3", 0, 0, 0},
        {"asin(2*u)", 1, 0, 0},
        {"acos(t)", 0, 0, -3},
        {"atan2(u,v)", 0, 0, 0},
        {"u^v", -0.5, 1, 0},
        {"u^t", 0, 0, -1},
        {"atan(log(u))", 0, 0, 0},
        {"sin(1/u)", 0, 0, 0},
        {"min(1,sqrt(u))", -1, 0, 0},
        {"tanh(sqrt(u))", -1, 0, 0},
        {"exp(1000*v)", 0, 1, 0},
        {"u", NAN, 0, 0},
        {"u+t", 0, 0, INFINITY},
},
  inside[] = {
      {"sqrt(u)", 0, 0, 0},    {"u^0.3", 0, 0, 0},        {"u^(1/3)", 0, 0, 0},
      {"u^v", 0, 1, 0},        {"asin(u)", 1, 0, 0},      {"acos(u)", -1, 0, 0},
      {"hypot(u,v)", 0, 0, 0}, {"cbrt(u)", 0, 0, 0},      {"atan2(u,v)", 0, 1, 0},
      {"1e300*t", 0, 0, 1e8},  {"exp(-1000*v)", 0, 2, 0}, {"acos(cos(u))", 0, 0, 0},
};

START_TEST(a_point_where_the_formula_is_undefined_is_outside_its_domain)
{
    double x, error;
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; ++i) {
        const struct point *p = &outside[i];
        ck_assert_msg(value_at(p->text, p->u, p->v, p->t, &x, &error) == IMP_STATUS_DOMAIN,
                      "%s at %g %g %g: %g +- %g", p->text, p->u, p->v, p->t, x, error);
    }
    for (size_t i = 0; i < sizeof inside / sizeof inside[0]; ++i) {
        const struct point *p = &inside[i];
        ck_assert_msg(value_at(p->text, p->u, p->v, p->t, &x, &error) == IMP_STATUS_OK,
                      "%s at %g %g %g", p->text, p->u, p->v, p->t);
        ck_assert_msg(error < 1e-7 * (1 + fabs(x)), "%s: %g +- %g", p->text, x, error);
    }
}
END_TEST

START_TEST(what_is_infinite_on_the_way_may_be_finite_in_the_end)
{
    double x, error;
    ck_assert_int_eq(value_at("1/(1+exp(1000*v))", 0, 1, 0, &x, &error), IMP_STATUS_OK);
    ck_assert_msg(x - error <= 0 && 0 <= x + error && error <= 0.51, "%g +- %g", x, error);
    ck_assert_int_eq(value_at("tanh(cosh(1000*v))", 0, 1, 0, &x, &error), IMP_STATUS_OK);
    ck_assert_msg(x - error <= 1 && 1 <= x + error && error <= 1.01, "%g +- %g", x, error);
}
END_TEST

START_TEST(a_region_where_the_formula_is_undefined_is_unbounded)
{
    static const char *const texts[] = {"sqrt(u)",       "log(u)",       "1/u",       "sin(1/u)",
                                        "tanh(sqrt(u))", "atan(log(u))", "u^0.5+1/u", "u^t"};
    const imp_model u = {.a = -0.5, .b = {0.25}, .lo = -0.75, .hi = 0, .rate = {1}, .depends = 1};
    const imp_model variables[] = {u, imp_num(1), imp_num(-0.5)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        imp_model out[3];
        expression_program *program = compiled(texts[i]);
        expression_models(program, variables, out);
        ck_assert_msg(out[0].rate[0] == INFINITY || out[0].e == INFINITY, "%s", texts[i]);
        expression_free(program);
    }
}
END_TEST

/* Rates are infinite there, ranges are not. */
START_TEST(a_range_is_known_where_rates_are_not)
{
    static const char *const texts[] = {"u^v",       "exp(log(u))",    "u^(1/3)",        "sqrt(u)",
                                        "u^pi",      "tanh(-log(u))",  "1/(1+log(u)^2)", "2^log(u)",
                                        "(1/u)^-pi", "1/(1+1/u)^(1/3)"};
    const imp_model u = {.a = 0.25, .b = {0.25}, .hi = 0.5, .rate = {1}, .depends = 1};
    const imp_model v = {.a = 0.5, .b = {0, 0.5}, .hi = 1, .rate = {0, 1}, .depends = 2};
    const imp_model variables[] = {u, v, imp_num(0)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        imp_model out[3];
        expression_program *program = compiled(texts[i]);
        expression_models(program, variables, out);
        ck_assert_msg(out[0].lo > -1e-300 && out[0].hi < 1.001, "%s: [%g, %g]", texts[i], out[0].lo,
                      out[0].hi);
        expression_free(program);
    }
}
END_TEST

/* At the apex of a cone the square root has no rate, but the distance has. */
START_TEST(a_distance_has_rates_at_zero)
{
    static const char *const texts[] = {"hypot(u,v)", "sqrt(u^2+v^2)", "hypot(u,v,0)",
                                        "sqrt(u*u+v*v)", "(u^2+v*v)^0.5"};
    const imp_model u = {.b = {0.5}, .lo = -0.5, .hi = 0.5, .rate = {1}, .depends = 1};
    const imp_model v = {.b = {0, 0.5}, .lo = -0.5, .hi = 0.5, .rate = {0, 1}, .depends = 2};
    const imp_model variables[] = {u, v, imp_num(0)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        imp_model out[3];
        expression_program *program = compiled(texts[i]);
        expression_models(program, variables, out);
        for (int j = 0; j < 2; ++j)
            ck_assert_msg(out[0].rate[j] >= 1 && out[0].rate[j] < 1.0001, "%s: %g", texts[i],
                          out[0].rate[j]);
        ck_assert_double_lt(out[0].hi, 0.7072);
        expression_free(program);
    }
}
END_TEST

START_TEST(a_copied_sign_is_lipschitz_where_it_is_taken)
{
    static const char *const texts[] = {"copysign(u,u)", "copysign(u*v,-2*u)",
                                        "copysign(abs(u)^1.5,u)", "copysign(sin(u)*exp(v),u)",
                                        "copysign(min(u^2,abs(u)),u)"};
    const imp_model u = {.b = {0.5}, .lo = -0.5, .hi = 0.5, .rate = {1}, .depends = 1};
    const imp_model variables[] = {u, imp_num(1), imp_num(0)};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        imp_model out[3];
        expression_program *program = compiled(texts[i]);
        expression_models(program, variables, out);
        ck_assert_msg(out[0].rate[0] < 3, "%s: %g", texts[i], out[0].rate[0]);
        ck_assert_double_eq(out[0].lo, -out[0].hi);
        expression_free(program);
    }
}
END_TEST

/* --- Running ---------------------------------------------------------------------------------- */

START_TEST(running_changes_nothing_and_always_answers_alike)
{
    static const char *const texts[] = {"exp(1000*v)+log(u)", "sqrt(u)/v+cbrt(t)", "u^v",
                                        "sinh(1000*v)*(1e200*t)^3", "atan2(u,t)-acos(u)"};
    const double p[] = {-0.5, 0, 1e200};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        double x[2][3], error[2][3];
        imp_model out[2][3],
            variables[] = {imp_between(-1, 1), imp_between(0, 2), imp_between(-INFINITY, 1)};
        expression_program *program = compiled(texts[i]);
        memset(x, 0, sizeof x);
        memset(error, 0, sizeof error);
        errno = 0;
        fesetround(FE_TONEAREST);
        imp_status first = expression_point(program, p, x[0], error[0]);
        ck_assert_int_eq(expression_point(program, p, x[1], error[1]), first);
        expression_models(program, variables, out[0]);
        expression_models(program, variables, out[1]);
        ck_assert_mem_eq(x[0], x[1], sizeof x[0]);
        ck_assert_mem_eq(error[0], error[1], sizeof error[0]);
        ck_assert_mem_eq(out[0], out[1], sizeof out[0]);
        ck_assert_int_eq(errno, 0);
        ck_assert_int_eq(fegetround(), FE_TONEAREST);
        expression_free(program);
    }
}
END_TEST

START_TEST(without_memory_nothing_is_compiled_and_nothing_left)
{
    static const char *const text[] = {"sin(u)", "u*v", "1/3"};
    size_t before = alloc_failure_live(), n = 0;
    for (bool failed = true; failed;) {
        expression_program *program = NULL;
        expression_error error;
        alloc_failure_begin(++n);
        imp_status status = compile_with(text, 0, NULL, NULL, &program, &error);
        failed = alloc_failure_end();
        ck_assert_int_eq(status, failed ? IMP_STATUS_INTERNAL : IMP_STATUS_OK);
        expression_free(program);
        ck_assert_uint_eq(alloc_failure_live(), before);
    }
    ck_assert_uint_ge(n, 3);
}
END_TEST

SUITE_MAIN("expression", every_operator_and_function_means_what_it_does_elsewhere,
           exact_arithmetic_with_constants_stays_exact, numbers_are_read_alike_in_every_locale,
           what_formulas_have_in_common_is_computed_once,
           a_point_where_the_formula_is_undefined_is_outside_its_domain,
           what_is_infinite_on_the_way_may_be_finite_in_the_end,
           a_region_where_the_formula_is_undefined_is_unbounded,
           a_range_is_known_where_rates_are_not, a_distance_has_rates_at_zero,
           a_copied_sign_is_lipschitz_where_it_is_taken,
           running_changes_nothing_and_always_answers_alike,
           without_memory_nothing_is_compiled_and_nothing_left)
