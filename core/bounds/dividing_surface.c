/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/dividing_surface.h"

#include "core/bounds/dividing_choice.h"
#include "core/bounds/normal_height.h"

/* --- One side --------------------------------------------------------------------------------- */

/* h at the centre of one side: its value and derivatives there. */
typedef struct place {
    double centre[2], drift[2]; /* half of the path's delta and drift, or their negatives */
    double value, gradient[2];
    form second;
    cubic third;
} place;

static place place_at(const dividing *h, const path *x, double sign)
{
    place p;
    double by_k[2], by_c[2], by_q[2];
    for (int i = 0; i < 2; ++i) {
        p.centre[i] = 0.5 * sign * x->delta.t[i];
        p.drift[i] = 0.5 * sign * x->drift.t[i];
    }
    const cubic along = quartic_by(&h->q, p.centre);
    const form by = cubic_by(&h->c, p.centre), twice = cubic_by(&along, p.centre);
    form_turn(&h->k, p.centre, by_k);
    form_turn(&by, p.centre, by_c);
    form_turn(&twice, p.centre, by_q);
    p.value = 0;
    for (int i = 0; i < 2; ++i) {
        p.gradient[i] = h->slope[i] + by_k[i] + 0.5 * by_c[i] + by_q[i] / 6;
        p.value += (h->slope[i] + 0.5 * by_k[i] + by_c[i] / 6 + by_q[i] / 24) * p.centre[i];
    }
    p.second = (form){h->k.xx + by.xx + 0.5 * twice.xx, h->k.xy + by.xy + 0.5 * twice.xy,
                      h->k.yy + by.yy + 0.5 * twice.yy};
    for (int i = 0; i < 4; ++i) p.third.x[i] = h->c.x[i] + along.x[i];
    return p;
}

/* Writes one side's part of f at w into lane k: sign +1 for B, -1 for A. */
static void take_side(const place *p, const local_slice *s, const double *mw, double w, double sign,
                      int lane, quadratics *to)
{
    const form *k = &p->second;
    const cubic *c = &p->third;
    const double *u = s->l[0].t, *v = s->l[1].t, *g = p->gradient, *d = p->drift;
    const double *uw = s->q[UW].t, *vw = s->q[VW].t;
    const local *slope[2] = {&s->l[0], &s->l[1]};
    double linear[2];
    for (int j = 0; j < 2; ++j)
        linear[j] = slope[j]->n - dot2(g, slope[j]) +
                    w * (s->q[UW + j].n - dot2(g, &s->q[UW + j]) + dot2(mw, slope[j]) -
                         form_of(k, slope[j]->t, d));
    double second[3];
    for (int j = UU; j <= VV; ++j)
        second[j] = s->q[j].n - dot2(g, &s->q[j]) +
                    w * (s->qw[j] + dot2(mw, &s->q[j]) - form_of(k, s->q[j].t, d));
    to->bs[lane] = sign * linear[0];
    to->br[lane] = sign * linear[1];
    to->qss[lane] = sign * (second[UU] - 0.5 * form_of(k, u, u) -
                            w * (form_of(k, u, uw) + 0.5 * cubic_of(c, d, u, u)));
    to->qsr[lane] = sign * (second[UV] - form_of(k, u, v) -
                            w * (form_of(k, u, vw) + form_of(k, v, uw) + cubic_of(c, d, u, v)));
    to->qrr[lane] = sign * (second[VV] - 0.5 * form_of(k, v, v) -
                            w * (form_of(k, v, vw) + 0.5 * cubic_of(c, d, v, v)));
}

/* Bounds the terms of third order in s_u and s_v. */
static double third_upper(const place *p, const local_slice *s)
{
    const form *k = &p->second;
    const cubic *c = &p->third;
    const double *u = s->l[0].t, *v = s->l[1].t;
    const double *uu = s->q[UU].t, *uv = s->q[UV].t, *vv = s->q[VV].t;
    return fabs(form_of(k, u, uu) + cubic_of(c, u, u, u) / 6) +
           fabs(form_of(k, u, uv) + form_of(k, v, uu) + 0.5 * cubic_of(c, u, u, v)) +
           fabs(form_of(k, u, vv) + form_of(k, v, uv) + 0.5 * cubic_of(c, u, v, v)) +
           fabs(form_of(k, v, vv) + cubic_of(c, v, v, v) / 6);
}

