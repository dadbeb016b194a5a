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

/* The frame between the two normals, on the side of B at the focus; false where the
 * surfaces have no normals or are not nearly tangent. Unit length up to rounding. */
static bool frame_between(const relative *r, frame *f)
{
    const double la = vec3_norm(r->a.normal), lb = vec3_norm(r->b.normal);
    if (!(la > 0x1p-300 && lb > 0x1p-300 && la < 0x1p300 && lb < 0x1p300)) return false;
    const vec3 na = vec3_scale(r->a.normal, 1 / la), nb = vec3_scale(r->b.normal, 1 / lb);
    const double cosine = vec3_dot(na, nb);
    if (!(fabs(cosine) > TUNING_FIELD_COSINE)) return false;
    vec3 n = cosine > 0 ? vec3_sub(na, vec3_scale(nb, -1)) : vec3_sub(na, nb);
    const vec3 here = vec3_sub(vec3_from(r->delta), vec3_scale(vec3_from(r->drift), -r->focus));
    n = vec3_scale(n, (vec3_dot(n, here) < 0 ? -1 : 1) / vec3_norm(n));
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

/* One surface's part of n(s).(B - A), into lane k of p: sign +1 for B, -1 for A. */
static void part(const local_slice *s, double m[2][2], const local *delta, double sign, int k,
                 quadratics *p)
{
    p->bs[k] = sign * s->l[0].n + dot2(m[0], delta);
    p->br[k] = sign * s->l[1].n + dot2(m[1], delta);
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

static double turning(const local_slice *s) { return fabs(s->lw[0].n) + fabs(s->lw[1].n); }

static double weighted(vec3 n, const double *x)
{
    return fabs(n.x[0]) * x[0] + fabs(n.x[1]) * x[1] + fabs(n.x[2]) * x[2];
}

/* Lemma. Let D = delta + drift w + (slopes and curvature of B) - (those of A) + rest, |rest_i| <=
 * slack_i, where the slopes l_k are l_k + lw_k w in truth, and
 *
 *   n(s) = n0 + sum_k s_k (m_k1 t1 + m_k2 t2),   k over the four parameters, for any numbers m.
 *
 * Then n(s).D is the sum of
 *
 *   n0.delta + n0.drift w
 *   part B (s_b) + part A (s_a)               terms of each surface's own parameters
 *   sum s_k s_l (m_k.l_l - m_l.l_k)           k of A, l of B, "cross": vanishes for m = -K l / 2
 *   sum s_k w n0.lw_k                         at most sum |n0.lw_k|
 *   sum s_k m_k.(drift w + curvature and      at most mu.(|drift| + |curvatures| + |turns|),
 *     turns of B - those of A)                  along t1 and t2
 *   n(s).rest                                 at most (|n0| + mu1 |t1| + mu2 |t2|).slack
 *
 * where mu_i = sum_k |m_ki| bounds how far the field turns. And |n(s).D| <= |n(s)| |D|, where
 *
 *   |n(s)|^2 <= |n0|^2 + 2 sum_i mu_i |n0.t_i| + (sum_i mu_i |t_i|)^2.
 *
 * So where the lower bound of n(s).D exceeds |n(s)| clearance, every point of B is farther than that
 * from every point of A. n0, t and m are what they are in double precision: they need not be unit,
 * tangent or accurate.
 *
 * Rounding, in units of u size, size = |n0|.magnitude + 2 sum_i mu_i |t_i|.magnitude: each magnitude
 * is multiplied by n0 once, and by at most mu in all.
 *
 *   relative_at                           RELATIVE_ROUNDING
 *   coordinates in the frame              3: product, two sums
 *   coefficients of the parts             4: product, sums of at most three terms
 *   least values of both parts            2 QUADRATIC_ROUNDING
 *   cross                                 4: product, three sums
 *   low                                   4: sums of at most four terms
 *   mu, slack and size themselves        64: fewer than 20 operations, each on less than 3 size
 */
enum { FIELD_ROUNDING = 512, SLACK_PAD = 32, MU_PAD = 8, DOT_ROUNDING = 8, LENGTH_PAD = 32 };
_Static_assert(RELATIVE_ROUNDING + 3 + 4 + 2 * QUADRATIC_ROUNDING + 4 + 4 + 64 <= FIELD_ROUNDING,
               "rounding along a field of normals");
PAD_COVERS(SLACK_PAD, 4 + 3 + 1 + 9); /* sums of a rest, of rests, times mu, sums in all */
PAD_COVERS(MU_PAD, 3);                /* three sums */
PAD_COVERS(LENGTH_PAD, (2 * (3 + 1 + 1) + 1 + 2 + 1) / 2 + 1 + 1); /* lean^2; sums; root; product */

bool normal_field_cut(const relative *r, double clearance, w_range *s, gap_lines *lines)
{
    frame f;
    form ka, kb;
    if (!frame_between(r, &f)) return true;
    const local_slice sa = slice_to_local(&f, &r->a), sb = slice_to_local(&f, &r->b);
    if (!curvature(&sa, &ka) || !curvature(&sb, &kb)) return true;
    const form mean = {0.5 * (ka.xx + kb.xx), 0.5 * (ka.xy + kb.xy), 0.5 * (ka.yy + kb.yy)};
    double ma[2][2], mb[2][2];
    turn(&mean, &sa, ma);
    turn(&mean, &sb, mb);
    const local delta = to_local(&f, r->delta), drift = to_local(&f, r->drift);
    quadratics parts = {imp_quad_all(0), imp_quad_all(0), imp_quad_all(0), imp_quad_all(0),
                        imp_quad_all(0)};
    part(&sa, ma, &delta, -1, 0, &parts);
    part(&sb, mb, &delta, 1, 1, &parts);
    const imp_quad seen = imp_quad_min(quadratics_corner(&parts), imp_quad_all(0));
    if (delta.n + (seen[0] + seen[1]) + fabs(drift.n) <= 0)
        return true; /* nothing to cut, whatever the rest may be */
    double slack = QUADRATIC_UNDERFLOW + weighted(f.n, r->slack) + turning(&sa) + turning(&sb);
    double size = weighted(f.n, r->magnitude);
    double tilt = 0, lean = 0;
    for (int k = 0; k < 2; ++k) {
        const double mu =
            padded_upper(fabs(ma[0][k]) + fabs(ma[1][k]) + fabs(mb[0][k]) + fabs(mb[1][k]), MU_PAD);
        slack += mu * (fabs(drift.t[k]) + tangential_rest(&sa, k) + tangential_rest(&sb, k) +
                       weighted(f.t[k], r->slack));
        size += 2 * mu * weighted(f.t[k], r->magnitude);
        tilt += mu * fabs(vec3_dot(f.n, f.t[k])) + mu * (DOT_ROUNDING * UNIT_ROUNDOFF);
        lean += mu * vec3_norm(f.t[k]);
    }
    for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) slack += fabs(dot2(ma[k], &sb.l[l]) - dot2(mb[l], &sa.l[k]));
    if (!(size < 0x1p400)) return true;
    slack += slack * (SLACK_PAD * UNIT_ROUNDOFF) + size * (FIELD_ROUNDING * UNIT_ROUNDOFF);
    const double length_upper =
        padded_upper(sqrt(vec3_dot(f.n, f.n) + 2 * tilt + lean * lean), LENGTH_PAD);
    const imp_quad least = quadratics_lower(&parts);
    const double low = delta.n + (least[0] + least[1]) - slack;
    if (lines != NULL) gap_lines_add(lines, low, drift.n, length_upper);
    return w_range_cut(s, low, drift.n, length_upper * clearance);
}
