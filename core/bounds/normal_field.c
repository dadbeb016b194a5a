/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/normal_field.h"

#include "core/base/rounding.h"
#include "core/bounds/dividing_surface.h"
#include "core/bounds/normal_height.h"
#include "core/bounds/tuning.h"

/* Returns m_q.x_l + m_l.x_q for two terms x of one surface. */
static double both_ways(const local_slice *s, const turn *m, int q, int l)
{
    return dot2(m->l[l], &s->q[q]) + dot2(m->q[q], &s->l[l]);
}

/* Writes one surface's part of n.(B - A) at w into lane k of p: sign +1 for B, -1 for A. */
static void take_part(const local_slice *s, const turn *m, const double *mw, const path *x,
                      double w, double sign, int k, quadratics *p)
{
    const local at = {{x->delta.t[0] + w * x->drift.t[0], x->delta.t[1] + w * x->drift.t[1]}, 0};
    double slope[2];
    for (int j = 0; j < 2; ++j)
        slope[j] = sign * (s->l[j].n + w * (s->q[UW + j].n + dot2(mw, &s->l[j]))) +
                   (dot2(m->l[j], &at) + w * dot2(m->q[UW + j], &x->delta));
    p->bs[k] = slope[0];
    p->br[k] = slope[1];
    p->qss[k] = sign * (s->q[UU].n + dot2(m->l[0], &s->l[0]) +
                        w * (s->qw[UU] + dot2(mw, &s->q[UU]) + both_ways(s, m, UW, 0))) +
                dot2(m->q[UU], &at);
    p->qsr[k] = sign * (s->q[UV].n + dot2(m->l[0], &s->l[1]) + dot2(m->l[1], &s->l[0]) +
                        w * (s->qw[UV] + dot2(mw, &s->q[UV]) + both_ways(s, m, UW, 1) +
                             both_ways(s, m, VW, 0))) +
                dot2(m->q[UV], &at);
    p->qrr[k] = sign * (s->q[VV].n + dot2(m->l[1], &s->l[1]) +
                        w * (s->qw[VV] + dot2(mw, &s->q[VV]) + both_ways(s, m, VW, 1))) +
                dot2(m->q[VV], &at);
}

/* Bounds the terms of third order in s_u and s_v of one surface's part; and those in w^2. */
static double cubic_upper(const local_slice *s, const turn *m)
{
    return fabs(both_ways(s, m, UU, 0)) + fabs(both_ways(s, m, UU, 1) + both_ways(s, m, UV, 0)) +
           fabs(both_ways(s, m, UV, 1) + both_ways(s, m, VV, 0)) + fabs(both_ways(s, m, VV, 1));
}

static double squared_time_upper(const local_slice *s, const turn *m, const double *mw,
                                 const path *x, double sign)
{
    double sum = 0;
    for (int j = 0; j < 2; ++j)
        sum += fabs(dot2(m->l[j], &x->bend) + dot2(m->q[UW + j], &x->drift) +
                    sign * dot2(mw, &s->q[UW + j]));
    return sum;
}

/* Bounds the terms that have parameters of both surfaces: slopes of one, anything of the other. */
static double cross_upper(const local_slice *a, const local_slice *b, const turn *ma,
                          const turn *mb)
{
    double sum = 0;
    for (int k = 0; k < 2; ++k) {
        for (int l = 0; l < 2; ++l)
            sum += fabs(dot2(ma->l[k], &b->l[l]) - dot2(mb->l[l], &a->l[k]));
        for (int q = 0; q < SECONDS; ++q)
            sum += fabs(dot2(ma->l[k], &b->q[q]) - dot2(mb->q[q], &a->l[k])) +
                   fabs(dot2(mb->l[k], &a->q[q]) - dot2(ma->q[q], &b->l[k]));
    }
    return sum;
}

