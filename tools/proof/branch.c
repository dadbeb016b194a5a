/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/branch.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "tools/proof/view.h"

/* --- Claims as bits of a mask -------------------------------------------------------
 *
 * Of each coordinate: rates by four variables, the range, the remainder. */

enum { RANGE = BOX_DIMS, REMAINDER, PER_COORDINATE, CLAIMS = 3 * PER_COORDINATE };
enum { DEPTH_MAX = 48 };

typedef struct part {
    ld_interval x[BOX_DIMS];
    uint32_t open; /* claims that are not proved here */
    int depth;
} part;

typedef struct search {
    frame frame;
    uint32_t given_up;
    branch_outcome outcome;
} search;

static uint32_t bit(int i, int which) { return 1u << (i * PER_COORDINATE + which); }

static uint32_t all_claims(const branch_field *field, const branch_claims *c)
{
    uint32_t mask = 0;
    for (int i = 0; i < 3; ++i) {
        const imp_model *g = &c->model[i];
        for (int j = 0; j < field->n; ++j)
            if (c->rate[i][j] < INFINITY) mask |= bit(i, j);
        if (!c->has_models) continue;
        if (g->lo > -INFINITY || g->hi < INFINITY) mask |= bit(i, RANGE);
        if (g->e < INFINITY) mask |= bit(i, REMAINDER);
    }
    return mask;
}

static int count_bits(uint32_t mask)
{
    int count = 0;
    for (; mask != 0; mask &= mask - 1) ++count;
    return count;
}

/* --- One box ---------------------------------------------------------------------------------- */

static bool is_outside(ld_interval x, ld_interval limits)
{
    return x.lo > limits.hi || x.hi < limits.lo;
}

static void evaluate_part(search *s, const part *b, view *v)
{
    bool off_wanted[3];
    for (int i = 0; i < 3; ++i) off_wanted[i] = (b->open & bit(i, REMAINDER)) != 0;
    frame_evaluate(&s->frame, b->x, off_wanted, v);
    ++s->outcome.boxes;
}

/* What a claim is about, over the box and at its middle, and the limits that it sets: within the
 * inner ones it surely holds, outside of the outer ones it surely does not. */
typedef struct matter {
    ld_interval over, at, inner, outer;
} matter;

/* Slopes by s are d times those by p. */
static matter matter_of(const search *s, const view *v, int i, int which)
{
    const branch_claims *c = s->frame.claims;
    const imp_model *g = &c->model[i];
    const ld_interval range = ld_interval_make(g->lo, g->hi), rest = ld_interval_plus_minus(g->e);
    if (which == RANGE)
        return (matter){jet_values(&v->box[i], &v->centre[i], v->offset), v->centre[i].v, range,
                        range};
    if (which == REMAINDER)
        return (matter){jet_values(&v->off_box[i], &v->off_centre[i], v->offset),
                        v->off_centre[i].v, rest, rest};
    const ld_interval most =
        ld_interval_mul(ld_interval_of(c->rate[i][which]), ld_interval_of(c->d[which]));
    return (matter){jet_slopes(&v->box[i], &v->centre[i], v->offset, which), v->centre[i].d[which],
                    ld_interval_plus_minus(most.lo), ld_interval_plus_minus(most.hi)};
}

static void name_claim(search *s, const view *v, int i, int which, ld_interval there)
{
    branch_outcome *o = &s->outcome;
    o->kind = which == RANGE ? BRANCH_RANGE : which == REMAINDER ? BRANCH_REMAINDER : BRANCH_RATE;
    o->i = i;
    o->j = which;
    o->there =
        which < RANGE ? ld_interval_div(there, ld_interval_of(s->frame.claims->d[which])) : there;
    for (int j = 0; j < s->frame.field->n; ++j) o->p[j] = v->point[j];
}

/* Returns how it changes with variable k. */
static ld_interval trend(const view *v, int i, int which, int k)
{
    if (which == RANGE) return jet_slopes(&v->box[i], &v->centre[i], v->offset, k);
    if (which == REMAINDER) return jet_slopes(&v->off_box[i], &v->off_centre[i], v->offset, k);
    return which <= k ? v->box[i].h[which][k] : v->box[i].h[k][which];
}

/* If it is monotone along a variable, its maximum and minimum are at the ends. False: it is
 * monotone along none. */
static bool reduce(const search *s, const view *v, part *b, int i, int which, bool greatest)
{
    bool reduced = false;
    for (int k = 0; k < s->frame.field->n; ++k) {
        const ld_interval slope = trend(v, i, which, k);
        if (!(b->x[k].lo < b->x[k].hi) || (slope.lo < 0 && slope.hi > 0)) continue;
        b->x[k] = ld_interval_of((slope.lo >= 0) == greatest ? b->x[k].hi : b->x[k].lo);
        reduced = true;
    }
    return reduced;
}

/* Is a claim refuted at the middle? Then it is recorded. */
static bool is_refuted(search *s, const view *v, int i, int which, const matter *m)
{
    if (!is_outside(m->at, m->outer)) return false;
    s->outcome.refuted = true;
    name_claim(s, v, i, which, m->at);
    return true;
}

