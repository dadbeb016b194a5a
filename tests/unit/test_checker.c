/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "tests/support/expression_oracle.h"
#include "tests/support/suite.h"
#include "tools/proof/branch.h"
#include "tools/proof/formula.h"

/* The arithmetic by which the checker proves: spans and jets of formulas hold what 200 bits make of
 * the same texts, and branch and bound tells what is true from what is nearly so. */

/* --- Formulas and what they are --------------------------------------------------------------- */

static const char *const names[] = {"u", "v", "t", "a"};
static const double a_value = 0.1;

/* Each function and operator, bent by what is inside of it; defined around [0.25, 1.75]^3. */
static const char *const texts[] = {
    "u+v*t-a",
    "u*v*t",
    "u*u - v/t",
    "(u-v)/(1+t)",
    "-u^2^v",
    "u^3 - v^-2 + (t-1)^5",
    "u^0.5 + v^(1/3) + t^-1.5",
    "u^v",
    "pow(u*v, t)",
    "abs(u-1)*v",
    "sqrt(u*v+t)",
    "sqrt(u^2+v^2)",
    "cbrt(u-1.01) + cbrt(v)",
    "exp(u-v*t)",
    "exp2(u*v) + e^t",
    "log(u*v) + ln(t)",
    "log2(u) * log10(v+t)",
    "sin(3*u + v*t)",
    "cos(2*pi*u) * sin(40*v)",
    "tan(u*v/3)",
    "asin(u/2 - v/4)",
    "acos(u*v/4)",
    "atan(5*(u-v))",
    "atan2(u, v-t)",
    "atan2(u-1, v+t)",
    "sinh(u)*cosh(v)",
    "cosh(u-v)",
    "tanh(3*(u-1))*t",
    "min(u, v, t)",
    "max(u*v, t)",
    "clamp(u, v/2, t+.5)",
    "lerp(u, v, t)",
    "hypot(u-1, v-1)",
    "hypot(u, v, t)",
    "copysign(abs(u)^2, u)",
    "sq(u-v)*sqr(t)*fabs(v-1) + fmin(u,v)*fmax(v,t)",
};
enum { TEXTS = sizeof texts / sizeof *texts };

static formula *made(const char *x, const char *y, const char *z)
{
    char fault[240];
    const formula_scope scope = {"uvt", 1, names + 3, &a_value};
    formula *f = formula_read(&scope, (const char *const[]){x, y, z}, fault, sizeof fault);
    ck_assert_msg(f != NULL, "%s: %s", x, fault);
    return f;
}

static jet jet_over(formula *f, const ld_interval where[3])
{
    jet variables[3], out[3];
    for (int j = 0; j < 3; ++j) variables[j] = jet_variable(3, j, where[j]);
    formula_jets(f, variables, out);
    return out[0];
}

static jet jet_at(formula *f, const double p[3])
{
    const ld_interval where[3] = {ld_interval_of(p[0]), ld_interval_of(p[1]), ld_interval_of(p[2])};
    return jet_over(f, where);
}

static number exact(const char *text, const double p[3])
{
    const number value[] = {num(p[0]), num(p[1]), num(p[2]), num(a_value)};
    const oracle_names known = {4, names, value};
    return expression_oracle(text, &known);
}

/* May the exact number be in the ld_interval? */
static bool holds(ld_interval x, number exact)
{
    return mpfr_cmp_ld(&exact->right, x.lo) >= 0 && mpfr_cmp_ld(&exact->left, x.hi) <= 0;
}

/* --- Boxes ------------------------------------------------------------------------------------ */

/* Draws a box of any size in [0.25, 1.75]^3, now and then with single values. */
static void draw_where(uint64_t *random, ld_interval where[3])
{
    for (int j = 0; j < 3; ++j) {
        const double c = random_between(random, 0.25, 1.75);
        const double d = random_bits(random) % 5 > 0 ? random_power(random, -30, 0) : 0;
        where[j] = ld_interval_make(fmax(0.25, c - d), fmin(1.75, c + d));
    }
}

