/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/rates.h"

#include <math.h>
#include <string.h>

#include "tools/check/pair.h"

/* Numbers at effort 1. N evenly spread tiny regions hit every box with a fraction V of the domain
 * if N is a few times 1/V: 12000 find a box of 0.04 %. */
enum { TINY = 12000, TOP = 8, CLIMBS = 48, LINES = 96, REGIONS = 160, EXPANSIONS = 24 };
/* Widths of tiny regions as parts of the domain's. Rates hardly change over the wider one, and
 * rounding is not seen; over the narrower one slopes are as good as constant: what is 1e-6 low
 * shows unless eval's errors hide it. */
static const double tiny_widths[2] = {1e-5, 3e-8};

typedef struct search {
    const subject *s;
    uint64_t *random;
    pair_finding worst;
    bool answered; /* the last region has rates */
} search;

static int times(int usual, double effort)
{
    const double n = usual * effort;
    return n < 1 ? 1 : n > 1e9 ? 1000000000 : (int)n;
}

/* Continues only while nothing is refuted: one counterexample is enough. */
static bool goes_on(const search *r)
{
    return r->s->answer->verdict != CHECK_FAIL && !(r->worst.ratio > 1);
}

/* --- One region: its centre line along each dimension, and two diagonals ---------------------- */

static double judge_region(search *r, const box *where)
{
    const subject *s = r->s;
    const int n = s->n;
    double rate[3][BOX_DIMS], largest = 0;
    evaluated points[2 * BOX_DIMS + 4];
    const size_t count = 2 * (size_t)n + 4;
    r->answered = subject_rate_sane(s, where, rate);
    const uint64_t call = s->answer->rate_call;
    if (!r->answered) return 0;
    memset(points, 0, sizeof points);
    for (size_t k = 0; k < count; ++k)
        for (int j = 0; j < n; ++j) points[k].p[j] = 0.5 * where->lo[j] + 0.5 * where->hi[j];
    for (int j = 0; j < n; ++j) {
        points[2 * j].p[j] = where->lo[j];
        points[2 * j + 1].p[j] = where->hi[j];
    }
    for (size_t k = 2 * (size_t)n; k < count; k += 2) {
        draw_point(r->random, where, n, points[k].p);
        draw_partner(r->random, where, n, points[k].p, points[k + 1].p);
    }
    if (!pair_evaluate(s, count, points)) return 0;
    for (size_t k = 0; k < count; k += 2) {
        const double ratio =
            pair_judge(s, where, rate, call, &points[k], &points[k + 1], &r->worst);
        if (ratio > largest) largest = ratio;
    }
    return largest;
}

/* --- Tiny regions, and climbing from the tightest --------------------------------------------- */

typedef struct place {
    double at[BOX_DIMS], ratio; /* `at` in [0, 1], across the domain */
} place;

static void keep_top(place top[TOP], const place *found)
{
    int least = 0;
    for (int k = 1; k < TOP; ++k)
        if (top[k].ratio < top[least].ratio) least = k;
    if (found->ratio > top[least].ratio) top[least] = *found;
}

static void climb(search *r, place from)
{
    for (int k = 0; k < CLIMBS && goes_on(r); ++k) {
        place next = from;
        const double reach = random_power(r->random, -14, -2);
        for (int j = 0; j < r->s->n; ++j) {
            next.at[j] += reach * random_between(r->random, -1, 1);
            next.at[j] = next.at[j] < 0 ? 0 : next.at[j] > 1 ? 1 : next.at[j];
        }
        const double width = tiny_widths[k % 2] * random_power(r->random, -6, 6);
        const box where = draw_around(&r->s->domain, r->s->n, next.at, width);
        next.ratio = judge_region(r, &where);
        if (next.ratio > from.ratio) from = next;
    }
}

/* A region may have no rates, but around nearly every place a small region must have them; this
 * place is random. False, and the check fails, if it has none, however small the region. */