/* Bounds how far the slopes (0) or terms of second order (1) turn the field along tangent i. */
static double turned(const turn *m, int order, int i)
{
    double sum = 0;
    for (int j = 0; j < 2 && order == 0; ++j) sum += fabs(m->l[j][i]);
    for (int j = 0; j < SECONDS && order == 1; ++j) sum += fabs(m->q[j][i]);
    return sum;
}

/* Bounds the terms of second order along tangent i. */
static double tangential_rest(const local_slice *s, int i)
{
    double sum = 0;
    for (int j = 0; j < SECONDS; ++j) sum += fabs(s->q[j].t[i]);
    return sum;
}

/* Lemma. Let D = delta + drift w + bend w^2 + (terms of B) - (those of A) + rest, |rest_i| <=
 * slack_i, where the terms of a surface are its slopes l_k s_k, its q_j z_j of second order, z_j
 * being s_u^2, s_u s_v, s_v^2, s_u w or s_v w; and
 *
 *   n = n0 + w m_w + sum_k s_k m_k + sum_j z_j m_j   over the terms of both surfaces, m_k being
 *                                                   m_k1 t1 + m_k2 t2, for any numbers m.
 *
 * Then n.D is the sum of
 *
 *   n0.delta + (n0.drift + m_w.delta) w
 *   (n0.bend + m_w.drift) w^2      at least its coefficient or 0
 *   part B (s_b) + part A (s_a)    what has one surface's parameters alone, is of second order in
 *                                    them and linear in w: take_part()
 *   their terms of third order     cubic_upper
 *   their terms in w^2             squared_time_upper: s_k (m_k.bend + m_kw.drift +- m_w.l_kw)
 *   s_k z_j (m_k.q_j - m_j.l_k)    k of one, j of the other, and s_k s_l likewise: cross_upper;
 *                                    vanishes for m = -K x / 2
 *   w^3 m_w.bend
 *   z_j m_j.(z_i q_i, w^2 bend)    at most nu.(sum of |q| of both + |bend|), along t1 and t2
 *   n.rest                         at most (|n0| + mu1 |t1| + mu2 |t2|).slack
 *
 * where nu_i = sum_j |m_ji| and mu_i = |m_wi| + sum_k |m_ki| + nu_i bound how far the field turns.
 * For fixed s the parts are linear in w. So the least value over s of each is concave in w, and
 * lies above the chord between the ends of the window. And |n.D| <= |n| |D|, where
 *
 *   |n|^2 <= |n0|^2 + 2 sum_i mu_i |n0.t_i| + (sum_i mu_i |t_i|)^2.
 *
 * So where the lower bound of n.D exceeds |n| gamma_clear, every point of B is farther than that
 * from every point of A. n0, t and m are what they are in double precision: they need not be unit,
 * tangent or accurate.
 *
 * The rest of posed nodes also has sum_k d_k (edge_k + swing_k w), |d_k| <= 1, which adds
 * |n.edge_k| + |n.swing_k| to |n.rest|; and the terms w z_i qw_i, z_i being s_u^2, s_u s_v or
 * s_v^2, of which w z_i n0.qw_i belongs to its surface's part, and the remainder is at most
 * (mu1 |t1.qw_i| + mu2 |t2.qw_i|).
 *
 * Rounding, in units of u size, size = |n0|.magnitude + 2 sum_i mu_i |t_i|.magnitude: each
 * magnitude is multiplied by n0 once, and by each m at most once.
 *
 *   difference_at                           DIFFERENCE_ROUNDING
 *   coordinates in the frame              3: product, two sums
 *   coefficients of the parts            15: product, times w, sums of at most thirteen terms
 *   least values of both parts            2 QUADRATIC_ROUNDING
 *   coefficients of the other terms       8: product, sums of at most seven terms
 *   low, its chord                       12: product, sums of at most six terms, of 2 size
 *   mu, slack and size themselves        96: fewer than 32 operations, each on less than 3 size
 */
