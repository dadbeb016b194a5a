/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdarg.h>
#include <string.h>

#include "plugins/expression/expression.h"
#include "tests/support/expression_oracle.h"
#include "tests/support/judge.h"
#include "tests/support/sampling.h"
#include "tests/support/suite.h"

/* Random formulas, compiled, against the same texts read by expression_oracle.c: points with their
 * errors, models, and rates. */

/* --- Formulas --------------------------------------------------------------------------------- */

#define TEXT_MAX 4000

typedef struct author {
    uint64_t random;
    const char *const *variable;
    unsigned variables;
    char text[TEXT_MAX];
    size_t length;
} author;

static unsigned below(author *a, unsigned n) { return (unsigned)(random_bits(&a->random) % n); }

__attribute__((format(printf, 2, 3))) static void put(author *a, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    a->length += (size_t)vsnprintf(a->text + a->length, TEXT_MAX - a->length, format, arguments);
    va_end(arguments);
    ck_assert_uint_lt(a->length, TEXT_MAX);
}

static void write_leaf(author *a)
{
    static const char *const others[] = {"pi", "e", "k", "2", ".5", "1e-3", "3.25", "7", "1", "10"};
    if (below(a, 3) > 0)
        put(a, "%s", a->variable[below(a, a->variables)]);
    else
        put(a, "%s", others[below(a, 10)]);
}

/* '#' stands for a formula, '~' for one that another '~' repeats. */
static const char *const forms[] = {
    "#+#",
    "#-#",
    "#*#",
    "#*#",
    "-#",
    "(#)",
    "( # + # )",
    "(#)/(2+(#)^2)",
    "#/3",
    "#/pi",
    "(#)^2",
    "(#)^3",
    "(#)^-1",
    "-(#)^2",
    "2*(#)^7",
    "sin(#)",
    "cos(#)",
    "sin(#)*cos(#)",
    "exp(-(#)^2)",
    "atan(#)",
    "tanh(#)",
    "abs(#)",
    "min(#,#)",
    "max(#, #, #)",
    "hypot(#,#)",
    "sqrt(1+(#)^2)",
    "sqrt(abs(#))",
    "cbrt(#)",
    "log(1+(#)^2)",
    "asin(sin(#))",
    "acos(tanh(#))",
    "(2+sin(#))^(#)",
    "(1+abs(#))^1.5",
    "abs(#)^(1/3)",
    "atan2(#,3+sin(#))",
    "sinh(sin(#))",
    "cosh(#/9)",
    "tan(atan(#))",
    "clamp(#,-1,#)",
    "lerp(#,#,#)",
    "copysign((~)*(#),~)",
    "copysign(abs(~)^1.5,~)",
    "sqrt((#)^2+(#)^2)",
    "(~)*(~)",
    "(~)*(~)*(~)",
    "2^(#)",
    "e^-abs(#)",
    "hypot(#,#,#)",
    "#^2*#",
    "log2(3+cos(#))",
    "(#)/(#)",
    "sqrt(#)",
    "log(#)",
    "(#)^0.7",
    "1/(#)",
};

static void write_formula(author *a, int depth);

/* ~: the same text each time; it is drawn once more from the same state. */
static void write_form(author *a, const char *form, int depth)
{
    uint64_t again = 0;
    for (const char *c = form; *c; ++c) {
        if (*c == '#') {
            write_formula(a, depth - 1);
        } else if (*c == '~') {
            uint64_t after = a->random;
            if (again == 0) again = after | 1;
            a->random = again;
            write_formula(a, depth - 1);
            a->random = after * 3 + 1;
        } else {
            put(a, "%c", *c);
        }
    }
}

/* Now and then one of the last forms, which are undefined here and there. */
static void write_formula(author *a, int depth)
{
    const unsigned count = sizeof forms / sizeof forms[0];
    if (depth <= 0 || below(a, 8) == 0)
        write_leaf(a);
    else
        write_form(a, forms[below(a, below(a, 6) ? count - 5 : count)], depth);
}

/* --- Trials ----------------------------------------------------------------------------------- */

enum { TEXTS = 3, FORMULA_REGIONS = 4, FORMULA_POINTS = 4 };

static const char *const surface_variable[] = {"u", "v", "t"};
static const char *const map_variable[] = {"x", "y", "z", "t"};
static const char *const constant_name[] = {"k"};

