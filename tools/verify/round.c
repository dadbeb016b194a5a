/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/round.h"

#include <math.h>

#include "tools/verify/meridian.h"

void centre_parts(const jet x[3], const centre *about, jet r[CENTRE_PARTS])
{
    const double *d = about->d;
    jet w[3];
    for (int i = 0; i < 3; ++i) {
        const jet c = jet_constant(VARIABLES, ld_interval_of(about->c[i]));
        w[i] = jet_sub(&x[i], &c);
        r[i] = w[i];
    }
    r[3] = jet_constant(VARIABLES, ld_interval_of(0));
    for (int i = 0; i < 3 && about->is_line; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const jet first = jet_scale(&w[j], ld_interval_of(d[k]));
        const jet second = jet_scale(&w[k], ld_interval_of(-d[j]));
        r[i] = jet_add(&first, &second);
        const jet height = jet_scale(&w[i], ld_interval_of(d[i]));
        r[3] = jet_add(&r[3], &height);
    }
}

/* Lemma. |x - c| changes by no more than |x - y| from x to y, and |(x - c) x d| by no more than |d|
 * times that. Where x has distance s from the line and height h, |x - y|^2 is at least the square
 * of the change of (s, h); so n[0] |(x - c) x d| + n[1] (x - c).d changes by no more than |n| |d|
 * |x - y|, by Cauchy-Schwarz. */
jet centre_distance(const jet r[CENTRE_PARTS], const aim *a)
{
    const jet distance = jet_length((const jet *const[3]){&r[0], &r[1], &r[2]}, 3);
    if (a->n[1] == 0) return a->n[0] > 0 ? distance : jet_neg(&distance);
    const jet from = jet_scale(&distance, ld_interval_of(a->n[0]));
    const jet along = jet_scale(&r[3], ld_interval_of(a->n[1]));
    return jet_add(&from, &along);
}

/* Lemma. |x - c|^2 is x^T x, and |x x d|^2 is x^T (d^T d - d d^T) x, of x - c. */
static void take_form(const centre *about, ld_interval e[3][3])
{
    const double *d = about->d;
    ld_interval square = ld_interval_of(0);
    for (int i = 0; i < 3; ++i)
        square = ld_interval_add(square, ld_interval_sqr(ld_interval_of(d[i])));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const ld_interval both = ld_interval_mul(ld_interval_of(d[i]), ld_interval_of(d[j]));
            const ld_interval same = ld_interval_of(i == j);
            e[i][j] = about->is_line ? ld_interval_sub(ld_interval_mul(same, square), both) : same;
        }
}

/* Bounds how much the square of the distance and the height change over the aim's times, for a box
 * of a surface that does not move by itself. False: they have no bounds. */
static bool find_changes(memory *known, const place *of, const box3 *where, const aim *a,
                         double *slip, double *lift)
{
    ld_interval e[3][3];
    double size[3];
    place bare = *of;
    bare.maps = 0;
    const kept *k = look_jets(known, &bare, where);
    if (k->result != ENCLOSED) return false;
    for (int i = 0; i < 3; ++i) size[i] = ld_interval_mag(k->box[i].v);
    take_form(a->about, e);
    const double *d = a->about->d;
    const form_changes *all = look_changes(known, of, a->times[0], a->times[1], a->about->c, e, d);
    *slip = form_change_upper(all, size);
    *lift = form_lift_upper(all, size);
    return *slip < INFINITY && *lift < INFINITY;
}

/* Lemma. |s - r| is |s^2 - r^2| / (s + r), and at most the root of |s^2 - r^2|. With |s^2 - r^2| <=
 * by it is at most by / (s + root of max(s^2 - by, 0)), which falls as s grows: so the least s of a
 * box stands for all of it. */
double centre_change_upper(memory *known, const place *of, const box3 *where, const aim *a,
                           double least)
{
    double slip, lift;
    if (!find_changes(known, of, where, a, &slip, &lift)) return INFINITY;
    const ld_interval by = ld_interval_of(slip), from = ld_interval_of(proof_larger(least, 0));
    const ld_interval square = ld_interval_sub(ld_interval_sqr(from), by);
    const ld_interval to = ld_interval_sqrt(ld_interval_of(proof_larger(square.lo, 0)));
    double change = ld_interval_sqrt(by).hi;
    if (least > 0)
        change = proof_smaller(change, ld_interval_div(by, ld_interval_add(from, to)).hi);
    const ld_interval both[2] = {
        ld_interval_mul(ld_interval_of(fabs(a->n[0])), ld_interval_of(change)),
        ld_interval_mul(ld_interval_of(fabs(a->n[1])), ld_interval_of(lift))};
    return ld_interval_add(both[0], both[1]).hi;
}

/* Holds a surface that does not move by itself at the middle of the times, and bounds how much its
 * motion changes the squares of distances, and heights. Else all times are bounded at once. */
static void hold(memory *known, const place *of, const box3 *where, aim *a)
{
    const piece *shape = enclose_piece(of, 0);
    double slip, lift;
    a->at = NAN, a->slip = 0, a->lift = 0;
    if (shape->count != 1 || shape->parts[0].is_moving) return;
    a->times[0] = where->lo[T], a->times[1] = where->hi[T];
    if (!find_changes(known, of, where, a, &slip, &lift)) return;
    a->slip = slip;
    a->lift = a->n[1] != 0 ? lift : 0;
    a->at = middle(where->lo[T], where->hi[T]);
}

bool centre_aims(memory *known, const centre *about, const place of[2], const box3 where[2],
                 double apart, aim a[2], double *change_upper)
{
    meridian middle[2];
    for (int side = 0; side < 2; ++side) {
        const kept *k = look_jets(known, &of[side], &where[side]);
        if (k->result != ENCLOSED) return false;
        meridian_measure(about, k, &middle[side]);
    }
    double n[2] = {middle[1].at[0] > middle[0].at[0] ? 1 : -1, 0};
    if (about->is_line) meridian_choose(middle, apart, n);
    if (n[1] == 0) n[0] = n[0] < 0 ? -1 : 1; /* centre_distance takes its sign alone then */
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1 : -1;
        a[side] = (aim){.n = {sign * n[0], sign * n[1], 0}, .about = about};
        a[side].radius = middle[side].at[0];
        hold(known, &of[side], &where[side], &a[side]);
    }
    ld_interval square = ld_interval_of(0), weight = square;
    for (int i = 0; i < 3; ++i)
        square = ld_interval_add(square, ld_interval_sqr(ld_interval_of(about->d[i])));
    for (int i = 0; i < 2; ++i)
        weight = ld_interval_add(weight, ld_interval_sqr(ld_interval_of(n[i])));
    *change_upper = about->is_line ? ld_interval_sqrt(ld_interval_mul(square, weight)).hi : 1;
    return true;
}
