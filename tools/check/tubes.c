/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/tubes.h"

#include <float.h>
#include <impinge/formula.h>
#include <math.h>

enum { REGIONS = 1000, POINTS = 10 };

/* --- Form ------------------------------------------------------------------------------------- */

/* Returns what is wrong with a line's coordinate, or NULL. */
static const char *fault_of(const imp_model *m)
{
    double sum = fabs(m->a) + fabs(m->lo) + fabs(m->hi), of_v = 0;
    for (int j = 0; j < 3; ++j) sum += fabs(m->b[j]) + fabs(m->rate[j]);
    for (int k = 0; k < 6; ++k) sum += fabs(m->q[k]);
    of_v = fabs(m->b[1]) + fabs(m->q[IMP_UV]) + fabs(m->q[IMP_VV]) + fabs(m->q[IMP_VT]) +
           fabs(m->rate[1]);
    if (!isfinite(sum)) return "has a number that is not finite";
    if (!(m->e >= 0 && isfinite(m->e))) return "has a remainder that is negative or not finite";
    if (!(m->lo <= m->hi)) return "has an inverted range";
    if (!(m->rate[0] >= 0 && m->rate[2] >= 0)) return "has a negative rate";
    return of_v != 0 || (m->depends & 2u) != 0 ? "depends on v" : NULL;
}

static bool judge_form(const subject *s, const imp_region *region, const imp_tube *tube)
{
    const char *fault = NULL;
    for (int i = 0; i < 3 && fault == NULL; ++i) fault = fault_of(&tube->line[i]);
    if (fault == NULL && !(tube->radius >= 0 && isfinite(tube->radius)))
        fault = "has a radius that is negative or not finite";
    return fault == NULL || answer_fail(s->answer, "the tube over %s %s",
                                        subject_box_text(3, region->lo, region->hi).text, fault);
}

/* --- Points ----------------------------------------------------------------------------------- */

/* How far a coordinate is from the line's polynomial at s, less what the line's remainder, the
 * point's error and rounding explain; long double's roundings are far below those of doubles. */
static long double off_line(const imp_model *m, const double at[3], double x, double error)
{
    const long double u = at[0], t = at[2];
    const long double b = m->b[0] * u + m->b[2] * t;
    const long double q = m->q[IMP_UU] * u * u + m->q[IMP_UT] * u * t + m->q[IMP_TT] * t * t;
    const long double size = fabs(m->a) + fabs(m->b[0]) + fabs(m->b[2]) + fabs(m->q[IMP_UU]) +
                             fabs(m->q[IMP_UT]) + fabs(m->q[IMP_TT]) + fabs(x);
    const long double off = fabsl(x - (m->a + b + q)) - m->e - error - 64 * LDBL_EPSILON * size;
    return off > 0 ? off : 0;
}

static bool judge_point(const subject *s, const imp_region *r, const imp_tube *tube,
                        const double p[3], const double at[3], const double x[3],
                        const double error[3])
{
    long double square = 0;
    for (int i = 0; i < 3; ++i) {
        const long double off = off_line(&tube->line[i], at, x[i], error[i]);
        square += off * off;
    }
    const long double off = sqrtl(square) * (1 - 16 * LDBL_EPSILON);
    ++s->answer->tests;
    return off <= tube->radius ||
           answer_fail_for(s->answer, FAULT_REMAINDER | FAULT_ERROR,
                           "the tube claims at most %.17g from its line, but at %s the surface is "
                           "%.9Lg away from the line over %s",
                           tube->radius, subject_point_text(3, p).text, off,
                           subject_box_text(3, r->lo, r->hi).text);
}

static bool judge(const subject *s, uint64_t *random)
{
    const box where = draw_box(random, &s->domain, 3);
    const imp_region region = imp_region_between(where.lo, where.hi);
    imp_tube tube;
    const imp_status status = subject_tube(s, &region, &tube);
    if (status == IMP_STATUS_UNBOUNDED) return true;
    if (status != IMP_STATUS_OK)
        return answer_fail(s->answer, "tube returned '%s' over %s", subject_status_name(status),
                           subject_box_text(3, region.lo, region.hi).text);
    if (!judge_form(s, &region, &tube)) return false;
    for (int k = 0; k < POINTS; ++k) {
        double p[3], at[3], x[3], error[3];
        draw_point(random, &where, 3, p);
        p[1] = random_between(random, s->domain.lo[1], s->domain.hi[1]);
        for (int j = 0; j < 3; ++j)
            at[j] = region.d[j] > 0 ? (p[j] - region.c[j]) / region.d[j] : 0;
        if (!subject_eval_sane(s, 1, p, x, error)) return false;
        if (!judge_point(s, &region, &tube, p, at, x, error)) return false;
    }
    return true;
}

void tubes_check(const subject *s, uint64_t *random, double effort)
{
    if (s->n != 3 || !subject_has_tube(s)) {
        answer_skip(s->answer, "it has no tubes");
        return;
    }
    const int count = (int)(effort * REGIONS) + 1;
    for (int k = 0; k < count; ++k)
        if (!judge(s, random)) return;
}
