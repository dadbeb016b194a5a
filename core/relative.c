/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "relative.h"

#include "lanes.h"

/* Lemma (re-centring). In a node, s_t = (t - c) / d; over the window s_t = s0 + k w with
 * s0 = (mid - c) / d and k = half / d, abs(s0) + k <= 1 up to rounding. Substituting,
 *
 *   a + bt s_t + qtt s_t^2 = [a + bt s0 + qtt s0^2] + [k (bt + 2 qtt s0)] w + qtt k^2 w^2
 *   bu s_u + qut s_u s_t   = [bu + qut s0] s_u + [qut k] s_u w      (v alike)
 *
 * The term in w^2 has no place in the form. As w^2 is 1/2 give or take 1/2, half of it goes to the
 * middle and half its size to the slack, weighted by the window. */
typedef struct moved {
    lanes shift, drift, slack;
    lanes magnitude; /* of the slice */
} moved;

LANES_INLINE moved slice_at(const node *n, double mid, double half, slice *s)
{
    const double d = n->region.d[PARAMETER_T], c = n->region.c[PARAMETER_T];
    const lanes s0 = lanes_all(d > 0 ? (mid - c) / d : 0), k = lanes_all(d > 0 ? half / d : 0);
    const quadratic3 *f = &n->f;
    const lanes bt = lanes_load(f->bt), qtt = lanes_load(f->qtt);
    const lanes qut = lanes_load(f->qut), qvt = lanes_load(f->qvt);
    const lanes bu = lanes_load(f->bu) + qut * s0, bv = lanes_load(f->bv) + qvt * s0;
    const lanes quu = lanes_load(f->quu), quv = lanes_load(f->quv), qvv = lanes_load(f->qvv);
    const lanes quw = qut * k, qvw = qvt * k, bow = lanes_all(0.5) * (k * k) * qtt;
    lanes_store(s->bu, bu);
    lanes_store(s->bv, bv);
    lanes_store(s->quu, quu);
    lanes_store(s->quv, quv);
    lanes_store(s->qvv, qvv);
    lanes_store(s->quw, quw);
    lanes_store(s->qvw, qvw);
    s->normal = vec3_cross(vec3_from(s->bu), vec3_from(s->bv));
    return (moved){(bt + qtt * s0) * s0 + bow, k * (bt + lanes_all(2) * qtt * s0),
                   lanes_load(n->e) + lanes_abs(bow),
                   lanes_abs(bu) + lanes_abs(bv) + lanes_abs(quu) + lanes_abs(quv) +
                       lanes_abs(qvv) + (lanes_abs(quw) + lanes_abs(qvw))};
}

/* Lemma (its rounding). With u = 2^-53 and abs(s0) + k <= 1: s0 is off by 2 u, k by u. Then shift
 * is off by at most 5 u abs(bt) + 11 u abs(qtt), their difference by u more of each, apart by u
 * abs(apart), drift by 3 u abs(bt) + 7 u abs(qtt), each slope by 3 u abs(q.t), what turns it by 2 u
 * abs(q.t), and the slopes, like delta, by u of the result; slack by 4 u of itself. Together below
 * 16 u (abs(bt) + 2 abs(qtt) + abs(qut) + abs(qvt) of both + abs(apart)), which is added to the
 * slack, plus 4 u of the magnitude of what comes out, which users of it count. Large motions and
 * far places thus cost u of themselves, once, before they cancel. */
LANES_INLINE void see(const node *a, const node *b, const time_window *window, relative *r)
{
    r->mid = 0.5 * window->lo + 0.5 * window->hi;
    const double above = window->hi - r->mid, below = r->mid - window->lo;
    const double reach = above > below ? above : below;
    r->half = reach + reach * 0x1p-51;
    const moved ma = slice_at(a, r->mid, r->half, &r->a), mb = slice_at(b, r->mid, r->half, &r->b);
    const lanes apart = lanes_load(b->f.a) - lanes_load(a->f.a);
    const lanes delta = apart + (mb.shift - ma.shift), drift = mb.drift - ma.drift;
    const lanes motion = lanes_load(a->motion) + lanes_load(b->motion);
    const lanes slack = (ma.slack + mb.slack) + lanes_all(0x1p-49) * (lanes_abs(apart) + motion);
    lanes_store(r->delta, delta);
    lanes_store(r->drift, drift);
    lanes_store(r->slack, slack);
    lanes_store(r->magnitude,
                slack + lanes_abs(delta) + lanes_abs(drift) + (ma.magnitude + mb.magnitude));
}

LANES_WIDE static void see_wide(const node *a, const node *b, const time_window *window,
                                relative *r)
{
    see(a, b, window, r);
}

void relative_at(const node *a, const node *b, const time_window *window, relative *r)
{
    if (lanes_are_wide())
        see_wide(a, b, window, r);
    else
        see(a, b, window, r);
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
