/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/pair.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

/* Lemma. All numbers are doubles, so one difference of two is rounded once in long double, and the
 * expressions below are sums of at most four non-negative terms, each of at most three roundings.
 * Every computed sum is thus within the factor 1 -+ 8 LDBL_EPSILON of the exact one; ROUNDING is
 * twice that. Nothing underflows, for products of two doubles are normal long doubles where that
 * is the x87 format, and where it is not, what is lost is below 2^-1074, which `tiny` covers. */
static const long double ROUNDING = 16 * LDBL_EPSILON;
static const long double tiny = 0x1p-1070L;

/* Returns a lower bound of the change of f from a to b. */
static long double change_lower(int i, const evaluated *a, const evaluated *b)
{
    const long double apart = fabsl((long double)a->x[i] - b->x[i]);
    const long double errors = (long double)a->error[i] + b->error[i];
    return apart * (1 - ROUNDING) - errors * (1 + ROUNDING);
}

double pair_ratio(int n, int coordinate, const double rate[BOX_DIMS], const evaluated *a,
                  const evaluated *b)
{
    const long double change = change_lower(coordinate, a, b);
    long double allowed = 0;
    for (int j = 0; j < n; ++j)
        if (a->p[j] != b->p[j]) allowed += rate[j] * fabsl((long double)a->p[j] - b->p[j]);
    if (!(change > 0)) return 0;
    return (double)(change / (allowed * (1 + ROUNDING) + tiny));
}

double pair_slope(int coordinate, int j, const evaluated *a, const evaluated *b)
{
    const long double change = change_lower(coordinate, a, b);
    const long double step = fabsl((long double)a->p[j] - b->p[j]);
    return change > 0 && step > 0 ? (double)(change / step) : 0;
}

double pair_judge(const subject *s, const box *where, double rate[3][BOX_DIMS], uint64_t call,
                  const evaluated *a, const evaluated *b, pair_finding *worst)
{
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        const double ratio = pair_ratio(s->n, i, rate[i], a, b);
        if (ratio > largest) largest = ratio;
        if (!(ratio > worst->ratio)) continue;
        *worst = (pair_finding){
            .ratio = ratio, .coordinate = i, .where = *where, .a = *a, .b = *b, .call = call};
        memcpy(worst->rate, rate[i], sizeof worst->rate);
    }
    ++s->answer->tests;
    return largest;
}

enum { BATCH = 64 };

bool pair_evaluate(const subject *s, size_t count, evaluated *points)
{
    double p[BATCH * BOX_DIMS], x[BATCH * 3], error[BATCH * 3];
    assert(count > 0 && count <= BATCH);
    for (size_t k = 0; k < count; ++k)
        memcpy(p + k * (size_t)s->n, points[k].p, (size_t)s->n * sizeof *p);
    if (!subject_eval_sane(s, count, p, x, error)) return false;
    for (size_t k = 0; k < count; ++k) {
        memcpy(points[k].x, x + 3 * k, sizeof points[k].x);
        memcpy(points[k].error, error + 3 * k, sizeof points[k].error);
    }
    return true;
}

bool pair_conclude(const subject *s, const pair_finding *worst, const char *claim, unsigned faults)
{
    const int i = worst->coordinate;
    if (!(worst->ratio > 1)) return true;
    s->answer->blamed = worst->call;
    /* If the ratio is close to 1, the errors may be too small instead of the rates. */
    const char *or_errors = worst->ratio < 1 + 1e-6 ? " or eval's errors" : "";
    return answer_fail_for(
        s->answer, faults | (or_errors[0] != 0 ? FAULT_ERROR : 0),
        "%s%s are too small: %c is %.17g (error %g) at %s, and %.17g (error %g) at %s, %.9g times "
        "what (%.9g, %.9g, %.9g%s%.9g) allow over %s",
        claim, or_errors, "xyz"[i], worst -> a.x[i], worst->a.error[i],
        subject_point_text(s->n, worst->a.p).text, worst->b.x[i], worst->b.error[i],
        subject_point_text(s->n, worst->b.p).text, worst->ratio, worst->rate[0], worst->rate[1],
        worst->rate[2], s->n == 4 ? ", " : "; ", s->n == 4 ? worst->rate[3] : 0.0,
        subject_box_text(s->n, worst->where.lo, worst->where.hi).text);
}