enum { FIELD_ROUNDING = 512, SLACK_PAD = 64, MU_PAD = 32, DOT_ROUNDING = 8, LENGTH_PAD = 32 };
_Static_assert(DIFFERENCE_ROUNDING + 3 + 15 + 2 * QUADRATIC_ROUNDING + 8 + 12 + 96 <=
                   FIELD_ROUNDING,
               "rounding along a field of normals");
PAD_COVERS(SLACK_PAD, 4 + 20 + 14 + 16); /* cross; of second order, times nu; sums in all */
PAD_COVERS(MU_PAD, 4 + 10);              /* slopes and w, terms of second order */
PAD_COVERS(LENGTH_PAD, (2 * (14 + 1) + 1 + 2 + 1) / 2 + 1 + 1); /* lean^2; sums; root; product */

/* Computes the lemma's slack and the length of n; `third` bounds the terms of third order. False:
 * they are too large. */
static bool slack_and_length(const difference *r, const frame *f, const local_slice *a,
                             const local_slice *b, const turns *m, const path *x, double third,
                             double *slack_upper, double *length_upper)
{
    double slack = QUADRATIC_UNDERFLOW + weighted(f->n, r->slack) + edges_upper(r, f->n) +
                   cross_upper(a, b, &m->a, &m->b) + third +
                   squared_time_upper(a, &m->a, m->w, x, -1) +
                   squared_time_upper(b, &m->b, m->w, x, 1) + fabs(dot2(m->w, &x->bend));
    double size = weighted(f->n, r->magnitude);
    double tilt = 0, lean = 0;
    for (int i = 0; i < 2; ++i) {
        const double nu = turned(&m->a, 1, i) + turned(&m->b, 1, i);
        const double mu =
            padded_upper(turned(&m->a, 0, i) + turned(&m->b, 0, i) + fabs(m->w[i]) + nu, MU_PAD);
        slack += nu * (tangential_rest(a, i) + tangential_rest(b, i) + fabs(x->bend.t[i])) +
                 mu * (weighted(f->t[i], r->slack) + edges_upper(r, f->t[i]) +
                       bending_upper(r, f->t[i]));
        size += 2 * mu * weighted(f->t[i], r->magnitude);
        tilt += mu * fabs(vec3_dot(f->n, f->t[i])) + mu * (DOT_ROUNDING * UNIT_ROUNDOFF);
        lean += mu * vec3_norm(f->t[i]);
    }
    if (!(size < 0x1p400)) return false;
    *length_upper = padded_upper(sqrt(vec3_dot(f->n, f->n) + 2 * tilt + lean * lean), LENGTH_PAD);
    slack += *length_upper * r->ball;
    *slack_upper =
        slack + (slack * (SLACK_PAD * UNIT_ROUNDOFF) + size * (FIELD_ROUNDING * UNIT_ROUNDOFF));
    return true;
}

/* Computes n.D along the field, or along -n if B lies on that side at the focus. */
static height height_of(const difference *r, const local_slice *a, const local_slice *b,
                        const turns *m, const path *x)
{
    const imp_quad none = imp_quad_all(0);
    height h = {x->delta.n,
                x->drift.n + dot2(m->w, &x->delta),
                x->bend.n + dot2(m->w, &x->drift),
                {none, none, none, none, none}};
    for (int end = 0; end < 2; ++end) {
        take_part(a, &m->a, m->w, x, 2 * end - 1, -1, 2 * end, &h.parts);
        take_part(b, &m->b, m->w, x, 2 * end - 1, 1, 2 * end + 1, &h.parts);
    }
    return height_towards(&h, r->focus);
}

/* Tilts the frame's normal; the tangents remain, though they are no longer perpendicular to it.
 * False: by 45 degrees or more. So |n0| is below 1.5, and n0.t off by less than DOT_ROUNDING u. */