/* A tighter evaluate_part for one claim, at the ends where its extremes are. */
static bool is_proved_at_ends(search *s, const part *b, const view *v, int i, int which)
{
    static view ends; /* large */
    bool proved = true;
    for (int greatest = 0; greatest < 2 && proved && !s->outcome.refuted; ++greatest) {
        part end = *b;
        if (!reduce(s, v, &end, i, which, greatest)) return false;
        evaluate_part(s, &end, &ends);
        const matter m = matter_of(s, &ends, i, which);
        is_refuted(s, &ends, i, which, &m);
        proved = greatest ? m.over.hi <= m.inner.hi : m.over.lo >= m.inner.lo;
    }
    return proved;
}

/* Removes the claims that are proved over the box. False: a claim is refuted. */
static bool judge(search *s, part *b, const view *v)
{
    for (int i = 0; i < 3; ++i)
        for (int which = 0; which < PER_COORDINATE; ++which) {
            if ((b->open & bit(i, which)) == 0) continue;
            const matter m = matter_of(s, v, i, which);
            if (is_refuted(s, v, i, which, &m)) return false;
            if (ld_interval_is_within(m.over, m.inner) || is_proved_at_ends(s, b, v, i, which))
                b->open &= ~bit(i, which);
            if (s->outcome.refuted) return false;
        }
    return true;
}

/* --- Halving ------------------------------------------------------------------------
 *
 * Along the variable that the excess of the bounds comes from most: how much second derivatives
 * vary over the box, weighed by its size, in units of the limits. A small share of their size keeps
 * it going where they do not vary. */

static long double unrest(const jet *g, int j, int k)
{
    const ld_interval bend = j <= k ? g->h[j][k] : g->h[k][j];
    return (bend.hi - bend.lo) + 0x1p-10L * ld_interval_mag(bend);
}

static long double excess(const search *s, const view *v, int i, int which, int k)
{
    const imp_model *g = &s->frame.claims->model[i];
    const long double r = ld_interval_mag(v->offset[k]);
    long double sum = 0;
    if (which == RANGE) return r * ld_interval_mag(v->box[i].d[k]) / ((long double)g->hi - g->lo);
    if (which != REMAINDER)
        return r * unrest(&v->box[i], which, k) /
               ((long double)s->frame.claims->rate[i][which] * s->frame.claims->d[which]);
    for (int l = 0; l < s->frame.field->n; ++l)
        sum += unrest(&v->off_box[i], k, l) * r * ld_interval_mag(v->offset[l]);
    return sum / g->e;
}

static long double share(const search *s, const part *b, const view *v, int k)
{
    const long double r = ld_interval_mag(v->offset[k]);
    long double sum = 0;
    for (int i = 0; i < 3; ++i)
        for (int which = 0; which < PER_COORDINATE; ++which) {
            if ((b->open & bit(i, which)) == 0 || r == 0 || ld_interval_is(v->box[i].d[k], 0))
                continue;
            const long double more = excess(s, v, i, which, k);
            sum += r * 0x1p-100L + (more < 1e6L ? more : 1e6L * r); /* infinite or NaN: by size */
        }
    return sum;
}

static int worst_variable(const search *s, const part *b, const view *v)
{
    int worst = 0;
    long double most = -1;
    for (int k = 0; k < s->frame.field->n; ++k) {
        const long double here = share(s, b, v, k);
        if (here > most) most = here, worst = k;
    }
    return worst;
}

static int split(search *s, const part *b, const view *v, part *stack, int count)
{
    const int k = worst_variable(s, b, v);
    const long double m =
        ld_interval_is_within(v->middle[k], b->x[k]) ? v->middle[k].lo : ld_interval_mid(b->x[k]);
    if (b->depth == DEPTH_MAX || !(b->x[k].lo < b->x[k].hi)) {
        s->given_up |= b->open;
        return count;
    }
    part lower = *b, upper = *b;
    lower.depth = upper.depth = b->depth + 1;
    lower.x[k].hi = upper.x[k].lo = m;
    stack[count++] = lower;
    stack[count++] = upper;
    return count;
}

static void name_open(search *s, const view *v)
{
    for (int k = 0; k < CLAIMS; ++k)
        if (s->given_up >> k & 1)
            name_claim(s, v, k / PER_COORDINATE, k % PER_COORDINATE, ld_interval_entire());
}

branch_outcome branch_settle(const branch_field *field, const branch_claims *claims,
                             unsigned long budget)
{
    part stack[DEPTH_MAX + 2] = {{.open = all_claims(field, claims)}};
    search s = {.frame = frame_make(field, claims)};
    view v;
    const uint32_t all = stack[0].open;
    int count = 1;
    memset(&v, 0, sizeof v);
    memcpy(stack[0].x, s.frame.whole, sizeof stack[0].x);
    while (count > 0) {
        part b = stack[--count];
        b.open &= ~s.given_up;
        if (b.open == 0) continue;
        if (s.outcome.boxes >= budget) {
            s.given_up |= b.open;
            continue;
        }
        evaluate_part(&s, &b, &v);
        if (!judge(&s, &b, &v)) break;
        if (b.open != 0) count = split(&s, &b, &v, stack, count);
    }
    s.outcome.claims = count_bits(all);
    s.outcome.proved = s.outcome.refuted ? 0 : count_bits(all & ~s.given_up);
    if (!s.outcome.refuted) name_open(&s, &v);
    return s.outcome;
}