/* Bounds the terms of fourth order in s_u and s_v. */
static double fourth_upper(const quartic *q, const place *p, const local_slice *s)
{
    const form *k = &p->second;
    const double *u = s->l[0].t, *v = s->l[1].t;
    const double *uu = s->q[UU].t, *uv = s->q[UV].t, *vv = s->q[VV].t;
    const form by_u = cubic_by(&p->third, u), by_v = cubic_by(&p->third, v);
    const form u_u = quartic_by_two(q, u, u), v_v = quartic_by_two(q, v, v);
    return fabs(0.5 * form_of(k, uu, uu) + 0.5 * form_of(&by_u, u, uu) + form_of(&u_u, u, u) / 24) +
           fabs(form_of(k, uu, uv) + 0.5 * form_of(&by_u, u, uv) + form_of(&by_u, v, uu) +
                form_of(&u_u, u, v) / 6) +
           fabs(0.5 * form_of(k, uv, uv) + form_of(k, uu, vv) + 0.5 * form_of(&by_u, u, vv) +
                form_of(&by_u, v, uv) + 0.5 * form_of(&by_v, v, uu) + 0.25 * form_of(&u_u, v, v)) +
           fabs(form_of(k, uv, vv) + form_of(&by_u, v, vv) + 0.5 * form_of(&by_v, v, uv) +
                form_of(&v_v, u, v) / 6) +
           fabs(0.5 * form_of(k, vv, vv) + 0.5 * form_of(&by_v, v, vv) + form_of(&v_v, v, v) / 24);
}

/* Bounds, along the tangents, the terms of a side. */
typedef struct reach {
    double l[2], q[2], qw[2], drift[2], bend[2]; /* q: UU, UV, VV; qw: UW, VW */
} reach;

static reach reach_of(const local_slice *s, const path *x)
{
    reach e;
    for (int i = 0; i < 2; ++i) {
        e.l[i] = fabs(s->l[0].t[i]) + fabs(s->l[1].t[i]);
        e.q[i] = fabs(s->q[UU].t[i]) + fabs(s->q[UV].t[i]) + fabs(s->q[VV].t[i]);
        e.qw[i] = fabs(s->q[UW].t[i]) + fabs(s->q[VW].t[i]);
        e.drift[i] = 0.5 * fabs(x->drift.t[i]);
        e.bend[i] = 0.5 * fabs(x->bend.t[i]);
    }
    return e;
}

/* Bounds what take_side leaves out of a side, but for the terms of third and fourth order in s. */
static double rest_upper(const dividing *h, const place *p, const reach *e, const double *mw)
{
    const form k = form_abs(p->second);
    const cubic c = cubic_abs(p->third);
    const quartic q = quartic_abs(h->q);
    double ends[2], bent[2], moves[2], still[2];
    const double *all = e->l, *bow = e->q, *late = e->qw;
    for (int i = 0; i < 2; ++i) {
        ends[i] = e->drift[i] + e->bend[i];
        bent[i] = bow[i] + 0.5 * late[i];
        moves[i] = ends[i] + bow[i] + late[i];
        still[i] = e->bend[i] + late[i];
    }
    const form by_all = quartic_by_two(&q, all, all), by_moves = quartic_by_two(&q, moves, moves);
    return form_of(&k, e->l, e->bend) + form_of(&k, e->q, e->bend) + form_of(&k, e->qw, ends) +
           form_of(&k, late, bent) + 0.5 * cubic_of(&c, still, all, all) +
           0.5 * cubic_of(&c, all, moves, moves) + cubic_of(&c, moves, moves, moves) / 6 +
           form_of(&by_all, all, moves) / 6 + form_of(&by_all, moves, moves) / 4 +
           form_of(&by_moves, all, moves) / 6 + form_of(&by_moves, moves, moves) / 24 +
           fabs(mw[0]) * e->qw[0] + fabs(mw[1]) * e->qw[1];
}

/* --- Both sides ------------------------------------------------------------------------------- */

static height height_between(const place p[2], const local_view *v, const double *mw)
{
    const path *x = &v->x;
    const double mean[2] = {0.5 * (p[0].gradient[0] + p[1].gradient[0]),
                            0.5 * (p[0].gradient[1] + p[1].gradient[1])};
    const imp_quad none = imp_quad_all(0);
    height to = {x->delta.n - (p[1].value - p[0].value),
                 x->drift.n + dot2(mw, &x->delta) - dot2(mean, &x->drift),
                 x->bend.n + dot2(mw, &x->drift) - dot2(mean, &x->bend),
                 {none, none, none, none, none}};
    for (int end = 0; end < 2; ++end) {
        take_side(&p[0], &v->a, mw, 2 * end - 1, -1, 2 * end, &to.parts);
        take_side(&p[1], &v->b, mw, 2 * end - 1, 1, 2 * end + 1, &to.parts);
    }
    return to;
}

