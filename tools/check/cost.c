/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/cost.h"

#include <impinge/formula.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/clock.h"
#include "tools/check/clearance_cost.h"
#include "tools/check/pair.h"
#include "tools/check/remainders.h"

/* --- Tightness -------------------------------------------------------------------------------- */

enum { BOXES = 48, LINES = 16, MOST = BOXES * 3 * BOX_DIMS };

typedef struct ratios {
    double value[MOST];
    int count;
} ratios;

static void add_ratio(ratios *r, double bound, double observed)
{
    if (observed > 0 && bound < INFINITY && r->count < MOST)
        r->value[r->count++] = bound / observed;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(ratios *r)
{
    if (r->count == 0) return NAN;
    qsort(r->value, (size_t)r->count, sizeof *r->value, ascending);
    return r->value[r->count / 2];
}

/* Largest slopes and least and largest values seen along random short lines in the region. */
typedef struct seen {
    double slope[3][BOX_DIMS], lo[3], hi[3];
} seen;

static void note_change(seen *found, int j, const evaluated ends[2])
{
    for (int i = 0; i < 3; ++i) {
        const double slope = pair_slope(i, j, &ends[0], &ends[1]);
        if (slope > found->slope[i][j]) found->slope[i][j] = slope;
        for (int k = 0; k < 2; ++k) {
            if (ends[k].x[i] < found->lo[i]) found->lo[i] = ends[k].x[i];
            if (ends[k].x[i] > found->hi[i]) found->hi[i] = ends[k].x[i];
        }
    }
}

static bool sample_around(const subject *s, uint64_t *random, const box *where, seen *found)
{
    *found = (seen){.lo = {INFINITY, INFINITY, INFINITY}, .hi = {-INFINITY, -INFINITY, -INFINITY}};
    for (int j = 0; j < s->n; ++j)
        for (int k = 0; k < LINES; ++k) {
            evaluated ends[2] = {{.p = {0}}, {.p = {0}}};
            draw_point(random, where, s->n, ends[0].p);
            memcpy(ends[1].p, ends[0].p, sizeof ends[1].p);
            const double step = (where->hi[j] - where->lo[j]) * 0x1p-12;
            ends[1].p[j] += ends[1].p[j] + step <= where->hi[j] ? step : -step;
            if (ends[1].p[j] < where->lo[j]) continue;
            if (!pair_evaluate(s, 2, ends)) return false;
            note_change(found, j, ends);
        }
    return true;
}

static void measure_region(const subject *s, uint64_t *random, const box *where, ratios *rates,
                           ratios *ranges)
{
    seen found;
    double rate[3][BOX_DIMS];
    imp_model model[3];
    if (!subject_rate_sane(s, where, rate) || !sample_around(s, random, where, &found)) return;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < s->n; ++j) add_ratio(rates, rate[i][j], found.slope[i][j]);
    if (s->n != 3 || s->instance->surface->include == NULL) return;
    const imp_region region = imp_region_between(where->lo, where->hi);
    if (subject_include(s, &region, model) != IMP_STATUS_OK) return;
    for (int i = 0; i < 3; ++i)
        add_ratio(ranges, model[i].hi - model[i].lo, found.hi[i] - found.lo[i]);
}

typedef struct ratios_words {
    char text[80];
} ratios_words;

/* Empty if nothing changes or there is no include. */
static ratios_words ratios_text(const char *what, const double ratio[CHECK_SCALES])
{
    ratios_words w = {""};
    if (!isnan(ratio[0]) || !isnan(ratio[1]) || !isnan(ratio[2]))
        snprintf(w.text, sizeof w.text, "%s %.3g, %.3g, %.3g", what, ratio[0], ratio[1], ratio[2]);
    return w;
}

static void measure_remainders(const subject *s, const box *where, ratios *remainders)
{
    double claimed[3], needed[3];
    if (s->n != 3 || !remainder_measure(s, where, claimed, needed)) return;
    add_ratio(remainders, claimed[0] + claimed[1] + claimed[2], needed[0] + needed[1] + needed[2]);
}

static double measure_distances(const subject *s, uint64_t *random)
{
    static ratios distances;
    double ratio;
    distances.count = 0;
    for (int k = 0; k < BOXES && subject_has_distance(s); ++k)
        if (distance_measure(s, random, &s->domain, &ratio)) add_ratio(&distances, ratio, 1);
    return median(&distances);
}

static void measure_scale(const subject *s, uint64_t *random, const double shift[BOX_DIMS], int k)
{
    static const double fractions[CHECK_SCALES] = {1.0 / 64, 1.0 / 8, 1.0 / 2};
    static ratios rates, ranges, remainders;
    double at[BOX_DIMS];
    rates.count = ranges.count = remainders.count = 0;
    for (int b = 0; b < BOXES; ++b) {
        draw_spread(shift, (uint64_t)b, s->n, at);
        const box where = draw_around(&s->domain, s->n, at, fractions[k]);
        measure_region(s, random, &where, &rates, &ranges);
        measure_remainders(s, &where, &remainders);
    }
    s->answer->rate_ratio[k] = median(&rates);
    s->answer->range_ratio[k] = median(&ranges);
    s->answer->remainder_ratio[k] = median(&remainders);
}