static void draw_inside(uint64_t *random, const ld_interval where[3], double p[3])
{
    for (int j = 0; j < 3; ++j) {
        const double lo = (double)where[j].lo, hi = (double)where[j].hi;
        p[j] = fmin(fmax(random_between(random, lo, hi), lo), hi);
    }
}

typedef void judge_jet(const char *text, formula *f, const ld_interval where[3], uint64_t *random);

static void for_all_texts(judge_jet *judge, int times)
{
    uint64_t random = suite_seed();
    for (int k = 0; k < TEXTS; ++k) {
        formula *f = made(texts[k], "0", "0");
        for (int n = suite_times(times); n > 0; --n) {
            ld_interval where[3];
            draw_where(&random, where);
            judge(texts[k], f, where, &random);
            num_forget();
        }
        formula_free(f);
    }
}

/* --- Jets ------------------------------------------------------------------------------------- */

static void judge_value(const char *text, formula *f, const ld_interval where[3], uint64_t *random)
{
    double p[3];
    draw_inside(random, where, p);
    const number there = exact(text, p);
    if (!num_is_bounded(there)) return;
    ck_assert_msg(holds(jet_at(f, p).v, there), "%s at %.17g, %.17g, %.17g", text, p[0], p[1],
                  p[2]);
    ck_assert_msg(holds(jet_over(f, where).v, there), "%s around %.17g, %.17g, %.17g", text, p[0],
                  p[1], p[2]);
}

START_TEST(a_jet_holds_the_values_that_its_text_has) { for_all_texts(judge_value, 300); }
END_TEST

static void judge_slope(const char *text, formula *f, const ld_interval where[3], uint64_t *random)
{
    double p[3], q[3];
    draw_inside(random, where, p);
    draw_inside(random, where, q);
    const number rise = num_sub(exact(text, q), exact(text, p));
    if (!num_is_bounded(rise)) return;
    const jet over = jet_over(f, where);
    ld_interval most = ld_interval_of(0);
    for (int j = 0; j < 3; ++j)
        most = ld_interval_add(
            most, ld_interval_mul(over.d[j],
                                  ld_interval_sub(ld_interval_of(q[j]), ld_interval_of(p[j]))));
    ck_assert_msg(holds(most, rise), "%s from %.17g, %.17g, %.17g to %.17g, %.17g, %.17g", text,
                  p[0], p[1], p[2], q[0], q[1], q[2]);
}

START_TEST(a_jet_holds_the_slopes_between_any_two_points) { for_all_texts(judge_slope, 300); }
END_TEST

static void judge_bend(const char *text, formula *f, const ld_interval where[3], uint64_t *random)
{
    double p[3], q[3];
    draw_inside(random, where, p);
    draw_inside(random, where, q);
    const jet over = jet_over(f, where), at_p = jet_at(f, p), at_q = jet_at(f, q);
    for (int j = 0; j < 3; ++j) {
        ld_interval most = at_p.d[j];
        for (int k = 0; k < 3; ++k) {
            const ld_interval bend = j <= k ? over.h[j][k] : over.h[k][j];
            most = ld_interval_add(
                most,
                ld_interval_mul(bend, ld_interval_sub(ld_interval_of(q[k]), ld_interval_of(p[k]))));
        }
        ck_assert_msg(most.lo <= at_q.d[j].hi && most.hi >= at_q.d[j].lo,
                      "%s by %d from %.17g, %.17g, %.17g to %.17g, %.17g, %.17g", text, j, p[0],
                      p[1], p[2], q[0], q[1], q[2]);
    }
}

START_TEST(a_jet_holds_how_its_slopes_change) { for_all_texts(judge_bend, 300); }
END_TEST

