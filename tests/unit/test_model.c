/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

/* Each operation alone, on operands that are as hostile as a model may be: at every point the
 * operand takes whatever value its quadratic, remainder and range allow, and the result must cover
 * what the operation makes of it. */

#include "tests/support/oracle.h"
#include "tests/support/suite.h"

/* --- Hostile operands ------------------------------------------------------------------------- */

/* Where operands lie: around kinks, poles, ends of domains, extrema; far out, deep down. */
static double hostile_centre(uint64_t *state)
{
    static const double special[] = {0, 1, -1, 0.5, 1e8, -1e8, 700, -700, 1e-300, 1e300};
    switch (oracle_below(state, 8)) {
    case 0:
        return special[oracle_below(state, 10)];
    case 1:
        return 1.5707963267948966 * (double)((int)oracle_below(state, 21) - 10);
    case 2:
        return oracle_magnitude(state, -1070, 1010);
    case 3:
        return 1.5707963267948966 * (double)oracle_below(state, 1u << 30);
    default:
        return oracle_magnitude(state, -8, 4);
    }
}

static double hostile_width(uint64_t *state, double centre)
{
    switch (oracle_below(state, 8)) {
    case 0:
        return 0;
    case 1:
        return fabs(centre) * 0x1p-52;
    case 2:
        return random_power(state, -1070, 3);
    case 3:
        return random_power(state, 3, 14);
    case 4:
        return random_power(state, 0, 1010);
    case 5:
        return fabs(centre) * random_power(state, -45, 1);
    default:
        return random_power(state, -30, 3);
    }
}

static double hostile_error(uint64_t *state, double centre, double width)
{
    switch (oracle_below(state, 5)) {
    case 0:
        return 0;
    case 1:
        return fabs(centre) * 0x1p-52;
    case 2:
        return fabs(centre) * random_power(state, -52, -28);
    default:
        return width * random_power(state, -50, 0);
    }
}

/* Cuts the range: at an end of some function's domain, or anywhere. */
static void trim(uint64_t *state, imp_model *m)
{
    static const double edge[] = {0, 0, 1, -1};
    double cut =
        oracle_below(state, 2) ? edge[oracle_below(state, 4)] : random_between(state, m->lo, m->hi);
    if (cut > m->lo && cut < m->hi) {
        if (oracle_below(state, 3))
            m->lo = cut;
        else
            m->hi = cut;
    }
}

/* Draws a model. Linear terms may be small, so that those of second order show, and an end instead
 * of the middle may be at the special place. */
static imp_model hostile_model(uint64_t *state)
{
    static const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
    imp_model m = imp_num(hostile_centre(state));
    double width = hostile_width(state, m.a);
    double linear = oracle_below(state, 3) ? width : width * random_power(state, -60, 0);
    double square = oracle_below(state, 3) ? width * random_power(state, -20, 0) : width;
    if (oracle_below(state, 4) == 0) m.a += oracle_below(state, 2) ? width : -width;
    m.depends = oracle_below(state, 2) ? 7 : oracle_below(state, 8);
    m.e = hostile_error(state, m.a, width);
    for (int j = 0; j < 3; j++) {
        if (m.depends >> j & 1 && oracle_below(state, 4))
            m.b[j] = linear * random_between(state, -1, 1);
        if (m.depends >> j & 1) m.rate[j] = fabs(oracle_magnitude(state, -20, 20));
    }
    for (int k = 0; k < 6; k++)
        if (m.depends >> row[k] & m.depends >> column[k] & 1 && oracle_below(state, 2))
            m.q[k] = square * random_between(state, -1, 1);
    imp_interval range = imp_model_poly_range(&m);
    m.lo = range.lo;
    m.hi = range.hi;
    if (!m.depends && m.e == 0) m.lo = m.hi = m.a;
    if (oracle_below(state, 2)) trim(state, &m);
    return m;
}

/* The values that m allows at s; false if there are none. */
static bool hostile_window(mpfi_ptr window, const imp_model *m, const mpfi_t *s)
{
    oracle_quadratic(window, m, s);
    mpfr_sub_d(&window->right, &window->right, m->e, MPFR_RNDU);
    mpfr_add_d(&window->left, &window->left, m->e, MPFR_RNDD);
    mpfr_swap(&window->left, &window->right);
    if (mpfr_cmp_d(&window->left, m->lo) < 0) mpfr_set_d(&window->left, m->lo, MPFR_RNDU);
    if (mpfr_cmp_d(&window->right, m->hi) > 0) mpfr_set_d(&window->right, m->hi, MPFR_RNDD);
    return mpfr_cmp(&window->left, &window->right) <= 0;
}

