/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/points.h"

#include <impinge/formula.h>

#include <math.h>
#include <string.h>

#include "tools/check/pair.h"

/* --- Finite ----------------------------------------------------------------------------------- */

static bool is_sane_at(const subject *s, const double *p)
{
    double x[3], error[3], rate[3][BOX_DIMS];
    box point = {.lo = {0}};
    memcpy(point.lo, p, (size_t)s->n * sizeof *p);
    point.hi[0] = point.lo[0], point.hi[1] = point.lo[1];
    point.hi[2] = point.lo[2], point.hi[3] = point.lo[3];
    if (!subject_eval_sane(s, 1, p, x, error)) return false;
    subject_rate_sane(s, &point, rate);
    s->answer->tests += 2;
    return s->answer->verdict != CHECK_FAIL;
}

/* Returns a parameter at its lower end, one double above, in the middle, one below the upper end,
 * there. */
static double place(const box *d, int j, int which)
{
    const double lo = d->lo[j], hi = d->hi[j];
    const double ends[5] = {lo, nextafter(lo, hi), 0.5 * lo + 0.5 * hi, nextafter(hi, lo), hi};
    return ends[which];
}

static bool corners_are_sane(const subject *s)
{
    int all = 1;
    for (int j = 0; j < s->n; ++j) all *= 5;
    for (int k = 0; k < all; ++k) {
        double p[BOX_DIMS] = {0};
        for (int j = 0, rest = k; j < s->n; ++j, rest /= 5) p[j] = place(&s->domain, j, rest % 5);
        if (!is_sane_at(s, p)) return false;
    }
    return true;
}

/* --- Holes ------------------------------------------------------------------------------------ */

enum { BATCH = 64, DESCENTS = 12 };

/* Each pair of special values in the first two numbers, special values in the others. */
static bool special_points_are_sane(const subject *s, uint64_t *random)
{
    static double value[BOX_DIMS][SPECIAL_MAX];
    double p[BATCH * BOX_DIMS], x[BATCH * 3], error[BATCH * 3];
    int count[BOX_DIMS];
    size_t waiting = 0;
    for (int j = 0; j < s->n; ++j)
        count[j] = special_values(s->domain.lo[j], s->domain.hi[j], value[j]);
    for (int k = 0; k < count[0] * count[1]; ++k) {
        double *at = p + waiting * (size_t)s->n;
        at[0] = value[0][k % count[0]];
        at[1] = value[1][k / count[0]];
        for (int j = 2; j < s->n; ++j) at[j] = value[j][draw_index(random, (size_t)count[j])];
        if (++waiting < BATCH && k + 1 < count[0] * count[1]) continue;
        if (!subject_eval_sane(s, waiting, p, x, error)) return false;
        s->answer->tests += waiting;
        waiting = 0;
    }
    return true;
}

/* Halves of regions without rates, down to neighbouring doubles: there a division by 0 occurs, or
 * nothing. */
static bool descend(const subject *s, uint64_t *random)
{
    double rate[3][BOX_DIMS];
    box where = s->domain;
    for (int step = 0; step < 60 * s->n; ++step) {
        const int j = step % s->n;
        const double middle = 0.5 * where.lo[j] + 0.5 * where.hi[j];
        const bool upper = draw_index(random, 2) > 0;
        for (int k = 0; k < 2; ++k) {
            box half = where;
            *(upper == (k == 0) ? &half.lo[j] : &half.hi[j]) = middle;
            const bool last = k == 1;
            if (!last && subject_rate(s, &half, rate) != IMP_STATUS_UNBOUNDED) continue;
            where = half;
            break;
        }
    }
    if (subject_rate(s, &where, rate) != IMP_STATUS_UNBOUNDED) return true;
    return is_sane_at(s, where.lo) && is_sane_at(s, where.hi);
}

static void seek_holes(const subject *s, uint64_t *random)
{
    double rate[3][BOX_DIMS];
    if (!special_points_are_sane(s, random)) return;
    if (subject_rate(s, &s->domain, rate) != IMP_STATUS_UNBOUNDED) return;
    for (int k = 0; k < DESCENTS; ++k)
        if (!descend(s, random)) return;
}

/* ---------------------------------------------------------------------------------------------- */

