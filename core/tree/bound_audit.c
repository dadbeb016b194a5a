/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/bound_audit.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/common/random.h"
#include "core/tree/distance_audit.h"
#include "core/tree/posed_terms.h"
#include "core/tree/triple.h"

static bool region_holds(const imp_region *r, const double p[3])
{
    for (int j = 0; j < 3; ++j)
        if (!(r->lo[j] <= p[j] && p[j] <= r->hi[j])) return false;
    return true;
}

/* Returns s, which is in [-1, 1] up to 2 roundings. */
static double parameter_within(const node *n, const double p[3], int j)
{
    return n->region.d[j] > 0 ? (p[j] - n->region.c[j]) / n->region.d[j] : 0;
}

/* Evaluates the polynomial at p, with x, y, z in lanes, and bounds its rounding, in units of u
 * times the sum of the terms' sizes: s, two factors of at most 2 each; two products; nine sums. */
enum { POLYNOMIAL_ROUNDING = 32 };
_Static_assert(2 * 2 + 2 + 9 <= POLYNOMIAL_ROUNDING, "rounding of the polynomial");

IMP_QUAD_INLINE imp_quad polynomial(const node *n, const double p[3], imp_quad *rounding)
{
    const quadratic3 *f = &n->f;
    imp_quad s[3];
    for (int j = 0; j < 3; ++j) s[j] = imp_quad_all(parameter_within(n, p, j));
    const imp_quad term[10] = {triple_load(f->a),
                               triple_load(f->bu) * s[0],
                               triple_load(f->bv) * s[1],
                               triple_load(f->bt) * s[2],
                               triple_load(f->quu) * s[0] * s[0],
                               triple_load(f->quv) * s[0] * s[1],
                               triple_load(f->qut) * s[0] * s[2],
                               triple_load(f->qvv) * s[1] * s[1],
                               triple_load(f->qvt) * s[1] * s[2],
                               triple_load(f->qtt) * s[2] * s[2]};
    imp_quad sum = imp_quad_all(0), size = sum;
    for (int k = 0; k < 10; ++k) {
        sum += term[k];
        size += imp_quad_abs(term[k]);
    }
    *rounding = imp_quad_all(POLYNOMIAL_ROUNDING * UNIT_ROUNDOFF) * size;
    return sum;
}

enum { POINT_ROUNDING = 8 }; /* units of u of x: 1 in x - polynomial, 1 in x -+ slack */
PAD_COVERS(8, 2);            /* of e: two sums */

/* Returns the coordinate whose bound x -+ eval_error breaks beyond rounding, or -1. A NaN breaks
 * none: it is caught where points and bounds are made. */
IMP_QUAD_INLINE int outside(const node *n, const double p[3], const double x[3],
                            const double eval_error[3])
{
    imp_quad rounding;
    const imp_quad middle = polynomial(n, p, &rounding);
    for (int i = 0; i < 3; ++i) {
        const double off = fabs(x[i] - middle[i]);
        const double slack = eval_error[i] + POINT_ROUNDING * UNIT_ROUNDOFF * fabs(x[i]);
        if (off > padded_upper(n->e[i], 8) + slack + rounding[i]) return i;
        if (x[i] + slack < n->lo[i] || x[i] - slack > n->hi[i]) return i;
    }
    return -1;
}

IMP_QUAD_WIDE static int outside_wide(const node *n, const double p[3], const double x[3],
                                      const double eval_error[3])
{
    return outside(n, p, x, eval_error);
}

static int coordinate_outside(const node *n, const double p[3], const double x[3],
                              const double eval_error[3])
{
    return imp_quad_is_wide() ? outside_wide(n, p, x, eval_error) : outside(n, p, x, eval_error);
}

/* Returns the terms of third order at p; *size is the sum of their vectors' sizes. Rounding, in
 * units of u size: three factors s 2 each, a square less 1/2 1, products 3, sums 4. */
enum { THIRD_ROUNDING = 16 };
_Static_assert(3 * 2 + 1 + 3 + 4 <= THIRD_ROUNDING, "rounding of terms of third order");

IMP_QUAD_INLINE imp_quad third_order(const posed_terms *x, const double s[3], imp_quad *size)
{
    const imp_quad u = imp_quad_all(s[0]), v = imp_quad_all(s[1]), t = imp_quad_all(s[2]);
    const imp_quad half = imp_quad_all(0.5);
    *size = imp_quad_abs(x->uut) + imp_quad_abs(x->uvt) + imp_quad_abs(x->vvt) +
            imp_quad_abs(x->utt) + imp_quad_abs(x->vtt);
    return x->uut * (t * (u * u - half)) + x->uvt * (t * u * v) + x->vvt * (t * (v * v - half)) +
           (t * t - half) * (x->utt * u + x->vtt * v);
}

/* Roundings of the extent of edges and boxes along an axis: dots 3, sums 9; the dot with x -
 * polynomial: 3 and 1. */