typedef struct trial {
    char text[TEXTS][TEXT_MAX];
    const char *const *variable;
    unsigned variables;
    double k;
    uint64_t random;
    expression_program *program;
    fault fault;
} trial;

typedef struct tally {
    int refused, points, undefined, models, unbounded;
} tally;

/* False: the formulas are undefined everywhere, or jump. */
static bool trial_begin(trial *t, uint64_t seed, bool map, const imp_model *whole)
{
    const char *text[TEXTS];
    author a = {.random = seed};
    t->variable = a.variable = map ? map_variable : surface_variable;
    t->variables = a.variables = map ? 4 : 3;
    for (int i = 0; i < TEXTS; ++i) {
        a.length = 0;
        write_formula(&a, 1 + (int)below(&a, 4));
        strcpy(t->text[i], a.text);
        text[i] = t->text[i];
    }
    t->k = random_between(&a.random, -2, 2);
    t->random = a.random;
    const expression_scope scope = {t->variable, whole, t->variables, constant_name, &t->k, 1};
    expression_error error;
    imp_status status = expression_compile(&scope, text, &t->program, &error);
    ck_assert_int_ne(status, IMP_STATUS_INTERNAL);
    bool expected =
        status == IMP_STATUS_OK || strstr(error.message, "undefined everywhere") != NULL ||
        strstr(error.message, "copysign") != NULL ||
        strstr(error.message, "division by 0") != NULL ||
        strstr(error.message, "to the power") != NULL || strstr(error.message, "> 0") != NULL ||
        strstr(error.message, "this constant overflows") != NULL;
    ck_assert_msg(expected, "%s\n%s\n%s\n%s", text[0], text[1], text[2], error.message);
    return status == IMP_STATUS_OK;
}

/* Which coordinates are known exactly enough to judge by. */
static bool exact_at(const trial *t, const number *p, number x[3])
{
    const char *name[5];
    number value[5];
    bool known = true;
    for (unsigned k = 0; k < t->variables; ++k) name[k] = t->variable[k], value[k] = p[k];
    name[t->variables] = "k";
    value[t->variables] = num(t->k);
    const oracle_names names = {t->variables + 1, name, value};
    for (int i = 0; i < TEXTS; ++i) {
        x[i] = expression_oracle(t->text[i], &names);
        known = known && num_is_bounded(x[i]);
    }
    return known;
}

static void expect(const trial *t, bool holds, const char *what, const double *p)
{
    ck_assert_msg(holds, "%s: %s\nx = %s\ny = %s\nz = %s\nk = %a, at %a, %a, %a, %a", what,
                  t->fault.text, t->text[0], t->text[1], t->text[2], t->k, p[0], p[1], p[2],
                  t->variables > 3 ? p[3] : 0);
}

static void try_point(trial *t, const double *p, bool known, const number truth[3], tally *sum)
{
    double x[3], error[3];
    imp_status status = expression_point(t->program, p, x, error);
    ck_assert(status == IMP_STATUS_OK || status == IMP_STATUS_DOMAIN);
    ++sum->points;
    sum->undefined += status != IMP_STATUS_OK;
    if (status == IMP_STATUS_OK && known)
        expect(t, judge_point(x, error, truth, &t->fault), "point", p);
}

static void try_rates(trial *t, const imp_model out[3], const double *p, const double *q,
                      const number at_p[3], const number at_q[3])
{
    for (int i = 0; i < 3; ++i)
        expect(t, judge_rates(3, out[i].rate, p, q, at_p[i], at_q[i], &t->fault), "rates", p);
}

static bool is_bounded(const imp_model out[3])
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(out[i].e < INFINITY && out[i].rate[j] < INFINITY)) return false;
    return true;
}

/* --- Surfaces --------------------------------------------------------------------------------- */

static const double domain_lo[] = {-1, -2, -INFINITY}, domain_hi[] = {1, 2, INFINITY};