/* One of them, as an interval of one number: the least, the greatest or the middle. */
static void hostile_value(uint64_t *state, mpfi_ptr value, const mpfi_t window)
{
    mpfi_set(value, window);
    switch (oracle_below(state, 3)) {
    case 0:
        mpfr_set(&value->right, &value->left, MPFR_RNDN);
        break;
    case 1:
        mpfr_set(&value->left, &value->right, MPFR_RNDN);
        break;
    default:
        mpfi_mid(&value->left, window);
        mpfr_set(&value->right, &value->left, MPFR_RNDN);
    }
}

/* --- One trial -------------------------------------------------------------------------------- */

typedef struct trial {
    const operation *op;
    uint64_t seed;
    uint64_t state;
    imp_model x, y, r;
    double k;
    mpfi_t s[3], xs, ys, p, q, value, value2, step; /* xs, ys: what x, y allow at s */
} trial;

static void trial_begin(trial *t, const operation *op, uint64_t seed)
{
    t->op = op;
    t->seed = seed;
    t->state = seed;
    t->x = hostile_model(&t->state);
    t->y = op->arity > 1 ? hostile_model(&t->state) : imp_num(0);
    t->k = operation_constant(op, &t->state);
    t->r = op->model(t->x, t->y, t->k);
    mpfi_ptr all[] = {t->s[0], t->s[1], t->s[2],  t->xs,     t->ys,
                      t->p,    t->q,    t->value, t->value2, t->step};
    for (int i = 0; i < 10; i++) mpfi_init2(all[i], ORACLE_BITS);
}

static void trial_end(trial *t)
{
    mpfi_ptr all[] = {t->s[0], t->s[1], t->s[2],  t->xs,     t->ys,
                      t->p,    t->q,    t->value, t->value2, t->step};
    for (int i = 0; i < 10; i++) mpfi_clear(all[i]);
}

#define ck_trial(T, CLAIM, WHAT)                                                                   \
    ck_assert_msg(CLAIM, "%s: %s, seed %#llx\n x %s\n y %s\n k %a\n r %s", (T)->op->name, WHAT,    \
                  (unsigned long long)(T)->seed, model_text(&(T)->x), model_text(&(T)->y), (T)->k, \
                  model_text(&(T)->r))

/* Values p, q of the operands at some place s, and op's there; false if there are none. */
static bool trial_take(trial *t)
{
    double s[3];
    oracle_place(&t->state, s);
    for (int j = 0; j < 3; j++) mpfi_set_d(t->s[j], s[j]);
    if (!hostile_window(t->xs, &t->x, t->s) || !hostile_window(t->ys, &t->y, t->s)) return false;
    hostile_value(&t->state, t->p, t->xs);
    hostile_value(&t->state, t->q, t->ys);
    return t->op->exact(t->value, t->p, t->q, t->k);
}

static void trial_sample(trial *t)
{
    if (!trial_take(t)) return;
    ck_trial(t, !quadratic_is_refuted(&t->r, t->s, t->value), "quadratic misses a value");
    ck_trial(t, !range_is_refuted(t->r.lo, t->r.hi, t->value), "range misses a value");
}

/* Two operands have more ways to be hostile. */
static int usual_times(const operation *op) { return suite_times(op->arity > 1 ? 4000 : 2000); }

static void every_value_is_covered(const operation *op)
{
    for (int i = 0; i < usual_times(op); i++) {
        trial t;
        trial_begin(&t, op, oracle_seed(i));
        ck_trial(&t, model_is_well_formed(&t.r), "malformed model");
        ck_trial(&t, (t.r.depends & ~(t.x.depends | t.y.depends)) == 0, "depends out of nothing");
        for (int k = 0; k < 10; k++) trial_sample(&t);
        trial_end(&t);
    }
}

START_TEST(every_value_that_the_operands_allow_is_covered)
{
    for (int i = 0; i < operation_count; i++) every_value_is_covered(&operations[i]);
}
END_TEST

/* --- The range of a quadratic ----------------------------------------------------------------- */

/* The cubics that replace cosine and sine, against long doubles; from a part of a degree on, their
 * errors are hardly more than needed. */
START_TEST(waves_are_within_their_error_and_reach_it)
{
    uint64_t state = suite_seed() + 9;
    for (int k = 0; k < suite_times(2000); ++k) {
        const double r = IMP_WAVE_FARTHEST_ * ldexp(random_between(&state, 0.5, 1), -k % 24);
        const imp_wave_series_ w = imp_wave_around_(r);
        long double even = 0, odd = 0;
        for (int j = -64; j <= 64; ++j) {
            const long double y = (long double)r * j / 64;
            const long double c = fabsl(cosl(y) - w.even[0] - w.even[1] * y * y);
            const long double s = fabsl(sinl(y) - w.odd[0] * y - w.odd[1] * y * y * y);
            even = c > even ? c : even;
            odd = s > odd ? s : odd;
        }
        ck_assert_msg(even <= w.even[2] && odd <= w.odd[2], "r = %g: %Lg of %g, %Lg of %g", r, even,
                      w.even[2], odd, w.odd[2]);
        if (r > 0.01) ck_assert(even > 0.9L * w.even[2] && odd > 0.9L * w.odd[2]);
    }
}
END_TEST

