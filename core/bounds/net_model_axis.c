/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/net_model_axis.h"

#include "core/base/rounding.h"
#include "core/bounds/gjk.h"
#include "core/bounds/net_hull.h"
#include "core/bounds/quadratic.h"
#include "core/tree/triple.h"

/* The pair from the side of the net: `way` is 1 where the model is B, -1 where it is A. */
typedef struct net_model {
    const net *net;
    const node *model;
    double way;
} net_model;

static net_model net_model_of(const node *a, const node *b)
{
    const net *of_a = node_net_made(a);
    return of_a != NULL ? (net_model){of_a, b, 1} : (net_model){node_net_made(b), a, -1};
}

/* Returns the vector from the net's place to the model's centre. */
IMP_QUAD_INLINE vec3 centre_apart(const net_model *p, double t)
{
    vec3 apart;
    for (int i = 0; i < 3; ++i)
        apart.x[i] = (p->model->f.a[i] - p->net->place[i]) - (t - p->net->time) * p->net->drift[i];
    return apart;
}

/* Returns the time relative to the model's region: off by 2 u, |s| <= 1 + 2 u. */
static double model_time(const node *f, double t)
{
    const double d = f->region.d[PARAMETER_T];
    return d > 0 ? (t - f->region.c[PARAMETER_T]) / d : 0;
}

/* --- The search ------------------------------------------------------------------------------- */

/* A model at one time, relative to its centre. The lanes hold x, y, z and 0; `form` holds the
 * coefficients again, by coordinate, with the lanes (slope along u, along v, curvature along u,
 * along v). */
typedef struct bowl {
    imp_quad middle, e, bu, bv, quu, quv, qvv;
    imp_quad form[3];
} bowl;

IMP_QUAD_INLINE bowl bowl_at(const node *f, double t)
{
    const quadratic3 *q = &f->f;
    const imp_quad s = imp_quad_all(model_time(f, t));
    bowl z = {.e = triple_load(f->e),
              .quu = triple_load(q->quu),
              .quv = triple_load(q->quv),
              .qvv = triple_load(q->qvv)};
    z.middle = (triple_load(q->bt) + triple_load(q->qtt) * s) * s;
    z.bu = triple_load(q->bu) + triple_load(q->qut) * s;
    z.bv = triple_load(q->bv) + triple_load(q->qvt) * s;
    for (int i = 0; i < 3; ++i) z.form[i] = (imp_quad){z.bu[i], z.bv[i], z.quu[i], z.qvv[i]};
    return z;
}

/* Returns the s in [-1, 1] at which b s + q s^2 is least. */
IMP_QUAD_INLINE double vertex_of(double b, double q)
{
    const double inside = -0.5 * b / q, end = b > 0 ? -1 : 1;
    if (!(q > 0x1p-1000)) return end;
    return inside < -1 ? -1 : inside > 1 ? 1 : inside;
}

/* Estimates the point that lies lowest along n: minimises over u, then v, then u. */
IMP_QUAD_INLINE vec3 lowest_of_bowl(const bowl *z, vec3 n)
{
    const imp_quad f = imp_quad_all(n.x[0]) * z->form[0] + imp_quad_all(n.x[1]) * z->form[1] +
                       imp_quad_all(n.x[2]) * z->form[2];
    const double twist = n.x[0] * z->quv[0] + n.x[1] * z->quv[1] + n.x[2] * z->quv[2];
    const double v = vertex_of(f[1] + twist * vertex_of(f[0], f[2]), f[3]);
    const double u = vertex_of(f[0] + twist * v, f[2]);
    const imp_quad up = {n.x[0], n.x[1], n.x[2], n.x[2]}, at_u = imp_quad_all(u),
                   at_v = imp_quad_all(v);
    const imp_quad x = z->middle + (z->bu + z->quu * at_u + z->quv * at_v) * at_u +
                       (z->bv + z->qvv * at_v) * at_v +
                       imp_quad_pick(up > imp_quad_all(0), -z->e, z->e);
    return (vec3){{x[0], x[1], x[2]}};
}

