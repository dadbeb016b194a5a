/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/nesting.h"

#include <stdlib.h>

enum { CELLS = 8, ROW = CELLS + 1, POINTS = ROW * ROW };

/* A shell in short. */
typedef struct shell_extent {
    vec_box box;
    vec point; /* one of its points */
} shell_extent;

static bool is_in_box(const vec_box *box, vec x)
{
    for (int i = 0; i < 3; ++i)
        if (!(x.x[i] > box->lo.x[i] && x.x[i] < box->hi.x[i])) return false;
    return true;
}

static shape_verdict read_extents(const patches *p, const shells *s, shell_extent *each,
                                  imp_error *why)
{
    vec at[POINTS];
    for (size_t k = 0; k < s->count; ++k) each[k].box = vec_box_empty();
    for (size_t i = 0; i < p->count; ++i) {
        if (s->facing[i].sign == 0) continue;
        if (limits_reached(p->limits) != IMP_REASON_NONE) return SHAPE_STOPPED;
        const shape_verdict verdict = patch_grid(p, i, CELLS, at, why);
        if (verdict != SHAPE_FOUND) return verdict;
        shell_extent *o = &each[s->facing[i].shell];
        for (int k = 0; k < POINTS; ++k) vec_box_add(&o->box, at[k]);
        o->point = at[POINTS / 2];
    }
    return SHAPE_FOUND;
}

/* Returns the solid angle at the origin of a triangle, by Van Oosterom and Strackee. */
static double solid_angle(vec a, vec b, vec c)
{
    const double x = vec_length(a), y = vec_length(b), z = vec_length(c);
    const double spread = x * y * z + x * vec_dot(b, c) + y * vec_dot(c, a) + z * vec_dot(a, b);
    return 2 * atan2(vec_dot(a, vec_cross(b, c)), spread);
}

/* Finds how often a shell winds around a point. */
static shape_verdict wind(const patches *p, const shells *s, size_t shell, vec x, double *winding,
                          imp_error *why)
{
    vec at[POINTS];
    double sum = 0;
    for (size_t i = 0; i < p->count; ++i) {
        if (s->facing[i].shell != shell) continue;
        if (limits_reached(p->limits) != IMP_REASON_NONE) return SHAPE_STOPPED;
        const shape_verdict verdict = patch_grid(p, i, CELLS, at, why);
        if (verdict != SHAPE_FOUND) return verdict;
        for (int k = 0; k < POINTS; ++k) at[k] = vec_sub(at[k], x);
        for (int k = 0; k + ROW < POINTS; ++k) {
            if (k % ROW == CELLS) continue;
            const vec a = at[k], b = at[k + ROW], c = at[k + ROW + 1], d = at[k + 1];
            sum += s->facing[i].sign * (solid_angle(a, b, c) + solid_angle(a, c, d));
        }
    }
    *winding = fabs(sum) / (4 * 3.141592653589793);
    return SHAPE_FOUND;
}

shape_verdict nesting_find(const patches *p, const shells *s, double *sign, imp_error *why)
{
    for (size_t k = 0; k < s->count; ++k) sign[k] = 1;
    if (s->count < 2) return SHAPE_FOUND;
    shell_extent *each = malloc(s->count * sizeof *each);
    if (each == NULL) return SHAPE_NO_MEMORY;
    shape_verdict verdict = read_extents(p, s, each, why);
    for (size_t k = 0; k < s->count && verdict == SHAPE_FOUND; ++k) {
        if (limits_reached(p->limits) != IMP_REASON_NONE) verdict = SHAPE_STOPPED;
        for (size_t other = 0; other < s->count && verdict == SHAPE_FOUND; ++other) {
            double winding = 0;
            if (other == k || !is_in_box(&each[other].box, each[k].box.lo) ||
                !is_in_box(&each[other].box, each[k].box.hi))
                continue;
            verdict = wind(p, s, other, each[k].point, &winding, why);
            if (winding > 0.5) sign[k] = -sign[k];
        }
    }
    free(each);
    return verdict;
}