static void try_region(trial *t, const imp_region *region, tally *sum)
{
    const imp_model in[] = {imp_param(region, 0), imp_param(region, 1), imp_param(region, 2)};
    imp_model out[3];
    expression_models(t->program, in, out);
    ++sum->models;
    sum->unbounded += !is_bounded(out);
    for (int k = 0; k < FORMULA_POINTS; ++k) {
        double p[3], q[3];
        number s[3], at_p[3], at_q[3];
        num_forget();
        sample_point(&t->random, 3, region->lo, region->hi, p);
        sample_partner(&t->random, 3, region->lo, region->hi, p, q);
        const number exact_p[] = {num(p[0]), num(p[1]), num(p[2])};
        const number exact_q[] = {num(q[0]), num(q[1]), num(q[2])};
        bool known = exact_at(t, exact_p, at_p);
        try_point(t, p, known, at_p, sum);
        sample_normalized(region, p, s);
        if (known) expect(t, judge_models(out, s, at_p, &t->fault), "models", p);
        if (known && exact_at(t, exact_q, at_q)) try_rates(t, out, p, q, at_p, at_q);
    }
}

static void try_surface(uint64_t seed, tally *sum)
{
    static trial t;
    const imp_model whole[] = {imp_between(-1, 1), imp_between(-2, 2), imp_unbounded(4)};
    if (!trial_begin(&t, seed, false, whole)) {
        ++sum->refused;
        return;
    }
    for (int k = 0; k < FORMULA_REGIONS; ++k) {
        imp_region region = sample_region(&t.random, domain_lo, domain_hi);
        try_region(&t, &region, sum);
    }
    expression_free(t.program);
}

static void expect_most_are_judged(const tally *sum, int trials)
{
    ck_assert_msg(sum->refused < trials / 4, "%d of %d refused", sum->refused, trials);
    ck_assert_msg(sum->undefined < sum->points / 4, "%d of %d points undefined", sum->undefined,
                  sum->points);
    ck_assert_msg(sum->unbounded < sum->models / 2, "%d of %d models unbounded", sum->unbounded,
                  sum->models);
}

START_TEST(points_models_and_rates_of_random_surfaces_hold)
{
    tally sum = {0};
    const int trials = suite_times(1500);
    for (int k = 0; k < trials; ++k) try_surface(suite_seed() + (uint64_t)k, &sum);
    expect_most_are_judged(&sum, trials);
}
END_TEST

/* --- Maps ------------------------------------------------------------------------------------- */

static void try_arguments(trial *t, const sample_models *models, tally *sum)
{
    imp_model out[3];
    const imp_region *region = &models->region;
    expression_models(t->program, models->in, out);
    ++sum->models;
    sum->unbounded += !is_bounded(out);
    for (int k = 0; k < FORMULA_POINTS; ++k) {
        double p[3], q[3], near_p[4];
        number s[3], in_p[4], in_q[4], at_p[3], at_q[3];
        num_forget();
        sample_point(&t->random, 3, region->lo, region->hi, p);
        sample_partner(&t->random, 3, region->lo, region->hi, p, q);
        sample_value(models, p, in_p);
        sample_value(models, q, in_q);
        sample_normalized(region, p, s);
        bool known = exact_at(t, in_p, at_p);
        if (known) expect(t, judge_models(out, s, at_p, &t->fault), "models", p);
        if (known && exact_at(t, in_q, at_q)) try_rates(t, out, p, q, at_p, at_q);
        number exact[4];
        for (int j = 0; j < 4; ++j) near_p[j] = num_near(in_p[j]), exact[j] = num(near_p[j]);
        known = exact_at(t, exact, at_p);
        try_point(t, near_p, known, at_p, sum);
    }
}

static void try_map(uint64_t seed, tally *sum)
{
    static trial t;
    imp_model whole[4];
    for (int j = 0; j < 4; ++j) whole[j] = imp_unbounded(7);
    if (!trial_begin(&t, seed, true, whole)) {
        ++sum->refused;
        return;
    }
    for (int k = 0; k < FORMULA_REGIONS; ++k) {
        sample_models models = sample_map_arguments(&t.random, -INFINITY, INFINITY);
        try_arguments(&t, &models, sum);
    }
    expression_free(t.program);
}

START_TEST(points_models_and_rates_of_random_maps_hold)
{
    tally sum = {0};
    const int trials = suite_times(1000);
    for (int k = 0; k < trials; ++k) try_map(suite_seed() + 1000000 + (uint64_t)k, &sum);
    expect_most_are_judged(&sum, trials);
}
END_TEST

SUITE_MAIN("expression bounds", points_models_and_rates_of_random_surfaces_hold,
           points_models_and_rates_of_random_maps_hold)