typedef struct net_and_bowl {
    cloud net;
    int quads;
    bowl bowl;
    vec3 apart;
} net_and_bowl;

/* The support function of model - net. */
IMP_QUAD_INLINE vec3 net_model_lowest(const void *set, vec3 n)
{
    const net_and_bowl *h = set;
    const vec3 p = lowest_of_bowl(&h->bowl, n);
    const vec3 q = lowest_of_cloud(&h->net, h->quads, vec3_scale(n, -1));
    return vec3_add(vec3_sub(p, q), h->apart);
}

IMP_QUAD_INLINE bool net_model_seek(const net_model *p, double t, vec3 *axis)
{
    net_and_bowl h;
    h.quads = p->net->stride / IMP_QUAD;
    h.apart = centre_apart(p, t);
    h.bowl = bowl_at(p->model, t);
    cloud_at(p->net, t, &h.net);
    vec3 n = vec3_scale(*axis, p->way);
    if (!gjk_search(net_model_lowest, &h, TUNING_GJK_GAP, &n)) return false;
    *axis = vec3_scale(n, p->way);
    return true;
}

IMP_QUAD_WIDE static bool net_model_seek_wide(const net_model *p, double t, vec3 *axis)
{
    return net_model_seek(p, t, axis);
}

bool net_model_axis_seek(const node *a, const node *b, double t, vec3 *axis)
{
    const net_model p = net_model_of(a, b);
    return imp_quad_is_wide() ? net_model_seek_wide(&p, t, axis) : net_model_seek(&p, t, axis);
}

/* --- The proof -------------------------------------------------------------------------------- */

/* Lemma (rounding of a gap). With s = model_time, in units of u R, where R = sum_i |n_i| (most and
 * |place - centre| + |its motion| of the net + |coefficients| of the model):
 *
 *   a control point                         3: t - time, its product, the sum
 *   places: difference, motion, sum         4
 *   slopes at s, and motion (bt + qtt s) s  7: s 2 and 2, two products, a sum
 *   bow: n.qtt and a square of half of      16: the differences of s are off by 4, twice; products,
 *                                               quotient
 *   dots with n                             3
 *   the least value of the form            QUADRATIC_ROUNDING
 *   sums of the parts                       6
 *   R itself                                8 */
enum { NET_MODEL_ROUNDING = 128 };
_Static_assert(3 + 4 + 7 + 16 + 3 + QUADRATIC_ROUNDING + 6 + 8 <= NET_MODEL_ROUNDING,
               "rounding of a gap of net and model");

/* Bounds the errors along n, and the rounding, for times at most `late` from the net's time; *size
 * is R. */
IMP_QUAD_INLINE double net_model_slack_upper(const net_model *p, vec3 n, double late, double *size)
{
    const quadratic3 *q = &p->model->f;
    const imp_quad form = imp_quad_abs(triple_load(q->bu)) + imp_quad_abs(triple_load(q->bv)) +
                          imp_quad_abs(triple_load(q->quu)) + imp_quad_abs(triple_load(q->quv)) +
                          imp_quad_abs(triple_load(q->qvv)) + triple_motion_upper(q);
    double error = 0;
    *size = 0;
    for (int i = 0; i < 3; ++i) {
        const double along = fabs(n.x[i]), places = fabs(q->a[i] - p->net->place[i]);
        *size += along * (form[i] + p->net->most[i] + places + late * fabs(p->net->drift[i]));
        error += along * (p->net->error[i] + p->model->e[i]);
    }
    return padded_upper(error, 8) + *size * (NET_MODEL_ROUNDING * UNIT_ROUNDOFF) +
           QUADRATIC_UNDERFLOW;
}

PAD_COVERS(8, 6); /* errors: their sum 1, product 1, sums of coordinates 2; of the return value 2 */

