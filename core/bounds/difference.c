/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/difference.h"

#include "core/bounds/tuning.h"
#include "core/tree/posed_terms.h"
#include "core/tree/triple.h"

#include <impinge/quad.h>

/* Lemma (re-centring). In a node, s_t = (t - c) / d; over the window s_t = s0 + k w with
 * s0 = (mid - c) / d and k = half / d, abs(s0) + k <= 1 up to rounding. Substituting,
 *
 *   a + bt s_t + qtt s_t^2 = [a + bt s0 + qtt s0^2] + [k (bt + 2 qtt s0)] w + qtt k^2 w^2
 *   bu s_u + qut s_u s_t   = [bu + qut s0] s_u + [qut k] s_u w      (v alike) */
typedef struct moved {
    imp_quad shift, drift, bend;
    imp_quad magnitude; /* of the slice */
    imp_quad squares;   /* of s_u and s_v: sum of their |coefficients| */
} moved;

IMP_QUAD_INLINE moved slice_at(const node *n, double mid, double half, slice *s)
{
    const double d = n->region.d[PARAMETER_T], c = n->region.c[PARAMETER_T];
    const imp_quad s0 = imp_quad_all(d > 0 ? (mid - c) / d : 0),
                   k = imp_quad_all(d > 0 ? half / d : 0);
    const quadratic3 *f = &n->f;
    const imp_quad bt = triple_load(f->bt), qtt = triple_load(f->qtt);
    const imp_quad qut = triple_load(f->qut), qvt = triple_load(f->qvt);
    const imp_quad bu = triple_load(f->bu) + qut * s0, bv = triple_load(f->bv) + qvt * s0;
    const imp_quad quu = triple_load(f->quu), quv = triple_load(f->quv), qvv = triple_load(f->qvv);
    const imp_quad quw = qut * k, qvw = qvt * k;
    imp_quad_store(s->bu, bu);
    imp_quad_store(s->bv, bv);
    imp_quad_store(s->quu, quu);
    imp_quad_store(s->quv, quv);
    imp_quad_store(s->qvv, qvv);
    imp_quad_store(s->quw, quw);
    imp_quad_store(s->qvw, qvw);
    const imp_quad normal = imp_quad_cross(bu, bv);
    memcpy(s->normal.x, &normal, sizeof s->normal.x);
    return (moved){(bt + qtt * s0) * s0, k * (bt + imp_quad_all(2) * qtt * s0), (k * k) * qtt,
                   imp_quad_abs(bu) + imp_quad_abs(bv) + imp_quad_abs(quu) + imp_quad_abs(quv) +
                       imp_quad_abs(qvv) + (imp_quad_abs(quw) + imp_quad_abs(qvw)),
                   imp_quad_abs(quu) + imp_quad_abs(qvv)};
}

static void slice_clear_third_order(slice *s)
{
    for (int i = 0; i < 4; ++i) s->uuw[i] = s->uvw[i] = s->vvw[i] = 0;
}

/* Lemma (terms of third order). With s = s0 + k w as above, and with w^2 = 1/2 +- 1/2,
 *
 *   uut s (su^2 - 1/2) = (s0 + k w) uut su^2 - (s0 + k w) uut / 2          (vvt alike)
 *   uvt s su sv        = (s0 + k w) uvt su sv
 *   utt (s^2 - 1/2) su = (s0^2 - 1/2 + k^2 / 2 + 2 s0 k w) utt su +- k^2 |utt| / 2   (vtt alike)
 *
 * Its rounding, in units of u of the vector's size, s0 being off by 2 u and k by u:
 *
 *              |uut|   |uvt|   |utt|                                    |bt|, 2 |qtt|   the result
 *   quu, quv       3       3                  s0 2, product 1                                  1
 *   uuw, uvw       2       2                  k 1, product 1
 *   shift          3                          s0 2, sum 1, product 1, sum 1; by 1/2       1
 *   drift          3                          k 1, sum 1, product 1, sum 1; by 1/2        1
 *   bu                            12          s0^2 5, k^2 / 2 3, sums 2, product 1, sum 1      1
 *   quw                            5          2 s0 k 4, product 1                              1
 *   slack                          4          k^2 3, product 1; by 1/2
 *   delta          2                          sums
 *
 * Columns add up to at most THIRD_ROUNDING, which is added to the slack, and to what
 * MOTION_ROUNDING and DIFFERENCE_ROUNDING leave. */
enum { THIRD_ROUNDING = 32 };
_Static_assert(3 + 2 + 3 + 3 + 2 <= THIRD_ROUNDING && 12 + 5 + 4 <= THIRD_ROUNDING, "third order");

/* Takes the terms of third order of a posed node into its slice, and its remainder's edges into r.
 * Returns the rest of the remainder. */
