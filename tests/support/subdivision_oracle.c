/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/shape_oracle.h"

#include <math.h>
#include <stdlib.h>

/* A Catmull-Clark surface by its definition: the faces around the point's own are subdivided by the rules
 * of 1978, as a list of polygons that is searched for neighbours, until the point's face is regular, and
 * then a uniform bicubic B-spline, or until nothing is left of it. */

enum { POINTS_MAX = 400, FACES_MAX = 200, CORNERS_MAX = 8, BITS = 200, LEVELS_MAX = 140 };

typedef struct polygons {
    size_t points, faces;
    mpfi_t x[POINTS_MAX][3];
    size_t corner[FACES_MAX][CORNERS_MAX], corners[FACES_MAX];
} polygons;

/* Two for what is finer and coarser in turn, and one between. */
static polygons *room(int which)
{
    static polygons *all[3];
    if (all[which] == NULL) {
        all[which] = calloc(1, sizeof *all[which]);
        for (size_t k = 0; k < POINTS_MAX; ++k)
            for (int i = 0; i < 3; ++i) mpfi_init2(all[which]->x[k][i], BITS);
    }
    return all[which];
}

static size_t new_point(polygons *m)
{
    if (m->points >= POINTS_MAX) abort();
    for (int i = 0; i < 3; ++i) mpfi_set_d(m->x[m->points][i], 0);
    return m->points++;
}

static void add_times(polygons *to, size_t p, const polygons *from, size_t k, double factor)
{
    mpfi_t term;
    mpfi_init2(term, BITS);
    for (int i = 0; i < 3; ++i) {
        if (factor != 1) mpfi_mul_d(term, from->x[k][i], factor);
        mpfi_add(to->x[p][i], to->x[p][i], factor != 1 ? term : from->x[k][i]);
    }
    mpfi_clear(term);
}

static void divide(polygons *m, size_t p, double by)
{
    for (int i = 0; i < 3; ++i) mpfi_div_d(m->x[p][i], m->x[p][i], by);
}

/* --- Neighbours ---------------------------------------------------------------------------------- */

static size_t corner_of(const polygons *m, size_t f, size_t k)
{
    return m->corner[f][k % m->corners[f]];
}

/* The face with an edge from a to b, and which of its edges that is. */
static bool find_edge(const polygons *m, size_t a, size_t b, size_t *face, size_t *k)
{
    for (*face = 0; *face < m->faces; ++*face)
        for (*k = 0; *k < m->corners[*face]; ++*k)
            if (corner_of(m, *face, *k) == a && corner_of(m, *face, *k + 1) == b) return true;
    return false;
}

static bool has_corner(const polygons *m, size_t f, size_t p)
{
    for (size_t k = 0; k < m->corners[f]; ++k)
        if (m->corner[f][k] == p) return true;
    return false;
}

static size_t faces_at(const polygons *m, size_t p)
{
    size_t count = 0;
    for (size_t f = 0; f < m->faces; ++f) count += has_corner(m, f, p);
    return count;
}

static bool is_border_edge(const polygons *m, size_t a, size_t b)
{
    size_t face, k;
    return !find_edge(m, b, a, &face, &k) || !find_edge(m, a, b, &face, &k);
}

static bool is_border(const polygons *m, size_t p)
{
    for (size_t f = 0; f < m->faces; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            const size_t a = corner_of(m, f, k), b = corner_of(m, f, k + 1);
            if ((a == p || b == p) && is_border_edge(m, a, b)) return true;
        }
    return false;
}

static bool is_regular(const polygons *m, size_t p)
{
    return is_border(m, p) ? faces_at(m, p) <= 2 : faces_at(m, p) == 4;
}

/* --- One step --------------------------------------------------------------------------------------- */

/* (F + 2 R + (n - 3) P) / n, R the mean of the edges' middles. */
static void smooth_inside(const polygons *m, size_t p, const polygons *finer, polygons *to, size_t at)
{
    const double n = (double)faces_at(m, p);
    for (size_t f = 0; f < m->faces; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            if (corner_of(m, f, k) != p) continue;
            add_times(to, at, finer, m->points + f, 1);
            add_times(to, at, m, p, 1);
            add_times(to, at, m, corner_of(m, f, k + 1), 1);
        }
    divide(to, at, n);
    add_times(to, at, m, p, n - 3);
    divide(to, at, n);
}

static void smooth_border(const polygons *m, size_t p, polygons *to, size_t at)
{
    const bool is_corner = faces_at(m, p) == 1;
    add_times(to, at, m, p, is_corner ? 1 : 0.75);
    for (size_t f = 0; f < m->faces && !is_corner; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            const size_t a = corner_of(m, f, k), b = corner_of(m, f, k + 1);
            if ((a == p || b == p) && is_border_edge(m, a, b))
                add_times(to, at, m, a == p ? b : a, 0.125);
        }
}

