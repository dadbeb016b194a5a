/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/mass.h"

#include <stdlib.h>

/* --- Points of a surface -------------------------------------------------------------------- */

/* Cells of the finest grid along u and v; coarser ones take every second point, and every fourth.
 * Many surfaces have fewer cells each. */
enum { CELLS_MAX = 128, CELLS_MIN = 16, SIDE_MAX = CELLS_MAX + 1, LEVELS = 3 };

static int cells_for(size_t surfaces)
{
    int cells = CELLS_MAX;
    for (size_t n = 8; n < surfaces && cells > CELLS_MIN; n *= 4) cells /= 2;
    return cells;
}

typedef struct grid {
    int cells;
    vec *at; /* (cells + 1)^2 points, v first */
} grid;

static vec grid_at(const grid *g, int i, int j) { return g->at[i * (g->cells + 1) + j]; }

static mass_verdict grid_read(grid *g, const imp_scene *scene, size_t body, size_t surface,
                              double t, imp_error *why)
{
    double lo[3], hi[3], p[3 * SIDE_MAX], x[3 * SIDE_MAX];
    const int n = g->cells;
    imp_scene_domain(scene, body, surface, lo, hi);
    for (int j = 0; j < 2; ++j)
        if (!(hi[j] - lo[j] < INFINITY)) return MASS_UNBOUNDED;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            p[3 * j] = i < n ? lo[0] + (hi[0] - lo[0]) * i / n : hi[0];
            p[3 * j + 1] = j < n ? lo[1] + (hi[1] - lo[1]) * j / n : hi[1];
            p[3 * j + 2] = t;
        }
        if (imp_scene_eval(scene, body, surface, (size_t)n + 1, p, x, NULL, why) != IMP_SUCCESS)
            return why->code == IMP_ERROR_MEMORY ? MASS_NO_MEMORY : MASS_FAULT;
        for (int j = 0; j <= n; ++j) g->at[i * (n + 1) + j] = vec_of(x + 3 * j);
    }
    return MASS_FOUND;
}

/* --- Integrals of polyhedra ------------------------------------------------------------------ */

enum { VOLUME, MOMENT, SQUARE = 4, MIXED = 7, AREA = 10, BY_AXIS = 13, INTEGRALS = 16 };
/* MIXED: of xy, yz, zx. BY_AXIS: the volume by I(x n_x), I(y n_y), I(z n_z). */

/* The tetrahedron of a triangle and the origin: sums over its corners a, b, c and 0. Over one of
 * volume V the mean of x_i is s_i / 4 and that of x_i x_j is (s_i s_j + sum_corners x_i x_j) / 20. */
static void add_triangle(vec a, vec b, vec c, double *sum)
{
    const vec normal = vec_cross(vec_sub(b, a), vec_sub(c, a)), s = vec_add(a, vec_add(b, c));
    const double volume = vec_dot(a, vec_cross(b, c)) / 6;
    sum[VOLUME] += volume;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double squares = a.x[i] * a.x[i] + b.x[i] * b.x[i] + c.x[i] * c.x[i];
        const double products = a.x[i] * a.x[j] + b.x[i] * b.x[j] + c.x[i] * c.x[j];
        sum[MOMENT + i] += volume * s.x[i] / 4;
        sum[SQUARE + i] += volume * (s.x[i] * s.x[i] + squares) / 20;
        sum[MIXED + i] += volume * (s.x[i] * s.x[j] + products) / 20;
        sum[AREA + i] += normal.x[i] / 2;
        sum[BY_AXIS + i] += s.x[i] * normal.x[i] / 6;
    }
}

/* Each cell as two triangles, about the middle of all so that little cancels. Both ways to cut it are
 * taken, each for one half, so that errors are even in the step. */
static void add_surface(const grid *g, int step, vec middle, double *sum)
{
    for (int k = 0; k < INTEGRALS; ++k) sum[k] = 0;
    for (int i = 0; i < g->cells; i += step)
        for (int j = 0; j < g->cells; j += step) {
            const vec a = vec_sub(grid_at(g, i, j), middle);
            const vec b = vec_sub(grid_at(g, i + step, j), middle);
            const vec c = vec_sub(grid_at(g, i + step, j + step), middle);
            const vec d = vec_sub(grid_at(g, i, j + step), middle);
            add_triangle(a, b, c, sum);
            add_triangle(a, c, d, sum);
            add_triangle(a, b, d, sum);
            add_triangle(b, c, d, sum);
        }
    for (int k = 0; k < INTEGRALS; ++k) sum[k] /= 2;
}

