/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/commute.h"

#include <impinge/model.h>
#include <math.h>

#include "core/base/rounding.h"
#include "core/surface/carried.h"

/* Whether the map turns about a line that stays where it is: the true shift is then the pivot. */
static bool keeps_pivot(const imp_pose *pose)
{
    for (int i = 0; i < 3; ++i) {
        const imp_model *m = &pose->shift[i];
        if (m->depends != 0 || m->e != 0 || m->lo != m->hi || m->lo != pose->pivot[i]) return false;
    }
    return true;
}

map_law map_law_of(const imp_pose *pose)
{
    map_law law = {.kind = MAP_IS_OTHER, .moves = pose_turns(pose)};
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        law.moves = law.moves || pose->shift[i].depends != 0;
        law.way[i] = imp_shift(pose->shift[i], -pose->pivot[i]);
        law.point[i] = pose->pivot[i];
        law.direction[i] = pose->fixed[i];
        largest = imp_larger(largest, fabs(pose->fixed[i]));
    }
    if (pose_turn_is_identity(pose))
        law.kind = MAP_SHIFTS;
    else if (largest > 0 && keeps_pivot(pose))
        law.kind = MAP_TURNS_ABOUT_LINE;
    return law;
}

/* Whether a b = c d exactly. Lemma. Where no product is below 2^-900, a product is the sum of its
 * rounded value and of the difference that fma returns exactly, both of which two equal products
 * share; two products whose pairs are equal are equal. */
static bool products_are_equal(double a, double b, double c, double d)
{
    const double x = a * b, y = c * d;
    if ((a == 0 || b == 0) && (c == 0 || d == 0)) return true;
    return x == y && fabs(x) > 0x1p-900 && fabs(x) < 0x1p900 && fma(a, b, -x) == fma(c, d, -y);
}

static bool are_parallel(const double a[3], const double b[3])
{
    return products_are_equal(a[0], b[1], a[1], b[0]) &&
           products_are_equal(a[1], b[2], a[2], b[1]) && products_are_equal(a[2], b[0], a[0], b[2]);
}

/* Whether x - y is a double, by what Knuth's sum of two doubles is off, which is exact. */
static bool difference_is_exact(double x, double y)
{
    const double sum = x - y, of_y = sum - x, of_x = sum - of_y;
    return (x - of_x) + (-y - of_y) == 0;
}

/* Whether both lines are one. A difference of two points counts only if it is exact. */
static bool are_one_line(const map_law *x, const map_law *y)
{
    double way[3];
    for (int i = 0; i < 3; ++i) {
        way[i] = y->point[i] - x->point[i];
        if (!difference_is_exact(y->point[i], x->point[i])) return false;
    }
    return are_parallel(x->direction, y->direction) && are_parallel(x->direction, way);
}

/* Lemma. With T: p -> p + w and R: p -> c + U (p - c), U f = f for the direction f of R's line,
 * R T p - T R p = U w - w = (U - 1) w', w' being the part of w across f. It is no longer than
 * 2 |w'| = 2 |w x f| / |f|. Roundings of it: |f| in the quotient 3 + 1, quotient 1. */
PAD_COVERS(8, 5);
static double across_upper(const map_law *turn, const map_law *shift)
{
    imp_model cross[3];
    const double *f = turn->direction;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        cross[i] = imp_sub(imp_scale(shift->way[j], f[k]), imp_scale(shift->way[k], f[j]));
    }
    const double length = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    if (!(length > AXIS_LEAST && length < AXIS_MOST)) return INFINITY;
    return padded_upper(2 * surface_size_upper(cross) / length, 8);
}

double map_laws_exchange_upper(const map_law *x, const map_law *y)
{
    if (x->kind == MAP_SHIFTS && y->kind == MAP_SHIFTS) return 0;
    if (x->kind == MAP_TURNS_ABOUT_LINE && y->kind == MAP_TURNS_ABOUT_LINE)
        return are_one_line(x, y) ? 0 : INFINITY;
    if (x->kind == MAP_TURNS_ABOUT_LINE && y->kind == MAP_SHIFTS) return across_upper(x, y);
    if (x->kind == MAP_SHIFTS && y->kind == MAP_TURNS_ABOUT_LINE) return across_upper(y, x);
    return INFINITY;
}
