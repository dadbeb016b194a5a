/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/polygons.h"
#include "tests/support/shape_oracle.h"

#include <stdlib.h>
#include <string.h>

/* A Catmull-Clark surface by its definition: the faces around the point's own are subdivided by the
 * rules of 1978, as a list of polygons that is searched for neighbours, until the point's face is
 * regular, and then a uniform bicubic B-spline, or until nothing is left of it. */

enum { LEVELS_MAX = 140 };

/* --- Regular corners -------------------------------------------------------------------------- */

static bool is_regular(const polygons *m, size_t p)
{
    return polygons_is_border(m, p) ? polygons_faces_at(m, p) <= 2 : polygons_faces_at(m, p) == 4;
}

/* --- One step --------------------------------------------------------------------------------- */

/* (F + 2 R + (n - 3) P) / n, R the mean of the edges' middles. */
static void smooth_inside(const polygons *m, size_t p, const polygons *finer, polygons *to,
                          size_t at)
{
    const double n = (double)polygons_faces_at(m, p);
    for (size_t f = 0; f < m->faces; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            if (polygons_corner(m, f, k) != p) continue;
            polygons_add(to, at, finer, m->points + f, 1);
            polygons_add(to, at, m, p, 1);
            polygons_add(to, at, m, polygons_corner(m, f, k + 1), 1);
        }
    polygons_divide(to, at, n);
    polygons_add(to, at, m, p, n - 3);
    polygons_divide(to, at, n);
}

/* The point on the edge a b, made once: found again by its ends. */
static size_t edge_point(const polygons *m, size_t a, size_t b, polygons *to,
                         size_t ends[POLYGONS_POINTS][2])
{
    for (size_t p = m->points + m->faces; p < to->points; ++p)
        if ((ends[p][0] == a && ends[p][1] == b) || (ends[p][0] == b && ends[p][1] == a)) return p;
    const size_t p = polygons_new_point(to);
    size_t f, k;
    double count = 2;
    ends[p][0] = a, ends[p][1] = b;
    polygons_add(to, p, m, a, 1);
    polygons_add(to, p, m, b, 1);
    if (!polygons_is_border_edge(m, a, b)) {
        polygons_find_edge(m, a, b, &f, &k);
        polygons_add(to, p, to, m->points + f, 1);
        polygons_find_edge(m, b, a, &f, &k);
        polygons_add(to, p, to, m->points + f, 1);
        count = 4;
    }
    polygons_divide(to, p, count);
    return p;
}

/* Corner k of face f gives a quad, after those of the faces before it. */
static void step(const polygons *m, polygons *to)
{
    size_t ends[POLYGONS_POINTS][2];
    to->points = to->faces = 0;
    for (size_t p = 0; p < m->points; ++p) polygons_new_point(to);
    for (size_t f = 0; f < m->faces; ++f) {
        const size_t p = polygons_new_point(to);
        for (size_t k = 0; k < m->corners[f]; ++k) polygons_add(to, p, m, m->corner[f][k], 1);
        polygons_divide(to, p, (double)m->corners[f]);
    }
    for (size_t p = 0; p < m->points; ++p)
        if (polygons_is_border(m, p))
            polygons_smooth_border(m, p, to, p);
        else if (polygons_faces_at(m, p) > 0)
            smooth_inside(m, p, to, to, p);
    for (size_t f = 0; f < m->faces; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            if (to->faces >= POLYGONS_FACES) abort();
            size_t *quad = to->corner[to->faces];
            const size_t a = polygons_corner(m, f, k);
            quad[0] = a;
            quad[1] = edge_point(m, a, polygons_corner(m, f, k + 1), to, ends);
            quad[2] = m->points + f;
            quad[3] = edge_point(m, polygons_corner(m, f, k + m->corners[f] - 1), a, to, ends);
            to->corners[to->faces++] = 4;
        }
}

/* --- Of what the first piece is made ---------------------------------------------------------- */