START_TEST(the_range_of_a_quadratic_covers_it)
{
    for (int i = 0; i < suite_times(20000); i++) {
        trial t;
        trial_begin(&t, &operations[0], oracle_seed(i));
        t.x.lo = -INFINITY;
        t.x.hi = INFINITY;
        t.r = imp_model_finish(t.x);
        ck_trial(&t, model_is_well_formed(&t.r), "malformed model");
        for (int k = 0; k < 4; k++)
            if (trial_take(&t))
                ck_trial(&t, !range_is_refuted(t.r.lo, t.r.hi, t.p), "range misses a value");
        trial_end(&t);
    }
}
END_TEST

/* --- Rates ------------------------------------------------------------------------------------ */

/* p becomes p + rate step, or p - rate step; false if that is not allowed. */
static bool move(uint64_t *state, mpfi_ptr p, const mpfi_t window, double rate, mpfi_srcptr step)
{
    mpfi_t change;
    mpfi_init2(change, ORACLE_BITS);
    mpfi_mul_d(change, step, random_bits(state) & 1 ? rate : -rate);
    mpfi_add(p, p, change);
    mpfi_clear(change);
    return mpfi_is_inside(p, window);
}

/* Operands that change as fast as their rates allow while p_j changes by `step`. */
static void trial_change(trial *t)
{
    int j = (int)oracle_below(&t->state, 3);
    mpfi_set_d(t->step, random_power(&t->state, -140, -10));
    if (!trial_take(t) || !move(&t->state, t->p, t->xs, t->x.rate[j], t->step) ||
        !move(&t->state, t->q, t->ys, t->y.rate[j], t->step))
        return;
    if (!t->op->exact(t->value2, t->p, t->q, t->k)) return;
    mpfi_sub(t->value, t->value, t->value2);
    mpfi_abs(t->value, t->value);
    if (t->r.rate[j] < INFINITY) mpfi_mul_d(t->step, t->step, t->r.rate[j]);
    ck_trial(t, t->r.rate[j] == INFINITY || mpfr_cmp(&t->value->left, &t->step->right) <= 0,
             "changes faster than its rate");
}

static void rates_hold(const operation *op)
{
    for (int i = 0; i < suite_times(1000); i++) {
        trial t;
        trial_begin(&t, op, oracle_seed(i));
        for (int k = 0; k < 10; k++) trial_change(&t);
        trial_end(&t);
    }
}

START_TEST(rates_hold_for_operands_that_change_as_fast_as_theirs_allow)
{
    for (int i = 0; i < operation_count; i++) rates_hold(&operations[i]);
}
END_TEST

/* --- What cannot be bounded ------------------------------------------------------------------- */

/* Ranges open on one side or both, at the limits of double, overflowing quadratics. */
static imp_model boundless_model(uint64_t *state)
{
    static const double ends[] = {-INFINITY, -1.7e308, -1, 0, 5e-324, 1, 1.7e308, INFINITY};
    imp_model m = hostile_model(state);
    unsigned i = oracle_below(state, 7), j = i + 1 + oracle_below(state, 7 - i);
    if (i + 1 == 8 || oracle_below(state, 4) == 0) return m;
    m.lo = ends[i];
    m.hi = ends[j];
    m.e = oracle_below(state, 2) ? INFINITY : 1e300;
    if (oracle_below(state, 2)) m.a = oracle_magnitude(state, 1000, 1023.9);
    for (int k = 0; k < 3; k++)
        if (m.depends >> k & 1 && oracle_below(state, 2))
            m.rate[k] = oracle_below(state, 2) ? INFINITY : 1.7e308;
    return m;
}

static void no_nan_comes_of(const operation *op)
{
    for (int i = 0; i < suite_times(2000); i++) {
        trial t;
        trial_begin(&t, op, oracle_seed(i));
        t.state = t.seed;
        t.x = boundless_model(&t.state);
        t.y = boundless_model(&t.state);
        t.r = t.op->model(t.x, t.y, t.k);
        ck_trial(&t, model_is_well_formed(&t.r), "malformed model");
        trial_end(&t);
    }
}

START_TEST(no_answer_holds_a_nan)
{
    for (int i = 0; i < operation_count; i++) no_nan_comes_of(&operations[i]);
}
END_TEST

/* --- What overflows --------------------------------------------------------------------------- */

