/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/fixed_axes.h"

#include "core/bounds/gjk_axis.h"
#include "core/bounds/quadratic.h"
#include "core/bounds/window_lanes.h"

/* Four axes in lanes, coordinate by coordinate; and their absolute values. */
typedef struct bundle {
    imp_quad x[3], size[3];
} bundle;

IMP_QUAD_INLINE imp_quad along(const bundle *n, const double *v)
{
    return n->x[0] * imp_quad_all(v[0]) + n->x[1] * imp_quad_all(v[1]) +
           n->x[2] * imp_quad_all(v[2]);
}

IMP_QUAD_INLINE imp_quad weighted(const bundle *n, const double *v)
{
    return n->size[0] * imp_quad_all(v[0]) + n->size[1] * imp_quad_all(v[1]) +
           n->size[2] * imp_quad_all(v[2]);
}

/* The coefficients of a slice along each direction. */
typedef struct forms {
    imp_quad bu, bv, uu, uv, vv, uw, vw;
    bool bends;    /* false: uu and vv are 0 */
    bool is_cubic; /* uu, uv and vv change with w, too: */
    imp_quad uuw, uvw, vvw;
} forms;

/* `bends` and `is_cubic` are constant in each caller, so that unused terms are compiled away. */
IMP_QUAD_INLINE forms project(const bundle *n, const slice *s, bool bends, bool is_cubic)
{
    const imp_quad none = imp_quad_all(0);
    forms f = {.bu = along(n, s->bu),
               .bv = along(n, s->bv),
               .uu = bends ? along(n, s->quu) : none,
               .uv = along(n, s->quv),
               .vv = bends ? along(n, s->qvv) : none,
               .uw = along(n, s->quw),
               .vw = along(n, s->qvw),
               .bends = bends,
               .is_cubic = is_cubic};
    if (is_cubic) {
        f.uuw = along(n, s->uuw);
        f.uvw = along(n, s->uvw);
        f.vvw = along(n, s->vvw);
    }
    return f;
}

IMP_QUAD_INLINE forms negative(const forms *f)
{
    return (forms){-f->bu, -f->bv,   -f->uu,      -f->uv,  -f->vv,  -f->uw,
                   -f->vw, f->bends, f->is_cubic, -f->uuw, -f->uvw, -f->vvw};
}

/* Bounds how far the form moves from its value at w = 0, for any parameters and w. */
IMP_QUAD_INLINE imp_quad change_over_w(const forms *f)
{
    const imp_quad slopes = imp_quad_abs(f->uw) + imp_quad_abs(f->vw);
    if (!f->is_cubic) return slopes;
    return slopes + (imp_quad_abs(f->uuw) + imp_quad_abs(f->uvw) + imp_quad_abs(f->vvw));
}

/* Returns the form at w. */
IMP_QUAD_INLINE quadratics form_at(const forms *f, double w)
{
    const imp_quad to = imp_quad_all(w);
    quadratics p = {f->bu + to * f->uw, f->bv + to * f->vw, f->uu, f->uv, f->vv};
    if (f->is_cubic) {
        p.qss += to * f->uuw;
        p.qsr += to * f->uvw;
        p.qrr += to * f->vvw;
    }
    return p;
}

IMP_QUAD_INLINE imp_quad lower(const forms *f, double w)
{
    const quadratics p = form_at(f, w);
    return f->bends ? quadratics_lower(&p) : quadratics_bilinear_lower(&p);
}

/* At every w the form's least value is at most this. */
IMP_QUAD_INLINE imp_quad min_upper_bound(const forms *f)
{
    const quadratics p = {f->bu, f->bv, f->uu, f->uv, f->vv};
    return imp_quad_min(quadratics_corner(&p) + change_over_w(f), imp_quad_all(0));
}

/* --- What four axes show ---------------------------------------------------------------------- */

/* Scales the axes to a longest coordinate of 1 and points them from A to B at w. Returns their
 * longest coordinates before. */
IMP_QUAD_INLINE imp_quad bundle_orient(bundle *n, const difference *r, double w)
{
    const imp_quad longest = imp_quad_max(
        imp_quad_abs(n->x[0]), imp_quad_max(imp_quad_abs(n->x[1]), imp_quad_abs(n->x[2])));
    const imp_quad way = along(n, r->delta) + along(n, r->drift) * imp_quad_all(w) +
                         along(n, r->bend) * imp_quad_all(w * w);
    const imp_quad one = imp_quad_pick(way < imp_quad_all(0), imp_quad_all(-1), imp_quad_all(1));
    const imp_quad scale = one / longest;
    for (int i = 0; i < 3; ++i) {
        n->x[i] *= scale;
        n->size[i] = imp_quad_abs(n->x[i]);
    }
    return longest;
}