/* From sums with steps 4, 2 and 1 to those with step 0, and what the last refinement changed. */
static void extrapolate(double sum[LEVELS][INTEGRALS], double *out, double *change)
{
    for (int k = 0; k < INTEGRALS; ++k) {
        const double once = sum[1][k] + (sum[1][k] - sum[0][k]) / 3;
        const double again = sum[2][k] + (sum[2][k] - sum[1][k]) / 3;
        out[k] = again + (again - once) / 15;
        change[k] = fabs(out[k] - again);
    }
}

/* --- Is it closed? ---------------------------------------------------------------------------- */

#define CLOSED_SLACK 1e-6

/* One of the four edges of each surface, as cells + 1 points of it. */
typedef struct edge {
    vec at[SIDE_MAX];
    int cells;
    size_t surface;
    int side; /* 0, 1: lowest and highest u; 2, 3: v */
} edge;

static void edge_read(edge *e, const grid *g, size_t surface, int side)
{
    e->surface = surface;
    e->side = side;
    e->cells = g->cells;
    const int end = side % 2 == 0 ? 0 : g->cells;
    for (int k = 0; k <= g->cells; ++k)
        e->at[k] = side < 2 ? grid_at(g, end, k) : grid_at(g, k, end);
}

static bool edge_is_point(const edge *e, double slack)
{
    for (int k = 1; k <= e->cells; ++k)
        if (!(vec_length(vec_sub(e->at[k], e->at[0])) <= slack)) return false;
    return true;
}

/* The parameter of the point k of an edge, or between two of them: (u, v). */
static void edge_parameters(const edge *e, const double lo[3], const double hi[3], double k,
                            double p[3])
{
    const int along = e->side < 2 ? 1 : 0, across = 1 - along;
    p[across] = e->side % 2 == 0 ? lo[across] : hi[across];
    p[along] = k >= e->cells ? hi[along] : lo[along] + (hi[along] - lo[along]) * k / e->cells;
}

/* How far x is from the edge between its points k - 1 and k + 1, by golden section. */
static double refined_distance(const imp_scene *scene, size_t body, double t, const edge *e, int k,
                               vec x)
{
    const double ratio = 0.6180339887498949;
    double a = k > 0 ? k - 1 : 0, b = k < e->cells ? k + 1 : e->cells, lo[3], hi[3],
           least = INFINITY;
    imp_scene_domain(scene, body, e->surface, lo, hi);
    for (int n = 0; n < 60; ++n) {
        const double at[2] = {b - ratio * (b - a), a + ratio * (b - a)};
        double distance[2];
        for (int i = 0; i < 2; ++i) {
            double p[3] = {0, 0, t}, y[3] = {0, 0, 0};
            edge_parameters(e, lo, hi, at[i], p);
            if (imp_scene_eval(scene, body, e->surface, 1, p, y, NULL, NULL) != IMP_SUCCESS)
                return INFINITY;
            distance[i] = vec_length(vec_sub(vec_of(y), x));
            if (distance[i] < least) least = distance[i];
        }
        if (distance[0] < distance[1])
            b = at[1];
        else
            a = at[0];
    }
    return least;
}

static bool lies_on(const imp_scene *scene, size_t body, double t, const edge *e, vec x,
                    double slack)
{
    int best = 0;
    double least = INFINITY;
    for (int k = 0; k <= e->cells; ++k) {
        const double distance = vec_length(vec_sub(e->at[k], x));
        if (distance < least) least = distance, best = k;
    }
    if (least <= slack) return true;
    const double step = vec_length(vec_sub(e->at[best > 0 ? best - 1 : 1], e->at[best]));
    return least <= 4 * step + slack && refined_distance(scene, body, t, e, best, x) <= slack;
}

/* Sixteen steps along each edge must lie on another edge. */
static bool is_closed(const imp_scene *scene, size_t body, double t, const edge *edges,
                      size_t count, double slack, vec *where)
{
    for (size_t i = 0; i < count; ++i) {
        if (edge_is_point(&edges[i], slack)) continue;
        for (int k = 0; k <= edges[i].cells; k += edges[i].cells / 16) {
            bool found = false;
            for (size_t j = 0; j < count && !found; ++j)
                found = j != i && lies_on(scene, body, t, &edges[j], edges[i].at[k], slack);
            if (!found) {
                *where = edges[i].at[k];
                return false;
            }
        }
    }
    return true;
}

/* --- All of it -------------------------------------------------------------------------------- */

