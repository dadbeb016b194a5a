/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/normal_turn.h"

#include "core/bounds/tuning.h"

bool normal_frame_between(const difference *r, frame *f)
{
    const double la = vec3_norm(r->a.normal), lb = vec3_norm(r->b.normal);
    if (!(la > 0x1p-300 && lb > 0x1p-300 && la < 0x1p300 && lb < 0x1p300)) return false;
    const vec3 na = vec3_scale(r->a.normal, 1 / la), nb = vec3_scale(r->b.normal, 1 / lb);
    const double cosine = vec3_dot(na, nb);
    if (!(fabs(cosine) > TUNING_FIELD_COSINE)) return false;
    vec3 n = cosine > 0 ? vec3_add(na, nb) : vec3_sub(na, nb);
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

/* A symmetric 2 x 2 matrix. */
typedef struct form {
    double xx, xy, yy;
} form;

/* Chooses K with y' K y / 2 = n.(quadratic part), y = (tangential slopes) s. False: the slopes are
 * too nearly parallel. Nothing is proved by the choice. */
static bool curvature(const local_slice *s, form *k)
{
    const double ux = s->l[0].t[0], uy = s->l[0].t[1], vx = s->l[1].t[0], vy = s->l[1].t[1];
    const double det = ux * vy - uy * vx;
    if (!(fabs(det) > 0x1p-20 * (fabs(ux * vy) + fabs(uy * vx)))) return false;
    /* s = J y with J the inverse of [u v]; K = J' H J, H = [[2 uu, uv], [uv, 2 vv]] */
    const double a = vy / det, b = -vx / det, c = -uy / det, d = ux / det;
    const double hxx = 2 * s->q[UU].n, hxy = s->q[UV].n, hyy = 2 * s->q[VV].n;
    k->xx = a * a * hxx + 2 * a * c * hxy + c * c * hyy;
    k->xy = a * b * hxx + (a * d + b * c) * hxy + c * d * hyy;
    k->yy = b * b * hxx + 2 * b * d * hxy + d * d * hyy;
    return true;
}

static void turn_by(const form *k, const local *x, double m[2])
{
    m[0] = -0.5 * (k->xx * x->t[0] + k->xy * x->t[1]);
    m[1] = -0.5 * (k->xy * x->t[0] + k->yy * x->t[1]);
}

static void turn_choose(const form *k, const local_slice *s, turn *m)
{
    for (int j = 0; j < 2; ++j) turn_by(k, &s->l[j], m->l[j]);
    for (int j = 0; j < SECONDS; ++j) turn_by(k, &s->q[j], m->q[j]);
}

/* Computes the rate, along the tangents, at which a surface's own normal turns: m.l + n0.lw = 0 for
 * both slopes. */
static void turn_in_time(const local_slice *s, double m[2])
{
    const local *u = &s->l[0], *v = &s->l[1];
    const double det = u->t[0] * v->t[1] - u->t[1] * v->t[0];
    m[0] = (v->t[1] * -s->q[UW].n - u->t[1] * -s->q[VW].n) / det;
    m[1] = (u->t[0] * -s->q[VW].n - v->t[0] * -s->q[UW].n) / det;
}

bool normal_turns_choose(const local_slice *a, const local_slice *b, turns *m)
{
    form ka, kb;
    if (!curvature(a, &ka) || !curvature(b, &kb)) return false;
    const form mean = {0.5 * (ka.xx + kb.xx), 0.5 * (ka.xy + kb.xy), 0.5 * (ka.yy + kb.yy)};
    double wa[2], wb[2];
    turn_choose(&mean, a, &m->a);
    turn_choose(&mean, b, &m->b);
    turn_in_time(a, wa);
    turn_in_time(b, wb);
    for (int i = 0; i < 2; ++i) m->w[i] = 0.5 * (wa[i] + wb[i]);
    return true;
}