/* u over [x, x + width], or the number x. */
static imp_model steep_argument(double x, double width)
{
    if (width == 0) return imp_num(x);
    const imp_region region = {.c = {x + width / 2, 0, 0},
                               .d = {width / 2, 0, 0},
                               .lo = {x, 0, 0},
                               .hi = {x + width, 0, 0}};
    return imp_param(&region, 0);
}

/* lo is at most what `exact` gives at x, and says that it is huge. */
static void ck_huge(double lo, int (*exact)(mpfi_ptr, mpfi_srcptr), double x, double least)
{
    mpfi_t value;
    mpfi_init2(value, ORACLE_BITS);
    mpfi_set_d(value, x);
    exact(value, value);
    ck_assert_msg(mpfr_cmp_d(&value->left, lo) >= 0, "%a exceeds the value at %.17g", lo, x);
    ck_assert_msg(lo > least, "%a at %.17g", lo, x);
    mpfi_clear(value);
}

START_TEST(what_overflows_is_known_to_be_large_and_its_inverse_to_be_small)
{
    for (int i = 0; i < suite_times(2000); i++) {
        uint64_t state = oracle_seed(i);
        const double x = 709 + random_power(&state, -40, 40);
        const double width = random_bits(&state) & 1 ? 0 : 0x1p-10 * x;
        const imp_model m = steep_argument(x, width), e = imp_exp(m), c = imp_cosh(m);
        ck_huge(e.lo, mpfi_exp, x, 8e307);
        ck_huge(c.lo, mpfi_cosh, x, 4e307);
        ck_huge(imp_sinh(m).lo, mpfi_sinh, x, 4e307);
        ck_assert(imp_sinh(imp_neg(m)).hi < -4e307);
        const imp_model step = imp_div(imp_num(1), imp_shift(e, 1));
        ck_assert(-1e-301 < step.lo && step.hi < 1e-301 && step.e < 1e-301);
        const imp_model bump = imp_div(imp_num(1), c);
        ck_assert(-1e-301 < bump.lo && bump.hi < 1e-301 && bump.e < 1e-301);
    }
}
END_TEST

/* 2^-1074 over y = 1e-150 (1 + 1e-10 s): the product of quotient and error, or rate, underflows,
 * but divided by y it counts. */
START_TEST(errors_and_rates_that_underflow_before_they_are_divided_are_kept)
{
    const imp_model least = imp_num(0x1p-1074), point = imp_known(1e-150, 1e-160);
    const imp_model at = imp_div(least, point);
    ck_assert(at.e >= 0x1p-1074 / 1e-150 * 1e-10);
    imp_region region = {.lo = {-1, -1, -1}, .hi = {1, 1, 1}, .d = {1, 1, 1}};
    imp_model y = imp_param(&region, 0);
    y = imp_add(imp_num(1e-150), imp_mul(imp_num(1e-160), y));
    const imp_model over = imp_div(least, y);
    ck_assert(over.rate[0] >= 0x1p-1074 / 1e-150 * 1e-10);
}
END_TEST

/* --- Intervals -------------------------------------------------------------------------------- */

/* Somewhere in [lo, hi], the ends above all. */
static double hostile_point(uint64_t *state, double lo, double hi)
{
    unsigned kind = oracle_below(state, 4);
    double x = kind == 0 ? lo : kind == 1 ? hi : random_between(state, lo, hi);
    return x < lo ? lo : x > hi ? hi : x;
}

static void interval_covers(const operation *op)
{
    for (int i = 0; i < suite_times(1000); i++) {
        trial t;
        trial_begin(&t, op, oracle_seed(i));
        imp_interval x = imp_interval_make(t.x.lo, t.x.hi), y = imp_interval_make(t.y.lo, t.y.hi);
        imp_interval r = op->interval(x, y, t.k);
        ck_trial(&t, r.lo <= r.hi, "malformed interval");
        for (int k = 0; k < 10; k++) {
            mpfi_set_d(t.p, hostile_point(&t.state, x.lo, x.hi));
            mpfi_set_d(t.q, hostile_point(&t.state, y.lo, y.hi));
            if (op->exact(t.value, t.p, t.q, t.k))
                ck_trial(&t, !range_is_refuted(r.lo, r.hi, t.value), "interval misses a value");
        }
        trial_end(&t);
    }
}

START_TEST(intervals_cover_every_value)
{
    for (int i = 0; i < operation_count; i++)
        if (operations[i].interval != NULL) interval_covers(&operations[i]);
}
END_TEST

SUITE_MAIN("model", every_value_that_the_operands_allow_is_covered,
           waves_are_within_their_error_and_reach_it,
           rates_hold_for_operands_that_change_as_fast_as_theirs_allow, no_answer_holds_a_nan,
           the_range_of_a_quadratic_covers_it,
           what_overflows_is_known_to_be_large_and_its_inverse_to_be_small,
           errors_and_rates_that_underflow_before_they_are_divided_are_kept,
           intervals_cover_every_value)