START_TEST(where_nothing_bends_a_jet_at_a_point_is_as_good_as_exact)
{
    const double p[3] = {0.7, 1.1, 1.3};
    for (int k = 0; k < TEXTS; ++k) {
        formula *f = made(texts[k], "0", "0");
        const jet g = jet_at(f, p);
        ck_assert_msg(g.v.hi - g.v.lo < 1e-13L, "%s", texts[k]);
        for (int j = 0; j < 3; ++j)
            ck_assert_msg(g.d[j].hi - g.d[j].lo < 1e-12L, "%s by %d", texts[k], j);
        formula_free(f);
    }
}
END_TEST

/* Over the box, from its middle. */
static void judge_best(const char *text, formula *f, const ld_interval where[3], uint64_t *random)
{
    double p[3], q[3];
    ld_interval middle[3], offset[BOX_DIMS] = {{0, 0}};
    for (int j = 0; j < 3; ++j) {
        middle[j] = ld_interval_of(ld_interval_mid(where[j]));
        offset[j] = ld_interval_sub(where[j], middle[j]);
    }
    const jet over = jet_over(f, where), centre = jet_over(f, middle);
    draw_inside(random, where, p);
    draw_inside(random, where, q);
    const number there = exact(text, p);
    if (num_is_bounded(there))
        ck_assert_msg(holds(jet_values(&over, &centre, offset), there), "%s at %.17g, %.17g, %.17g",
                      text, p[0], p[1], p[2]);
    for (int j = 0; j < 3; ++j) {
        const ld_interval all = jet_slopes(&over, &centre, offset, j), at_q = jet_at(f, q).d[j];
        ck_assert_msg(all.lo <= at_q.hi && all.hi >= at_q.lo, "%s by %d at %.17g, %.17g, %.17g",
                      text, j, q[0], q[1], q[2]);
    }
}

START_TEST(values_and_slopes_over_a_box_are_held_by_what_its_middle_tells)
{
    for_all_texts(judge_best, 300);
}
END_TEST

/* --- Reading ---------------------------------------------------------------------------------- */

START_TEST(a_text_that_is_no_formula_is_refused_with_its_place)
{
    static const char *const wrong[] = {
        "",  "u+",   "(u",    "u)",       "u v",   "2u",     "sin", "sin(u,v)",
        "q", "u**v", "1e999", "floor(u)", "u < v", "max(u)", "é",   "hypot(u,v,t,u)"};
    const formula_scope scope = {"uvt", 1, names + 3, &a_value};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        char fault[240];
        const char *const text[3] = {"u", wrong[k], "t"};
        ck_assert_msg(formula_read(&scope, text, fault, sizeof fault) == NULL, "%s", wrong[k]);
        ck_assert_msg(strstr(fault, "character ") != NULL, "%s: %s", wrong[k], fault);
    }
}
END_TEST

START_TEST(a_formula_that_is_too_deep_or_too_long_is_refused)
{
    static char deep[2000], wide[60000];
    const formula_scope scope = {"uvt", 0, NULL, NULL};
    char fault[240];
    memset(deep, '(', 1000);
    ck_assert(formula_read(&scope, (const char *const[]){deep, "u", "v"}, fault, 240) == NULL);
    for (int k = 0; k < 9000; ++k) sprintf(wide + strlen(wide), "%d+", k);
    strcat(wide, "u");
    ck_assert(formula_read(&scope, (const char *const[]){wide, "u", "v"}, fault, 240) == NULL);
}
END_TEST

START_TEST(no_text_harms_the_reader)
{
    static const char *const words[] = {"u",   "v",    "(",   ")",  "+", "-",    "*",  "/",
                                        "^",   ",",    "sin", "1e", ".", "1e99", "pi", "hypot(",
                                        "min", "max(", " ",   "e",  "x", "\xff", "#",  "atan2("};
    uint64_t random = suite_seed();
    for (int k = suite_times(3000); k > 0; --k) {
        char text[400] = "", fault[240];
        const int length = (int)(random_bits(&random) % 30);
        for (int n = 0; n < length; ++n) strcat(text, words[random_bits(&random) % 24]);
        const formula_scope scope = {"uvt", 0, NULL, NULL};
        formula_free(formula_read(&scope, (const char *const[]){text, "u", "v"}, fault, 240));
    }
}
END_TEST

