/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/poses.h"

#include <float.h>
#include <impinge/formula.h>
#include <math.h>
#include <stdio.h>

enum { SPANS = 1000, TIMES = 5, ENTRIES = 12 };

/* Entry k of a pose: the twelve of turn and shift, row by row; [3] is the shift's. */
static const imp_model *entry_of(const imp_pose *pose, int i, int j)
{
    return j < 3 ? &pose->turn[i][j] : &pose->shift[i];
}

static subject_text name_of(int i, int j)
{
    subject_text name;
    if (j < 3)
        snprintf(name.text, sizeof name.text, "turn[%d][%d]", i, j);
    else
        snprintf(name.text, sizeof name.text, "shift[%d]", i);
    return name;
}

static subject_text times_text(const imp_region *span)
{
    subject_text text;
    snprintf(text.text, sizeof text.text, "t in [%.17g, %.17g]", span->lo[2], span->hi[2]);
    return text;
}

/* --- Form ------------------------------------------------------------------------------------- */

static const char *fault_of_form(const imp_model *m)
{
    if ((m->depends & 3u) != 0 || m->b[0] != 0 || m->b[1] != 0) return "depends on more than t";
    for (int k = 0; k < IMP_TT; ++k)
        if (m->q[k] != 0) return "depends on more than t";
    if (!(isfinite(m->a) && isfinite(m->b[2]) && isfinite(m->q[IMP_TT])))
        return "has a coefficient that is not finite";
    if (!(m->e >= 0 && m->e < INFINITY)) return "has a remainder that is negative or not finite";
    if (!(m->lo <= m->hi && m->lo > -INFINITY && m->hi < INFINITY))
        return "has a range that is inverted or not finite";
    if (!(m->rate[2] >= 0 && m->rate[2] < INFINITY))
        return "has a rate that is negative or not finite";
    return NULL;
}

static bool judge_form(const subject *s, const imp_region *span, const imp_pose *pose)
{
    for (int k = 0; k < ENTRIES; ++k) {
        const char *fault = fault_of_form(entry_of(pose, k / 4, k % 4));
        if (fault != NULL)
            return answer_fail(s->answer, "%s of the pose over %s %s", name_of(k / 4, k % 4).text,
                               times_text(span).text, fault);
        if (!isfinite(pose->pivot[k / 4]))
            return answer_fail(s->answer, "the pivot of the pose over %s is not finite",
                               times_text(span).text);
    }
    return true;
}

/* --- Rotations -------------------------------------------------------------------------------- */

/* Returns the polynomial of an entry; sizes of its terms bound its rounding by 8 LDBL_EPSILON of
 * them. */
static long double value_at(const imp_model *m, long double at)
{
    return m->a + at * (m->b[2] + at * m->q[IMP_TT]);
}

/* Returns whether the pose's direction may be one that the turn leaves as it is. */
static bool judge_fixed(const subject *s, const imp_region *span, const imp_pose *pose, double t)
{
    const long double d = span->d[2], at = d > 0 ? (t - (long double)span->c[2]) / d : 0;
    for (int i = 0; i < 3; ++i) {
        long double sum = -(long double)pose->fixed[i], e = 0, size = fabsl(sum);
        for (int j = 0; j < 3; ++j) {
            sum += value_at(&pose->turn[i][j], at) * pose->fixed[j];
            e += pose->turn[i][j].e * fabsl((long double)pose->fixed[j]);
            size += 3 * fabsl((long double)pose->fixed[j]);
        }
        ++s->answer->tests;
        if (fabsl(sum) > e + 64 * LDBL_EPSILON * size)
            return answer_fail(
                s->answer,
                "the pose over %s says that it leaves the direction %.9g, %.9g, %.9g "
                "fixed; at t = %.17g it turns it by %.3Lg in %c",
                times_text(span).text, pose->fixed[0], pose->fixed[1], pose->fixed[2], t, sum,
                "xyz"[i]);
    }
    return true;
}

/* `off` is how far the product is from that of a rotation's columns, which is 1 or 0. */
static bool refute_rotation(const subject *s, const imp_region *span, int j, int k, long double off,
                            long double slack)
{
    const char *what = j == k ? "the square of a column's length" : "the product of two columns";
    return answer_fail_for(
        s->answer, FAULT_VALUE,
        "turn is no rotation over %s: %s (%d, %d) is off %d by %.9Lg, and allowed is "
        "%s",
        times_text(span).text, what, j, k, j == k, off,
        slack > 0 ? "IMP_RIGID_SLACK, 2^-16"
                  : "nothing but rounding, for the flag IMP_FLAG_TURNS_EXACTLY claims an "
                    "exact one");
}

