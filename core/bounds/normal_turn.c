/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/normal_turn.h"

#include "core/bounds/tuning.h"

/* --- The frame -------------------------------------------------------------------------------- */

/* Whether a vector has a direction that can be computed with. */
static bool has_direction(vec3 x)
{
    const double length = vec3_norm(x);
    return length > 0x1p-300 && length < 0x1p300;
}

static bool are_nearly_parallel(vec3 x, vec3 y)
{
    return fabs(vec3_dot(x, y)) > TUNING_FIELD_COSINE * vec3_norm(x) * vec3_norm(y);
}

/* Whether a slope leaves the plane across the axis by so much that the surface is nearest at an end
 * of its parameter, whatever bends. */
static bool leaves_plane(vec3 axis, const double *slope, const double *square, const double *twist)
{
    const double bend = 2 * fabs(vec3_dot(axis, vec3_from(square)));
    return fabs(vec3_dot(axis, vec3_from(slope))) > bend + fabs(vec3_dot(axis, vec3_from(twist)));
}

static touch touch_along(const slice *s, vec3 axis)
{
    const bool u = leaves_plane(axis, s->bu, s->quu, s->quv);
    const bool v = leaves_plane(axis, s->bv, s->qvv, s->quv);
    if (u != v) return u ? TOUCH_EDGE_V : TOUCH_EDGE_U;
    return has_direction(s->normal) && are_nearly_parallel(s->normal, axis) ? TOUCH_FACE
                                                                            : TOUCH_CORNER;
}

static vec3 edge_of(const slice *s, touch edge)
{
    return vec3_from(edge == TOUCH_EDGE_U ? s->bu : s->bv);
}

/* Returns a vector along the normal of the field at its middle; 0: there is none. */
static vec3 normal_along(const difference *r, vec3 axis, touch side[2])
{
    const vec3 none = {{0, 0, 0}};
    if (!has_direction(axis)) return none;
    side[0] = touch_along(&r->a, axis);
    side[1] = touch_along(&r->b, axis);
    for (int k = 0; k < 2; ++k)
        if (side[k] == TOUCH_FACE && side[!k] != TOUCH_FACE)
            return k == 0 ? r->a.normal : r->b.normal;
    if (side[0] > TOUCH_EDGE_V || side[1] > TOUCH_EDGE_V) return none;
    const vec3 n = vec3_cross(edge_of(&r->a, side[0]), edge_of(&r->b, side[1]));
    return are_nearly_parallel(n, axis) ? n : none;
}

/* Returns the mean of two normals that are nearly parallel; 0: they are not. */
static vec3 normal_between(const difference *r, touch side[2])
{
    if (!has_direction(r->a.normal) || !has_direction(r->b.normal)) return (vec3){{0, 0, 0}};
    const vec3 na = vec3_scale(r->a.normal, 1 / vec3_norm(r->a.normal));
    const vec3 nb = vec3_scale(r->b.normal, 1 / vec3_norm(r->b.normal));
    const double cosine = vec3_dot(na, nb);
    if (!(fabs(cosine) > TUNING_FIELD_COSINE)) return (vec3){{0, 0, 0}};
    side[0] = side[1] = TOUCH_FACE;
    return cosine > 0 ? vec3_add(na, nb) : vec3_sub(na, nb);
}

bool normal_frame_between(const difference *r, vec3 axis, frame *f)
{
    vec3 n = normal_between(r, f->side);
    if (!(vec3_norm1(n) > 0)) n = normal_along(r, axis, f->side);
    if (!has_direction(n)) return false;
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

/* --- How it turns ----------------------------------------------------------------------------- */

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

/* Returns a surface of which both edges are parameters: that between two edges that cross. */
static local_slice between_edges(const local_slice *a, touch of_a, const local_slice *b, touch of_b)
{
    const int i = of_a == TOUCH_EDGE_V, j = of_b == TOUCH_EDGE_V;
    local_slice s = {.l = {a->l[i], b->l[j]}};
    s.q[UU] = a->q[i == 1 ? VV : UU];
    s.q[VV] = b->q[j == 1 ? VV : UU];
    s.q[UW] = a->q[UW + i];
    s.q[VW] = b->q[UW + j];
    return s;
}

/* Computes how the field's normal at the middle between both centres differs from that where A's
 * centre is (sign +1), or B's (-1). */
static void tilt_by_face(const form *k, const local *x, double sign, double c[2])
{
    double m[2];
    turn_by(k, x, m);
    for (int i = 0; i < 2; ++i) c[i] += sign * m[i];
}

/* Computes what is to be added to n, across both edges, so that the field is across each where it
 * is: a.c = -a.K x / 2, b.c = b.K x / 2, x being the way between their centres. */
static void tilt_by_edges(const form *k, const local_slice *s, const local *x, double c[2])
{
    const local *a = &s->l[0], *b = &s->l[1];
    double m[2];
    turn_by(k, x, m);
    const double along_a = dot2(m, a), along_b = -dot2(m, b);
    const double det = a->t[0] * b->t[1] - a->t[1] * b->t[0];
    c[0] += (b->t[1] * along_a - a->t[1] * along_b) / det;
    c[1] += (a->t[0] * along_b - b->t[0] * along_a) / det;
}

/* Chooses the numbers of a field that follows one face, or two edges. */
static bool turns_along(const frame *f, const local_slice *a, const local_slice *b, const path *x,
                        turns *m)
{
    const bool has_edges = f->side[0] != TOUCH_FACE && f->side[1] != TOUCH_FACE;
    const local_slice s = has_edges ? between_edges(a, f->side[0], b, f->side[1])
                                    : *(f->side[0] == TOUCH_FACE ? a : b);
    const double sign = f->side[0] == TOUCH_FACE ? 1 : -1;
    form k;
    if (!curvature(&s, &k)) return false;
    m->k = k;
    turn_choose(&k, a, &m->a);
    turn_choose(&k, b, &m->b);
    turn_in_time(&s, m->w);
    if (has_edges) {
        tilt_by_edges(&k, &s, &x->delta, m->tilt);
        tilt_by_edges(&k, &s, &x->drift, m->w);
    } else {
        tilt_by_face(&k, &x->delta, sign, m->tilt);
        tilt_by_face(&k, &x->drift, sign, m->w);
    }
    return true;
}

bool normal_turns_choose(const frame *f, const local_slice *a, const local_slice *b, const path *x,
                         turns *m)
{
    form ka, kb;
    m->tilt[0] = m->tilt[1] = 0;
    if (f->side[0] != TOUCH_FACE || f->side[1] != TOUCH_FACE) return turns_along(f, a, b, x, m);
    if (!curvature(a, &ka) || !curvature(b, &kb)) return false;
    const form mean = {0.5 * (ka.xx + kb.xx), 0.5 * (ka.xy + kb.xy), 0.5 * (ka.yy + kb.yy)};
    double wa[2], wb[2];
    m->k = mean;
    turn_choose(&mean, a, &m->a);
    turn_choose(&mean, b, &m->b);
    turn_in_time(a, wa);
    turn_in_time(b, wb);
    for (int i = 0; i < 2; ++i) m->w[i] = 0.5 * (wa[i] + wb[i]);
    return true;
}