/* |n| gamma_clear, rounded up. Roundings: squares 1, sums 2, root (1 + 2) / 2 + 1, product 1. */
PAD_COVERS(16, 3 + 1);
IMP_QUAD_INLINE imp_quad limit_upper(const bundle *n, double gamma_clear)
{
    const imp_quad square = n->x[0] * n->x[0] + n->x[1] * n->x[1] + n->x[2] * n->x[2];
    imp_quad root;
    for (int k = 0; k < IMP_QUAD; ++k) root[k] = sqrt(square[k]);
    return quad_padded_upper(root * imp_quad_all(gamma_clear), 16);
}

/* Adds the line low + drift w of each lane. The length is rounded up:
 * its square goes through 3 roundings, which the root halves and adds one to. */
PAD_COVERS(8, 3);
IMP_QUAD_INLINE void add_lines(gap_lines *lines, const bundle *n, imp_quad_mask sane, imp_quad low,
                               imp_quad drift)
{
    const imp_quad square = n->x[0] * n->x[0] + n->x[1] * n->x[1] + n->x[2] * n->x[2];
    for (int k = 0; k < IMP_QUAD; ++k)
        if (sane[k]) gap_lines_add(lines, low[k], drift[k], padded_upper(sqrt(square[k]), 8));
}

/* A line below the sum of both forms' least values: at w they are at least middle + tilt w. */
typedef struct chord {
    imp_quad middle, tilt;
} chord;

IMP_QUAD_INLINE chord chord_under(const forms *f, const forms *g)
{
    const imp_quad half = imp_quad_all(0.5), start = lower(f, -1) + lower(g, -1);
    if (!imp_quad_any(change_over_w(f) + change_over_w(g) > imp_quad_all(0)))
        return (chord){start, imp_quad_all(0)};
    const imp_quad end = lower(f, 1) + lower(g, 1);
    return (chord){half * (start + end), half * (end - start)};
}

/* Lemma (edges). At w, a remainder sum_k d_k (edge_k + swing_k w), |d_k| <= 1, is along n at most
 * sum_k |n.edge_k + n.swing_k w|, which is convex in w and so at most the chord between its values
 * at the ends. Rounding: EDGE_ROUNDING. */
IMP_QUAD_INLINE imp_quad along_edge(const bundle *n, const double edge[3][4], int k)
{
    return n->x[0] * imp_quad_all(edge[0][k]) + n->x[1] * imp_quad_all(edge[1][k]) +
           n->x[2] * imp_quad_all(edge[2][k]);
}

IMP_QUAD_INLINE chord chord_over_edges(const difference *r, const bundle *n)
{
    const imp_quad half = imp_quad_all(0.5);
    imp_quad start = imp_quad_all(0), end = start;
    for (int side = 0; side < r->posed; ++side)
        for (int k = 0; k < 3; ++k) {
            const imp_quad at = along_edge(n, r->edge[side], k),
                           by = along_edge(n, r->swing[side], k);
            start += imp_quad_abs(at - by);
            end += imp_quad_abs(at + by);
        }
    return (chord){half * (start + end), half * (end - start)};
}

/* Lemma (one axis). Let x of A and y of B have fixed parameters s_a, s_b. Apart from the slack,
 * n.(y - x) is then linear in w, plus n.bend w^2, which lies between min(n.bend, 0) and max(n.bend,
 * 0). The minimum of the linear part over all s_a, s_b is concave in w, being a minimum of linear
 * functions, and so lies above its chord; the maximum lies below its chord. At either end of the
 * window, w = -1 and w = 1, they are
 *
 *   n.delta + n.drift w + [min Qb - max Qa, max Qb - min Qa],   the forms with their slopes at w,
 *
 * and |n.(y - x)| <= |n| |y - x|. So where the lower chord less sum_i |n_i| slack_i and the chord
 * over the edges exceeds g = |n| gamma_clear, or the upper chord plus both is below -g, the nodes
 * are farther apart than gamma_clear. 2^-490 outweighs underflow, since every axis has a coordinate
 * of 1. Lanes whose axis or size is out of range are left out: they prove nothing. The far side is
 * computed only where it may end below g. Rounding, in units of u R, R = sum_i |n_i| magnitude_i:
 *
 *   difference_at                            DIFFERENCE_ROUNDING
 *   dots n.x                               6: of a form 3, of offset, drift and bend 3
 *   form at the ends                       2: product, sum
 *   least values of both forms             2 QUADRATIC_ROUNDING
 *   chord, low +- drift, limit - low      16: sums of at most 4 R
 *   slack and R themselves                12: product 1, sums 2, two more of the slack, four of
 *                                             posed nodes */