/* With entries r, each within e of the truth, the rows' products are within sum_k (|r| e' + |r'| e
 * + e e') of the true ones; likewise the determinant, whose terms are products of three. */
static bool judge_rotation(const subject *s, const imp_region *span, const imp_pose *pose,
                           long double at)
{
    long double r[3][3], worst = 0, size = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            r[i][j] = value_at(&pose->turn[i][j], at);
            worst = fmaxl(worst, pose->turn[i][j].e);
            size = fmaxl(size, fabsl(r[i][j]));
        }
    const long double off = 3 * (2 * size * worst + worst * worst) + 0x1p-40L * (1 + size * size);
    const bool is_exact = (s->instance->map->flags & IMP_FLAG_TURNS_EXACTLY) != 0;
    const long double slack = is_exact ? 0 : (long double)IMP_RIGID_SLACK;
    ++s->answer->tests;
    for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) {
            const long double product =
                r[0][j] * r[0][k] + r[1][j] * r[1][k] + r[2][j] * r[2][k] - (j == k);
            if (fabsl(product) > slack + off) return refute_rotation(s, span, j, k, product, slack);
        }
    const long double det = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                            r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                            r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    if (det < -(6 * powl(size + worst, 2) * 3 * worst + 0x1p-40L))
        return answer_fail_for(s->answer, FAULT_VALUE,
                               "the pose's turn has the determinant %.9Lg within %s, not 1", det,
                               times_text(span).text);
    return true;
}

/* --- Entries ---------------------------------------------------------------------------------- */

/* The entries of a pose as images show them, each within `error`. */
typedef struct seen_pose {
    double t;
    long double entry[3][4], error[3][4];
} seen_pose;

/* The images of the pivot and of a point at a distance of `step` from it along each axis. */
static bool see(const subject *s, const imp_pose *pose, double t, seen_pose *seen)
{
    double x[4][3], error[4][3], step[3];
    for (int k = 0; k < 4; ++k) {
        const int j = (k + 3) % 4;
        double p[4] = {pose->pivot[0], pose->pivot[1], pose->pivot[2], t};
        if (j < 3) {
            p[j] += ldexp(1, ilogb(fmax(1, fabs(p[j]))));
            step[j] = p[j] - pose->pivot[j];
            if (pose->pivot[j] + step[j] != p[j]) return false;
        }
        if (!subject_eval_sane(s, 1, p, x[j], error[j])) return false;
    }
    seen->t = t;
    for (int i = 0; i < 3; ++i) {
        seen->entry[i][3] = x[3][i];
        seen->error[i][3] = error[3][i];
        for (int j = 0; j < 3; ++j) {
            seen->entry[i][j] = ((long double)x[j][i] - x[3][i]) / step[j];
            seen->error[i][j] = ((long double)error[j][i] + error[3][i]) / step[j] * 1.0001L +
                                8 * LDBL_EPSILON * fabsl(seen->entry[i][j]);
        }
    }
    return true;
}

static bool judge_entry(const subject *s, const imp_region *span, const imp_pose *pose, int i,
                        int j, const seen_pose *seen, const seen_pose *other)
{
    const imp_model *m = entry_of(pose, i, j);
    const long double d = span->d[2], at = d > 0 ? (seen->t - (long double)span->c[2]) / d : 0;
    const long double is = seen->entry[i][j], slack = seen->error[i][j], says = value_at(m, at);
    const long double size = fabsl(m->a) + fabsl(m->b[2]) + fabsl(m->q[IMP_TT]);
    const long double off = fabsl(is - says) - slack - 64 * LDBL_EPSILON * size;
    const long double moved = fabsl(is - other->entry[i][j]) - slack - other->error[i][j];
    const long double may = m->rate[2] * fabsl((long double)seen->t - other->t);
    s->answer->tests += 3;
    if (off > m->e)
        return answer_fail_for(
            s->answer, FAULT_REMAINDER | FAULT_ERROR,
            "%s is %.17Lg at t=%.17g, %.9Lg off the pose, whose remainder is %.9g "
            "over %s",
            name_of(i, j).text, is, seen->t, off, m->e, times_text(span).text);
    if (is + slack < m->lo || is - slack > m->hi)
        return answer_fail_for(
            s->answer, FAULT_REMAINDER | FAULT_ERROR,
            "%s is %.17Lg at t=%.17g, outside of the range [%.17g, %.17g] that the "
            "pose has over %s",
            name_of(i, j).text, is, seen->t, m->lo, m->hi, times_text(span).text);
    if (moved > may * (1 + 8 * LDBL_EPSILON))
        return answer_fail_for(
            s->answer, FAULT_RATE | FAULT_ERROR,
            "%s changes by %.9Lg from t=%.17g to t=%.17g, and the pose's rate %.9g "
            "allows %.9Lg",
            name_of(i, j).text, moved, seen->t, other->t, m->rate[2], may);
    return true;
}

