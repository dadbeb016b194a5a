/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

/* Formulas: random compositions of all operations against their exact values, then what the
 * macros of <impinge/formula.h> make of known ones. */

#include <errno.h>
#include <string.h>

#include <impinge/formula.h>

#include "tests/support/oracle.h"
#include "tests/support/suite.h"

/* --- Random formulas -------------------------------------------------------------------------- */

enum { NODES_MAX = 64, PARAMETER = -1, NUMBER = -2, SOME_NUMBER = -3, PI = -4 };

/* A tree in an array: children stand before their parents, the root is last. */
typedef struct tree {
    struct {
        int op; /* index into operations, or one of the above */
        int x, y;
        double k, lo, hi; /* SOME_NUMBER: k in [lo, hi], of which the model knows only that */
    } node[NODES_MAX];
    int count;
} tree;

static int grow_leaf(tree *t, uint64_t *state)
{
    static const int kinds[] = {PARAMETER, PARAMETER, PARAMETER, NUMBER, SOME_NUMBER, PI};
    int i = t->count++;
    t->node[i].op = kinds[oracle_below(state, 6)];
    t->node[i].x = (int)oracle_below(state, 3);
    t->node[i].k = t->node[i].lo = t->node[i].hi = oracle_magnitude(state, -3, 3);
    if (t->node[i].op == SOME_NUMBER) {
        t->node[i].lo -= random_power(state, -50, -1);
        t->node[i].hi += random_power(state, -50, -1);
    }
    return i;
}

/* Half of the nodes are sums and products, as in real formulas. */
static int pick_operation(uint64_t *state)
{
    static const char *const plain[] = {"add", "sub", "mul", "sqr", "scale", "shift"};
    const char *name = plain[oracle_below(state, 6)];
    if (oracle_below(state, 2)) return (int)oracle_below(state, (unsigned)operation_count);
    int op = 0;
    while (strcmp(operations[op].name, name) != 0) op++;
    return op;
}

static int grow(tree *t, uint64_t *state, int depth)
{
    if (depth == 0 || oracle_below(state, 8) == 0) return grow_leaf(t, state);
    int op = pick_operation(state), x = grow(t, state, depth - 1);
    int y = operations[op].arity > 1 ? grow(t, state, depth - 1) : x;
    int i = t->count++;
    t->node[i].op = op;
    t->node[i].x = x;
    t->node[i].y = y;
    t->node[i].k = operation_constant(&operations[op], state);
    return i;
}

static imp_model tree_model(const tree *t, const imp_model p[3])
{
    imp_model value[NODES_MAX];
    for (int i = 0; i < t->count; i++) {
        int op = t->node[i].op;
        value[i] = op == PARAMETER     ? p[t->node[i].x]
                   : op == NUMBER      ? imp_num(t->node[i].k)
                   : op == SOME_NUMBER ? imp_between(t->node[i].lo, t->node[i].hi)
                   : op == PI          ? imp_const_pi()
                              : operations[op].model(value[t->node[i].x], value[t->node[i].y],
                                                     t->node[i].k);
        ck_assert_msg(model_is_well_formed(&value[i]), "%s", model_text(&value[i]));
    }
    return value[t->count - 1];
}

/* Numbers beyond double's range make the oracle slow and the model unbounded. */
static bool is_moderate(mpfi_srcptr x)
{
    return !mpfi_nan_p(x) && mpfi_bounded_p(x) &&
           (mpfr_zero_p(&x->left) || labs(mpfr_get_exp(&x->left)) < 2000) &&
           (mpfr_zero_p(&x->right) || labs(mpfr_get_exp(&x->right)) < 2000);
}

/* The number or parameter of a leaf; or an operation's value, false where there is none. */
static bool node_exact(const tree *t, int i, const mpfi_t p[3], mpfi_t value[])
{
    int op = t->node[i].op, x = t->node[i].x, y = t->node[i].y;
    if (op >= 0) return operations[op].exact(value[i], value[x], value[y], t->node[i].k);
    if (op == PARAMETER)
        mpfi_set(value[i], p[x]);
    else if (op == PI)
        mpfi_const_pi(value[i]);
    else
        mpfi_set_d(value[i], t->node[i].k);
    return true;
}

