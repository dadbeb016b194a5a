/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/polygons.h"

#include <stdlib.h>

enum { BITS = 200 };

/* Two for what is finer and coarser in turn, and one between. */
polygons *polygons_room(int which)
{
    static polygons *all[3];
    if (all[which] == NULL) {
        all[which] = calloc(1, sizeof *all[which]);
        for (size_t k = 0; k < POLYGONS_POINTS; ++k)
            for (int i = 0; i < 3; ++i) mpfi_init2(all[which]->x[k][i], BITS);
    }
    return all[which];
}

size_t polygons_new_point(polygons *m)
{
    if (m->points >= POLYGONS_POINTS) abort();
    for (int i = 0; i < 3; ++i) mpfi_set_d(m->x[m->points][i], 0);
    return m->points++;
}

void polygons_add(polygons *to, size_t p, const polygons *from, size_t k, double factor)
{
    mpfi_t term;
    mpfi_init2(term, BITS);
    for (int i = 0; i < 3; ++i) {
        if (factor != 1) mpfi_mul_d(term, from->x[k][i], factor);
        mpfi_add(to->x[p][i], to->x[p][i], factor != 1 ? term : from->x[k][i]);
    }
    mpfi_clear(term);
}

void polygons_divide(polygons *m, size_t p, double by)
{
    for (int i = 0; i < 3; ++i) mpfi_div_d(m->x[p][i], m->x[p][i], by);
}

/* --- Neighbours ------------------------------------------------------------------------------- */

size_t polygons_corner(const polygons *m, size_t f, size_t k)
{
    return m->corner[f][k % m->corners[f]];
}

/* The face with an edge from a to b, and which of its edges that is. */
bool polygons_find_edge(const polygons *m, size_t a, size_t b, size_t *face, size_t *k)
{
    for (*face = 0; *face < m->faces; ++*face)
        for (*k = 0; *k < m->corners[*face]; ++*k)
            if (polygons_corner(m, *face, *k) == a && polygons_corner(m, *face, *k + 1) == b)
                return true;
    return false;
}

bool polygons_has_corner(const polygons *m, size_t f, size_t p)
{
    for (size_t k = 0; k < m->corners[f]; ++k)
        if (m->corner[f][k] == p) return true;
    return false;
}

size_t polygons_faces_at(const polygons *m, size_t p)
{
    size_t count = 0;
    for (size_t f = 0; f < m->faces; ++f) count += polygons_has_corner(m, f, p);
    return count;
}

bool polygons_is_border_edge(const polygons *m, size_t a, size_t b)
{
    size_t face, k;
    return !polygons_find_edge(m, b, a, &face, &k) || !polygons_find_edge(m, a, b, &face, &k);
}

bool polygons_is_border(const polygons *m, size_t p)
{
    for (size_t f = 0; f < m->faces; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            const size_t a = polygons_corner(m, f, k), b = polygons_corner(m, f, k + 1);
            if ((a == p || b == p) && polygons_is_border_edge(m, a, b)) return true;
        }
    return false;
}

void polygons_smooth_border(const polygons *m, size_t p, polygons *to, size_t at)
{
    const bool is_corner = polygons_faces_at(m, p) == 1;
    polygons_add(to, at, m, p, is_corner ? 1 : 0.75);
    for (size_t f = 0; f < m->faces && !is_corner; ++f)
        for (size_t k = 0; k < m->corners[f]; ++k) {
            const size_t a = polygons_corner(m, f, k), b = polygons_corner(m, f, k + 1);
            if ((a == p || b == p) && polygons_is_border_edge(m, a, b))
                polygons_add(to, at, m, a == p ? b : a, 0.125);
        }
}

/* The faces that share a point with f, which becomes the first of them and begins at its corner
 * `first`. */
void polygons_take_around(const polygons *m, size_t f, size_t first, polygons *to)
{
    size_t taken[POLYGONS_POINTS];
    to->points = to->faces = 0;
    for (size_t p = 0; p < m->points; ++p) taken[p] = SIZE_MAX;
    for (size_t k = 0; k <= m->faces; ++k) {
        const size_t g = k == 0 ? f : k - 1;
        bool shares = g == f && k == 0;
        for (size_t j = 0; j < m->corners[g] && k > 0 && g != f; ++j)
            shares = shares || polygons_has_corner(m, f, m->corner[g][j]);
        if (!shares) continue;
        for (size_t j = 0; j < m->corners[g]; ++j) {
            const size_t p = polygons_corner(m, g, g == f ? j + first : j);
            if (taken[p] == SIZE_MAX) {
                taken[p] = polygons_new_point(to);
                polygons_add(to, taken[p], m, p, 1);
            }
            to->corner[to->faces][j] = taken[p];
        }
        to->corners[to->faces++] = m->corners[g];
    }
}

void polygons_read(const type_arguments *arguments, number t, polygons *m)
{
    const imp_value *points = argument(arguments, "points"), *faces = argument(arguments, "faces");
    const imp_value *velocities = argument(arguments, "velocities");
    m->points = m->faces = 0;
    for (size_t p = 0; p < points->extent[0]; ++p) {
        polygons_new_point(m);
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

/* Everything that may still be: the hull of all points. */
void polygons_hull(const polygons *m, number x[3])
{
    for (int i = 0; i < 3; ++i) {
        mpfi_ptr hull = num_fresh();
        mpfi_set(hull, m->x[0][i]);
        for (size_t p = 1; p < m->points; ++p) mpfi_union(hull, hull, m->x[p][i]);
        x[i] = hull;
    }
}