/* --- Points ----------------------------------------------------------------------------------- */

/* The image of any point lies where the pose puts it. */
static bool judge_image(const subject *s, uint64_t *random, const imp_region *span,
                        const imp_pose *pose, double t)
{
    double p[4], x[3], error[3];
    const long double d = span->d[2], at = d > 0 ? (t - (long double)span->c[2]) / d : 0;
    draw_point(random, &s->domain, 4, p);
    p[3] = t;
    if (!subject_eval_sane(s, 1, p, x, error)) return false;
    for (int i = 0; i < 3; ++i) {
        long double sum = value_at(&pose->shift[i], at), e = pose->shift[i].e, size = fabsl(sum);
        for (int j = 0; j < 3; ++j) {
            const long double z = (long double)p[j] - pose->pivot[j];
            sum += value_at(&pose->turn[i][j], at) * z;
            e += pose->turn[i][j].e * fabsl(z);
            size += 3 * fabsl(z);
        }
        const long double off = fabsl(x[i] - sum) - error[i] - 64 * LDBL_EPSILON * size;
        ++s->answer->tests;
        if (off > e)
            return answer_fail_for(
                s->answer, FAULT_REMAINDER | FAULT_ERROR | FAULT_VALUE,
                "%c is %.17g at %s, %.9Lg off the place where the pose over %s puts "
                "it, within %.9Lg",
                "xyz"[i], x[i], subject_point_text(4, p).text, off, times_text(span).text, e);
    }
    return true;
}

/* --- The check -------------------------------------------------------------------------------- */

static bool judge_span(const subject *s, uint64_t *random)
{
    const box where = draw_box(random, &s->domain, 4);
    const imp_region span = subject_span(&where);
    imp_pose pose;
    const imp_status status = subject_pose(s, &span, &pose);
    if (status == IMP_STATUS_UNBOUNDED) return true;
    if (status != IMP_STATUS_OK)
        return answer_fail(s->answer, "rigid returned '%s' over %s", subject_status_name(status),
                           times_text(&span).text);
    if (!judge_form(s, &span, &pose)) return false;
    for (int k = 0; k < TIMES; ++k) {
        double time[2];
        seen_pose seen[2];
        for (int n = 0; n < 2; ++n) {
            const double at = span.c[2] + span.d[2] * draw_normalized(random);
            time[n] = at < span.lo[2] ? span.lo[2] : at > span.hi[2] ? span.hi[2] : at;
        }
        const long double at = span.d[2] > 0 ? ((long double)time[0] - span.c[2]) / span.d[2] : 0;
        if (!judge_rotation(s, &span, &pose, at)) return false;
        if (!see(s, &pose, time[0], &seen[0]) || !see(s, &pose, time[1], &seen[1]))
            return s->answer->verdict != CHECK_FAIL;
        for (int n = 0; n < ENTRIES; ++n)
            if (!judge_entry(s, &span, &pose, n / 4, n % 4, &seen[0], &seen[1])) return false;
        if (!judge_image(s, random, &span, &pose, time[0])) return false;
        if (!judge_fixed(s, &span, &pose, time[0])) return false;
    }
    return true;
}

void poses_check(const subject *s, uint64_t *random, double effort)
{
    if (!subject_is_rigid(s)) {
        answer_skip(s->answer, s->n == 3 ? "only maps have poses" : "the map has no pose");
        return;
    }
    const double count = SPANS * effort;
    for (int k = 0; (k < count || k == 0) && s->answer->verdict != CHECK_FAIL; ++k)
        judge_span(s, random);
    if (s->answer->verdict == CHECK_PASS && s->answer->tests == 0)
        answer_skip(s->answer, "it has no pose with these parameters");
}
