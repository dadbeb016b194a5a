/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "tools/proof/steps.h"
#include "tools/verify/net_internal.h"

/* Polynomials of s, each variable being lo + (hi - lo) s, s in [0, 1]: coefficients in intervals,
 * by powers of the first variable, then the second, then the third. */
typedef struct poly {
    int n[3]; /* 0: it is none, or has too many terms */
    ld_interval c[NET_POINTS];
} poly;

enum { POWER_MOST = 32, TIMES_MOST = 3, PRODUCTS_MOST = 1 << 18 };

static int size_of(const poly *x) { return x->n[0] * x->n[1] * x->n[2]; }

/* The place of coefficient k of x in a polynomial with the counts n. */
static int place_in(const int n[3], const poly *x, int k)
{
    const int t = k % x->n[2], v = k / x->n[2] % x->n[1], u = k / x->n[2] / x->n[1];
    return (u * n[1] + v) * n[2] + t;
}

static bool set_counts(poly *x, int u, int v, int t)
{
    const bool fits =
        t <= TIMES_MOST && u <= NET_POINTS && v <= NET_POINTS && u * v * t <= NET_POINTS;
    x->n[0] = fits ? u : 0, x->n[1] = v, x->n[2] = t;
    for (int k = 0; k < size_of(x); ++k) x->c[k] = ld_interval_of(0);
    return fits;
}

static void set_constant(poly *x, ld_interval value)
{
    set_counts(x, 1, 1, 1);
    x->c[0] = value;
}

static void add_scaled(poly *sum, const poly *x, double by)
{
    for (int k = 0; k < size_of(x); ++k) {
        ld_interval *c = &sum->c[place_in(sum->n, x, k)];
        *c = ld_interval_add(*c, by < 0 ? ld_interval_neg(x->c[k]) : x->c[k]);
    }
}

static int larger(int a, int b) { return a > b ? a : b; }

/* x + by y, by being 1 or -1 */
static void add(poly *r, const poly *x, const poly *y, double by)
{
    if (!set_counts(r, larger(x->n[0], y->n[0]), larger(x->n[1], y->n[1]),
                    larger(x->n[2], y->n[2])))
        return;
    add_scaled(r, x, 1);
    add_scaled(r, y, by);
}

static void multiply(poly *r, const poly *x, const poly *y)
{
    if (!set_counts(r, x->n[0] + y->n[0] - 1, x->n[1] + y->n[1] - 1, x->n[2] + y->n[2] - 1)) return;
    for (int i = 0; i < size_of(x); ++i) {
        const int base = place_in(r->n, x, i);
        for (int k = 0; k < size_of(y); ++k) {
            ld_interval *c = &r->c[base + place_in(r->n, y, k)];
            *c = ld_interval_add(*c, ld_interval_mul(x->c[i], y->c[k]));
        }
    }
}

static void divide(poly *r, const poly *x, ld_interval by)
{
    *r = *x;
    if (!ld_interval_excludes_0(by)) r->n[0] = 0;
    for (int k = 0; k < size_of(r); ++k) r->c[k] = ld_interval_div(x->c[k], by);
}

static void power(poly *r, const poly *x, double n)
{
    poly before;
    set_constant(r, ld_interval_of(1));
    if (!(n >= 0 && n <= POWER_MOST && n == floor(n))) r->n[0] = 0;
    for (; n > 0 && r->n[0] > 0; --n) {
        before = *r;
        multiply(r, &before, x);
    }
}

static void set_variable(poly *x, int j, const double lo[3], const double hi[3])
{
    const ld_interval from = ld_interval_of(lo[j]);
    set_counts(x, 1 + (j == 0), 1 + (j == 1), 1 + (j == 2));
    x->c[0] = from;
    x->c[1] = ld_interval_sub(ld_interval_of(hi[j]), from);
}

