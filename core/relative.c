/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "relative.h"

/* Lemma (re-centring). In a node, s_t = (t - c) / d; over the window s_t = s0 + k w with
 * s0 = (mid - c) / d and k = half / d, abs(s0) + k <= 1 up to rounding. Substituting,
 *
 *   a + bt s_t + qtt s_t^2 = [a + bt s0 + qtt s0^2] + [k (bt + 2 qtt s0)] w + qtt k^2 w^2
 *   bu s_u + qut s_u s_t   = [bu + qut s0] s_u + [qut k] s_u w      (v alike)
 *
 * The term in w^2 has no place in the form. As w^2 is 1/2 give or take 1/2, half of it goes to the
 * middle and half its size to the slack, weighted by the window. */
static void slice_at(const node *n, double mid, double half, slice *s, double *shift, double *drift,
                     double *slack)
{
    const double d = n->region.d[PARAMETER_T], c = n->region.c[PARAMETER_T];
    const double s0 = d > 0 ? (mid - c) / d : 0, k = d > 0 ? half / d : 0;
    const quadratic3 *f = &n->f;
    for (int i = 0; i < 3; ++i) {
        s->bu[i] = f->bu[i] + f->qut[i] * s0;
        s->bv[i] = f->bv[i] + f->qvt[i] * s0;
        s->quw[i] = f->qut[i] * k;
        s->qvw[i] = f->qvt[i] * k;
        s->quu[i] = f->quu[i];
        s->quv[i] = f->quv[i];
        s->qvv[i] = f->qvv[i];
        const double bow = 0.5 * (k * k) * f->qtt[i];
        shift[i] = (f->bt[i] + f->qtt[i] * s0) * s0 + bow;
        drift[i] = k * (f->bt[i] + 2 * f->qtt[i] * s0);
        slack[i] = n->e[i] + fabs(bow);
    }
    s->normal = vec3_cross(vec3_from(s->bu), vec3_from(s->bv));
}

static double slice_magnitude(const slice *s, int i)
{
    return fabs(s->bu[i]) + fabs(s->bv[i]) + fabs(s->quu[i]) + fabs(s->quv[i]) + fabs(s->qvv[i]) +
           (fabs(s->quw[i]) + fabs(s->qvw[i]));
}

/* Lemma (its rounding). With u = 2^-53 and abs(s0) + k <= 1: s0 is off by 2 u, k by u. Then shift
 * is off by at most 5 u abs(bt) + 11 u abs(qtt), their difference by u more of each, apart by u
 * abs(apart), drift by 3 u abs(bt) + 7 u abs(qtt), each slope by 3 u abs(q.t), what turns it by 2 u
 * abs(q.t), and the slopes, like delta, by u of the result; slack by 4 u of itself. Together below
 * 16 u (abs(bt) + 2 abs(qtt) + abs(qut) + abs(qvt) of both + abs(apart)), which is added to the
 * slack, plus 4 u of the magnitude of what comes out, which users of it count. Large motions and
 * far places thus cost u of themselves, once, before they cancel. */
void relative_at(const node *a, const node *b, const time_window *window, relative *r)
{
    double shift_a[3], shift_b[3], drift_a[3], drift_b[3], slack_a[3], slack_b[3];
    r->mid = 0.5 * window->lo + 0.5 * window->hi;
    const double above = window->hi - r->mid, below = r->mid - window->lo;
    const double reach = above > below ? above : below;
    r->half = reach + reach * 0x1p-51;
    slice_at(a, r->mid, r->half, &r->a, shift_a, drift_a, slack_a);
    slice_at(b, r->mid, r->half, &r->b, shift_b, drift_b, slack_b);
    for (int i = 0; i < 3; ++i) {
        const double apart = b->f.a[i] - a->f.a[i];
        r->delta[i] = apart + (shift_b[i] - shift_a[i]);
        r->drift[i] = drift_b[i] - drift_a[i];
        r->slack[i] =
            (slack_a[i] + slack_b[i]) + 0x1p-49 * (fabs(apart) + (a->motion[i] + b->motion[i]));
        r->magnitude[i] = r->slack[i] + fabs(r->delta[i]) + fabs(r->drift[i]) +
                          (slice_magnitude(&r->a, i) + slice_magnitude(&r->b, i));
    }
}

/* Keeps the w with low + drift w <= limit. The division and the difference are each off by 2^-53; a
 * w of abs(w) <= 1 is moved outward by 2^-50. NaN keeps everything. */
bool share_cut(share *s, double low, double drift, double limit)
{
    if (low + fabs(drift) <= limit) return true;
    if (low - fabs(drift) > limit) return false;
    const double w = (limit - low) / drift;
    if (drift > 0 && w + 0x1p-50 < s->hi) s->hi = w + 0x1p-50;
    if (drift < 0 && w - 0x1p-50 > s->lo) s->lo = w - 0x1p-50;
    return !(s->lo > s->hi);
}
