/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/integrals.h"

#include <stdlib.h>

enum { LEVELS = 5 };

/* Computes the tetrahedron of a triangle and the origin: sums over its corners a, b, c and 0. Over
 * one of volume V the mean of x_i is s_i / 4 and that of x_i x_j is (s_i s_j + sum_corners x_i x_j)
 * / 20. */
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

/* Adds each cell, `step` points wide, as two triangles. Both ways to cut it are taken, each for one
 * half, so that errors are even in the step. */
static void add_grid(const vec *at, int cells, int step, double factor, double *sum)
{
    const int row = cells + 1;
    double part[INTEGRALS] = {0};
    for (int i = 0; i < cells; i += step)
        for (int j = 0; j < cells; j += step) {
            const vec a = at[i * row + j], b = at[(i + step) * row + j];
            const vec c = at[(i + step) * row + j + step], d = at[i * row + j + step];
            add_triangle(a, b, c, part);
            add_triangle(a, c, d, part);
            add_triangle(a, b, d, part);
            add_triangle(b, c, d, part);
        }
    for (int k = 0; k < INTEGRALS; ++k) sum[k] += factor / 2 * part[k];
}

/* Sums over a shell with cells 1, 2, 4, ... points wide. */
typedef struct levels {
    double sum[LEVELS][INTEGRALS];
} levels;

/* Extrapolates to cells of no width (Romberg): the errors of sums are even powers of the step. The
 * change is what the coarsest sums have contributed. */
static void extrapolate(levels *l, int count, integrals *out)
{
    for (int k = 0; k < INTEGRALS; ++k) {
        double factor = 1, before = l->sum[0][k];
        for (int order = 1; order < count; ++order) {
            factor *= 4;
            before = l->sum[0][k];
            for (int level = 0; level + order < count; ++level)
                l->sum[level][k] += (l->sum[level][k] - l->sum[level + 1][k]) / (factor - 1);
        }
        out->sum[k] = l->sum[0][k];
        out->change[k] = fabs(l->sum[0][k] - before);
    }
}

/* Returns how many steps, each twice as long, divide the cells. */
static int levels_of(int cells)
{
    int count = 1;
    while (count < LEVELS && cells % (1 << count) == 0) ++count;
    return count;
}

/* Adds all patches to the sums of their shells, about one of their points so that little cancels.
 */
static shape_verdict add_patches(const patches *p, const shells *s, int cells, vec *at,
                                 levels *each, vec *origin, imp_error *why)
{
    const int points = (cells + 1) * (cells + 1);
    for (size_t i = 0; i < p->count; ++i) {
        if (limits_reached(p->limits) != IMP_REASON_NONE) return SHAPE_STOPPED;
        const shape_verdict verdict = patch_grid(p, i, cells, at, why);
        if (verdict != SHAPE_FOUND) return verdict;
        if (i == 0) *origin = at[0];
        if (s->facing[i].sign == 0) continue;
        for (int k = 0; k < points; ++k) at[k] = vec_sub(at[k], *origin);
        for (int level = 0; level < levels_of(cells); ++level)
            add_grid(at, cells, 1 << level, s->facing[i].sign, each[s->facing[i].shell].sum[level]);
    }
    return SHAPE_FOUND;
}

shape_verdict integrals_find(const patches *p, const shells *s, int cells, integrals *each,
                             imp_error *why)
{
    levels *sums = calloc(s->count + 1, sizeof *sums);
    vec *at = malloc((size_t)((cells + 1) * (cells + 1)) * sizeof *at), origin = {{0, 0, 0}};
    shape_verdict verdict = SHAPE_NO_MEMORY;
    if (sums != NULL && at != NULL) verdict = add_patches(p, s, cells, at, sums, &origin, why);
    for (size_t k = 0; verdict == SHAPE_FOUND && k < s->count; ++k) {
        extrapolate(&sums[k], levels_of(cells), &each[k]);
        each[k].origin = origin;
    }
    free(sums);
    free(at);
    return verdict;
}