enum { OFF_ROUNDING = 8 };
PAD_COVERS(32, 3 + 10);

/* Whether x lies, beyond rounding, outside the parallelepiped of a posed node's remainder along one
 * of the body's axes at that time. */
IMP_QUAD_INLINE bool outside_edges(const node *n, const double p[3], const double x[3],
                                   const double eval_error[3])
{
    imp_quad rounding, size;
    const double s[3] = {parameter_within(n, p, 0), parameter_within(n, p, 1),
                         parameter_within(n, p, 2)};
    const posed_terms terms = posed_terms_at(n, s[2], 0);
    const imp_quad at = {x[0], x[1], x[2], 0},
                   slack = {eval_error[0], eval_error[1], eval_error[2], 0};
    const imp_quad third = third_order(&terms, s, &size), t = imp_quad_all(s[2]);
    const imp_quad off = at - polynomial(n, p, &rounding) - third;
    const imp_quad box = triple_load(n->posed_e) + slack + rounding +
                         imp_quad_all(THIRD_ROUNDING * UNIT_ROUNDOFF) * size +
                         imp_quad_all(POINT_ROUNDING * UNIT_ROUNDOFF) * imp_quad_abs(at) +
                         imp_quad_all(OFF_ROUNDING * UNIT_ROUNDOFF) * imp_quad_abs(off);
    for (int j = 0; j < 3; ++j) {
        const imp_quad axis =
            triple_load(n->pose->turn[0][j]) +
            (triple_load(n->pose->turn[1][j]) + triple_load(n->pose->turn[2][j]) * t) * t;
        imp_quad along = imp_quad_all(0);
        double way = 0;
        double reach = n->ball * sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        for (int i = 0; i < 3; ++i) {
            along += imp_quad_all(axis[i]) * terms.edge[i];
            way += axis[i] * off[i];
            reach += fabs(axis[i]) * box[i];
        }
        reach += fabs(along[0]) + fabs(along[1]) + fabs(along[2]);
        if (fabs(way) > padded_upper(reach, 32)) return true;
    }
    return false;
}

IMP_QUAD_WIDE static bool outside_edges_wide(const node *n, const double p[3], const double x[3],
                                             const double eval_error[3])
{
    return outside_edges(n, p, x, eval_error);
}

static bool leaves_edges(const node *n, const double p[3], const double x[3],
                         const double eval_error[3])
{
    if (n->pose == NULL) return false;
    return imp_quad_is_wide() ? outside_edges_wide(n, p, x, eval_error)
                              : outside_edges(n, p, x, eval_error);
}

/* Rounding of the box of a net at time t, by which it is widened: t - time and its products 2, sums
 * 3 of the sizes below, and as much for those sums themselves. */
enum { NET_ROUNDING = 16 };
_Static_assert(2 * (2 + 3) <= NET_ROUNDING, "rounding of a net's box");

/* Returns the coordinate that lies, beyond rounding, outside the bounding box of the node's net; or
 * -1. */
IMP_QUAD_INLINE int off_net(const net *f, double t, const double x[3], const double eval_error[3])
{
    const double tau = t - f->time;
    for (int i = 0; i < 3; ++i) {
        const double *at = f->numbers + i * f->stride, base = f->place[i] + tau * f->drift[i];
        const double size = fabs(x[i]) + fabs(f->place[i]) + fabs(tau * f->drift[i]) + f->most[i];
        imp_quad least = imp_quad_all(INFINITY), most = -least;
        for (int k = 0; k < f->stride; k += IMP_QUAD) {
            imp_quad y = imp_quad_load(at + k);
            if (f->is_moving) y += imp_quad_all(tau) * imp_quad_load(at + k + 3 * f->stride);
            least = imp_quad_min(y, least);
            most = imp_quad_max(y, most);
        }
        double lo = least[0], hi = most[0];
        for (int l = 1; l < IMP_QUAD; ++l) {
            if (least[l] < lo) lo = least[l];
            if (most[l] > hi) hi = most[l];
        }
        const double slack = f->error[i] + eval_error[i] + NET_ROUNDING * UNIT_ROUNDOFF * size;
        if (x[i] - base + slack < lo || x[i] - base - slack > hi) return i;
    }
    return -1;
}

IMP_QUAD_WIDE static int off_net_wide(const net *f, double t, const double x[3],
                                      const double eval_error[3])
{
    return off_net(f, t, x, eval_error);
}

static int coordinate_off_net(const net *f, double t, const double x[3], const double eval_error[3])
{
    return imp_quad_is_wide() ? off_net_wide(f, t, x, eval_error) : off_net(f, t, x, eval_error);
}

static imp_code net_fault(const surface *s, const node *n, const double p[3], const double x[3],
                          int i, imp_error *error)
{
    const imp_region *r = &n->region;
    return surface_fault(s, error,
                         "breaks its control net over u [%.17g, %.17g], v [%.17g, %.17g], "
                         "t [%.17g, %.17g]: at u = %.17g, v = %.17g, t = %.17g its %c is %.17g, "
                         "which is outside the hull of the control points by more than %.3g",
                         r->lo[0], r->hi[0], r->lo[1], r->hi[1], r->lo[2], r->hi[2], p[0], p[1],
                         p[2], "xyz"[i], x[i], node_net_made(n) -> error[i]);
}

