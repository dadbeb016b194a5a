/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "tools/view/mesh.h"
#include "tools/view/mesh_cell.h"

/* --- Triangles -------------------------------------------------------------------------------- */

void mesh_patch_triangles(const mesh *m, const mesh_patch *p, mesh_visitor visit, void *context)
{
    size_t cell = p->first_cell;
    for (size_t i = 0; i + 1 < p->nu; ++i)
        for (size_t j = 0; j + 1 < p->nv; ++j, ++cell) {
            const size_t a = p->first_point + i * p->nv + j, b = a + p->nv;
            visit(context, m, (const size_t[3]){a, b, b + 1}, cell);
            if (!p->is_triangle) visit(context, m, (const size_t[3]){a, b + 1, a + 1}, cell);
        }
}

void mesh_triangles(const mesh *m, mesh_visitor visit, void *context)
{
    for (size_t k = 0; k < m->patch_count; ++k)
        mesh_patch_triangles(m, &m->patches[k], visit, context);
}

/* --- Points and normals of curved patches ----------------------------------------------------- */

/* Steps for a difference quotient: 2^-20 of the domain, so that neither curvature nor rounding
 * shows in a normal. */
typedef struct offsets {
    double hi[2], h[2];
} offsets;

/* Memory for one row of points, and for the normals of one patch. */
typedef struct scratch {
    double *p, *x;
    vec *sum;
} scratch;

/* Returns a value one step further, or back at the end of the domain. */
static double beside(double at, double h, double hi) { return at + h <= hi ? at + h : at - h; }

/* Makes three points: at u and v, and one step away in u, and in v. */
static void three_points(const offsets *o, double u, double v, double t, double p[9])
{
    for (int k = 0; k < 3; ++k) p[3 * k] = u, p[3 * k + 1] = v, p[3 * k + 2] = t;
    p[3] = beside(u, o->h[0], o->hi[0]);
    p[7] = beside(v, o->h[1], o->hi[1]);
}

static void take_three(mesh *m, size_t at, const double p[9], const double x[9])
{
    const double turn = (p[3] < p[0]) == (p[7] < p[1]) ? 1 : -1; /* a step back turns the normal */
    const vec du = vec_sub(vec_of(x + 3), vec_of(x)), dv = vec_sub(vec_of(x + 6), vec_of(x));
    const vec n = vec_scale(turn, vec_cross(du, dv));
    const double scale = vec_length(du) * vec_length(dv);
    m->point[at] = vec_of(x);
    m->normal[at] = vec_length(n) > 1e-4 * scale ? vec_unit(n) : (vec){{0, 0, 0}};
}

typedef struct facets {
    vec *sum; /* one a point of the patch */
    size_t first;
} facets;

/* A point without a normal, such as a pole, gets the mean of the normals of the triangles around
 * it, weighted by area. */
static void add_facet(void *context, const mesh *m, const size_t c[3], size_t cell)
{
    const facets *f = context;
    const vec side = vec_sub(m->point[c[1]], m->point[c[0]]);
    const vec n = vec_cross(side, vec_sub(m->point[c[2]], m->point[c[0]]));
    (void)cell;
    for (int k = 0; k < 3; ++k) f->sum[c[k] - f->first] = vec_add(f->sum[c[k] - f->first], n);
}

/* Adds up the sums of all copies of a pole, since they are one point. */
static void join_pole(const vec *normal, vec *sum, size_t from, size_t step, size_t count)
{
    vec all = {{0, 0, 0}};
    for (size_t k = 0; k < count; ++k) {
        const size_t at = from + k * step;
        if (vec_dot(normal[at], normal[at]) > 0) return;
        all = vec_add(all, sum[at]);
    }
    for (size_t k = 0; k < count; ++k) sum[from + k * step] = all;
}

static void mend_normals(mesh *m, const mesh_patch *p, vec *sum)
{
    const size_t n = p->nu * p->nv;
    vec *normal = m->normal + p->first_point;
    facets f = {sum, p->first_point};
    memset(sum, 0, n * sizeof *sum);
    mesh_patch_triangles(m, p, add_facet, &f);
    for (size_t i = 0; i < p->nu; ++i) join_pole(normal, sum, i * p->nv, 1, p->nv);
    join_pole(normal, sum, 0, p->nv, p->nu);
    join_pole(normal, sum, p->nv - 1, p->nv, p->nu);
    for (size_t k = 0; k < n; ++k)
        if (!(vec_dot(normal[k], normal[k]) > 0)) normal[k] = vec_unit(sum[k]);
}

static imp_code evaluate_row(const imp_scene *scene, mesh *m, const mesh_patch *p, const offsets *o,
                             size_t i, double t, const scratch *s, imp_error *error)
{
    const double u = mesh_u(m, p)[i], *v = mesh_v(m, p);
    const imp_place at = {m->body, m->surface, p->piece};
    for (size_t j = 0; j < p->nv; ++j) three_points(o, u, v[j], t, s->p + 9 * j);
    const imp_code code = imp_piece_eval(scene, at, 3 * p->nv, s->p, s->x, NULL, error);
    for (size_t j = 0; j < p->nv && code == IMP_SUCCESS; ++j)
        take_three(m, p->first_point + i * p->nv + j, s->p + 9 * j, s->x + 9 * j);
    return code;
}

static imp_code evaluate_curved(const imp_scene *scene, mesh *m, const mesh_patch *p, double t,
                                allowance *l, const scratch *s, imp_error *error)
{
    const double *u = mesh_u(m, p), *v = mesh_v(m, p);
    const double u1 = u[p->nu - 1], v1 = v[p->nv - 1];
    const offsets o = {{u1, v1}, {0x1p-20 * (u1 - u[0]), 0x1p-20 * (v1 - v[0])}};
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < p->nu && code == IMP_SUCCESS; ++i) {
        code = allowance_check(l, "points were evaluated", error);
        if (code == IMP_SUCCESS) code = evaluate_row(scene, m, p, &o, i, t, s, error);
    }
    if (code == IMP_SUCCESS) mend_normals(m, p, s->sum);
    return code;
}

