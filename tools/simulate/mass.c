/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/mass.h"

#include <stdlib.h>

#include "tools/simulate/integrals.h"
#include "tools/simulate/nesting.h"
#include "tools/simulate/shells.h"

/* Cells of the finest grid along u and v of a patch. */
enum { CELLS_MIN = 4, CELLS_MAX = 128 };

static int cells_for(size_t count)
{
    int cells = CELLS_MAX;
    for (size_t n = 8; n < count && cells > CELLS_MIN; n *= 4) cells /= 2;
    return cells;
}

/* For the mass 1, about the center; the integrals are about `origin`. */
static void properties_of(const double *sum, vec origin, mass_properties *out)
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
    out->volume = volume;
    out->center = vec_add(origin, c);
}

/* Returns whether the volume is one: closed surfaces have no vector area I(n), and I(x n_x), I(y
 * n_y) and I(z n_z) are each the volume. */
static bool is_volume(const double *sum, double size)
{
    const double slack = 1e-3, volume = sum[VOLUME];
    if (!(volume > 1e-9 * size * size * size)) return false;
    for (int i = 0; i < 3; ++i) {
        if (!(fabs(sum[AREA + i]) <= slack * size * size)) return false;
        if (!(fabs(sum[BY_AXIS + i] - volume) <= slack * volume)) return false;
    }
    return true;
}

/* Relative: of the volume, of the center by the size, of the second moments by size^2. */
static double error_of(const double *sum, const double *change, double size)
{
    const double volume = sum[VOLUME];
    double most = change[VOLUME] / volume;
    for (int i = 0; i < 3; ++i) {
        most = fmax(most, change[MOMENT + i] / (volume * size));
        most = fmax(most, change[SQUARE + i] / (volume * size * size));
        most = fmax(most, change[MIXED + i] / (volume * size * size));
    }
    return most;
}

/* Adds up the integrals of all shells, each with its sign and its volume positive. */
static shape_verdict add_shells(const patches *p, const double *sign, const integrals *each,
                                size_t count, mass_properties *out)
{
    integrals all = {{0}, {0}, each[0].origin};
    for (size_t k = 0; k < count; ++k) {
        const double outward = each[k].sum[VOLUME] < 0 ? -sign[k] : sign[k];
        for (int i = 0; i < INTEGRALS; ++i) {
            all.sum[i] += outward * each[k].sum[i];
            all.change[i] += each[k].change[i];
        }
    }
    if (!is_volume(all.sum, p->size)) return SHAPE_FLAT;
    out->error = error_of(all.sum, all.change, p->size);
    properties_of(all.sum, all.origin, out);
    return SHAPE_FOUND;
}

/* With finer and finer grids. What a coarse grid takes for flat may have a volume in a finer one.
 */
static shape_verdict integrate(const patches *p, const shells *s, const double *sign,
                               integrals *each, mass_properties *out, imp_error *why)
{
    const int most = cells_for(p->count);
    for (int cells = CELLS_MIN;; cells *= 2) {
        shape_verdict verdict = integrals_find(p, s, cells, each, why);
        if (verdict != SHAPE_FOUND) return verdict;
        verdict = add_shells(p, sign, each, s->count, out);
        if (cells >= most || (verdict == SHAPE_FOUND && out->error <= MASS_ERROR_GOAL))
            return verdict;
    }
}

shape_verdict mass_integrate(const patches *p, mass_properties *out, vec *where, imp_error *why)
{
    shells s;
    shape_verdict verdict = shells_find(&s, p, where, why);
    double *sign = malloc((s.count + 1) * sizeof *sign);
    integrals *each = malloc((s.count + 1) * sizeof *each);
    if (sign == NULL || each == NULL) verdict = SHAPE_NO_MEMORY;
    if (verdict == SHAPE_FOUND) verdict = nesting_find(p, &s, sign, why);
    if (verdict == SHAPE_FOUND) verdict = integrate(p, &s, sign, each, out, why);
    free(sign);
    free(each);
    shells_free(&s);
    return verdict;
}