static imp_code model_fault(const surface *s, const node *n, const double p[3], const double x[3],
                            int i, imp_error *error)
{
    imp_quad rounding;
    const imp_region *r = &n->region;
    const double middle = polynomial(n, p, &rounding)[i];
    const char axis = "xyz"[i];
    return surface_fault(s, error,
                         "breaks its own bounds over u [%.17g, %.17g], v [%.17g, %.17g], "
                         "t [%.17g, %.17g]: at u = %.17g, v = %.17g, t = %.17g its %c is %.17g, "
                         "the bounds say %.17g +- %.3g within [%.17g, %.17g]",
                         r->lo[0], r->hi[0], r->lo[1], r->hi[1], r->lo[2], r->hi[2], p[0], p[1],
                         p[2], axis, x[i], middle, n->e[i], n->lo[i], n->hi[i]);
}

static imp_code shape_fault(const surface *s, const node *n, const double p[3], imp_error *error)
{
    const imp_region *r = &n->region;
    return surface_fault(
        s, error,
        "breaks its own bounds over u [%.17g, %.17g], v [%.17g, %.17g], "
        "t [%.17g, %.17g]: at u = %.17g, v = %.17g, t = %.17g it leaves the remainder "
        "that it has before its maps, moved as they say",
        r->lo[0], r->hi[0], r->lo[1], r->hi[1], r->lo[2], r->hi[2], p[0], p[1], p[2]);
}

static imp_code judge(const surface *s, const node *n, const double p[3], const double x[3],
                      const double eval_error[3], imp_error *error)
{
    int i = coordinate_outside(n, p, x, eval_error);
    if (i >= 0) return model_fault(s, n, p, x, i, error);
    if (leaves_edges(n, p, x, eval_error)) return shape_fault(s, n, p, error);
    const net *hull = node_net_made(n);
    i = hull != NULL ? coordinate_off_net(hull, p[2], x, eval_error) : -1;
    return i >= 0 ? net_fault(s, n, p, x, i, error) : IMP_SUCCESS;
}

/* Evaluates a point with its error bounds. A point that cannot be evaluated is no evidence here. */
static bool evaluate(const surface *s, const double p[3], double x[3], double eval_error[3])
{
    if (surface_eval(s, 1, p, x, eval_error) != IMP_STATUS_OK) return false;
    for (int i = 0; i < 3; ++i)
        if (!(eval_error[i] >= 0 && isfinite(x[i]))) return false;
    return true;
}

imp_code bound_audit_holds_at(const surface *s, const node *n, const double p[3], const double x[3],
                              imp_error *error)
{
    if (!n->bounded || !region_holds(&n->region, p)) return IMP_SUCCESS;
    double eval_error[3], again[3];
    for (int i = 0; i < 3; ++i) eval_error[i] = 0;
    const net *hull = node_net_made(n);
    const bool fine = coordinate_outside(n, p, x, eval_error) < 0 &&
                      !leaves_edges(n, p, x, eval_error) &&
                      (hull == NULL || coordinate_off_net(hull, p[2], x, eval_error) < 0);
    if (fine || !evaluate(s, p, again, eval_error)) return IMP_SUCCESS;
    return judge(s, n, p, again, eval_error, error);
}

enum { AUDIT_POINTS = 8 };

/* Draws a point of the region. The bits of the region's centre are the seed, so that every machine
 * draws the same. */
static void audit_point(const imp_region *r, uint64_t *state, double p[3])
{
    for (int j = 0; j < 3; ++j) {
        const double where = random_fraction(state);
        p[j] = where < 0.25   ? r->lo[j]
               : where > 0.75 ? r->hi[j]
                              : r->lo[j] + (r->hi[j] - r->lo[j]) * 2 * (where - 0.25);
        if (p[j] > r->hi[j]) p[j] = r->hi[j];
    }
}

imp_code bound_audit_run(const surface *s, const node *n, imp_error *error)
{
    uint64_t state = 0;
    for (int j = 0; j < 3; ++j) {
        uint64_t bits;
        memcpy(&bits, &n->region.c[j], sizeof bits);
        state = (state ^ bits) * 0x9e3779b97f4a7c15u;
    }
    if (!n->bounded) return IMP_SUCCESS;
    for (int k = 0; k < AUDIT_POINTS; ++k) {
        double p[3], x[3], eval_error[3];
        audit_point(&n->region, &state, p);
        if (!evaluate(s, p, x, eval_error)) continue;
        const imp_code code = judge(s, n, p, x, eval_error, error);
        if (code != IMP_SUCCESS) return code;
    }
    return distance_audit_run(n, &state, error);
}
