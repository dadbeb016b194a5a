/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tools/verify/motion_internal.h"

/* Returns the element i, k of J^T J - 1. */
static jet gram(const jet j[3][4], int i, int k)
{
    jet sum = jet_constant(1, ld_interval_of(i == k ? -1 : 0));
    for (int l = 0; l < 3; ++l) {
        const jet both = jet_mul(&j[l][i], &j[l][k]);
        sum = jet_add(&sum, &both);
    }
    return sum;
}

/* Lemma. The largest sum of a row bounds the norm of a symmetric matrix. */
static double deviation(const part *p, double lo, double hi, jet room[])
{
    affine a;
    if (!p->is_affine) return INFINITY;
    affine_take(p, lo, hi, room, &a);
    double most = 0;
    ld_interval size[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = i; k < 3; ++k) {
            const jet over = gram(a.wide, i, k), middle = gram(a.centre, i, k);
            size[i][k] = size[k][i] = ld_interval_abs(jet_values(&over, &middle, a.offset));
        }
    for (int i = 0; i < 3; ++i) {
        const ld_interval row =
            ld_interval_add(ld_interval_add(size[i][0], size[i][1]), size[i][2]);
        if (!(row.hi <= most)) most = row.hi;
    }
    return most;
}

/* The greatest deviation of the parts that hold all of the times. */
static double deviation_of_parts(const piece *p, const part *first, const box3 *times, double lo,
                                 double hi, jet room[])
{
    double most = 0;
    for (const part *q = first; q != NULL; q = enclose_next_part(p, q, times)) {
        const double d = deviation(q, lo, hi, room);
        if (!(d <= most)) most = d;
    }
    return most;
}

/* Times are halved until d is small or this deep. */
enum { HALVINGS = 14 };
#define DEVIATION_SMALL 0x1p-26

static double worst(const piece *p, double lo, double hi, int depth, jet room[])
{
    const part *found;
    split divide;
    const box3 times = {{-INFINITY, -INFINITY, lo}, {INFINITY, INFINITY, hi}};
    const enclosed result = enclose_choose_part(p, &times, &found, &divide);
    double at = lo + 0.5 * (hi - lo);
    if (result != ENCLOSED && result != ENCLOSED_SPLIT) return INFINITY;
    if (result == ENCLOSED) {
        const double d = deviation_of_parts(p, found, &times, lo, hi, room);
        if (d <= DEVIATION_SMALL || depth >= HALVINGS || !(lo < at && at < hi) || isinf(d))
            return d;
        /* it is no smaller there */
        if (deviation_of_parts(p, found, &times, at, at, room) > 0.5 * d) return d;
    } else {
        at = divide.at;
    }
    depth += result == ENCLOSED;
    const double first = worst(p, lo, at, depth, room);
    const double second = worst(p, at, hi, depth, room);
    return !(first <= second) ? first : second;
}

double map_deviation_upper(const statement *s, size_t map, double lo, double hi, jet *room)
{
    return worst(&s->stages[map].pieces[0], lo, hi, 0, room);
}
