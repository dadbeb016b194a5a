/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/proof.h"

#include <impinge/formula.h>

#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tools/check/map_operand.h"
#include "tools/check/own_formula.h"
#include "tools/check/proof_text.h"
#include "tools/check/stated_formula.h"
#include "tools/proof/branch.h"
#include "tools/proof/polynomial.h"

enum { HALVED = 63, REGIONS = 160, POINTS = 2, TINY = 8000 };
#define TINY_WIDTH 1e-5  /* of the domain */
#define BOXES 120        /* per region, on average so far */
#define BOXES_MOST 24000 /* for one region: a few tight bounds need most of the boxes */

typedef struct proof {
    const subject *s;
    formula *f;
    uint64_t left; /* boxes */
    under below;   /* maps only */
} proof;

/* --- The bounded functions -------------------------------------------------------------------- */

/* Computes the formula of the variables themselves. */
static void plain_jets(void *context, const jet p[], const jet s[], jet out[3])
{
    const proof *now = context;
    (void)s;
    formula_jets(now->f, p, out);
}

/* Computes jets of a map on a surface: from u, v, t by x, y, z, t to the result. */
static void mapped_jets(void *context, const jet p[], const jet s[], jet out[3])
{
    const proof *now = context;
    jet variables[BOX_DIMS];
    for (int i = 0; i < 3; ++i)
        variables[i] = polynomial_jet(&now->below.in[i], now->below.rest[i], s);
    variables[3] = p[2];
    formula_jets(now->f, variables, out);
}

/* Tries to settle the claims. False: one is refuted. */
static bool settle(proof *p, const branch_field *field, const branch_claims *c)
{
    check_proof *sum = &p->s->answer->proof;
    fesetround(FE_TONEAREST); /* another check reports a plugin that changes it */
    const branch_outcome o = branch_settle(field, c, p->left < BOXES_MOST ? p->left : BOXES_MOST);
    if (o.proved < o.claims && !o.refuted) proof_tell_open(p->s, field, c, &o);
    p->left = p->left > o.boxes ? p->left - o.boxes : 0;
    sum->claims += (uint64_t)o.claims;
    p->s->answer->tests += (uint64_t)o.claims;
    sum->proved += (uint64_t)o.proved;
    sum->boxes += o.boxes;
    sum->regions += 1;
    return !o.refuted || proof_refute(p->s, field, c, &o);
}

/* --- Claims ----------------------------------------------------------------------------------- */

static branch_claims no_claims(const box *where, const imp_region *region)
{
    branch_claims c = {.where = *where};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < BOX_DIMS; ++j) c.rate[i][j] = INFINITY;
    for (int j = 0; j < BOX_DIMS; ++j) c.d[j] = 1;
    if (region == NULL) return c;
    memcpy(c.c, region->c, sizeof region->c);
    memcpy(c.d, region->d, sizeof region->d);
    return c;
}

/* The rate by a variable with a single value has no meaning. */
static void add_rate(branch_claims *c, int i, int j, double rate)
{
    if (rate < c->rate[i][j] && c->where.lo[j] < c->where.hi[j]) c->rate[i][j] = rate;
}

static void add_models(branch_claims *c, imp_status status)
{
    c->has_models = status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED;
    for (int i = 0; i < 3 && c->has_models; ++i)
        for (int j = 0; j < 3; ++j) add_rate(c, i, j, c->model[i].rate[j]);
}

static bool add_rates(const proof *p, branch_claims *c)
{
    double rate[3][BOX_DIMS];
    if (!subject_rate_sane(p->s, &c->where, rate)) return p->s->answer->verdict != CHECK_FAIL;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < p->s->n; ++j) add_rate(c, i, j, rate[i][j]);
    return true;
}

static bool settle_plain(proof *p, const box *where, bool rates_only)
{
    const bool is_surface = p->s->n == 3;
    const imp_region region = imp_region_between(where->lo, where->hi);
    branch_claims c = no_claims(where, is_surface ? &region : NULL);
    const branch_field field = {p->s->n, plain_jets, p};
    if (!add_rates(p, &c)) return false;
    if (is_surface && !rates_only && p->s->instance->surface->include != NULL)
        add_models(&c, subject_include(p->s, &region, c.model));
    return settle(p, &field, &c);
}

static bool settle_mapped(proof *p, uint64_t *random)
{
    const branch_field field = {3, mapped_jets, p};
    box where = {.lo = {0}};
    p->below = under_draw(random, p->s->domain.lo[3], p->s->domain.hi[3]);
    memcpy(where.lo, p->below.region.lo, sizeof p->below.region.lo);
    memcpy(where.hi, p->below.region.hi, sizeof p->below.region.hi);
    branch_claims c = no_claims(&where, &p->below.region);
    add_models(&c, subject_apply(p->s, p->below.in, c.model));
    return settle(p, &field, &c);
}

/* --- Points ----------------------------------------------------------------------------------- */