static bool tree_exact(const tree *t, mpfi_ptr result, const mpfi_t p[3])
{
    mpfi_t value[NODES_MAX];
    bool defined = true;
    for (int i = 0; i < t->count; i++) {
        mpfi_init2(value[i], ORACLE_BITS);
        defined = defined && node_exact(t, i, p, value) && is_moderate(value[i]);
    }
    mpfi_set(result, value[t->count - 1]);
    for (int i = 0; i < t->count; i++) mpfi_clear(value[i]);
    return defined;
}

static void tree_print(const tree *t)
{
    for (int i = 0; i < t->count; i++) {
        int op = t->node[i].op;
        printf("  %2d %s %d %d %a in [%a, %a]\n", i,
               op == PARAMETER     ? "parameter"
               : op == NUMBER      ? "number"
               : op == SOME_NUMBER ? "some number"
               : op == PI          ? "pi"
                                   : operations[op].name,
               t->node[i].x, t->node[i].y, t->node[i].k, t->node[i].lo, t->node[i].hi);
    }
}

/* --- Random regions and their points ---------------------------------------------------------- */

static imp_region random_region(uint64_t *state)
{
    double lo[3], hi[3];
    for (int j = 0; j < 3; j++) {
        double far = oracle_below(state, 6) == 0 ? 1e8 : 0;
        double centre = oracle_below(state, 4) ? oracle_magnitude(state, -3, 3) : 0;
        double width = oracle_below(state, 6) ? random_power(state, -30, 2) : 0;
        lo[j] = far + centre - width * random_between(state, 0, 1);
        hi[j] = far + centre + width;
        if (oracle_below(state, 8) == 0) hi[j] = nextafter(lo[j], INFINITY);
    }
    return imp_region_between(lo, hi);
}

/* A real point of the region, seldom of doubles: lo + (hi - lo) w. */
static void random_point(uint64_t *state, const imp_region *region, mpfi_t p[3])
{
    double w[3];
    oracle_place(state, w);
    for (int j = 0; j < 3; j++) {
        mpfr_ptr at = &p[j]->left;
        mpfr_set_d(at, region->hi[j], MPFR_RNDN);
        mpfr_sub_d(at, at, region->lo[j], MPFR_RNDN);
        mpfr_mul_d(at, at, w[j] == 1 ? 1 : (w[j] + 1) / 2, MPFR_RNDN);
        mpfr_add_d(at, at, region->lo[j], MPFR_RNDN);
        if (mpfr_cmp_d(at, region->hi[j]) > 0) mpfr_set_d(at, region->hi[j], MPFR_RNDN);
        mpfr_set(&p[j]->right, at, MPFR_RNDN);
    }
}

/* s = (p - c) / d, or 0 where d is 0. */
static void place_in_region(const imp_region *region, const mpfi_t p[3], mpfi_t s[3])
{
    for (int j = 0; j < 3; j++) {
        mpfi_sub_d(s[j], p[j], region->c[j]);
        if (region->d[j] > 0)
            mpfi_div_d(s[j], s[j], region->d[j]);
        else
            mpfi_set_si(s[j], 0);
    }
}

/* --- One trial -------------------------------------------------------------------------------- */

typedef struct trial {
    uint64_t seed, state;
    tree t;
    imp_region region;
    imp_model m;
    mpfi_t p[3], q[3], s[3], value, value2;
} trial;

static void trial_numbers(trial *t, void (*act)(mpfi_ptr))
{
    mpfi_ptr all[] = {t->p[0], t->p[1], t->p[2], t->q[0],  t->q[1],  t->q[2],
                      t->s[0], t->s[1], t->s[2], t->value, t->value2};
    for (int i = 0; i < 11; i++) act(all[i]);
}

static void number_make(mpfi_ptr x) { mpfi_init2(x, ORACLE_BITS); }

static void number_free(mpfi_ptr x) { mpfi_clear(x); }

static void trial_begin(trial *t, uint64_t seed)
{
    t->seed = t->state = seed;
    t->t.count = 0;
    grow(&t->t, &t->state, 1 + (int)oracle_below(&t->state, 5));
    t->region = random_region(&t->state);
    trial_numbers(t, number_make);
}

static void trial_end(trial *t) { trial_numbers(t, number_free); }

