/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/inclusions.h"

#include <impinge/formula.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "tools/check/map_operand.h"
#include "tools/check/pair.h"

enum { REGIONS = 3000, POINTS = 10, CLIMB_EVERY = 3 };

/* Models over one region, and how to evaluate what they include. */
typedef struct included {
    const subject *s;
    imp_region region;
    imp_model model[3];
    bool bounded; /* IMP_STATUS_OK, not IMP_STATUS_UNBOUNDED */
    under below;  /* maps only */
} included;

typedef struct sample {
    double s[3]; /* multiples of 2^-10 */
    long double exact_s[3];
    evaluated at; /* p = (u, v, t), and the value there */
} sample;

/* --- Form ------------------------------------------------------------------------------------- */

static subject_text region_text(const included *n)
{
    return subject_box_text(3, n->region.lo, n->region.hi);
}

static bool judge_form(const included *n, int i)
{
    const imp_model *g = &n->model[i];
    bool finite = isfinite(g->a) && isfinite(g->e) && isfinite(g->lo) && isfinite(g->hi);
    bool independent = true;
    for (int j = 0; j < 3; ++j) finite = finite && isfinite(g->b[j]) && isfinite(g->rate[j]);
    for (int k = 0; k < 6; ++k) finite = finite && isfinite(g->q[k]);
    for (int j = 0; j < 3; ++j)
        if ((g->depends >> j & 1) == 0)
            independent = independent && g->b[j] == 0 && g->rate[j] == 0;
    const char *fault = NULL;
    if (isnan(g->e) || isnan(g->lo) || isnan(g->hi))
        fault = "has NaN in it";
    else if (n->bounded && !finite)
        fault = "is not finite, though the answer is 'ok'";
    else if (!(g->e >= 0))
        fault = "has a negative remainder";
    else if (!(g->lo <= g->hi))
        fault = "has lo > hi";
    else if (!(g->rate[0] >= 0 && g->rate[1] >= 0 && g->rate[2] >= 0))
        fault = "has a negative rate";
    else if (n->bounded && !independent)
        fault = "has a slope or rate for a parameter it says it does not depend on";
    return fault == NULL ||
           answer_fail_for(n->s->answer, FAULT_RANGE | FAULT_REMAINDER,
                           "the model of %c %s over %s", "xyz"[i], fault, region_text(n).text);
}

/* False, with or without a failure, if there is nothing to compare. */
static bool judge_status(included *n, imp_status status)
{
    n->bounded = status == IMP_STATUS_OK;
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED)
        return answer_fail(n->s->answer, "%s returned '%s' over %s",
                           n->s->n == 3 ? "include" : "apply", subject_status_name(status),
                           region_text(n).text);
    for (int i = 0; i < 3; ++i)
        if (!judge_form(n, i)) return false;
    return true;
}

/* --- Points ----------------------------------------------------------------------------------- */

/* The point at s, and its exact s rounded to long double. */
static bool evaluate(const included *n, sample *x)
{
    const imp_region *r = &n->region;
    double in[4], out[3], error[3];
    for (int j = 0; j < 3; ++j) {
        const double p = r->c[j] + r->d[j] * x->s[j];
        x->at.p[j] = in[j] = p < r->lo[j] ? r->lo[j] : p > r->hi[j] ? r->hi[j] : p;
        x->exact_s[j] = r->d[j] > 0 ? ((long double)in[j] - r->c[j]) / r->d[j] : 0;
    }
    x->at.p[3] = 0;
    if (n->s->n == 4) under_value(&n->below, x->s, in);
    if (!subject_eval_sane(n->s, 1, in, out, error)) return false;
    memcpy(x->at.x, out, sizeof out);
    memcpy(x->at.error, error, sizeof error);
    return true;
}

/* Lemma. The quadratic's ten terms have at most four roundings each and take part in ten sums; s
 * has two more, twice: 20 LDBL_EPSILON of the sum of magnitudes cover it all, and 32 are taken. */
static long double distance(const included *n, int i, const sample *x)
{
    long double size;
    const long double value = under_quadratic(&n->model[i], x->exact_s, &size);
    const long double slack = 32 * LDBL_EPSILON * (size + fabsl((long double)x->at.x[i]));
    return fabsl(x->at.x[i] - value) - x->at.error[i] - slack;
}

static bool judge_value(const included *n, int i, const sample *x)
{
    const imp_model *g = &n->model[i];
    const double value = x->at.x[i], error = x->at.error[i];
    const long double off = distance(n, i, x);
    const subject_text at = subject_point_text(3, x->at.p);
    ++n->s->answer->tests;
    if (off > g->e)
        return answer_fail_for(
            n->s->answer, FAULT_REMAINDER | FAULT_ERROR,
            "%c is %.17g (error %g) at %s, %.9Lg off the quadratic, whose remainder "
            "is %.9g over %s",
            "xyz"[i], value, error, at.text, off, g->e, region_text(n).text);
    const long double slack = 4 * LDBL_EPSILON * fabsl((long double)value);
    if ((long double)value + error + slack < g->lo || (long double)value - error - slack > g->hi)
        return answer_fail_for(
            n->s->answer, FAULT_RANGE,
            "%c is %.17g (error %g) at %s, outside the range [%.17g, %.17g] over %s", "xyz"[i],
            value, error, at.text, g->lo, g->hi, region_text(n).text);
    return true;
}