/* Returns the model's least value along n at both ends of the window, relative to its centre, less
 * the most by which its acceleration lowers it in between. Lemma (bow). For fixed u and v the value
 * is linear in time except for n.qtt s^2. If n.qtt is negative, that term is above its chord
 * between the ends; if positive, at most n.qtt ((s1 - s0) / 2)^2 below. The minimum of the rest
 * over u and v is a minimum of linear functions, and above its chord. */
IMP_QUAD_INLINE window_ends lowest_values(const node *f, const time_window *w, vec3 n)
{
    const quadratic3 *q = &f->f;
    const double s[2] = {model_time(f, w->lo), model_time(f, w->hi)}, half = 0.5 * (s[1] - s[0]);
    const imp_quad at = {s[0], s[1], s[0], s[1]};
    imp_quad bu = imp_quad_all(0), bv = bu, uu = bu, uv = bu, vv = bu, way = bu;
    double bend = 0;
    for (int i = 0; i < 3; ++i) {
        const imp_quad along = imp_quad_all(n.x[i]);
        bu += along * (imp_quad_all(q->bu[i]) + imp_quad_all(q->qut[i]) * at);
        bv += along * (imp_quad_all(q->bv[i]) + imp_quad_all(q->qvt[i]) * at);
        uu += along * imp_quad_all(q->quu[i]);
        uv += along * imp_quad_all(q->quv[i]);
        vv += along * imp_quad_all(q->qvv[i]);
        way += along * ((imp_quad_all(q->bt[i]) + imp_quad_all(q->qtt[i]) * at) * at);
        bend += n.x[i] * q->qtt[i];
    }
    const quadratics form = {bu, bv, uu, uv, vv};
    const imp_quad low = quadratics_lower(&form) + way;
    const double bow = bend > 0 ? bend * (half * half) : 0;
    return (window_ends){low[0] - bow, low[1] - bow};
}

/* Lemma (separating axis of a net and a model). At every moment n.(model - net) is at least the
 * least value of the model, less its remainder, less the greatest of the control points, less the
 * net's error. The least of n.(-point) over control points, which move linearly, is above the line
 * between its values at the window's ends, as is that of the model (bow). Where the sum of both
 * lines, less errors and rounding, is above |n| gamma_clear, the nodes are farther apart than
 * gamma_clear. One coordinate of n is about 1, so that no underflow matters; a NaN or a number out
 * of range cuts nothing. */
IMP_QUAD_INLINE bool net_model_cut(const net_model *p, vec3 axis, double gamma_clear,
                                   time_window *window)
{
    double size;
    vec3 n;
    if (!axis_scaled(vec3_scale(axis, p->way), &n)) return true;
    const double early = fabs(window->lo - p->net->time), after = fabs(window->hi - p->net->time);
    const double slack = net_model_slack_upper(p, n, early > after ? early : after, &size);
    const double limit = net_limit_upper(n, gamma_clear, slack);
    const window_ends low = lowest_values(p->model, window, n);
    const window_ends high = lowest_heights_of(p->net, window, n, -1);
    const double g0 = low.lo + high.lo + vec3_dot(n, centre_apart(p, window->lo));
    const double g1 = low.hi + high.hi + vec3_dot(n, centre_apart(p, window->hi));
    if (!(size < 0x1p400 && g0 < INFINITY && g1 < INFINITY && limit < INFINITY)) return true;
    return line_cut(g0, g1, limit, window);
}

IMP_QUAD_WIDE static bool net_model_cut_wide(const net_model *p, vec3 axis, double gamma_clear,
                                             time_window *window)
{
    return net_model_cut(p, axis, gamma_clear, window);
}

bool net_model_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear,
                        time_window *window)
{
    const net_model p = net_model_of(a, b);
    return imp_quad_is_wide() ? net_model_cut_wide(&p, axis, gamma_clear, window)
                              : net_model_cut(&p, axis, gamma_clear, window);
}