/* Whether face f is a quad among quads with one extraordinary corner at most, which *first says. */
static bool is_piece(const polygons *m, size_t f, size_t *first)
{
    size_t extraordinary = 0;
    *first = 0;
    if (m->corners[f] != 4) return false;
    for (size_t k = 0; k < 4; ++k) {
        for (size_t g = 0; g < m->faces; ++g)
            if (polygons_has_corner(m, g, m->corner[f][k]) && m->corners[g] != 4) return false;
        if (!is_regular(m, m->corner[f][k])) ++extraordinary, *first = k;
    }
    return extraordinary <= 1;
}

/* The first piece and what is around it, in `to`. */
static void take_first(const type_arguments *arguments, number t, polygons *to)
{
    int coarse = 0;
    polygons_read(arguments, t, polygons_room(coarse));
    for (int level = 0; level < 3; ++level, coarse = !coarse) {
        size_t first;
        for (size_t f = 0; f < polygons_room(coarse)->faces; ++f)
            if (is_piece(polygons_room(coarse), f, &first)) {
                polygons_take_around(polygons_room(coarse), f, first, to);
                return;
            }
        step(polygons_room(coarse), polygons_room(!coarse));
    }
    abort();
}

/* --- A point ---------------------------------------------------------------------------------- */

/* Numbers of the 4 by 4 points around the first face; SIZE_MAX where none is. */
static void find_grid(const polygons *m, size_t grid[4][4])
{
    static const int at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    static const int out[5][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int k = 0; k < 16; ++k) grid[k / 4][k % 4] = SIZE_MAX;
    for (int side = 0; side < 4; ++side) {
        const int *a = at[side], *b = at[side + 1], *o = out[side], *turned = out[side + 1];
        const size_t p = polygons_corner(m, 0, (size_t)side),
                     q = polygons_corner(m, 0, (size_t)side + 1);
        size_t f, k;
        grid[a[0] + 1][a[1] + 1] = p;
        if (!polygons_find_edge(m, q, p, &f, &k)) continue;
        const size_t near = polygons_corner(m, f, k + 3);
        grid[a[0] + o[0] + 1][a[1] + o[1] + 1] = polygons_corner(m, f, k + 2);
        grid[b[0] + o[0] + 1][b[1] + o[1] + 1] = near;
        if (polygons_find_edge(m, q, near, &f, &k))
            grid[b[0] + o[0] + turned[0] + 1][b[1] + o[1] + turned[1] + 1] =
                polygons_corner(m, f, k + 2);
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
            x[i] = num_add(x[i],
                           num_mul(num_mul(along_u[k / 4], along_v[k % 4]), value[k / 4][k % 4]));
    }
}

static bool is_flat(const polygons *m)
{
    for (size_t k = 0; k < 4; ++k)
        if (!is_regular(m, m->corner[0][k])) return false;
    return true;
}

/* A face's quads follow each other; that of corner k lies, seen from (0,0), k quarters round: it
 * begins at its corner 4 - k. */
void subdivision_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    if (strcmp(argument(arguments, "scheme")->string[0], "loop") == 0) {
        loop_oracle(arguments, p, x);
        return;
    }
    polygons *around = polygons_room(2);
    number u = p[0], v = p[1];
    take_first(arguments, p[2], around);
    for (int level = 0; level < LEVELS_MAX && !is_flat(around); ++level) {
        const bool far_u = !num_is_less(u, num(0.5)), far_v = !num_is_less(v, num(0.5));
        const size_t k = far_u ? (far_v ? 2 : 1) : (far_v ? 3 : 0);
        step(around, polygons_room(0));
        polygons_take_around(polygons_room(0), k, (4 - k) % 4, around);
        u = num_sub(num_mul(num(2), u), num(far_u));
        v = num_sub(num_mul(num(2), v), num(far_v));
    }
    if (is_flat(around))
        spline_of(around, u, v, x);
    else
        polygons_hull(around, x);
}