/* Computes step k from the earlier ones; false: it is no polynomial. */
static bool compute(const formula *f, int k, const double lo[3], const double hi[3], poly *all)
{
    const step *s = &f->steps[k], *second = &f->steps[s->count == 2 ? s->operand[1] : 0];
    poly *r = &all[k];
    const poly *x = &all[s->count > 0 ? s->operand[0] : 0];
    const poly *y = &all[s->count > 1 ? s->operand[1] : 0];
    r->n[0] = 0;
    if (s->kind == STEP_NUMBER) set_constant(r, ld_interval_of(s->number));
    if (s->kind == STEP_CONSTANT) set_constant(r, s->constant);
    if (s->kind == STEP_VARIABLE) set_variable(r, s->operand[0], lo, hi);
    if (s->kind == STEP_NEGATE) divide(r, x, ld_interval_of(-1));
    if (s->kind == STEP_ADD || s->kind == STEP_SUBTRACT) add(r, x, y, s->kind == STEP_ADD ? 1 : -1);
    if (s->kind == STEP_MULTIPLY) multiply(r, x, y);
    if (s->kind == STEP_FUNCTION && s->function == jet_sqr_) multiply(r, x, x);
    if (s->kind == STEP_DIVIDE && second->kind == STEP_CONSTANT) divide(r, x, second->constant);
    if (s->kind == STEP_POWER && second->kind == STEP_CONSTANT &&
        ld_interval_is(second->constant, second->constant.lo))
        power(r, x, second->constant.lo);
    return r->n[0] > 0;
}

/* Lemma. s^i is the sum over k of (k over i) / (d over i) times the Bernstein polynomial k of
 * degree d. Coefficient k takes lower ones only, so that they are replaced from the highest on. */
static void take_row(ld_interval *row, int n, int stride)
{
    for (int k = n - 1; k >= 0; --k) {
        ld_interval sum = row[0], share = ld_interval_of(1);
        for (int i = 1; i <= k; ++i) {
            share = ld_interval_mul(
                share, ld_interval_div(ld_interval_of(k - i + 1), ld_interval_of(n - i)));
            sum = ld_interval_add(sum, ld_interval_mul(share, row[i * stride]));
        }
        row[k * stride] = sum;
    }
}

static void to_bernstein(poly *x)
{
    int stride = size_of(x), blocks = 1;
    for (int j = 0; j < 3; ++j) {
        stride /= x->n[j];
        for (int b = 0; b < blocks; ++b)
            for (int i = 0; i < stride; ++i)
                take_row(&x->c[b * x->n[j] * stride + i], x->n[j], stride);
        blocks *= x->n[j];
    }
}

/* Makes a net of x, y and z. */
static bool take_net(const poly *const x[3], net *to)
{
    poly same = {.n = {1, 1, 1}};
    for (int c = 0; c < 3; ++c)
        for (int j = 0; j < 3; ++j) same.n[j] = larger(same.n[j], x[c]->n[j]);
    for (int j = 0; j < 3; ++j) {
        to->n[j] = same.n[j];
        for (int c = 0; c < 3; ++c) to->share[c][j] = 0;
    }
    double *p = to->p;
    if (!set_counts(&same, same.n[0], same.n[1], same.n[2])) return false;
    for (int c = 0; c < 3; ++c) {
        set_counts(&same, to->n[0], to->n[1], to->n[2]);
        add_scaled(&same, x[c], 1);
        to_bernstein(&same);
        to->error[c] = to->blur[c] = 0;
        for (int k = 0; k < size_of(&same); ++k, ++p) {
            *p = ld_interval_mid(same.c[k]);
            to->error[c] = proof_larger(to->error[c], net_off(same.c[k], *p));
        }
    }
    return net_take_sizes(to);
}

/* What the products of all steps cost, so that a hostile file costs no more. */
static bool is_cheap(const formula *f, int k, const poly *all, long *products)
{
    const step *s = &f->steps[k];
    if (s->kind == STEP_MULTIPLY)
        *products += (long)size_of(&all[s->operand[0]]) * size_of(&all[s->operand[1]]);
    if (s->kind == STEP_POWER || s->kind == STEP_FUNCTION) *products += NET_POINTS;
    return *products <= PRODUCTS_MOST;
}

net *net_of_formula(const formula *f, const double lo[3], const double hi[3])
{
    poly *all = malloc((size_t)f->count * sizeof *all);
    net *made = malloc(sizeof *made);
    bool is_one = all != NULL && made != NULL;
    for (int j = 0; j < 3; ++j) is_one = is_one && hi[j] - lo[j] < INFINITY;
    long products = 0;
    for (int k = 0; k < f->count && is_one; ++k)
        is_one = is_cheap(f, k, all, &products) && compute(f, k, lo, hi, all);
    for (int j = 0; j < 3 && is_one; ++j) made->lo[j] = lo[j], made->hi[j] = hi[j];
    const poly *out[3] = {NULL, NULL, NULL};
    for (int i = 0; i < 3 && is_one; ++i) out[i] = &all[f->out[i]];
    is_one = is_one && take_net(out, made);
    free(all);
    net *fitting = is_one ? realloc(made, net_bytes(made)) : NULL;
    if (fitting == NULL) free(made);
    return fitting;
}