/* Bounds what both sides leave out, before rounding. */
static double left_out_upper(const dividing *h, const place p[2], const local_view *v,
                             const double *mw)
{
    const path *x = &v->x;
    const reach a = reach_of(&v->a, x), b = reach_of(&v->b, x);
    const form by = form_abs(cubic_by(&h->c, x->delta.t));
    const double ends[2] = {a.drift[0] + a.bend[0], a.drift[1] + a.bend[1]};
    return third_upper(&p[0], &v->a) + third_upper(&p[1], &v->b) +
           fourth_upper(&h->q, &p[0], &v->a) + fourth_upper(&h->q, &p[1], &v->b) +
           rest_upper(h, &p[0], &a, mw) + rest_upper(h, &p[1], &b, mw) +
           0.5 * form_of(&by, ends, ends) + fabs(dot2(mw, &x->bend));
}

/* Lemma (a dividing surface). Let o(w) be any moving point, and for a point x let p_i = t_i.(x -
 * o), z = n0.(x - o) and
 *
 *   f(x) = z + w m.p - h(p),   h a polynomial of at most fourth order, m, n0, t1, t2 any vectors.
 *
 * For points x of A and y of B at w, f(y) - f(x) is the mean of f's gradient along the way from x
 * to y times y - x. The gradient is n0 + sum_i (w m_i - h_i(p)) t_i, h_i being derivatives of h.
 * With mu_i >= |m_i| + |h_i| wherever |p_i| <= P_i, as it is for points of both surfaces and so
 * between them, its length is at most |n|, |n|^2 = |n0|^2 + 2 sum_i mu_i |n0.t_i| + (sum_i mu_i
 * |t_i|)^2. So |y - x| is at least (f(y) - f(x)) / |n|.
 *
 * Let o be the middle of the way delta + drift w + bend w^2 from A's centre to B's, so that they
 * lie at -+ half of it. On one side p = c + L + T, with c = +- delta / 2, L the slopes times s, T
 * the rest: +- half of drift w + bend w^2, and terms q_j z_j of second order. g, H and C are the
 * first, second and third derivatives of h at c, Q its fourth.
 *
 *   h(p) = h(c) + g.(L + T) + H(L + T, L + T) / 2 + C(L + T, L + T, L + T) / 6
 *               + Q(L + T, L + T, L + T, L + T) / 24,   exactly.
 *
 * take_side has what is of first or second order in s, times 1 or w. Terms without s are
 * height_between's, H(d, d) / 2, d = drift w + bend w^2 over 2, being alike on both sides but for
 * the third derivative in the middle, C(delta)(d, d) / 2, since what Q adds to H is even in c. What
 * is left of one side is of third or fourth order in s alone (third_upper, fourth_upper: H(q, q) /
 * 2, C(L, L, q) / 2 and Q(L, L, L, L) / 24, q being q_j z_j without w), or at most
 *
 *   H(L, bend / 2), H(q z, bend / 2), H(q_w w s, d)                 in w^2
 *   H(q_w w s, q z + q_w w s / 2)
 *   C(L, L, T without drift and q z) / 2, C(L, T, T) / 2, C(T, T, T) / 6
 *   Q(L, L, L, T) / 6, Q(L, L, T, T) / 4, Q(L, T, T, T) / 6, Q(T, T, T, T) / 24
 *   m.q_w w^2 s                                                     and once m.bend w^3
 *
 * the forms and vectors being replaced by their sizes (rest_upper). For fixed s the rest is linear
 * in w, but for w^2 times one number: so least values over s are above their chords. Remainders,
 * edges and the change of q z along the tangents move f by at most |n0.rest| + sum_i mu_i
 * |t_i.rest| on either side, as there.
 *
 * Rounding, in units of u size, size = |n0|.magnitude + 8 sum_i mu_i P_i: sum_i mu_i P_i is above
 * the sizes of all terms of h that its expansion at c adds up, P_i being above the size of p's.
 *
 *   difference_at                             DIFFERENCE_ROUNDING
 *   coordinates in the frame                3: product, two sums; a change of p_i by 3 u P_i moves
 *                                              h by mu_i times that
 *   C, H, g, h(c)                          20: products of four with two sums each, sums of at most
 *                                              six terms
 *   coefficients of the parts              24: products of four, sums of at most ten terms; of
 *                                              fourth order products of five, of six terms
 *   least values of both parts              2 QUADRATIC_ROUNDING
 *   offset, drift, bend, chord             24: sums of at most seven terms, of 2 size
 *   mu, slack and size themselves          96: fewer than 32 operations, each on less than 3 size
 */
