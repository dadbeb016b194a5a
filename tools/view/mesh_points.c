/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "tools/view/mesh.h"

/* --- Points and normals -------------------------------------------------------------- */

/* Steps to either side for a difference quotient: 2^-20 of the domain, so that neither curvature
 * nor rounding shows in a normal. */
typedef struct offsets {
    double lo[2], hi[2], h[2];
} offsets;

/* Five points: here, then to either side in u and in v, inside the domain. */
static void five_points(const offsets *o, double u, double v, double t, double p[15])
{
    for (int k = 0; k < 5; ++k) p[3 * k] = u, p[3 * k + 1] = v, p[3 * k + 2] = t;
    p[3] = fmax(u - o->h[0], o->lo[0]), p[6] = fmin(u + o->h[0], o->hi[0]);
    p[10] = fmax(v - o->h[1], o->lo[1]), p[13] = fmin(v + o->h[1], o->hi[1]);
}

static void take_five(mesh *m, size_t at, const double x[15])
{
    const vec du = vec_sub(vec_of(x + 6), vec_of(x + 3)),
              dv = vec_sub(vec_of(x + 12), vec_of(x + 9));
    const vec n = vec_cross(du, dv);
    const double scale = vec_length(du) * vec_length(dv);
    m->point[at] = vec_of(x);
    m->normal[at] = vec_length(n) > 1e-4 * scale ? vec_unit(n) : (vec){{0, 0, 0}};
}

/* Where the surface has no normal of its own, as at a pole, the mean of the triangles' around it,
 * each weighed by its area. */
static void add_facet(void *context, const mesh *m, const size_t c[3])
{
    vec *sum = context;
    const vec n =
        vec_cross(vec_sub(m->point[c[1]], m->point[c[0]]), vec_sub(m->point[c[2]], m->point[c[0]]));
    for (int k = 0; k < 3; ++k) sum[c[k]] = vec_add(sum[c[k]], n);
}

/* The sums of a pole's copies are one sum: it is one point. */
static void join_pole(mesh *m, vec *sum, size_t from, size_t step, size_t count)
{
    vec all = {{0, 0, 0}};
    for (size_t k = 0; k < count; ++k) {
        if (vec_dot(m->normal[from + k * step], m->normal[from + k * step]) > 0) return;
        all = vec_add(all, sum[from + k * step]);
    }
    for (size_t k = 0; k < count; ++k) sum[from + k * step] = all;
}

static void mend_normals(mesh *m, vec *sum)
{
    const size_t n = m->nu * m->nv;
    mesh_triangles(m, add_facet, sum);
    for (size_t i = 0; i < m->nu; ++i) join_pole(m, sum, i * m->nv, 1, m->nv);
    join_pole(m, sum, 0, m->nv, m->nu);
    join_pole(m, sum, m->nv - 1, m->nv, m->nu);
    for (size_t k = 0; k < n; ++k)
        if (!(vec_dot(m->normal[k], m->normal[k]) > 0)) m->normal[k] = vec_unit(sum[k]);
}

static imp_code move_row(const imp_scene *scene, mesh *m, const offsets *o, size_t i, double t,
                         double *p, double *x, imp_error *error)
{
    for (size_t j = 0; j < m->nv; ++j) five_points(o, m->u[i], m->v[j], t, p + 15 * j);
    const imp_code code = imp_piece_eval(scene, mesh_place(m), 5 * m->nv, p, x, NULL, error);
    for (size_t j = 0; j < m->nv && code == IMP_SUCCESS; ++j)
        take_five(m, i * m->nv + j, x + 15 * j);
    return code;
}

imp_code mesh_move(const imp_scene *scene, mesh *m, double t, imp_error *error)
{
    const offsets o = {
        {m->u[0], m->v[0]},
        {m->u[m->nu - 1], m->v[m->nv - 1]},
        {0x1p-20 * (m->u[m->nu - 1] - m->u[0]), 0x1p-20 * (m->v[m->nv - 1] - m->v[0])}};
    double *p = calloc(15 * m->nv, sizeof *p), *x = calloc(15 * m->nv, sizeof *x);
    vec *sum = calloc(m->nu * m->nv, sizeof *sum);
    imp_code code = p != NULL && x != NULL && sum != NULL ? IMP_SUCCESS : mesh_no_memory(error);
    for (size_t i = 0; i < m->nu && code == IMP_SUCCESS; ++i)
        code = move_row(scene, m, &o, i, t, p, x, error);
    if (code == IMP_SUCCESS) mend_normals(m, sum);
    free(p);
    free(x);
    free(sum);
    return code;
}

/* --- Triangles ------------------------------------------------------------------------- */

size_t mesh_triangle_count(const mesh *m) { return 2 * (m->nu - 1) * (m->nv - 1); }

void mesh_triangles(const mesh *m, mesh_visitor visit, void *context)
{
    for (size_t i = 0; i + 1 < m->nu; ++i)
        for (size_t j = 0; j + 1 < m->nv; ++j) {
            const size_t a = i * m->nv + j, b = a + m->nv;
            visit(context, m, (const size_t[3]){a, b, b + 1});
            visit(context, m, (const size_t[3]){a, b + 1, a + 1});
        }
}

void mesh_marked_steps(const mesh *m, mesh_step_visitor visit, void *context)
{
    for (size_t i = 0; i < m->nu; ++i)
        for (size_t j = 0; j + 1 < m->nv && m->marked_u[i]; ++j)
            visit(context, m, i * m->nv + j, i * m->nv + j + 1);
    for (size_t j = 0; j < m->nv; ++j)
        for (size_t i = 0; i + 1 < m->nu && m->marked_v[j]; ++i)
            visit(context, m, i * m->nv + j, (i + 1) * m->nv + j);
}