enum { AXIS_ROUNDING = 256 };
_Static_assert(DIFFERENCE_ROUNDING + 6 + 2 + 2 * QUADRATIC_ROUNDING + 16 + 12 <= AXIS_ROUNDING,
               "rounding along one axis");

/* Lemma (ways). A sum of d_k ways[k], any |d_k| <= 1, is along n at most sum_k |n.ways[k]|, in any
 * of its senses. A dot is off by at most 4 u (|n| |way|, of the 1-norms), the sum by one rounding
 * for each way: WAYS_ROUNDING outweighs both, beside the sums of the norms themselves. */
enum { WAYS_ROUNDING = 1024 };

IMP_QUAD_INLINE imp_quad along_ways(const difference *r, const bundle *n)
{
    imp_quad sum = imp_quad_all(0), size = sum;
    for (size_t k = 0; k < r->way_count; ++k) {
        sum += imp_quad_abs(along(n, r->ways[k]));
        for (int i = 0; i < 3; ++i) size += n->size[i] * imp_quad_all(fabs(r->ways[k][i]));
    }
    return sum + size * imp_quad_all(WAYS_ROUNDING * UNIT_ROUNDOFF);
}

/* Cuts the range by the lemma above, along four axes: `near` is the lower chord, `far` the negative
 * of the upper one; far_most bounds the latter before the slack. */
IMP_QUAD_INLINE bool cut_along_bundle(const difference *r, bundle *n, double gamma_clear,
                                      w_range *s, gap_lines *lines, bool is_posed, bool bends)
{
    const imp_quad longest = bundle_orient(n, r, r->focus);
    const forms a = project(n, &r->a, bends, is_posed), b = project(n, &r->b, bends, is_posed);
    const forms minus_a = negative(&a), minus_b = negative(&b);
    const imp_quad offset = along(n, r->delta), drift = along(n, r->drift);
    const imp_quad bend = along(n, r->bend), none = imp_quad_all(0);
    const imp_quad size = weighted(n, r->magnitude);
    imp_quad slack = weighted(n, r->slack) + size * imp_quad_all(AXIS_ROUNDING * UNIT_ROUNDOFF) +
                     imp_quad_all(QUADRATIC_UNDERFLOW);
    if (r->way_count > 0) slack += along_ways(r, n);
    if (r->ball > 0) slack += limit_upper(n, r->ball);
    const imp_quad_mask sane = (longest > imp_quad_all(0x1p-400)) &
                               (longest < imp_quad_all(0x1p400)) & (size < imp_quad_all(0x1p400));
    const imp_quad limit = imp_quad_pick(sane, limit_upper(n, gamma_clear), imp_quad_all(INFINITY));
    chord over = {none, none}, near = chord_under(&b, &minus_a);
    if (is_posed) {
        over = chord_over_edges(r, n);
        near.middle -= over.middle;
        near.tilt -= over.tilt;
    }
    window_lanes c = window_lanes_none();
    const imp_quad low = offset + imp_quad_min(bend, none) + near.middle - slack;
    window_lanes_add(&c, low, drift + near.tilt, limit);
    if (lines != NULL) add_lines(lines, n, sane, low, drift + near.tilt);
    const imp_quad high = offset + imp_quad_max(bend, none);
    const imp_quad far_most = imp_quad_abs(drift) - offset + min_upper_bound(&a) +
                              min_upper_bound(&minus_b) - imp_quad_min(bend, none);
    if (imp_quad_any(far_most > none)) {
        chord far = chord_under(&a, &minus_b);
        if (is_posed) {
            far.middle -= over.middle;
            far.tilt -= over.tilt;
        }
        window_lanes_add(&c, far.middle - high - slack, far.tilt - drift, limit);
        if (lines != NULL) add_lines(lines, n, sane, far.middle - high - slack, far.tilt - drift);
    }
    return window_lanes_take(s, &c);
}

