/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/mesh_cell.h"

#include <math.h>

/* At a fixed time coordinate i of a cell is a + b_u s + b_v r + q_uu s^2 + q_uv s r + q_vv r^2
 * within e, for s, r in [-1,1]. The corners' own rounding, some 1e-16 of the coordinates, is left
 * out of both bounds: no picture shows it. */

/* --- Point by point --------------------------------------------------------------------------- */

/* Bounds the coordinate's curvature along u and v, without q_uv. Lemma. The function linear in s,
 * linear in r, that agrees at the four corners differs from the coordinate by q_uu (s^2 - 1) + q_vv
 * (r^2 - 1), at most |q_uu| + |q_vv|, and by e once at the point and once at the corners, of which
 * it is a mean. */
static double bend(const imp_model *m)
{
    return fabs(m->q[IMP_UU]) + fabs(m->q[IMP_VV]) + 2 * m->e;
}

/* Lemma. The triangles are linear and agree with the coordinate at three corners each. The rest
 * beside `bend` is q_uv: on the triangle s >= r, s r - (r - s + 1) = (s - 1)(r + 1) is in [-1, 0],
 * on the other (s + 1)(r - 1), likewise. Both points are also in [lo, hi], so no coordinate differs
 * by more than its width. */
static double coordinate_error(const imp_model *m)
{
    const double bent = bend(m) + fabs(m->q[IMP_UV]), wide = m->hi - m->lo;
    return bent < wide ? bent : wide;
}

/* --- As sets ---------------------------------------------------------------------------------- */

static vec coefficient(const imp_model m[3], bool of_b, int k)
{
    return of_b ? (vec){{m[0].b[k], m[1].b[k], m[2].b[k]}}
                : (vec){{m[0].q[k], m[1].q[k], m[2].q[k]}};
}

/* Rounding of the cross products below, relative to their factors. */
static const double cross_slack = 1e-12;

/* Bounds the distance of the cell's image from the two triangles, as sets of points.
 *
 * Lemma. Let B = a + b_u s + b_v r + q s r be linear in s and in r, n the unit normal of b_u and
 * b_v, and q = q_t + n (n.q). Without the last term B lies in the plane through a, and its Jacobian
 * n.(b_u x b_v) + s n.(b_u x q_t) + r n.(q_t x b_v) is linear in s and r: if it is nowhere
 * negative, the four corners form a convex quadrilateral, of which a corner may coincide with the
 * next, and B covers just that, as do the two triangles. The term shifts points of B, and those of
 * the triangles, by |n.q| at most. The surface is within `bend` of the B of its own corners. A
 * Jacobian that is negative by rounding alone turns a corner inward by that part of the sides. */
static double set_error(const imp_model m[3])
{
    const vec bu = coefficient(m, true, 0), bv = coefficient(m, true, 1);
    const vec q = coefficient(m, false, IMP_UV), normal = vec_cross(bu, bv);
    const double area = vec_length(normal);
    if (!(area > 0)) return INFINITY;
    const vec n = vec_scale(1 / area, normal);
    const double lift = fabs(vec_dot(n, q));
    const double turn = fabs(vec_dot(n, vec_cross(bu, q))) + fabs(vec_dot(n, vec_cross(q, bv)));
    if (!(turn <= area * (1 + cross_slack))) return INFINITY;
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += bend(&m[i]) * bend(&m[i]);
    return sqrt(sum) + 2 * lift +
           4 * cross_slack * (vec_length(bu) + vec_length(bv) + vec_length(q));
}

/* --- Cells ------------------------------------------------------------------------------------ */

static void take_shares(cell_error *cell, const imp_model *m)
{
    const double bu = fabs(m->b[0]), bv = fabs(m->b[1]), all = bu + bv;
    const double both = 0.5 * fabs(m->q[IMP_UV]), e = isfinite(m->e) ? m->e : 1;
    cell->share[0] += fabs(m->q[IMP_UU]) + both + e * (all > 0 ? bu / all : 0.5);
    cell->share[1] += fabs(m->q[IMP_VV]) + both + e * (all > 0 ? bv / all : 0.5);
}

imp_code cell_measure(const imp_scene *scene, imp_place at, const double u[2], const double v[2],
                      double t, cell_error *cell, imp_error *error)
{
    const double lo[3] = {u[0], v[0], t}, hi[3] = {u[1], v[1], t};
    imp_model model[3];
    const imp_code code = imp_piece_include(scene, at, lo, hi, model, error);
    if (code != IMP_SUCCESS) return code;
    *cell = (cell_error){.upper = 0};
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double e = coordinate_error(&model[k]);
        sum += e * e;
        take_shares(cell, &model[k]);
        cell->box.lo.x[k] = model[k].lo, cell->box.hi.x[k] = model[k].hi;
    }
    const double by_point = sqrt(sum), by_set = set_error(model);
    cell->upper = by_set < by_point ? by_set : by_point;
    return code;
}

bool cell_is_in_focus(vec focus, double radius, const vec_box *box)
{
    if (!(radius < INFINITY)) return true;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double x = focus.x[k];
        const double off = x < box->lo.x[k]   ? box->lo.x[k] - x
                           : x > box->hi.x[k] ? x - box->hi.x[k]
                                              : 0;
        sum += off * off;
    }
    return sqrt(sum) <= radius;
}
