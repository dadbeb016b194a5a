/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/normal_field.h"

#include "core/solver/quadratic.h"
#include "core/solver/tuning.h"

/* A vector in the field's frame: along the tangents t1, t2 and the normal. */
typedef struct local {
    double t[2], n;
} local;

typedef struct frame {
    vec3 t[2], n;
} frame;

static local to_local(const frame *f, const double *x)
{
    const vec3 v = vec3_from(x);
    return (local){{vec3_dot(f->t[0], v), vec3_dot(f->t[1], v)}, vec3_dot(f->n, v)};
}

/* A slice in the frame. */
typedef struct local_slice {
    local l[2]; /* slopes along u, v */
    local uu, uv, vv;
    local lw[2]; /* how the slopes turn with w */
} local_slice;

static local_slice slice_to_local(const frame *f, const slice *s)
{
    return (local_slice){{to_local(f, s->bu), to_local(f, s->bv)},
                         to_local(f, s->quu),
                         to_local(f, s->quv),
                         to_local(f, s->qvv),
                         {to_local(f, s->quw), to_local(f, s->qvw)}};
}

/* The frame between the two normals; false where the surfaces have none or are not nearly tangent.
 * Unit length up to rounding. */
static bool frame_between(const relative *r, frame *f)
{
    const double la = vec3_norm(r->a.normal), lb = vec3_norm(r->b.normal);
    if (!(la > 0x1p-300 && lb > 0x1p-300 && la < 0x1p300 && lb < 0x1p300)) return false;
    const vec3 na = vec3_scale(r->a.normal, 1 / la), nb = vec3_scale(r->b.normal, 1 / lb);
    const double cosine = vec3_dot(na, nb);
    if (!(fabs(cosine) > TUNING_FIELD_COSINE)) return false;
    vec3 n = cosine > 0 ? vec3_sub(na, vec3_scale(nb, -1)) : vec3_sub(na, nb);
    n = vec3_scale(n, 1 / vec3_norm(n));
    const int least = fabs(n.x[0]) < fabs(n.x[1]) ? (fabs(n.x[0]) < fabs(n.x[2]) ? 0 : 2)
                                                  : (fabs(n.x[1]) < fabs(n.x[2]) ? 1 : 2);
    vec3 e = {{0, 0, 0}};
    e.x[least] = 1;
    const vec3 t = vec3_cross(n, e);
    f->n = n;
    f->t[0] = vec3_scale(t, 1 / vec3_norm(t));
    f->t[1] = vec3_cross(n, f->t[0]);
    return true;
}

/* Symmetric 2 x 2. */
typedef struct form {
    double xx, xy, yy;
} form;

/* K with y' K y / 2 = n.(quadratic part), y = (tangential slopes) s; false where the slopes are too
 * nearly parallel to say. Only a choice: nothing is proved by it. */
static bool curvature(const local_slice *s, form *k)
{
    const double ux = s->l[0].t[0], uy = s->l[0].t[1], vx = s->l[1].t[0], vy = s->l[1].t[1];
    const double det = ux * vy - uy * vx;
    if (!(fabs(det) > 0x1p-20 * (fabs(ux * vy) + fabs(uy * vx)))) return false;
    /* s = J y with J the inverse of [u v]; K = J' H J, H = [[2 uu, uv], [uv, 2 vv]] */
    const double a = vy / det, b = -vx / det, c = -uy / det, d = ux / det;
    const double hxx = 2 * s->uu.n, hxy = s->uv.n, hyy = 2 * s->vv.n;
    k->xx = a * a * hxx + 2 * a * c * hxy + c * c * hyy;
    k->xy = a * b * hxx + (a * d + b * c) * hxy + c * d * hyy;
    k->yy = b * b * hxx + 2 * b * d * hxy + d * d * hyy;
    return true;
}

/* How the field turns along one parameter: m = -K l / 2, in the tangents. */
static void turn(const form *k, const local_slice *s, double m[2][2])
{
    for (int j = 0; j < 2; ++j) {
        const double x = s->l[j].t[0], y = s->l[j].t[1];
        m[j][0] = -0.5 * (k->xx * x + k->xy * y);
        m[j][1] = -0.5 * (k->xy * x + k->yy * y);
    }
}

static double dot2(const double *m, const local *x) { return m[0] * x->t[0] + m[1] * x->t[1]; }

/* How fast a surface's own normal turns, in the tangents: m.l + n0.lw = 0 for both slopes. */
static void turn_in_time(const local_slice *s, double m[2])
{
    const local *u = &s->l[0], *v = &s->l[1];
    const double det = u->t[0] * v->t[1] - u->t[1] * v->t[0];
    m[0] = (v->t[1] * -s->lw[0].n - u->t[1] * -s->lw[1].n) / det;
    m[1] = (u->t[0] * -s->lw[1].n - v->t[0] * -s->lw[0].n) / det;
}

/* The numbers m of the lemma. */
typedef struct turns {
    double a[2][2], b[2][2], w[2];
} turns;