enum {
    DIVIDING_ROUNDING = 1024,
    SUM_PAD = 128,
    GRADIENT_PAD = 64,
    TILT_ROUNDING = 8,
    ROOT_PAD = 32
};
_Static_assert(DIFFERENCE_ROUNDING + 3 + 20 + 24 + 2 * QUADRATIC_ROUNDING + 24 + 96 <=
                   DIVIDING_ROUNDING,
               "rounding along a dividing surface");
PAD_COVERS(SUM_PAD, 8 + 20 + 40); /* of upper bounds: coordinates, products of five, sums */
PAD_COVERS(GRADIENT_PAD, 4 + 20); /* P; products of four, sums of at most ten terms */
PAD_COVERS(ROOT_PAD, (2 * (2 + 1) + 1 + 2 + 1) / 2 + 1 + 1); /* lean^2; sums; root; product */

/* Computes mu and P, and from them slack and the length of n. False: they are too large. */
static bool slack_and_length(const difference *r, const frame *f, const dividing *h,
                             const double *mw, double left_out, double *slack_upper,
                             double *length_upper)
{
    double far[2], mu[2];
    for (int i = 0; i < 2; ++i)
        far[i] = padded_upper(weighted(f->t[i], r->magnitude) + edges_upper(r, f->t[i]), SUM_PAD);
    const form k = form_abs(h->k);
    const cubic c = cubic_abs(h->c);
    const quartic q = quartic_abs(h->q);
    const form by = cubic_by(&c, far), twice = quartic_by_two(&q, far, far);
    double by_k[2], by_c[2], by_q[2], tilt = 0, lean = 0;
    form_turn(&k, far, by_k);
    form_turn(&by, far, by_c);
    form_turn(&twice, far, by_q);
    double slack = left_out + QUADRATIC_UNDERFLOW + weighted(f->n, r->slack) + edges_upper(r, f->n);
    double size = weighted(f->n, r->magnitude);
    for (int i = 0; i < 2; ++i) {
        mu[i] = padded_upper(
            fabs(mw[i]) + fabs(h->slope[i]) + by_k[i] + 0.5 * by_c[i] + by_q[i] / 6, GRADIENT_PAD);
        slack += mu[i] * (weighted(f->t[i], r->slack) + edges_upper(r, f->t[i]) +
                          bending_upper(r, f->t[i]));
        size += 8 * mu[i] * far[i];
        tilt += mu[i] * fabs(vec3_dot(f->n, f->t[i])) + mu[i] * (TILT_ROUNDING * UNIT_ROUNDOFF);
        lean += mu[i] * vec3_norm(f->t[i]);
    }
    /* A product of two lengths that underflows loses less than 2^-1074. By a component of H, C L or
     * Q L L that is at most mu_i / far_j, and size has 8 mu_i far_i: with far > 2^-500 all such
     * losses together are below u size. One of no such factor is multiplied by three lengths:
     * together less than QUADRATIC_UNDERFLOW. */
    if (!(size < 0x1p400)) return false;
    for (int i = 0; i < 2; ++i)
        if (!(far[i] > 0x1p-500 && far[i] < 0x1p150)) return false;
    *length_upper = padded_upper(sqrt(vec3_dot(f->n, f->n) + 2 * tilt + lean * lean), ROOT_PAD);
    slack += *length_upper * r->ball;
    *slack_upper =
        slack + (slack * (SUM_PAD * UNIT_ROUNDOFF) + size * (DIVIDING_ROUNDING * UNIT_ROUNDOFF));
    return true;
}

bool dividing_surface_cut(const difference *r, const frame *f, const local_view *v, const turns *m,
                          double gamma_clear, w_range *s, gap_lines *lines)
{
    dividing h;
    height_line line;
    double slack, length;
    if (!dividing_choose(f, v, &m->k, &h)) return true;
    const place p[2] = {place_at(&h, &v->x, -1), place_at(&h, &v->x, 1)};
    const height between = height_between(p, v, m->w);
    const height to = height_towards(&between, r->focus);
    if (!height_least(&to, lines != NULL, &line)) return true;
    if (!slack_and_length(r, f, &h, m->w, left_out_upper(&h, p, v, m->w), &slack, &length))
        return true;
    const double low = line.middle - slack;
    if (lines != NULL) gap_lines_add(lines, low, line.drift, length);
    return w_range_cut(s, low, line.drift, length * gamma_clear);
}