static void ck_trial(const trial *t, bool claim, const char *what)
{
    if (claim) return;
    tree_print(&t->t);
    ck_abort_msg("%s, seed %#llx\n region %a %a  %a %a  %a %a\n %s", what,
                 (unsigned long long)t->seed, t->region.lo[0], t->region.hi[0], t->region.lo[1],
                 t->region.hi[1], t->region.lo[2], t->region.hi[2], model_text(&t->m));
}

static void trial_sample(trial *t)
{
    random_point(&t->state, &t->region, t->p);
    place_in_region(&t->region, t->p, t->s);
    if (!tree_exact(&t->t, t->value, t->p)) return;
    ck_trial(t, !quadratic_is_refuted(&t->m, t->s, t->value), "quadratic misses a value");
    ck_trial(t, !range_is_refuted(t->m.lo, t->m.hi, t->value), "range misses a value");
}

START_TEST(random_formulas_are_covered_and_leave_errno_alone)
{
    int before = errno;
    for (int i = 0; i < suite_times(8000); i++) {
        trial t;
        trial_begin(&t, oracle_seed(i));
        const imp_model p[3] = {imp_param(&t.region, 0), imp_param(&t.region, 1),
                                imp_param(&t.region, 2)};
        errno = 12345;
        t.m = tree_model(&t.t, p);
        ck_trial(&t, errno == 12345, "errno was set");
        for (int k = 0; k < 8; k++) trial_sample(&t);
        trial_end(&t);
    }
    errno = before;
}
END_TEST

/* |g(p) - g(q)| <= sum rate_j |p_j - q_j|, for neighbours or across the region. */
static void trial_change(trial *t)
{
    random_point(&t->state, &t->region, t->p);
    random_point(&t->state, &t->region, t->q);
    if (!tree_exact(&t->t, t->value, t->p) || !tree_exact(&t->t, t->value2, t->q)) return;
    mpfi_sub(t->value, t->value, t->value2);
    mpfi_abs(t->value, t->value);
    mpfi_set_si(t->value2, 0);
    for (int j = 0; j < 3; j++) {
        mpfi_sub(t->s[j], t->p[j], t->q[j]);
        mpfi_abs(t->s[j], t->s[j]);
        if (mpfi_is_zero(t->s[j])) continue;
        if (t->m.rate[j] == INFINITY) return;
        mpfi_mul_d(t->s[j], t->s[j], t->m.rate[j]);
        mpfi_add(t->value2, t->value2, t->s[j]);
    }
    ck_trial(t, mpfr_cmp(&t->value->left, &t->value2->right) <= 0, "changes faster than its rate");
}

START_TEST(random_formulas_change_no_faster_than_their_rates)
{
    for (int i = 0; i < suite_times(8000); i++) {
        trial t;
        trial_begin(&t, oracle_seed(i));
        const imp_model p[3] = {imp_param(&t.region, 0), imp_param(&t.region, 1),
                                imp_param(&t.region, 2)};
        t.m = tree_model(&t.t, p);
        for (int k = 0; k < 8; k++) trial_change(&t);
        trial_end(&t);
    }
}
END_TEST

START_TEST(a_point_is_within_its_error)
{
    for (int i = 0; i < suite_times(8000); i++) {
        trial t;
        imp_model p[3];
        trial_begin(&t, oracle_seed(i));
        for (int j = 0; j < 3; j++) {
            p[j] = imp_num(t.region.c[j]);
            mpfi_set_d(t.p[j], t.region.c[j]);
            mpfi_set_si(t.s[j], 0);
        }
        t.m = tree_model(&t.t, p);
        ck_trial(&t, t.m.depends == 0, "a point depends on parameters");
        if (tree_exact(&t.t, t.value, t.p)) {
            ck_trial(&t, !quadratic_is_refuted(&t.m, t.s, t.value), "error is too small");
            ck_trial(&t, !range_is_refuted(t.m.lo, t.m.hi, t.value), "range misses the point");
        }
        trial_end(&t);
    }
}
END_TEST

SUITE_MAIN("formula", random_formulas_are_covered_and_leave_errno_alone,
           random_formulas_change_no_faster_than_their_rates, a_point_is_within_its_error)