IMP_QUAD_INLINE imp_quad take_posed_terms(const node *n, difference *r, slice *s, moved *m)
{
    const double d = n->region.d[PARAMETER_T], c = n->region.c[PARAMETER_T];
    const double s0 = d > 0 ? (r->mid - c) / d : 0, k = d > 0 ? r->half / d : 0;
    const posed_terms x = posed_terms_at(n, s0, k);
    const imp_quad at = imp_quad_all(s0), by = imp_quad_all(k), half = imp_quad_all(0.5);
    const imp_quad part = half * (by * by), across = at * at - half + part;
    const imp_quad turn = imp_quad_all(2) * at * by, bowls = half * (x.uut + x.vvt);
    m->shift -= at * bowls;
    m->drift -= by * bowls;
    imp_quad_store(s->quu, imp_quad_load(s->quu) + at * x.uut);
    imp_quad_store(s->quv, imp_quad_load(s->quv) + at * x.uvt);
    imp_quad_store(s->qvv, imp_quad_load(s->qvv) + at * x.vvt);
    imp_quad_store(s->uuw, by * x.uut);
    imp_quad_store(s->uvw, by * x.uvt);
    imp_quad_store(s->vvw, by * x.vvt);
    imp_quad_store(s->bu, imp_quad_load(s->bu) + across * x.utt);
    imp_quad_store(s->bv, imp_quad_load(s->bv) + across * x.vtt);
    imp_quad_store(s->quw, imp_quad_load(s->quw) + turn * x.utt);
    imp_quad_store(s->qvw, imp_quad_load(s->qvw) + turn * x.vtt);
    s->normal = vec3_cross(vec3_from(s->bu), vec3_from(s->bv));
    const imp_quad across_all = imp_quad_abs(x.utt) + imp_quad_abs(x.vtt);
    const imp_quad third =
        imp_quad_abs(x.uut) + imp_quad_abs(x.uvt) + imp_quad_abs(x.vvt) + across_all;
    m->magnitude += imp_quad_all(2) * third;
    m->squares += imp_quad_abs(x.uut) + imp_quad_abs(x.vvt);
    for (int i = 0; i < 3; ++i) {
        imp_quad_store(r->edge[r->posed][i], x.edge[i]);
        imp_quad_store(r->swing[r->posed][i], x.swing[i]);
    }
    ++r->posed;
    return triple_load(n->posed_e) + x.bow + part * across_all +
           imp_quad_all(THIRD_ROUNDING * UNIT_ROUNDOFF) * third;
}

/* Returns the sum of both nodes' remainders, as boxes. */
IMP_QUAD_INLINE imp_quad remainders(const node *a, const node *b, difference *r, moved *ma,
                                    moved *mb)
{
    imp_quad ea = triple_load(a->ball > 0 ? a->posed_e : a->e);
    imp_quad eb = triple_load(b->ball > 0 ? b->posed_e : b->e);
    r->posed = 0;
    r->ball = a->ball > 0 || b->ball > 0 ? sum_upper(a->ball, b->ball) : 0;
    if (a->pose == NULL && b->pose == NULL) return ea + eb;
    if (a->pose != NULL)
        ea = take_posed_terms(a, r, &r->a, ma);
    else
        slice_clear_third_order(&r->a);
    if (b->pose != NULL)
        eb = take_posed_terms(b, r, &r->b, mb);
    else
        slice_clear_third_order(&r->b);
    return ea + eb;
}

/* Lemma (rounding of re-centring). With |s0| + k <= 1, s0 is off by 2 u and k by u. Errors at most,
 * in units of u of each node's
 *
 *              |bt|   2 |qtt|   |q.t|   |apart|   the result
 *   shift       4       4                                        7 |qtt|
 *   drift       3       4                             1          7 |qtt|
 *   bend                2                             1          4 |qtt|
 *   slopes                        3                   1
 *   turns                         2
 *   apart                                  1
 *   delta       1       1                             1
 *   slack                                             3
 *
 * Columns of the nodes' terms add up to at most MOTION_ROUNDING, which is added to the slack; the
 * result's column is DIFFERENCE_ROUNDING, which callers count. Large motions and distant places
 * thus cost u of their size once, before they cancel. */
enum { MOTION_ROUNDING = 16 };
_Static_assert(4 + 3 + 1 + 2 <= MOTION_ROUNDING, "|bt|");
_Static_assert(4 + 4 + 2 + 1 + 2 <= MOTION_ROUNDING, "2 |qtt|");
_Static_assert(3 + 2 <= MOTION_ROUNDING, "|qut|, |qvt|");
IMP_QUAD_INLINE void recentre(const node *a, const node *b, const time_window *window,
                              difference *r)
{
    r->mid = 0.5 * window->lo + 0.5 * window->hi;
    r->half = window_half_upper(window, r->mid);
    r->focus = -1;
    r->share = TUNING_GJK_GAP;
    r->way_count = 0;
    moved ma = slice_at(a, r->mid, r->half, &r->a), mb = slice_at(b, r->mid, r->half, &r->b);
    const imp_quad e = remainders(a, b, r, &ma, &mb);
    const imp_quad apart = triple_load(b->f.a) - triple_load(a->f.a);
    const imp_quad delta = apart + (mb.shift - ma.shift), drift = mb.drift - ma.drift,
                   bend = mb.bend - ma.bend;
    const imp_quad motion = triple_motion_upper(&a->f) + triple_motion_upper(&b->f);
    const imp_quad slack =
        e + imp_quad_all(MOTION_ROUNDING * UNIT_ROUNDOFF) * (imp_quad_abs(apart) + motion);
    const imp_quad squares = ma.squares + mb.squares;
    r->squares = squares[0] + squares[1] + squares[2];
    imp_quad_store(r->delta, delta);
    imp_quad_store(r->drift, drift);
    imp_quad_store(r->bend, bend);
    imp_quad_store(r->slack, slack);
    imp_quad_store(r->magnitude, slack + imp_quad_abs(delta) + imp_quad_abs(drift) +
                                     imp_quad_abs(bend) + (ma.magnitude + mb.magnitude));
}

IMP_QUAD_WIDE static void see_wide(const node *a, const node *b, const time_window *window,
                                   difference *r)
{
    recentre(a, b, window, r);
}

void difference_at(const node *a, const node *b, const time_window *window, difference *r)
{
    if (imp_quad_is_wide())
        see_wide(a, b, window, r);
    else
        recentre(a, b, window, r);
}