/* --- Waves ------------------------------------------------------------------------------------ */

/* An arc that barely holds an extreme, or ends a little before it. */
START_TEST(an_arc_that_holds_a_top_reaches_it)
{
    uint64_t random = suite_seed();
    for (int k = suite_times(20000); k > 0; --k) {
        const int quarter = (int)(random_bits(&random) % 2001) - 1000;
        const long double top = 1.57079632679489661923132169163975144L * quarter;
        const long double before = random_power(&random, -66, 1),
                          after = random_power(&random, -66, 1);
        const ld_interval arc = ld_interval_make(top - before, top + after);
        const ld_interval waves[2] = {ld_interval_cos(arc), ld_interval_sin(arc)};
        const long double extreme = (quarter / 2) % 2 == 0 ? 1 : -1;
        const ld_interval wave = waves[quarter % 2 != 0];
        const long double sign = quarter % 2 == -1 ? -extreme : extreme;
        const bool inside = arc.lo < top && top < arc.hi;
        if (inside) ck_assert_msg(wave.lo <= sign && wave.hi >= sign, "quarter %d", quarter);
        ck_assert(wave.lo >= -1 && wave.hi <= 1);
    }
}
END_TEST

/* --- Branch and bound ------------------------------------------------------------------------- */

static void formula_field(void *f, const jet p[], const jet s[], jet out[3])
{
    (void)s;
    formula_jets(f, p, out);
}

/* Claims about x over [-1, 1]^3, none yet. */
static branch_claims bound_audit_none(void)
{
    branch_claims c = {.has_models = true};
    for (int j = 0; j < 3; ++j) c.where.lo[j] = -1, c.where.hi[j] = c.d[j] = 1;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < BOX_DIMS; ++j) c.rate[i][j] = INFINITY;
        c.model[i].lo = -INFINITY, c.model[i].hi = c.model[i].e = INFINITY;
    }
    return c;
}

static branch_outcome settled(const char *text, const branch_claims *claims)
{
    formula *f = made(text, "0", "0");
    const branch_field field = {3, formula_field, f};
    const branch_outcome o = branch_settle(&field, claims, 3000);
    formula_free(f);
    return o;
}

/* A rate by u that is just enough is proved, and one that is just too small is refuted. */
static void judge_rate(const char *text, double greatest)
{
    branch_claims c = bound_audit_none();
    c.rate[0][0] = greatest * (1 + 1e-13);
    const branch_outcome enough = settled(text, &c);
    ck_assert_msg(enough.claims == 1 && enough.proved == 1, "%s is not proved", text);
    c.rate[0][0] = greatest * (1 - 1e-6);
    const branch_outcome small = settled(text, &c);
    ck_assert_msg(small.refuted && small.kind == BRANCH_RATE && small.i == 0 && small.j == 0,
                  "%s is not refuted", text);
}

START_TEST(the_exact_rate_is_proved_and_less_than_it_refuted)
{
    judge_rate("u", 1);
    judge_rate("u^3-u", 2);                       /* at ends */
    judge_rate("sin(2*u)", 2);                    /* inside */
    judge_rate("u*v*t", 1);                       /* at corners */
    judge_rate("u*sin(2*v)", 1);                  /* on a line */
    judge_rate("exp(-u^2)", sqrt(2) * exp(-0.5)); /* where it bends away */
    judge_rate("abs(u-.3)", 1);                   /* at a kink */
    judge_rate("(1+u^2)*(1-v^2)", 2);
}
END_TEST

