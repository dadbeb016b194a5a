/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/domain.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "tools/check/stated_formula.h"

/* --- The stated domain ------------------------------------------------------------------------ */

/* Ends are computed in double precision: a stated end may differ by this many doubles. */
#define END_ULPS 4

static bool is_end(const subject *s, int j, double found, ld_interval stated, const char *which)
{
    const double size = fabs(s->domain.lo[j]) + fabs(s->domain.hi[j]);
    const long double slack = END_ULPS * DBL_EPSILON * (long double)size;
    ++s->answer->tests;
    return (found >= stated.lo - slack && found <= stated.hi + slack) ||
           answer_fail_for(s->answer, FAULT_DOMAIN, "%c %s at %.17g, but is said to %s at %.17Lg",
                           (s->n == 3 ? "uvt" : "xyzt")[j], which, found,
                           which[0] == 'e' ? "end" : "begin", stated.lo);
}

static bool is_as_stated(const subject *s)
{
    char fault[240];
    said_domain d;
    if (!said_domain_read(&d, s->registry, s->type, s->stage, s->said_domain, fault, sizeof fault))
        return answer_fail(s->answer, "the domain cannot be read: %s", fault);
    for (int k = 0; k < d.count; ++k) {
        const int j = s->n == 3 ? k : 3;
        if (!is_end(s, j, s->domain.lo[j], d.lo[k], "begins") ||
            !is_end(s, j, s->domain.hi[j], d.hi[k], "ends"))
            return false;
    }
    return true;
}

/* --- Seams ------------------------------------------------------------------------------------ */

enum { LINES = 48, STEPS = 16 };

/* Ends that are farther apart than rounding explains, but nearer than this, were probably meant to
 * meet. In sizes of the surface. */
#define SEAM_LEAST 1e-10
#define SEAM_MOST 1e-2

static double distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The distance between the ends of a line along j, and the largest distance from its first end. */
static bool measure_line(const subject *s, uint64_t *random, int j, double *apart, double *away)
{
    double p[(STEPS + 1) * BOX_DIMS], x[(STEPS + 1) * 3], error[(STEPS + 1) * 3];
    draw_point(random, &s->domain, s->n, p);
    for (int k = 0; k <= STEPS; ++k) {
        memcpy(p + 3 * k, p, 3 * sizeof *p);
        p[3 * k + j] = s->domain.lo[j] + (s->domain.hi[j] - s->domain.lo[j]) * k / STEPS;
    }
    p[3 * STEPS + j] = s->domain.hi[j];
    p[j] = s->domain.lo[j];
    if (!subject_eval_sane(s, STEPS + 1, p, x, error)) return false;
    for (int k = 1; k <= STEPS; ++k) *away = fmax(*away, distance(x, x + 3 * k));
    *apart = fmax(*apart, distance(x, x + 3 * STEPS));
    ++s->answer->tests;
    return true;
}

static void point_out_seam(const subject *s, uint64_t *random, int j)
{
    double apart = 0, away = 0;
    for (int k = 0; k < LINES; ++k)
        if (!measure_line(s, random, j, &apart, &away)) return;
    if (apart > SEAM_LEAST * away && apart < SEAM_MOST * away)
        answer_note(s->answer,
                    "the ends of %c, %.17g and %.17g, almost meet: they are up to %.3g apart, of "
                    "%.3g in all; is one of them rounded? --domain states the domain",
                    "uv"[j], s -> domain.lo[j], s->domain.hi[j], apart, away);
}

void domain_check(const subject *s, uint64_t *random, double effort)
{
    (void)effort;
    if (s->said_domain != NULL) {
        if (is_as_stated(s)) answer_pass(s->answer, "as stated");
        return;
    }
    for (int j = 0; j < 2 && s->n == 3; ++j) point_out_seam(s, random, j);
    answer_pass(s->answer, "no ends that almost meet; --domain states the domain");
}