/* The point on the edge a b, made once: found again by its ends. */
static size_t edge_point(const polygons *m, size_t a, size_t b, polygons *to,
                         size_t ends[POINTS_MAX][2])
{
    for (size_t p = m->points + m->faces; p < to->points; ++p)
        if ((ends[p][0] == a && ends[p][1] == b) || (ends[p][0] == b && ends[p][1] == a)) return p;
    const size_t p = new_point(to);
    size_t f, k;
    double count = 2;
    ends[p][0] = a, ends[p][1] = b;
    add_times(to, p, m, a, 1);
    add_times(to, p, m, b, 1);
    if (!is_border_edge(m, a, b)) {
        find_edge(m, a, b, &f, &k);
        add_times(to, p, to, m->points + f, 1);
        find_edge(m, b, a, &f, &k);
        add_times(to, p, to, m->points + f, 1);
        count = 4;
    }
    divide(to, p, count);
    return p;
}

/* Corner k of face f gives a quad, after those of the faces before it. */
static void step(const polygons *m, polygons *to)
{
    size_t ends[POINTS_MAX][2];
    to->points = to->faces = 0;
    for (size_t p = 0; p < m->points; ++p) new_point(to);
    for (size_t f = 0; f < m->faces; ++f) {
        const size_t p = new_point(to);
        for (size_t k = 0; k < m->corners[f]; ++k) add_times(to, p, m, m->corner[f][k], 1);
        divide(to, p, (double)m->corners[f]);
    }
    for (size_t p = 0; p < m->points; ++p)
        if (is_border(m, p))
            smooth_border(m, p, to, p);
        else if (faces_at(m, p) > 0)
            smooth_inside(m, p, to, to, p);
    for (size_t f = 0; f < m->faces; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            if (to->faces >= FACES_MAX) abort();
            size_t *quad = to->corner[to->faces];
            const size_t a = corner_of(m, f, k);
            quad[0] = a;
            quad[1] = edge_point(m, a, corner_of(m, f, k + 1), to, ends);
            quad[2] = m->points + f;
            quad[3] = edge_point(m, corner_of(m, f, k + m->corners[f] - 1), a, to, ends);
            to->corners[to->faces++] = 4;
        }
}

/* --- Of what the first piece is made ------------------------------------------------------------------- */

/* Whether face f is a quad among quads with one extraordinary corner at most, which *first says. */
static bool is_piece(const polygons *m, size_t f, size_t *first)
{
    size_t extraordinary = 0;
    *first = 0;
    if (m->corners[f] != 4) return false;
    for (size_t k = 0; k < 4; ++k) {
        for (size_t g = 0; g < m->faces; ++g)
            if (has_corner(m, g, m->corner[f][k]) && m->corners[g] != 4) return false;
        if (!is_regular(m, m->corner[f][k])) ++extraordinary, *first = k;
    }
    return extraordinary <= 1;
}

/* The faces that share a point with f, which becomes the first of them and begins at its corner `first`. */
static void take_around(const polygons *m, size_t f, size_t first, polygons *to)
{
    size_t taken[POINTS_MAX];
    to->points = to->faces = 0;
    for (size_t p = 0; p < m->points; ++p) taken[p] = SIZE_MAX;
    for (size_t k = 0; k <= m->faces; ++k) {
        const size_t g = k == 0 ? f : k - 1;
        bool shares = g == f && k == 0;
        for (size_t j = 0; j < m->corners[g] && k > 0 && g != f; ++j)
            shares = shares || has_corner(m, f, m->corner[g][j]);
        if (!shares) continue;
        for (size_t j = 0; j < m->corners[g]; ++j) {
            const size_t p = corner_of(m, g, g == f ? j + first : j);
            if (taken[p] == SIZE_MAX) {
                taken[p] = new_point(to);
                add_times(to, taken[p], m, p, 1);
            }
            to->corner[to->faces][j] = taken[p];
        }
        to->corners[to->faces++] = m->corners[g];
    }
}

static void read(const type_arguments *arguments, number t, polygons *m)
{
    const imp_value *points = argument(arguments, "points"), *faces = argument(arguments, "faces");
    const imp_value *velocities = argument(arguments, "velocities");
    m->points = m->faces = 0;
    for (size_t p = 0; p < points->extent[0]; ++p) {
        new_point(m);
        for (size_t i = 0; i < 3; ++i) {
            mpfi_set_d(m->x[p][i], points->number[3 * p + i]);
            if (velocities->count > 0)
                mpfi_add(m->x[p][i], m->x[p][i], num_mul(num(velocities->number[3 * p + i]), t));
        }
    }
    m->faces = faces->extent[0];
    for (size_t f = 0; f < m->faces; ++f) {
        m->corners[f] = faces->extent[1];
        for (size_t k = 0; k < m->corners[f]; ++k)
            m->corner[f][k] = (size_t)faces->number[m->corners[f] * f + k];
    }
}