/* --- All patches ------------------------------------------------------------------------------ */

/* Four corners, which have one normal. */
static imp_code evaluate_flat(const imp_scene *scene, mesh *m, const mesh_patch *p, double t,
                              imp_error *error)
{
    const double *u = mesh_u(m, p), *v = mesh_v(m, p);
    const double at[12] = {u[0], v[0], t, u[0], v[1], t, u[1], v[0], t, u[1], v[1], t};
    double x[12];
    const imp_code code =
        imp_piece_eval(scene, (imp_place){m->body, m->surface, p->piece}, 4, at, x, NULL, error);
    if (code != IMP_SUCCESS) return code;
    const vec across = vec_sub(vec_of(x + 9), vec_of(x));
    const vec n = vec_unit(vec_cross(vec_sub(vec_of(x + 6), vec_of(x + 3)), across));
    for (size_t k = 0; k < 4; ++k) {
        m->point[p->first_point + k] = vec_of(x + 3 * k);
        m->normal[p->first_point + k] = n;
    }
    return code;
}

static bool scratch_begin(const mesh *m, scratch *s)
{
    size_t longest = 1, most = 1;
    for (size_t k = 0; k < m->patch_count; ++k) {
        const mesh_patch *p = &m->patches[k];
        if (p->nv > longest) longest = p->nv;
        if (p->nu * p->nv > most) most = p->nu * p->nv;
    }
    *s = (scratch){malloc(9 * longest * sizeof *s->p), malloc(9 * longest * sizeof *s->x),
                   malloc(most * sizeof *s->sum)};
    return s->p != NULL && s->x != NULL && s->sum != NULL;
}

static imp_code evaluate(const imp_scene *scene, mesh *m, double t, allowance *l, imp_error *error)
{
    scratch s;
    imp_code code = scratch_begin(m, &s) ? IMP_SUCCESS : mesh_no_memory(error);
    for (size_t k = 0; k < m->patch_count && code == IMP_SUCCESS; ++k) {
        const mesh_patch *p = &m->patches[k];
        code = allowance_check(l, "points were evaluated", error);
        if (code != IMP_SUCCESS) break;
        code = p->is_flat && p->nu == 2 && p->nv == 2
                   ? evaluate_flat(scene, m, p, t, error)
                   : evaluate_curved(scene, m, p, t, l, &s, error);
    }
    free(s.p);
    free(s.x);
    free(s.sum);
    return code;
}

/* --- Moving ----------------------------------------------------------------------------------- */

static vec turned(const imp_rigid_motion *motion, vec x)
{
    vec y;
    for (int i = 0; i < 3; ++i) y.x[i] = vec_dot(vec_of(motion->turn[i]), x);
    return y;
}

imp_code mesh_motion(const imp_scene *scene, const mesh *m, double t, imp_rigid_motion *motion,
                     imp_error *error)
{
    motion->is_known = false;
    if (!m->is_rigid) return IMP_SUCCESS;
    return imp_piece_motion(scene, mesh_place(m, 0), m->home, t, motion, error);
}

imp_code mesh_move(const imp_scene *scene, mesh *m, double t, allowance *l, imp_error *error)
{
    imp_rigid_motion motion;
    const imp_code code = mesh_motion(scene, m, t, &motion, error);
    if (code != IMP_SUCCESS) return code;
    if (!motion.is_known) return evaluate(scene, m, t, l, error);
    const vec shift = vec_of(motion.shift);
    for (size_t k = 0; k < m->point_count; ++k) {
        m->point[k] = vec_add(turned(&motion, m->home_point[k]), shift);
        m->normal[k] = turned(&motion, m->home_normal[k]);
    }
    return allowance_check(l, "points were moved", error);
}

/* --- Error ------------------------------------------------------------------------------------ */

/* A rigid motion lengthens vectors by less than this factor: IMP_RIGID_SLACK for each of a hundred
 * maps. */
static const double stretch_upper = 1.002;

static imp_code patch_error(const imp_scene *scene, const mesh *m, const mesh_patch *p, double t,
                            double *upper, imp_error *error)
{
    const double *u = mesh_u(m, p), *v = mesh_v(m, p);
    const imp_place at = {m->body, m->surface, p->piece};
    for (size_t i = 0; i + 1 < p->nu; ++i)
        for (size_t j = 0; j + 1 < p->nv; ++j) {
            cell_error cell;
            const imp_code code = cell_measure(scene, at, u + i, v + j, t, &cell, error);
            if (code != IMP_SUCCESS) return code;
            if (cell.upper <= *upper || !cell_is_in_focus(m->focus, m->focus_radius, &cell.box))
                continue;
            *upper = cell.upper;
        }
    return IMP_SUCCESS;
}

imp_code mesh_error(const imp_scene *scene, const mesh *m, double t, allowance *l, double *upper,
                    imp_error *error)
{
    imp_rigid_motion motion;
    imp_code code = mesh_motion(scene, m, t, &motion, error);
    *upper = motion.is_known ? stretch_upper * m->home_error : 0;
    for (size_t k = 0; k < m->patch_count && code == IMP_SUCCESS && !motion.is_known; ++k) {
        code = allowance_check(l, "the error of triangles was found", error);
        if (code == IMP_SUCCESS) code = patch_error(scene, m, &m->patches[k], t, upper, error);
    }
    return code;
}