static void judge_range(const char *text, double lo, double hi)
{
    branch_claims c = bound_audit_none();
    c.model[0].lo = lo - 1e-13, c.model[0].hi = hi + 1e-13;
    const branch_outcome enough = settled(text, &c);
    ck_assert_msg(enough.claims == 1 && enough.proved == 1, "%s is not proved", text);
    c.model[0].lo = lo + 1e-6;
    ck_assert_msg(settled(text, &c).refuted, "%s is not refuted below", text);
    c.model[0].lo = lo - 1, c.model[0].hi = hi - 1e-6;
    ck_assert_msg(settled(text, &c).refuted, "%s is not refuted above", text);
}

START_TEST(the_exact_range_is_proved_and_less_than_it_refuted)
{
    judge_range("u", -1, 1);
    judge_range("u^3-u", -2 / (3 * sqrt(3)), 2 / (3 * sqrt(3)));
    judge_range("u*v-t", -2, 2);
    judge_range("cos(3*u)*cos(2*v)", cos(3), 1);
    judge_range("max(u,v)", -1, 1);
}
END_TEST

/* Chebyshev: s^3 is within 1/4 of 3/4 s, and no line is closer. */
START_TEST(a_remainder_that_is_attained_six_times_is_proved)
{
    branch_claims c = bound_audit_none();
    c.model[0].b[0] = 0.75;
    c.model[0].e = 0.25 * (1 + 1e-13);
    ck_assert_int_eq(settled("u^3", &c).proved, 1);
    c.model[0].e = 0.25 * (1 - 1e-6);
    const branch_outcome o = settled("u^3", &c);
    ck_assert(o.refuted && o.kind == BRANCH_REMAINDER);
}
END_TEST

START_TEST(a_model_that_is_exact_is_proved_without_any_slack)
{
    branch_claims c = bound_audit_none();
    for (int j = 0; j < 3; ++j) { /* p = c + d s */
        c.c[j] = 0.1, c.d[j] = 0.3;
        c.where.lo[j] = -0.2, c.where.hi[j] = 0.4;
    }
    c.model[0] = (imp_model){.a = 0.1, .b = {0.3}, .e = 0, .lo = -0.2, .hi = 0.4};
    c.rate[0][0] = 1;
    c.rate[0][1] = c.rate[0][2] = 0;
    ck_assert_int_eq(settled("u", &c).proved, 5);
    c.rate[0][0] = 1 - 0x1p-53;
    ck_assert(settled("u", &c).refuted);
}
END_TEST

START_TEST(what_takes_more_than_the_budget_is_neither_proved_nor_refuted)
{
    branch_claims c = bound_audit_none();
    c.rate[0][0] = 3;
    const branch_outcome o = settled("sqrt(1+u)", &c);
    ck_assert(!o.refuted || o.there.lo > 3 || o.there.hi < -3);
    c.rate[0][0] = 1 + 1e-15, c.where.lo[0] = -0.75;
    c.rate[0][1] = 0;
    const branch_outcome half = settled("sqrt(1+u)", &c);
    ck_assert(half.proved == 2 && !half.refuted);
}
END_TEST

SUITE_MAIN("checker", a_jet_holds_the_values_that_its_text_has,
           a_jet_holds_the_slopes_between_any_two_points, a_jet_holds_how_its_slopes_change,
           where_nothing_bends_a_jet_at_a_point_is_as_good_as_exact,
           values_and_slopes_over_a_box_are_held_by_what_its_middle_tells,
           a_text_that_is_no_formula_is_refused_with_its_place, no_text_harms_the_reader,
           an_arc_that_holds_a_top_reaches_it, a_formula_that_is_too_deep_or_too_long_is_refused,
           the_exact_rate_is_proved_and_less_than_it_refuted,
           the_exact_range_is_proved_and_less_than_it_refuted,
           a_remainder_that_is_attained_six_times_is_proved,
           a_model_that_is_exact_is_proved_without_any_slack,
           what_takes_more_than_the_budget_is_neither_proved_nor_refuted)