static bool judge_rates(const included *n, const sample *a, const sample *b)
{
    for (int i = 0; i < 3; ++i) {
        double rate[BOX_DIMS] = {0};
        memcpy(rate, n->model[i].rate, sizeof n->model[i].rate);
        const double ratio = pair_ratio(3, i, rate, &a->at, &b->at);
        ++n->s->answer->tests;
        if (ratio > 1)
            return answer_fail_for(n->s->answer, FAULT_RATE,
                                   "%c is %.17g at %s and %.17g at %s, %.9g times what the model's "
                                   "rates (%.9g, %.9g, %.9g) allow over %s",
                                   "xyz"[i], a -> at.x[i], subject_point_text(3, a->at.p).text,
                                   b->at.x[i], subject_point_text(3, b->at.p).text, ratio, rate[0],
                                   rate[1], rate[2], region_text(n).text);
    }
    return true;
}

static bool judge_sample(const included *n, const sample *x)
{
    for (int i = 0; i < 3; ++i)
        if (!judge_value(n, i, x)) return false;
    return true;
}

/* --- Climbing --------------------------------------------------------------------------------- */

/* Returns how near a coordinate is to a violation: distance from the quadratic in remainders. */
static double strain(const included *n, int i, const sample *x)
{
    const double e = n->model[i].e;
    return e > 0 && e < INFINITY ? (double)(distance(n, i, x) / e) : 0;
}

/* Steps in s, towards more strain of coordinate i. */
static bool climb(const included *n, int i, sample from)
{
    double best = strain(n, i, &from);
    for (double reach = 0.25; reach >= 0x1p-6; reach *= 0.5)
        for (int j = 0; j < 3; ++j)
            for (int side = -1; side <= 1; side += 2) {
                sample next = from;
                next.s[j] += side * reach;
                if (!(fabs(next.s[j]) <= 1) || n->region.d[j] == 0) continue;
                if (!evaluate(n, &next) || !judge_sample(n, &next)) return false;
                const double there = strain(n, i, &next);
                if (there > best) best = there, from = next;
            }
    return true;
}

/* --- One region ------------------------------------------------------------------------------- */

static bool judge_points(const included *n, uint64_t *random, bool climbs)
{
    sample samples[POINTS], *worst = &samples[0];
    const int suspect = (int)draw_index(random, 3);
    for (int k = 0; k < POINTS; ++k) {
        for (int j = 0; j < 3; ++j) samples[k].s[j] = draw_normalized(random);
        if (k % 2) /* differs from the last in one parameter only */
            for (int j = 0; j < 3; ++j)
                if (j != k / 2 % 3) samples[k].s[j] = samples[k - 1].s[j];
        if (!evaluate(n, &samples[k]) || !judge_sample(n, &samples[k])) return false;
        if (k > 0 && !judge_rates(n, &samples[k - 1], &samples[k])) return false;
        if (strain(n, suspect, &samples[k]) > strain(n, suspect, worst)) worst = &samples[k];
    }
    return !climbs || climb(n, suspect, *worst);
}

/* Returns the place of the k-th region: spread evenly, or random. */
static box place_of(const subject *s, uint64_t *random, const double shift[BOX_DIMS], int k)
{
    double at[BOX_DIMS];
    if (k % 2) return draw_box(random, &s->domain, s->n);
    draw_spread(shift, (uint64_t)k / 2, s->n, at);
    return draw_around(&s->domain, s->n, at, random_power(random, -16, 0));
}

/* Some region around a random place has models. False, and the check fails, if none has. */
static bool has_model(const subject *s, const double shift[BOX_DIMS], int k)
{
    double at[BOX_DIMS];
    imp_model model[3];
    box where = {.lo = {0}};
    draw_spread(shift, (uint64_t)k / 2, s->n, at);
    for (double width = 1e-4; width > 1e-16; width *= 1e-3) {
        where = draw_around(&s->domain, s->n, at, width);
        const imp_region region = imp_region_between(where.lo, where.hi);
        if (subject_include(s, &region, model) != IMP_STATUS_UNBOUNDED) return true;
    }
    return answer_fail_for(s->answer, FAULT_UNBOUNDED,
                           "include has no bound over any region around a place, such as %s",
                           subject_box_text(3, where.lo, where.hi).text);
}

static bool judge_region(const subject *s, uint64_t *random, const double shift[BOX_DIMS], int k)
{
    included n = {.s = s};
    if (s->n == 3 && k % 2 == 0 && !has_model(s, shift, k)) return false;
    if (s->n == 3) {
        const box where = place_of(s, random, shift, k);
        n.region = imp_region_between(where.lo, where.hi);
        if (!judge_status(&n, subject_include(s, &n.region, n.model))) return false;
    } else {
        n.below = under_draw(random, s->domain.lo[3], s->domain.hi[3]);
        n.region = n.below.region;
        if (!judge_status(&n, subject_apply(s, n.below.in, n.model))) return false;
    }
    return judge_points(&n, random, k % CLIMB_EVERY == 0);
}

/* ---------------------------------------------------------------------------------------------- */

void inclusions_check(const subject *s, uint64_t *random, double effort)
{
    const imp_instance *i = s->instance;
    if (i->surface != NULL ? i->surface->include == NULL : i->map->apply == NULL) {
        answer_skip(s->answer, "the type has no %s; the host makes its own from eval and rate",
                    s->n == 3 ? "include" : "apply");
        return;
    }
    double shift[BOX_DIMS];
    for (int j = 0; j < BOX_DIMS; ++j) shift[j] = random_between(random, 0, 1);
    const double count = REGIONS * effort;
    for (int k = 0; (k < count || k == 0) && s->answer->verdict != CHECK_FAIL; ++k)
        judge_region(s, random, shift, k);
}