static bool has_bound(const search *r, const double at[BOX_DIMS])
{
    const subject *s = r->s;
    double rate[3][BOX_DIMS];
    box where = {.lo = {0}};
    for (double width = 1e-6; width > 1e-16; width *= 1e-3) {
        where = draw_around(&s->domain, s->n, at, width);
        if (subject_rate(s, &where, rate) != IMP_STATUS_UNBOUNDED) return true;
    }
    return answer_fail_for(s->answer, FAULT_UNBOUNDED,
                           "rate has no bound over any region around a place, such as %s: no "
                           "query near it can be answered",
                           subject_box_text(s->n, where.lo, where.hi).text);
}

static void search_tiny(search *r, double effort)
{
    place top[TOP] = {{.ratio = 0}};
    double shift[BOX_DIMS];
    for (int j = 0; j < BOX_DIMS; ++j) shift[j] = random_between(r->random, 0, 1);
    const int count = times(TINY, effort);
    for (int k = 0; k < count && goes_on(r); ++k) {
        place here;
        draw_spread(shift, (uint64_t)k, r->s->n, here.at);
        const box where = draw_around(&r->s->domain, r->s->n, here.at, tiny_widths[k % 2]);
        here.ratio = judge_region(r, &where);
        if (!r->answered && !has_bound(r, here.at)) return;
        keep_top(top, &here);
    }
    for (int k = 0; k < TOP && goes_on(r); ++k)
        if (top[k].ratio > 0) climb(r, top[k]);
}

/* --- Lines, halved towards the steeper half --------------------------------------------------- */

/* Halves the pair towards the steeper half. One half changes at least half as much, so that the
 * slope never falls. */
static void halve(search *r, evaluated a, evaluated b, double rate[3][BOX_DIMS], uint64_t call)
{
    const subject *s = r->s;
    for (int depth = 0; depth < 30 && goes_on(r); ++depth) {
        evaluated mid = a;
        for (int j = 0; j < s->n; ++j) mid.p[j] = 0.5 * a.p[j] + 0.5 * b.p[j];
        if (!pair_evaluate(s, 1, &mid)) return;
        const double below = pair_judge(s, &s->domain, rate, call, &a, &mid, &r->worst);
        const double above = pair_judge(s, &s->domain, rate, call, &mid, &b, &r->worst);
        if (!(below > 0 || above > 0)) return;
        if (below > above)
            b = mid;
        else
            a = mid;
    }
}

static void search_lines(search *r, double effort)
{
    const subject *s = r->s;
    double rate[3][BOX_DIMS];
    if (!subject_rate_sane(s, &s->domain, rate)) return;
    const uint64_t call = s->answer->rate_call;
    for (int k = times(LINES, effort); k > 0 && goes_on(r); --k) {
        evaluated ends[2] = {{.p = {0}}, {.p = {0}}};
        draw_point(r->random, &s->domain, s->n, ends[0].p);
        draw_partner(r->random, &s->domain, s->n, ends[0].p, ends[1].p);
        if (!pair_evaluate(s, 2, ends)) return;
        pair_judge(s, &s->domain, rate, call, &ends[0], &ends[1], &r->worst);
        halve(r, ends[0], ends[1], rate, call);
    }
}

/* --- Regions: where is the rate's maximum? ---------------------------------------------------- */

typedef struct hunt {
    box root;
    double rate[3][BOX_DIMS]; /* claimed over the root */
    uint64_t call;            /* by this call */
    int i, j;                 /* the entry under suspicion */
    double slope;             /* largest seen */
    double at[BOX_DIMS];      /* there */
} hunt;

/* Compares the slope at p, by a short step along j, with the claim. */
static void probe(search *r, hunt *h, const double p[BOX_DIMS])
{
    const int j = h->j;
    const double step = (h->root.hi[j] - h->root.lo[j]) * 0x1p-13;
    evaluated ends[2] = {{.p = {0}}, {.p = {0}}};
    memcpy(ends[0].p, p, sizeof ends[0].p);
    memcpy(ends[1].p, p, sizeof ends[1].p);
    ends[1].p[j] += ends[1].p[j] + step <= h->root.hi[j] ? step : -step;
    if (ends[1].p[j] < h->root.lo[j] || !pair_evaluate(r->s, 2, ends)) return;
    pair_judge(r->s, &h->root, h->rate, h->call, &ends[0], &ends[1], &r->worst);
    const double slope = pair_slope(h->i, j, &ends[0], &ends[1]);
    if (!(slope > h->slope)) return;
    h->slope = slope;
    memcpy(h->at, p, sizeof h->at);
}