void finite_check(const subject *s, uint64_t *random, double effort)
{
    double rate[3][BOX_DIMS];
    if (!corners_are_sane(s)) return;
    subject_rate_sane(s, &s->domain, rate);
    seek_holes(s, random);
    for (int k = 0; k < 500 * effort && s->answer->verdict != CHECK_FAIL; ++k) {
        double p[BOX_DIMS];
        const box where = draw_box(random, &s->domain, s->n);
        draw_point(random, &where, s->n, p);
        subject_rate_sane(s, &where, rate);
        is_sane_at(s, p);
    }
}

/* --- Errors ----------------------------------------------------------------------------------- */

enum { CLUSTERS = 600, NEIGHBOURS = 12 };

/* `steps` doubles away from x, but not outside. */
static double step_away(double x, int steps, double lo, double hi)
{
    for (; steps > 0 && x < hi; --steps) x = nextafter(x, hi);
    for (; steps < 0 && x > lo; ++steps) x = nextafter(x, lo);
    return x;
}

/* Neighbours within some doubles of p, along all dimensions or one, and the box around them. */
static void draw_cluster(const subject *s, uint64_t *random, evaluated points[NEIGHBOURS],
                         box *around)
{
    double p[BOX_DIMS];
    const size_t only = draw_index(random, (size_t)s->n + 1), reach = 1u << draw_index(random, 5);
    draw_point(random, &s->domain, s->n, p);
    for (int j = 0; j < s->n; ++j) around->lo[j] = around->hi[j] = p[j];
    for (int k = 0; k < NEIGHBOURS; ++k)
        for (int j = 0; j < s->n; ++j) {
            const int steps = (int)draw_index(random, 2 * reach + 1) - (int)reach;
            const bool moves = only == (size_t)s->n || only == (size_t)j;
            const double x =
                moves ? step_away(p[j], steps, s->domain.lo[j], s->domain.hi[j]) : p[j];
            points[k].p[j] = x;
            if (x < around->lo[j]) around->lo[j] = x;
            if (x > around->hi[j]) around->hi[j] = x;
        }
}

static bool judge_cluster(const subject *s, uint64_t *random)
{
    evaluated points[NEIGHBOURS];
    box around = {.lo = {0}};
    double rate[3][BOX_DIMS];
    pair_finding worst = {.ratio = 0};
    memset(points, 0, sizeof points);
    draw_cluster(s, random, points, &around);
    if (!subject_rate_sane(s, &around, rate) || !pair_evaluate(s, NEIGHBOURS, points))
        return s->answer->verdict != CHECK_FAIL;
    for (int k = 0; k < NEIGHBOURS; ++k)
        for (int l = 0; l < k; ++l)
            pair_judge(s, &around, rate, s->answer->rate_call, &points[k], &points[l], &worst);
    return pair_conclude(s, &worst, "between neighbouring doubles, eval's errors or the rates",
                         FAULT_RATE | FAULT_ERROR | FAULT_RANGE);
}

/* The range of a region that is one point contains the value, and so does eval's result with its
 * error. */
static bool judge_against_inclusion(const subject *s, uint64_t *random)
{
    double p[BOX_DIMS], x[3], error[3];
    imp_model model[3];
    draw_point(random, &s->domain, s->n, p);
    const imp_region region = imp_region_between(p, p);
    if (subject_include(s, &region, model) != IMP_STATUS_OK) return true;
    if (!subject_eval_sane(s, 1, p, x, error)) return false;
    for (int i = 0; i < 3; ++i) {
        const long double value = x[i], slack = 0x1p-62L * fabsl(value);
        ++s->answer->tests;
        if (value + error[i] + slack < model[i].lo || value - error[i] - slack > model[i].hi)
            return answer_fail_for(
                s->answer, FAULT_ERROR | FAULT_RANGE,
                "%c is %.17g by eval (error %g) and in [%.17g, %.17g] by include, at "
                "%s: one of the two is wrong",
                "xyz"[i], x[i], error[i], model[i].lo, model[i].hi, subject_point_text(3, p).text);
    }
    return true;
}

void errors_check(const subject *s, uint64_t *random, double effort)
{
    const bool includes = s->n == 3 && s->instance->surface->include != NULL;
    for (int k = 0; k < CLUSTERS * effort || k == 0; ++k) {
        if (!judge_cluster(s, random)) return;
        if (includes && !judge_against_inclusion(s, random)) return;
    }
}
