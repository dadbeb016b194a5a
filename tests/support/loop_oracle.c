/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/polygons.h"
#include "tests/support/shape_oracle.h"

#include <stdlib.h>

/* A surface of Loop's by its definition: the triangles around the point's own are subdivided by the
 * rules of 1987, until its own is regular, and then by the twelve basis functions of Stam's course
 * notes of 1999, or until nothing is left of it. */

enum { LEVELS_MAX = 140, BASIS = 12, TERMS = 15, RING = 6 };

static bool is_regular(const polygons *m, size_t p)
{
    const size_t n = polygons_faces_at(m, p);
    return polygons_is_border(m, p) ? n == 1 || n == 3 : n == 6;
}

/* --- One step --------------------------------------------------------------------------------- */

/* P + share (Q - P), Q the mean of the neighbours. */
static void smooth_inside(const polygons *m, size_t p, polygons *to, size_t at)
{
    const double n = (double)polygons_faces_at(m, p);
    const number turn = num_cos(num_div(num_mul(num(2), num_pi()), num(n)));
    const number x = num_add(num(0.375), num_mul(num(0.25), turn));
    const number share = num_sub(num(0.625), num_sqr(x));
    for (size_t f = 0; f < m->faces; ++f)
        for (size_t k = 0; k < 3; ++k)
            if (polygons_corner(m, f, k) == p)
                polygons_add(to, at, m, polygons_corner(m, f, k + 1), 1);
    for (int i = 0; i < 3; ++i) {
        const number mean = num_div(to->x[at][i], num(n));
        mpfi_set(to->x[at][i], num_add(m->x[p][i], num_mul(share, num_sub(mean, m->x[p][i]))));
    }
}

/* The point on the edge a b, made once: found again by its ends. */
static size_t edge_point(const polygons *m, size_t a, size_t b, bool all, polygons *to,
                         size_t ends[POLYGONS_POINTS][2])
{
    for (size_t p = m->points; p < to->points; ++p)
        if ((ends[p][0] == a && ends[p][1] == b) || (ends[p][0] == b && ends[p][1] == a)) return p;
    const size_t p = polygons_new_point(to);
    size_t f, k;
    ends[p][0] = a, ends[p][1] = b;
    if (!all && !polygons_has_corner(m, 0, a) && !polygons_has_corner(m, 0, b)) return p;
    const bool is_border = polygons_is_border_edge(m, a, b);
    polygons_add(to, p, m, a, is_border ? 0.5 : 0.375);
    polygons_add(to, p, m, b, is_border ? 0.5 : 0.375);
    for (int way = 0; way < 2 && !is_border; ++way) {
        if (!polygons_find_edge(m, way ? b : a, way ? a : b, &f, &k)) abort();
        polygons_add(to, p, m, polygons_corner(m, f, k + 2), 0.125);
    }
    return p;
}

/* Face f gives four: of its corners, each first of its own, and of its edges. `all`: else only what
 * lies around the first face's four is in its place: what corners of that face and edges from them
 * become. */
static void step(const polygons *m, bool all, polygons *to)
{
    size_t ends[POLYGONS_POINTS][2];
    to->points = to->faces = 0;
    for (size_t p = 0; p < m->points; ++p) polygons_new_point(to);
    for (size_t p = 0; p < m->points; ++p)
        if (!all && !polygons_has_corner(m, 0, p))
            continue;
        else if (polygons_is_border(m, p))
            polygons_smooth_border(m, p, to, p);
        else if (polygons_faces_at(m, p) > 0)
            smooth_inside(m, p, to, p);
    for (size_t f = 0; f < m->faces; ++f) {
        size_t edge[3];
        if (to->faces + 4 > POLYGONS_FACES) abort();
        for (size_t k = 0; k < 3; ++k)
            edge[k] = edge_point(m, polygons_corner(m, f, k), polygons_corner(m, f, k + 1), all, to,
                                 ends);
        for (size_t k = 0; k < 4; ++k) {
            size_t *face = to->corner[to->faces];
            face[0] = k < 3 ? m->corner[f][k] : edge[0];
            face[1] = k < 3 ? edge[k] : edge[1];
            face[2] = k < 3 ? edge[(k + 2) % 3] : edge[2];
            to->corners[to->faces++] = 3;
        }
    }
}

/* --- The first piece -------------------------------------------------------------------------- */

static bool is_piece(const polygons *m, size_t f, size_t *first)
{
    size_t extraordinary = 0;
    *first = 0;
    for (size_t k = 0; k < 3; ++k)
        if (!is_regular(m, m->corner[f][k])) ++extraordinary, *first = k;
    return extraordinary <= 1;
}

static void take_first(const type_arguments *arguments, number t, polygons *to)
{
    polygons_read(arguments, t, polygons_room(0));
    for (int level = 0; level < 2; ++level) {
        size_t first;
        for (size_t f = 0; f < polygons_room(level)->faces; ++f)
            if (is_piece(polygons_room(level), f, &first)) {
                polygons_take_around(polygons_room(level), f, first, to);
                return;
            }
        if (level == 0) step(polygons_room(0), true, polygons_room(1));
    }
    abort();
}

/* --- A regular triangle ----------------------------------------------------------------------- */

/* The neighbours of corner k of the first face, counterclockwise from the next corner; beyond a
 * border edge p q of a face p q r is p + q - r. */