/* Of the mass 1, about the center; the integrals are about `middle`. */
static void properties_of(const double *sum, vec middle, mass_properties *out)
{
    const double volume = sum[VOLUME];
    double square[3], mixed[3];
    vec c;
    for (int i = 0; i < 3; ++i) c.x[i] = sum[MOMENT + i] / volume;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        square[i] = sum[SQUARE + i] / volume - c.x[i] * c.x[i];
        mixed[i] = sum[MIXED + i] / volume - c.x[i] * c.x[j];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out->inertia.m[i][i] = square[j] + square[k];
        out->inertia.m[i][j] = out->inertia.m[j][i] = -mixed[i];
    }
    out->volume = fabs(volume);
    out->center = vec_add(middle, c);
}

/* Is all of one orientation? Areas and volumes in units of the size. */
static bool is_ordered(const double *sum, double size)
{
    const double slack = 1e-3;
    const double volume = fabs(sum[VOLUME]), most = size * size * size;
    if (!(volume > 1e-9 * most)) return false;
    for (int i = 0; i < 3; ++i) {
        if (!(fabs(sum[AREA + i]) <= slack * size * size)) return false;
        if (!(fabs(sum[BY_AXIS + i] - sum[VOLUME]) <= slack * volume)) return false;
    }
    return true;
}

/* Relative: of the volume, of the center by the size, of the second moments by size^2. */
static double error_of(const double *sum, const double *change, double size)
{
    const double volume = fabs(sum[VOLUME]);
    double most = change[VOLUME] / volume;
    for (int i = 0; i < 3; ++i) {
        most = fmax(most, change[MOMENT + i] / (volume * size));
        most = fmax(most, change[SQUARE + i] / (volume * size * size));
        most = fmax(most, change[MIXED + i] / (volume * size * size));
    }
    return most;
}

/* Sums over all surfaces with each step; first of all the middle and the size. */
typedef struct measuring {
    grid *grids;
    edge *edges;
    size_t surfaces;
    vec middle;
    double size;
} measuring;

static mass_verdict read_all(measuring *m, const imp_scene *scene, size_t body, double t,
                             imp_error *why)
{
    vec_box box = vec_box_empty();
    for (size_t s = 0; s < m->surfaces; ++s) {
        grid *g = &m->grids[s];
        g->cells = cells_for(m->surfaces);
        const size_t points = (size_t)((g->cells + 1) * (g->cells + 1));
        g->at = malloc(points * sizeof *g->at);
        if (g->at == NULL) return MASS_NO_MEMORY;
        const mass_verdict read = grid_read(g, scene, body, s, t, why);
        if (read != MASS_FOUND) return read;
        for (size_t k = 0; k < points; ++k) vec_box_add(&box, g->at[k]);
        for (int side = 0; side < 4; ++side) edge_read(&m->edges[4 * s + (size_t)side], g, s, side);
    }
    m->middle = vec_scale(0.5, vec_add(box.lo, box.hi));
    m->size = vec_length(vec_sub(box.hi, box.lo));
    return m->size < INFINITY ? MASS_FOUND : MASS_UNBOUNDED;
}

static mass_verdict integrate(const measuring *m, mass_properties *out)
{
    double sum[LEVELS][INTEGRALS] = {{0}}, part[INTEGRALS], all[INTEGRALS], change[INTEGRALS];
    for (int level = 0; level < LEVELS; ++level)
        for (size_t s = 0; s < m->surfaces; ++s) {
            add_surface(&m->grids[s], 4 >> level, m->middle, part);
            for (int k = 0; k < INTEGRALS; ++k) sum[level][k] += part[k];
        }
    extrapolate(sum, all, change);
    if (!is_ordered(all, m->size)) return MASS_DISORDER;
    out->error = error_of(all, change, m->size);
    properties_of(all, m->middle, out);
    return MASS_FOUND;
}

mass_verdict mass_integrate(const imp_scene *scene, size_t body, double t, mass_properties *out,
                            vec *where, imp_error *why)
{
    measuring m = {.surfaces = imp_scene_surface_count(scene, body)};
    if (m.surfaces > MASS_SURFACES_MAX) return MASS_TOO_MANY;
    m.grids = calloc(m.surfaces, sizeof *m.grids);
    m.edges = calloc(4 * m.surfaces, sizeof *m.edges);
    mass_verdict verdict = MASS_NO_MEMORY;
    if (m.grids != NULL && m.edges != NULL) verdict = read_all(&m, scene, body, t, why);
    if (verdict == MASS_FOUND &&
        !is_closed(scene, body, t, m.edges, 4 * m.surfaces, CLOSED_SLACK * m.size, where))
        verdict = MASS_OPEN;
    if (verdict == MASS_FOUND) verdict = integrate(&m, out);
    for (size_t s = 0; m.grids != NULL && s < m.surfaces; ++s) free(m.grids[s].at);
    free(m.grids);
    free(m.edges);
    return verdict;
}
