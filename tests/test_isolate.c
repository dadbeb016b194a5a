/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "isolate.h"

#include <impinge/formula.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "suite.h"

/* Instances in processes of their own: the same answers, and an answer when they have none. */

enum { CRASH_IN_CREATE = 1, CRASH_IN_EVAL, EXIT_IN_RATE, HANG_IN_EVAL, TRAP_IN_INCLUDE };

static imp_status make(const imp_value *values, void **self, imp_complaint *why)
{
    (void)why;
    if (values->number[0] == CRASH_IN_CREATE) raise(SIGSEGV);
    *self = malloc(sizeof(double));
    memcpy(*self, values->number, sizeof(double));
    return IMP_OK;
}

static imp_status complain(const imp_value *values, void **self, imp_complaint *why)
{
    (void)values;
    (void)self;
    why->parameter = 0;
    strcpy(why->text, "too red");
    return IMP_PARAMETER;
}

static void bowl_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    (void)self;
    out[0] = u;
    out[1] = v;
    out[2] = imp_add(imp_add(imp_sqr(u), imp_sin(v)), t);
}
IMP_SURFACE_FORMULA(bowl_formula)

static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const double sin = *(const double *)self;
    if (sin == CRASH_IN_EVAL) raise(SIGSEGV);
    while (sin == HANG_IN_EVAL) pause();
    return bowl_formula_eval(self, n, p, x, error);
}

static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    if (*(const double *)self == EXIT_IN_RATE) _exit(0);
    return bowl_formula_rate(self, region, rates);
}

/* Subnormals off, as -ffast-math does it. */
static void change_mode(void)
{
#if defined(__x86_64__)
    __builtin_ia32_ldmxcsr(0x1f80 | 0x8000);
#endif
}

static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    if (*(const double *)self == TRAP_IN_INCLUDE) change_mode();
    return bowl_formula_include(self, region, model);
}

static void domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    memcpy(lo, (double[3]){-1, -2, -INFINITY}, 3 * sizeof *lo);
    memcpy(hi, (double[3]){1, 2, INFINITY}, 3 * sizeof *hi);
}

static const imp_surface_type bowl = {.name = "bowl",
                                      .create = make,
                                      .destroy = free,
                                      .domain = domain,
                                      .eval = eval,
                                      .rate = rate,
                                      .include = include};
static const imp_surface_type fussy = {.name = "fussy",
                                       .create = complain,
                                       .destroy = free,
                                       .domain = domain,
                                       .eval = eval,
                                       .rate = rate};

static isolated *isolated_bowl(double sin, imp_status expected)
{
    const imp_value value = {.count = 1, .extent = {1, 1, 1}, .number = &sin};
    imp_complaint why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    isolated *i = isolate_surface(&bowl);
    ck_assert_ptr_nonnull(i);
    ck_assert_int_eq(isolate_create(i, &value, &why), expected);
    return i;
}

START_TEST(answers_from_another_process_are_the_same_bit_for_bit)
{
    isolated *i = isolated_bowl(0, IMP_OK);
    const imp_surface_type *type = isolate_surface_type(i);
    const double zero = 0;
    uint64_t state = suite_seed();
    double p[3 * 200], x[2][3 * 200], e[2][3 * 200];
    for (int k = 0; k < 600; ++k) p[k] = suite_between(&state, -1, 1);
    ck_assert_int_eq(type->eval(i, 200, p, x[0], e[0]), IMP_OK);
    ck_assert_int_eq(eval(&zero, 200, p, x[1], e[1]), IMP_OK);
    ck_assert(memcmp(x[0], x[1], sizeof x[0]) == 0 && memcmp(e[0], e[1], sizeof e[0]) == 0);
    ck_assert_int_eq(type->eval(i, 200, p, x[0], NULL), IMP_OK);
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    imp_model m[2][3];
    imp_rate_matrix rates[2];
    memset(m, 0, sizeof m);
    ck_assert_int_eq(type->include(i, &r, m[0]), include(&zero, &r, m[1]));
    ck_assert_int_eq(type->rate(i, &r, &rates[0]), rate(&zero, &r, &rates[1]));
    ck_assert(memcmp(m[0], m[1], sizeof m[0]) == 0);
    ck_assert(memcmp(&rates[0], &rates[1], sizeof rates[0]) == 0);
    double lo[3], hi[3];
    type->domain(i, lo, hi);
    ck_assert(lo[1] == -2 && hi[0] == 1 && hi[2] == INFINITY);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_crash_costs_an_answer_and_every_later_one)
{
    isolated *i = isolated_bowl(CRASH_IN_EVAL, IMP_OK);
    const imp_surface_type *type = isolate_surface_type(i);
    double p[3] = {0, 0, 0}, x[3];
    imp_rate_matrix rates;
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    ck_assert_int_eq(type->rate(i, &r, &rates), IMP_OK);
    ck_assert_int_eq(type->eval(i, 1, p, x, NULL), SURFACE_CRASHED);
    ck_assert_int_eq(type->rate(i, &r, &rates), SURFACE_CRASHED);
    isolate_destroy(i);
    i = isolated_bowl(EXIT_IN_RATE, IMP_OK);
    ck_assert_int_eq(isolate_surface_type(i)->rate(i, &r, &rates), SURFACE_CRASHED);
    isolate_destroy(i);
    isolate_destroy(isolated_bowl(CRASH_IN_CREATE, SURFACE_CRASHED));
}
END_TEST

START_TEST(a_call_that_never_comes_back_is_ended_in_time)
{
    isolated *i = isolated_bowl(HANG_IN_EVAL, IMP_OK);
    double p[3] = {0, 0, 0}, x[3];
    ck_assert_int_eq(isolate_surface_type(i)->eval(i, 1, p, x, NULL), SURFACE_HUNG);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_changed_floating_point_mode_is_seen_there_too)
{
#if defined(__x86_64__)
    isolated *i = isolated_bowl(TRAP_IN_INCLUDE, IMP_OK);
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    imp_model m[3];
    ck_assert_int_eq(isolate_surface_type(i)->include(i, &r, m), SURFACE_CHANGED_MODE);
    isolate_destroy(i);
#endif
}
END_TEST

START_TEST(complaints_of_create_come_through)
{
    isolated *i = isolate_surface(&fussy);
    imp_complaint why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    ck_assert_int_eq(isolate_create(i, NULL, &why), IMP_PARAMETER);
    ck_assert_int_eq(why.parameter, 0);
    ck_assert_str_eq(why.text, "too red");
    isolate_destroy(i);
}
END_TEST

START_TEST(no_child_is_left_behind)
{
    for (int k = 0; k < 20; ++k) isolate_destroy(isolated_bowl(0, IMP_OK));
    ck_assert_int_eq(waitpid(-1, NULL, WNOHANG), -1);
}
END_TEST

SUITE_MAIN("isolate", answers_from_another_process_are_the_same_bit_for_bit,
           a_crash_costs_an_answer_and_every_later_one,
           a_call_that_never_comes_back_is_ended_in_time,
           a_changed_floating_point_mode_is_seen_there_too, complaints_of_create_come_through,
           no_child_is_left_behind)