static void ring_of(const polygons *m, size_t k, int axis, number ring[RING])
{
    const size_t p = polygons_corner(m, 0, k);
    const number own = m->x[p][axis];
    size_t at[RING], f, j;
    at[0] = polygons_corner(m, 0, k + 1);
    for (int d = 1; d < RING; ++d) at[d] = SIZE_MAX;
    for (int d = 0; d + 1 < RING && polygons_find_edge(m, p, at[d], &f, &j); ++d)
        at[d + 1] = polygons_corner(m, f, j + 2);
    for (int d = RING; d > 1 && polygons_find_edge(m, at[d % RING], p, &f, &j); --d)
        at[d - 1] = polygons_corner(m, f, j + 2);
    for (int d = 0; d < RING; ++d) ring[d] = at[d] != SIZE_MAX ? (number)m->x[at[d]][axis] : NULL;
    for (int missing = RING; missing > 0; --missing)
        for (int d = 0; d < RING; ++d) {
            const int before = (d + 5) % RING, twice = (d + 4) % RING;
            const int after = (d + 1) % RING, further = (d + 2) % RING;
            if (ring[d] != NULL) continue;
            if (at[before] != SIZE_MAX && at[twice] != SIZE_MAX)
                ring[d] = num_sub(num_add(own, ring[before]), ring[twice]);
            else if (at[after] != SIZE_MAX && at[further] != SIZE_MAX)
                ring[d] = num_sub(num_add(own, ring[after]), ring[further]);
            else if (at[(d + 3) % RING] !=
                     SIZE_MAX) /* one face: the corner is in the middle of these */
                ring[d] = num_sub(num_mul(num(2), own), ring[(d + 3) % RING]);
        }
}

/* 12 times the coefficients of a^4, a^3 b, a^3 c, a^2 b^2, a^2 b c, a^2 c^2, a b^3, ..., c^4. */
static const int basis[BASIS][TERMS] = {
    {6, 24, 24, 24, 60, 24, 8, 36, 36, 8, 1, 6, 12, 6, 1}, /* the corners */
    {1, 8, 6, 24, 36, 12, 24, 60, 36, 6, 6, 24, 24, 8, 1},
    {1, 6, 8, 12, 36, 24, 6, 36, 60, 24, 1, 8, 24, 24, 6},
    {1, 6, 2, 12, 6, 0, 6, 6, 0, 0, 1, 2, 0, 0, 0}, /* beyond a b, b c, c a */
    {0, 0, 0, 0, 0, 0, 2, 6, 6, 2, 1, 6, 12, 6, 1},
    {1, 2, 6, 0, 6, 12, 0, 0, 6, 6, 0, 0, 0, 2, 1},
    {1, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, /* the other two of a, of b, of c */
    {1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 1},
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1},
};

/* Collects one coordinate of the control points around the first face, in the order of `basis`. */
static void values_of(const polygons *m, int axis, number value[BASIS])
{
    static const int from[BASIS][2] = {{1, 1}, {0, 0}, {0, 1}, {0, 5}, {1, 5}, {2, 5},
                                       {0, 3}, {0, 4}, {1, 3}, {1, 4}, {2, 3}, {2, 4}};
    number ring[3][RING];
    for (size_t k = 0; k < 3; ++k) ring_of(m, k, axis, ring[k]);
    for (int p = 0; p < BASIS; ++p) value[p] = ring[from[p][0]][from[p][1]];
}

static void regular_point(const polygons *m, const number at[3], number x[3])
{
    number power[3][5], value[3][BASIS];
    for (int k = 0; k < 3; ++k) {
        values_of(m, k, value[k]);
        x[k] = num(0);
        for (unsigned n = 0; n <= 4; ++n) power[k][n] = num_power(at[k], n);
    }
    for (int k = 0, which = 0; k <= 4; ++k)
        for (int j = 0; j <= k; ++j, ++which) {
            const number term = num_mul(num_mul(power[0][4 - k], power[1][k - j]), power[2][j]);
            for (int axis = 0; axis < 3; ++axis) {
                number sum = num(0);
                for (int p = 0; p < BASIS; ++p)
                    if (basis[p][which] != 0)
                        sum = num_add(sum, num_mul(num(basis[p][which]), value[axis][p]));
                x[axis] = num_add(x[axis], num_mul(term, sum));
            }
        }
    for (int axis = 0; axis < 3; ++axis) x[axis] = num_div(x[axis], num(12));
}

/* --- A point ---------------------------------------------------------------------------------- */

static bool is_flat(const polygons *m)
{
    for (size_t k = 0; k < 3; ++k)
        if (!is_regular(m, m->corner[0][k])) return false;
    return true;
}

/* The child that the point is in: of a corner whose coordinate is 1/2 or more, or of the edges. */
static size_t descend(number at[3])
{
    const number one = num(1), two = num(2);
    for (size_t k = 0; k < 3; ++k)
        if (!num_is_less(at[k], num(0.5))) {
            const number own = num_sub(num_mul(two, at[k]), one);
            const number next = num_mul(two, at[(k + 1) % 3]), last = num_mul(two, at[(k + 2) % 3]);
            at[0] = own, at[1] = next, at[2] = last;
            return k;
        }
    const number own[3] = {at[0], at[1], at[2]};
    for (size_t k = 0; k < 3; ++k) at[k] = num_sub(one, num_mul(two, own[(k + 2) % 3]));
    return 3;
}

void loop_oracle(const type_arguments *arguments, const number p[3], number x[3])
{
    polygons *around = polygons_room(2);
    number at[3] = {num_sub(num(1), p[0]), num_mul(p[0], num_sub(num(1), p[1])),
                    num_mul(p[0], p[1])};
    take_first(arguments, p[2], around);
    for (int level = 0; level < LEVELS_MAX && !is_flat(around); ++level) {
        const size_t child = descend(at);
        step(around, false, polygons_room(0));
        polygons_take_around(polygons_room(0), child, 0, around);
    }
    if (is_flat(around))
        regular_point(around, at, x);
    else
        polygons_hull(around, x);
}