/* |x - f(p)| <= error, for a point that is exactly known. */
static bool settle_point(const proof *p, const box *where, uint64_t *random)
{
    double at[BOX_DIMS], x[3], error[3];
    check_proof *sum = &p->s->answer->proof;
    jet exact[BOX_DIMS], value[3];
    draw_point(random, where, p->s->n, at);
    if (!subject_eval_sane(p->s, 1, at, x, error)) return false;
    fesetround(FE_TONEAREST);
    for (int j = 0; j < p->s->n; ++j) exact[j] = jet_constant(p->s->n, ld_interval_of(at[j]));
    formula_jets(p->f, exact, value);
    for (int i = 0; i < 3; ++i) {
        const ld_interval off = ld_interval_abs(ld_interval_sub(value[i].v, ld_interval_of(x[i])));
        sum->claims += 1;
        p->s->answer->tests += 1;
        sum->proved += off.hi <= error[i];
        if (off.lo > error[i])
            return answer_fail_for(
                p->s->answer, FAULT_ERROR,
                "eval gives %c = %.17g with the error %.9g at %s, but by the formula "
                "it is surely %.9Lg off",
                "xyz"[i], x[i], error[i], subject_point_text(p->s->n, at).text, off.lo);
        if (off.hi > error[i] && sum->open[0] == '\0')
            snprintf(sum->open, sizeof sum->open, "the error of %c at %s", "xyz"[i],
                     subject_point_text(p->s->n, at).text);
    }
    return true;
}

/* --- The whole check -------------------------------------------------------------------------- */

/* Region k >= 1 of those that halving makes, along each variable in turn: k's halves are 2 k and
 * 2 k + 1. */
static box halved_box(const box *all, int n, int k)
{
    box b = *all;
    int depth = 0;
    while (k >> (depth + 1) > 0) ++depth;
    for (int level = 0; level < depth; ++level) {
        const int j = level % n;
        const double middle = b.lo[j] + (b.hi[j] - b.lo[j]) / 2;
        *((k >> (depth - 1 - level) & 1) != 0 ? &b.lo[j] : &b.hi[j]) = middle;
    }
    return b;
}

/* A rate that is too small in one place is found only in a region that contains little else. */
static bool settle_tiny(proof *p, uint64_t *random, double effort)
{
    const subject *s = p->s;
    double shift[BOX_DIMS], at[BOX_DIMS];
    for (int j = 0; j < BOX_DIMS; ++j) shift[j] = random_between(random, 0, 1);
    for (uint64_t k = 0; (double)k < TINY * effort; ++k) {
        draw_spread(shift, k, s->n, at);
        const box where = draw_around(&s->domain, s->n, at, TINY_WIDTH);
        p->left += 2;
        if (!settle_plain(p, &where, true)) return false;
    }
    return true;
}

static void settle_all(proof *p, uint64_t *random, double effort)
{
    const subject *s = p->s;
    const double count = REGIONS * effort;
    for (int k = 1; k == 1 || k <= count; ++k) {
        const box where =
            k <= HALVED ? halved_box(&s->domain, s->n, k) : draw_box(random, &s->domain, s->n);
        p->left += BOXES;
        if (!settle_plain(p, &where, false)) return;
        if (s->n == 4 && s->instance->map->apply != NULL && !settle_mapped(p, random)) return;
        for (int i = 0; i < POINTS; ++i)
            if (!settle_point(p, &where, random)) return;
    }
}

static void conclude(const subject *s)
{
    const check_proof *sum = &s->answer->proof;
    if (sum->proved == sum->claims)
        answer_pass(s->answer, "all %llu claims over %llu regions are proved, by %llu boxes",
                    (unsigned long long)sum->claims, (unsigned long long)sum->regions,
                    (unsigned long long)sum->boxes);
    else
        answer_pass(s->answer,
                    "%llu of %llu claims over %llu regions are proved, by %llu boxes; none is "
                    "refuted; not settled: %s",
                    (unsigned long long)sum->proved, (unsigned long long)sum->claims,
                    (unsigned long long)sum->regions, (unsigned long long)sum->boxes, sum->open);
}

/* What a type states itself is asked for on every run, so it gets this part of the effort. */
#define OWN_EFFORT 0.125

/* By the formula that the type states: over the first, the middle and the last of its parts. */
static void prove_by_own(const subject *s, uint64_t *random, double effort)
{
    char fault[480];
    own_formula own = own_formula_read(s->registry, s->type, s->stage, s->instance, s->answer,
                                       fault, sizeof fault);
    const size_t which[3] = {0, own.count / 2, own.count > 0 ? own.count - 1 : 0};
    if (own.count == 0 && fault[0] != '\0')
        answer_skip(s->answer, "the type's formula cannot be read: %s", fault);
    else if (own.count == 0)
        answer_skip(s->answer, "no formula is known; state it with --formula 'X; Y; Z'");
    bool good = own.count > 0;
    for (int k = 0; k < 3 && good; ++k) {
        if (k > 0 && which[k] == which[k - 1]) continue;
        subject part = *s;
        part.domain = own_part_box(&own.parts[which[k]], s);
        proof p = {.s = &part, .f = own.parts[which[k]].f};
        good = settle_tiny(&p, random, OWN_EFFORT * effort);
        if (good) settle_all(&p, random, OWN_EFFORT * effort);
        good = good && s->answer->verdict != CHECK_FAIL;
    }
    if (good) conclude(s);
    own_formula_free(&own);
}

void proof_check(const subject *s, uint64_t *random, double effort)
{
    char fault[480];
    proof p = {.s = s};
    p.f = stated_formula(s->registry, s->type, s->stage, s->formula, fault, sizeof fault);
    if (p.f == NULL && fault[0] == '\0')
        prove_by_own(s, random, effort);
    else if (p.f == NULL && s->formula != NULL && s->answer->proof.claims > 0)
        return; /* it has been proved of another stage, which has more parameters */
    else if (p.f == NULL && s->formula != NULL)
        answer_skip(s->answer, "with these parameters the formula cannot be read: %s", fault);
    else if (p.f == NULL) /* its texts may be in another language */
        answer_skip(s->answer, "x, y and z cannot be read as formulas: %s", fault);
    if (p.f == NULL) return;
    if (settle_tiny(&p, random, effort)) settle_all(&p, random, effort);
    formula_free(p.f);
    conclude(s);
}