/* Without include the host's models are boxes, whose remainders shrink like a region's width. */
static const char *advice(const subject *s)
{
    const double *ratio = s->answer->remainder_ratio;
    if (s->n != 3 || !(ratio[0] > 4)) return "";
    if (s->instance->surface->include == NULL)
        return ". There is no include: remainders are those of rates and shrink like a region's "
               "width, not like "
               "its cube; where surfaces come near each other this takes thousands of times the "
               "pairs. Write "
               "include, or a formula";
    return ". The remainder of include is far wider than needed, and decides what a search costs: "
           "bound terms of "
           "third order over the region instead of its ends, and write each variable once";
}

void tightness_check(const subject *s, uint64_t *random, double effort)
{
    double shift[BOX_DIMS];
    (void)effort;
    for (int j = 0; j < BOX_DIMS; ++j) shift[j] = random_between(random, 0, 1);
    for (int k = 0; k < CHECK_SCALES; ++k) measure_scale(s, random, shift, k);
    s->answer->distance_ratio = measure_distances(s, random);
    const ratios_words slopes = ratios_text(": rates", s->answer->rate_ratio);
    const ratios_words spans = ratios_text("; ranges", s->answer->range_ratio);
    const ratios_words rests = ratios_text("; remainders", s->answer->remainder_ratio);
    ratios_words gaps = {""};
    if (!isnan(s->answer->distance_ratio))
        snprintf(gaps.text, sizeof gaps.text, "; distances %.3g", s->answer->distance_ratio);
    if (slopes.text[0] == '\0' && spans.text[0] == '\0')
        answer_pass(s->answer, "no coordinate changes");
    else
        answer_pass(s->answer, "bound / observed over 1/64, 1/8 and 1/2 of the domain%s%s%s%s%s",
                    slopes.text, spans.text, rests.text, gaps.text, advice(s));
}

/* --- Cost ------------------------------------------------------------------------------------- */

enum { BATCH = 64 };
#define MEASURED_SECONDS 0.01 /* per call: enough for two digits */

typedef struct load {
    const subject *s;
    double p[BATCH * BOX_DIMS], x[BATCH * 3], error[BATCH * 3];
    box where[BATCH];
    imp_region region[BATCH];
} load;

static void all_points(load *l) { subject_eval(l->s, BATCH, l->p, l->x, l->error); }

static void all_rates(load *l)
{
    double rate[3][BOX_DIMS];
    for (int k = 0; k < BATCH; ++k) subject_rate(l->s, &l->where[k], rate);
}

static void all_models(load *l)
{
    imp_model model[3];
    for (int k = 0; k < BATCH; ++k) subject_include(l->s, &l->region[k], model);
}

/* Nanoseconds for one of BATCH. */
static double measure(load *l, void (*run)(load *))
{
    run(l);
    const double start = clock_seconds();
    double spent;
    long rounds = 0;
    do {
        run(l);
        ++rounds;
        spent = clock_seconds() - start;
    } while (spent < MEASURED_SECONDS);
    return 1e9 * spent / ((double)rounds * BATCH);
}

typedef struct cost_text {
    char text[120];
} cost_text;

static cost_text include_text(const check_answer *answer)
{
    cost_text t = {""};
    if (!isnan(answer->include_ns))
        snprintf(t.text, sizeof t.text, " and include %.3g", answer->include_ns);
    return t;
}

static cost_text pairs_text(const subject *s, const check_answer *answer)
{
    cost_text t = {""};
    char count[2][24];
    for (int k = 0; k < 2; ++k) {
        snprintf(count[k], sizeof count[k], "over %d", REACH_MOST);
        if (!isnan(answer->pairs[k])) snprintf(count[k], sizeof count[k], "%.0f", answer->pairs[k]);
    }
    if (s->n == 3)
        snprintf(t.text, sizeof t.text,
                 "; pairs tested with a plane 1e-3 and 1e-6 of its size away: %s, %s", count[0],
                 count[1]);
    return t;
}

void cost_check(const subject *s, uint64_t *random, double effort)
{
    static load l;
    check_answer *answer = s->answer;
    double at[BOX_DIMS];
    (void)effort;
    l.s = s;
    for (int k = 0; k < BATCH; ++k) {
        draw_point(random, &s->domain, s->n, l.p + k * s->n);
        for (int j = 0; j < BOX_DIMS; ++j) at[j] = random_between(random, 0, 1);
        l.where[k] = draw_around(&s->domain, s->n, at, 1.0 / 8);
        l.region[k] = imp_region_between(l.where[k].lo, l.where[k].hi);
    }
    const bool includes = s->n == 3 && s->instance->surface->include != NULL;
    answer->eval_ns = measure(&l, all_points);
    answer->rate_ns = measure(&l, all_rates);
    answer->include_ns = includes ? measure(&l, all_models) : NAN;
    answer->pairs[0] = reach_pairs(s, 1e-3);
    answer->pairs[1] = reach_pairs(s, 1e-6);
    answer_pass(answer, "eval %.3g ns per point, rate %.3g%s ns per region%s", answer->eval_ns,
                answer->rate_ns, include_text(answer).text, pairs_text(s, answer).text);
}