typedef struct part {
    box where;
    double claim; /* rate[i][j] there, INFINITY if there is none */
} part;

static part part_of(search *r, hunt *h, const box *where)
{
    double rate[3][BOX_DIMS], mid[BOX_DIMS] = {0};
    part t = {*where, INFINITY};
    for (int j = 0; j < r->s->n; ++j) mid[j] = 0.5 * where->lo[j] + 0.5 * where->hi[j];
    probe(r, h, mid);
    if (subject_rate_sane(r->s, where, rate)) t.claim = rate[h->i][h->j];
    return t;
}

/* The dimension along which the part is largest, measured in the root. */
static int widest(const search *r, const hunt *h, const box *where)
{
    int best = 0;
    double most = -1;
    for (int j = 0; j < r->s->n; ++j) {
        const double whole = h->root.hi[j] - h->root.lo[j];
        const double share = whole > 0 ? (where->hi[j] - where->lo[j]) / whole : 0;
        if (share > most) most = share, best = j;
    }
    return best;
}

/* Splits the part with the largest claim, again and again: claims of small regions show where the
 * rate is large, even if the claim of the whole is wrong. */
static void split_towards_claims(search *r, hunt *h)
{
    part parts[EXPANSIONS + 1];
    int count = 1;
    parts[0] = part_of(r, h, &h->root);
    while (count <= EXPANSIONS && goes_on(r)) {
        int best = 0;
        for (int k = 1; k < count; ++k)
            if (parts[k].claim > parts[best].claim) best = k;
        box low = parts[best].where, high = low;
        const int j = widest(r, h, &low);
        low.hi[j] = high.lo[j] = 0.5 * low.lo[j] + 0.5 * low.hi[j];
        parts[best] = part_of(r, h, &low);
        parts[count++] = part_of(r, h, &high);
    }
}

/* Pattern search: steps along each dimension, halved when none increases the value. */
static void climb_slope(search *r, hunt *h)
{
    for (double reach = 0.06; reach > 1e-4 && goes_on(r);) {
        const double before = h->slope;
        for (int j = 0; j < r->s->n; ++j)
            for (int side = -1; side <= 1; side += 2) {
                double p[BOX_DIMS];
                memcpy(p, h->at, sizeof p);
                p[j] += side * reach * (h->root.hi[j] - h->root.lo[j]);
                if (p[j] >= h->root.lo[j] && p[j] <= h->root.hi[j]) probe(r, h, p);
            }
        if (!(h->slope > before)) reach *= 0.5;
    }
}

static void hunt_region(search *r, const box *where)
{
    hunt h = {.root = *where};
    h.i = (int)draw_index(r->random, 3);
    h.j = (int)draw_index(r->random, (size_t)r->s->n);
    judge_region(r, where);
    if (!subject_rate_sane(r->s, where, h.rate)) return;
    h.call = r->s->answer->rate_call;
    if (!(where->lo[h.j] < where->hi[h.j])) return;
    split_towards_claims(r, &h);
    if (h.slope > 0.5 * h.rate[h.i][h.j]) climb_slope(r, &h);
}

static void search_regions(search *r, double effort)
{
    const int count = times(REGIONS, effort);
    for (int k = 0; k < count && goes_on(r); ++k) {
        const box where = k % 8 ? draw_box(r->random, &r->s->domain, r->s->n) : r->s->domain;
        hunt_region(r, &where);
    }
}

void rates_check(const subject *s, uint64_t *random, double effort)
{
    search r = {.s = s, .random = random};
    search_tiny(&r, effort);
    search_lines(&r, effort);
    search_regions(&r, effort);
    pair_conclude(s, &r.worst, "the rates", FAULT_RATE);
}