/* False where the slopes are too nearly parallel to say. */
static bool turns_choose(const local_slice *a, const local_slice *b, turns *m)
{
    form ka, kb;
    if (!curvature(a, &ka) || !curvature(b, &kb)) return false;
    const form mean = {0.5 * (ka.xx + kb.xx), 0.5 * (ka.xy + kb.xy), 0.5 * (ka.yy + kb.yy)};
    double wa[2], wb[2];
    turn(&mean, a, m->a);
    turn(&mean, b, m->b);
    turn_in_time(a, wa);
    turn_in_time(b, wb);
    for (int i = 0; i < 2; ++i) m->w[i] = 0.5 * (wa[i] + wb[i]);
    return true;
}

/* Offset, drift and bend in the frame. */
typedef struct path {
    local delta, drift, bend;
} path;

/* One surface's part of n.(B - A) at w, into lane k of p: sign +1 for B, -1 for A. */
static void part(const local_slice *s, const double m[2][2], const turns *all, const path *x,
                 double w, double sign, int k, quadratics *p)
{
    double slope[2];
    for (int j = 0; j < 2; ++j)
        slope[j] = sign * (s->l[j].n + w * (s->lw[j].n + dot2(all->w, &s->l[j]))) +
                   (dot2(m[j], &x->delta) + w * dot2(m[j], &x->drift));
    p->bs[k] = slope[0];
    p->br[k] = slope[1];
    p->qss[k] = sign * (s->uu.n + dot2(m[0], &s->l[0]));
    p->qsr[k] = sign * (s->uv.n + dot2(m[0], &s->l[1]) + dot2(m[1], &s->l[0]));
    p->qrr[k] = sign * (s->vv.n + dot2(m[1], &s->l[1]));
}

/* Along tangent k, of all but the slopes: at most this. */
static double tangential_rest(const local_slice *s, int k)
{
    return fabs(s->uu.t[k]) + fabs(s->uv.t[k]) + fabs(s->vv.t[k]) +
           (fabs(s->lw[0].t[k]) + fabs(s->lw[1].t[k]));
}

static double weighted(vec3 n, const double *x)
{
    return fabs(n.x[0]) * x[0] + fabs(n.x[1]) * x[1] + fabs(n.x[2]) * x[2];
}

/* Lemma. Let D = delta + drift w + bend w^2 + (slopes and curvature of B) - (those of A) + rest,
 * |rest_i| <= slack_i, where the slopes l_k are l_k + lw_k w in truth, and
 *
 *   n(s, w) = n0 + m_w + sum_k s_k m_k,   k over the four parameters, m_k = m_k1 t1 + m_k2 t2 and
 *                                         m_w = w (m_w1 t1 + m_w2 t2) for any numbers m.
 *
 * Then n.D is the sum of
 *
 *   n0.delta + (n0.drift + m_w.delta) w
 *   (n0.bend + m_w.drift) w^2                 at least its coefficient or 0
 *   part B (s_b) + part A (s_a)               terms of each surface's own parameters, with the slopes
 *                                               that they have at w
 *   sum s_k s_l (m_k.l_l - m_l.l_k)           k of A, l of B, "cross": vanishes for m = -K l / 2
 *   (sum s_k m_k + w m_w).(curvature and      at most mu.(|curvatures| + |turns| + |bend|), along t1
 *     turns of B - those of A + bend w^2)       and t2, but for what the parts and w^2 have of it
 *   n.rest                                    at most (|n0| + mu1 |t1| + mu2 |t2|).slack
 *
 * where mu_i = |m_wi| + sum_k |m_ki| bounds how far the field turns. In the parts only the slopes
 * depend on w, and linearly: +-(l_k + lw_k w).n0 + m_k.(delta + drift w) +- w m_w.l_k. So the least
 * value over s of each part is concave in w, and lies above the chord between the ends of the window.
 * And |n.D| <= |n| |D|, where
 *
 *   |n|^2 <= |n0|^2 + 2 sum_i mu_i |n0.t_i| + (sum_i mu_i |t_i|)^2.
 *
 * So where the lower bound of n.D exceeds |n| clearance, every point of B is farther than that
 * from every point of A. n0, t and m are what they are in double precision: they need not be unit,
 * tangent or accurate.
 *
 * Rounding, in units of u size, size = |n0|.magnitude + 2 sum_i mu_i |t_i|.magnitude: each magnitude
 * is multiplied by n0 once, and by at most mu in all.
 *
 *   relative_at                           RELATIVE_ROUNDING
 *   coordinates in the frame              3: product, two sums
 *   coefficients of the parts             7: product, times w, sums of at most five terms
 *   least values of both parts            2 QUADRATIC_ROUNDING
 *   cross                                 4: product, three sums
 *   low, its chord                       12: product, sums of at most six terms, of 2 size
 *   mu, slack and size themselves        64: fewer than 20 operations, each on less than 3 size
 */