static bool tilt_frame(frame *f, const double tilt[2])
{
    if (!(fabs(tilt[0]) + fabs(tilt[1]) < 1)) return false;
    f->n = vec3_add(f->n, vec3_add(vec3_scale(f->t[0], tilt[0]), vec3_scale(f->t[1], tilt[1])));
    return true;
}

/* Whether a face is a plane across n over the window, as far as doubles tell: its terms of second
 * order, as those of a triangle's corners or of a parallelogram that turns within its plane, lie in
 * it. A dot is off by PLANE_ROUNDING u of its terms' sizes, n itself by twice that. */
enum { PLANE_ROUNDING = 4 };
static bool is_plane(const slice *s, vec3 n)
{
    const double *const terms[] = {s->quu, s->quv, s->qvv, s->quw, s->qvw};
    double off = 0, size = 0;
    for (int j = 0; j < SECONDS; ++j) {
        const double x = n.x[0] * terms[j][0], y = n.x[1] * terms[j][1], z = n.x[2] * terms[j][2];
        off += fabs(x + y + z);
        size += fabs(x) + fabs(y) + fabs(z);
    }
    return off <= 3 * PLANE_ROUNDING * UNIT_ROUNDOFF * size;
}

/* Whether the field follows one face, which is a plane: K and all numbers by which it turns are
 * then mere rounding, and it is the face's own normal, along which fixed axes have cut already, by
 * fewer roundings (AXIS_ROUNDING). */
static bool is_fixed(const difference *r, const frame *f)
{
    const bool a = f->side[0] == TOUCH_FACE, b = f->side[1] == TOUCH_FACE;
    return a != b && r->posed == 0 && is_plane(a ? &r->a : &r->b, f->n);
}

/* Makes the frame, the slices and path in it, and how the field turns. False: there is none, or it
 * shows nothing that fixed axes did not. */
static bool begin(const difference *r, vec3 axis, frame *f, local_view *v, turns *m)
{
    if (!normal_frame_between(r, axis, f) || is_fixed(r, f)) return false;
    *v = view_in(f, r);
    if (!normal_turns_choose(f, &v->a, &v->b, &v->x, m)) return false;
    if (m->tilt[0] == 0 && m->tilt[1] == 0) return true;
    if (!tilt_frame(f, m->tilt)) return false;
    *v = view_in(f, r);
    return true;
}

/* Whether terms of third order, and not remainders, hide the gap between two faces. */
static bool is_of_third_order(const difference *r, const frame *f, double third)
{
    const double rest = weighted(f->n, r->slack) + edges_upper(r, f->n);
    return f->side[0] == TOUCH_FACE && f->side[1] == TOUCH_FACE &&
           third > TUNING_THIRD_OF_REMAINDER * rest;
}

bool normal_field_cut(const difference *r, vec3 axis, double gamma_clear, w_range *s,
                      gap_lines *lines)
{
    frame f;
    local_view v;
    turns m;
    height_line line;
    double slack, length;
    if (!begin(r, axis, &f, &v, &m)) return true;
    const double third = cubic_upper(&v.a, &m.a) + cubic_upper(&v.b, &m.b);
    if (is_of_third_order(r, &f, third))
        return dividing_surface_cut(r, &f, &v, &m, gamma_clear, s, lines);
    const height h = height_of(r, &v.a, &v.b, &m, &v.x);
    if (!height_least(&h, lines != NULL, &line)) return true;
    if (!slack_and_length(r, &f, &v.a, &v.b, &m, &v.x, third, &slack, &length)) return true;
    const double low = line.middle - slack, limit = length * gamma_clear;
    if (lines != NULL) gap_lines_add(lines, low, line.drift, length);
    if (!w_range_cut(s, low, line.drift, limit)) return false;
    const bool is_hidden = line.middle + fabs(line.drift) > limit;
    if (!(is_hidden && TUNING_THIRD_SHARE * third > slack)) return true;
    return dividing_surface_cut(r, &f, &v, &m, gamma_clear, s, lines);
}