/* The first piece and what is around it, in `to`. */
static void take_first(const type_arguments *arguments, number t, polygons *to)
{
    int coarse = 0;
    read(arguments, t, room(coarse));
    for (int level = 0; level < 3; ++level, coarse = !coarse) {
        size_t first;
        for (size_t f = 0; f < room(coarse)->faces; ++f)
            if (is_piece(room(coarse), f, &first)) {
                take_around(room(coarse), f, first, to);
                return;
            }
        step(room(coarse), room(!coarse));
    }
    abort();
}

/* --- A point ------------------------------------------------------------------------------------------- */

/* Numbers of the 4 by 4 points around the first face; SIZE_MAX where none is. */
static void find_grid(const polygons *m, size_t grid[4][4])
{
    static const int at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    static const int out[5][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int k = 0; k < 16; ++k) grid[k / 4][k % 4] = SIZE_MAX;
    for (int side = 0; side < 4; ++side) {
        const int *a = at[side], *b = at[side + 1], *o = out[side], *turned = out[side + 1];
        const size_t p = corner_of(m, 0, (size_t)side), q = corner_of(m, 0, (size_t)side + 1);
        size_t f, k;
        grid[a[0] + 1][a[1] + 1] = p;
        if (!find_edge(m, q, p, &f, &k)) continue;
        const size_t near = corner_of(m, f, k + 3);
        grid[a[0] + o[0] + 1][a[1] + o[1] + 1] = corner_of(m, f, k + 2);
        grid[b[0] + o[0] + 1][b[1] + o[1] + 1] = near;
        if (find_edge(m, q, near, &f, &k))
            grid[b[0] + o[0] + turned[0] + 1][b[1] + o[1] + turned[1] + 1] = corner_of(m, f, k + 2);
    }
}

static void reflect(number x[4][4], int out, int inner, int next, bool is_row)
{
    for (int k = 0; k < 4; ++k) {
        number *to = is_row ? &x[out][k] : &x[k][out];
        *to = num_sub(num_mul(num(2), is_row ? x[inner][k] : x[k][inner]),
                      is_row ? x[next][k] : x[k][next]);
    }
}

static void splines(number u, number n[4])
{
    const number v = num_sub(num(1), u), six = num(6);
    const double inner[4] = {4, 0, -6, 3};
    n[0] = num_div(num_power(v, 3), six);
    n[1] = num_div(num_poly(inner, 4, 1, u), six);
    n[2] = num_div(num_poly(inner, 4, 1, v), six);
    n[3] = num_div(num_power(u, 3), six);
}

static void spline_of(const polygons *m, number u, number v, number x[3])
{
    size_t grid[4][4];
    number along_u[4], along_v[4];
    find_grid(m, grid);
    splines(u, along_u);
    splines(v, along_v);
    for (int i = 0; i < 3; ++i) {
        number value[4][4];
        for (int k = 0; k < 16; ++k)
            value[k / 4][k % 4] =
                grid[k / 4][k % 4] != SIZE_MAX ? (number)m->x[grid[k / 4][k % 4]][i] : num(0);
        if (grid[1][0] == SIZE_MAX) reflect(value, 0, 1, 2, false);
        if (grid[1][3] == SIZE_MAX) reflect(value, 3, 2, 1, false);
        if (grid[0][1] == SIZE_MAX) reflect(value, 0, 1, 2, true);
        if (grid[3][1] == SIZE_MAX) reflect(value, 3, 2, 1, true);
        x[i] = num(0);
        for (int k = 0; k < 16; ++k)
            x[i] = num_add(x[i], num_mul(num_mul(along_u[k / 4], along_v[k % 4]), value[k / 4][k % 4]));
    }
}

static bool is_flat(const polygons *m)
{
    for (size_t k = 0; k < 4; ++k)
        if (!is_regular(m, m->corner[0][k])) return false;
    return true;
}

/* Everything that may still be: the hull of all points. */
static void hull_of(const polygons *m, number x[3])
{
    for (int i = 0; i < 3; ++i) {
        mpfi_ptr hull = num_fresh();
        mpfi_set(hull, m->x[0][i]);
        for (size_t p = 1; p < m->points; ++p) mpfi_union(hull, hull, m->x[p][i]);
        x[i] = hull;
    }
}

/* A face's quads follow each other; that of corner k lies, seen from (0,0), k quarters round: it begins at
 * its corner 4 - k. */
void subdivision_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    polygons *around = room(2);
    number u = p[0], v = p[1];
    take_first(arguments, p[2], around);
    for (int level = 0; level < LEVELS_MAX && !is_flat(around); ++level) {
        const bool far_u = !num_is_less(u, num(0.5)), far_v = !num_is_less(v, num(0.5));
        const size_t k = far_u ? (far_v ? 2 : 1) : (far_v ? 3 : 0);
        step(around, room(0));
        take_around(room(0), k, (4 - k) % 4, around);
        u = num_sub(num_mul(num(2), u), num(far_u));
        v = num_sub(num_mul(num(2), v), num(far_v));
    }
    if (is_flat(around))
        spline_of(around, u, v, x);
    else
        hull_of(around, x);
}