IMP_QUAD_INLINE bool bundle_cut(const difference *r, bundle *n, double gamma_clear, w_range *s,
                                gap_lines *lines)
{
    const bool bends = !(r->squares == 0);
    if (r->posed > 0)
        return bends ? cut_along_bundle(r, n, gamma_clear, s, lines, true, true)
                     : cut_along_bundle(r, n, gamma_clear, s, lines, true, false);
    return bends ? cut_along_bundle(r, n, gamma_clear, s, lines, false, true)
                 : cut_along_bundle(r, n, gamma_clear, s, lines, false, false);
}

IMP_QUAD_INLINE imp_quad direction(const slice *s, double w)
{
    return imp_quad_load(s->bu) + imp_quad_load(s->bv) +
           imp_quad_all(w) * (imp_quad_load(s->quw) + imp_quad_load(s->qvw));
}

/* Returns a vector that is nearly perpendicular to both curves at w; curves have no normals. */
IMP_QUAD_INLINE imp_quad across(const difference *r, double w)
{
    return imp_quad_cross(direction(&r->a, w), direction(&r->b, w));
}

IMP_QUAD_INLINE imp_quad quad_from(vec3 v) { return imp_quad_of(v.x[0], v.x[1], v.x[2], 0); }

/* Makes a bundle of two axes and both normals or, for two curves, vectors perpendicular to both at
 * either end. */
IMP_QUAD_INLINE bundle bundle_with(const difference *r, vec3 x, vec3 y)
{
    const bool curves = !(vec3_norm1(r->a.normal) + vec3_norm1(r->b.normal) > 0);
    imp_quad n[4] = {quad_from(x), curves ? across(r, -1) : quad_from(r->a.normal),
                     curves ? across(r, 1) : quad_from(r->b.normal), quad_from(y)};
    imp_quad_transpose(n);
    return (bundle){.x = {n[0], n[1], n[2]}};
}

/* Cuts along the axis that is best at the focus, which is the window's start in a search for the
 * earliest contact; along both normals; and along the line of centres at the end of the window that
 * is farther from the focus. If no axis separates the nodes at the focus, the line of centres there
 * replaces the first. */
IMP_QUAD_INLINE bool cut_along_axes(const difference *r, double gamma_clear, w_range *s, vec3 *axis,
                                    gap_lines *lines)
{
    const vec3 here = difference_offset(r, r->focus);
    const vec3 end = difference_offset(r, r->focus > 0 ? -1 : 1);
    vec3 best = vec3_norm1(*axis) > 0 ? *axis : here;
    const bool apart = gjk_axis(r, r->focus, &best);
    *axis = apart ? best : (vec3){{0, 0, 0}};
    bundle n = bundle_with(r, apart ? best : here, end);
    return bundle_cut(r, &n, gamma_clear, s, lines);
}

/* Cuts along a given axis, both normals and the line of centres at the window's end. */
IMP_QUAD_INLINE bool cut_along_given(const difference *r, double gamma_clear, w_range *s, vec3 axis)
{
    const vec3 end = vec3_add(vec3_from(r->delta), vec3_from(r->drift));
    bundle n = bundle_with(r, axis, end);
    return bundle_cut(r, &n, gamma_clear, s, NULL);
}

IMP_QUAD_NARROW static bool cut_along_given_narrow(const difference *r, double gamma_clear,
                                                   w_range *s, vec3 axis)
{
    return cut_along_given(r, gamma_clear, s, axis);
}

IMP_QUAD_WIDE static bool cut_along_given_wide(const difference *r, double gamma_clear, w_range *s,
                                               vec3 axis)
{
    return cut_along_given(r, gamma_clear, s, axis);
}

bool fixed_axes_cut_along(const difference *r, double gamma_clear, w_range *s, vec3 axis)
{
    return imp_quad_is_wide() ? cut_along_given_wide(r, gamma_clear, s, axis)
                              : cut_along_given_narrow(r, gamma_clear, s, axis);
}

IMP_QUAD_NARROW static bool cut_along_axes_narrow(const difference *r, double gamma_clear,
                                                  w_range *s, vec3 *axis, gap_lines *lines)
{
    return cut_along_axes(r, gamma_clear, s, axis, lines);
}

IMP_QUAD_WIDE static bool cut_along_axes_wide(const difference *r, double gamma_clear, w_range *s,
                                              vec3 *axis, gap_lines *lines)
{
    return cut_along_axes(r, gamma_clear, s, axis, lines);
}

bool fixed_axes_cut(const difference *r, double gamma_clear, w_range *s, vec3 *axis,
                    gap_lines *lines)
{
    return imp_quad_is_wide() ? cut_along_axes_wide(r, gamma_clear, s, axis, lines)
                              : cut_along_axes_narrow(r, gamma_clear, s, axis, lines);
}