enum { FIELD_ROUNDING = 512, SLACK_PAD = 32, MU_PAD = 8, DOT_ROUNDING = 8, LENGTH_PAD = 32 };
_Static_assert(RELATIVE_ROUNDING + 3 + 7 + 2 * QUADRATIC_ROUNDING + 4 + 12 + 64 <= FIELD_ROUNDING,
               "rounding along a field of normals");
PAD_COVERS(SLACK_PAD, 4 + 4 + 1 + 9); /* sums of a rest, of rests, times mu, sums in all */
PAD_COVERS(MU_PAD, 4);                /* four sums */
PAD_COVERS(LENGTH_PAD, (2 * (4 + 1 + 1) + 1 + 2 + 1) / 2 + 1 + 1); /* lean^2; sums; root; product */

/* What the lemma takes off, and the length of n. False: too large to tell. */
static bool slack_and_length(const relative *r, const frame *f, const local_slice *a,
                             const local_slice *b, const turns *m, const path *x,
                             double *slack_upper, double *length_upper)
{
    double slack = QUADRATIC_UNDERFLOW + weighted(f->n, r->slack);
    double size = weighted(f->n, r->magnitude);
    double tilt = 0, lean = 0;
    for (int k = 0; k < 2; ++k) {
        const double mu = padded_upper(fabs(m->a[0][k]) + fabs(m->a[1][k]) + fabs(m->b[0][k]) +
                                           fabs(m->b[1][k]) + fabs(m->w[k]),
                                       MU_PAD);
        slack += mu * (fabs(x->bend.t[k]) + tangential_rest(a, k) + tangential_rest(b, k) +
                       weighted(f->t[k], r->slack));
        size += 2 * mu * weighted(f->t[k], r->magnitude);
        tilt += mu * fabs(vec3_dot(f->n, f->t[k])) + mu * (DOT_ROUNDING * UNIT_ROUNDOFF);
        lean += mu * vec3_norm(f->t[k]);
    }
    for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
            slack += fabs(dot2(m->a[k], &b->l[l]) - dot2(m->b[l], &a->l[k]));
    if (!(size < 0x1p400)) return false;
    *slack_upper =
        slack + (slack * (SLACK_PAD * UNIT_ROUNDOFF) + size * (FIELD_ROUNDING * UNIT_ROUNDOFF));
    *length_upper = padded_upper(sqrt(vec3_dot(f->n, f->n) + 2 * tilt + lean * lean), LENGTH_PAD);
    return true;
}

/* n.D but for the slack: offset + drift w + bend w^2, and the parts of A and B at the start of the
 * window and at its end. */
typedef struct height {
    double offset, drift, bend;
    quadratics parts;
} height;

/* Along the field, or against it if B lies on that side at the focus. */
static height height_of(const relative *r, const local_slice *a, const local_slice *b,
                        const turns *m, const path *x)
{
    const imp_quad none = imp_quad_all(0);
    height h = {x->delta.n,
                x->drift.n + dot2(m->w, &x->delta),
                x->bend.n + dot2(m->w, &x->drift),
                {none, none, none, none, none}};
    for (int end = 0; end < 2; ++end) {
        part(a, m->a, m, x, 2 * end - 1, -1, 2 * end, &h.parts);
        part(b, m->b, m, x, 2 * end - 1, 1, 2 * end + 1, &h.parts);
    }
    if (!(h.offset + (h.drift + h.bend * r->focus) * r->focus < 0)) return h;
    const quadratics *p = &h.parts;
    return (height){-h.offset, -h.drift, -h.bend, {-p->bs, -p->br, -p->qss, -p->qsr, -p->qrr}};
}

bool normal_field_cut(const relative *r, double clearance, w_range *s, gap_lines *lines)
{
    frame f;
    turns m;
    if (!frame_between(r, &f)) return true;
    const local_slice a = slice_to_local(&f, &r->a), b = slice_to_local(&f, &r->b);
    if (!turns_choose(&a, &b, &m)) return true;
    const path x = {to_local(&f, r->delta), to_local(&f, r->drift), to_local(&f, r->bend)};
    const height h = height_of(r, &a, &b, &m, &x);
    const imp_quad seen = imp_quad_min(quadratics_corner(&h.parts), imp_quad_all(0));
    if (h.offset - h.drift + (seen[0] + seen[1]) <= 0 &&
        h.offset + h.drift + (seen[2] + seen[3]) <= 0)
        return true; /* nothing to cut, whatever the rest may be */
    double slack, length;
    if (!slack_and_length(r, &f, &a, &b, &m, &x, &slack, &length)) return true;
    const imp_quad least = quadratics_lower(&h.parts);
    const double start = least[0] + least[1], end = least[2] + least[3];
    const double low = h.offset + 0.5 * (start + end) + (h.bend < 0 ? h.bend : 0) - slack;
    const double drift = h.drift + 0.5 * (end - start);
    if (lines != NULL) gap_lines_add(lines, low, drift, length);
    return w_range_cut(s, low, drift, length * clearance);
}
