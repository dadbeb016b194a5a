/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/form.h"
#include "tools/verify/orbit.h"

/* The elements where a map turns, but for what its angle does to them, and how much that is. */
typedef struct turned_form {
    form_elements mean;
    double swing[5][4];
} turned_form;

/* A jet over some times, and at their middle. */
typedef struct both_jets {
    jet wide, centre;
} both_jets;

static both_jets form_of_both(const affine *n, const affine *l, ld_interval e[3][3], int i, int k)
{
    return (both_jets){form_of(n->wide, l->wide, e, i, k), form_of(n->centre, l->centre, e, i, k)};
}

static both_jets sum_of(const both_jets *x, const both_jets *y, double by)
{
    const jet wide = jet_scale(&y->wide, ld_interval_of(by)),
              narrow = jet_scale(&y->centre, ld_interval_of(by));
    return (both_jets){jet_add(&x->wide, &wide), jet_add(&x->centre, &narrow)};
}

static ld_interval values_of(const both_jets *x, const affine *of)
{
    return jet_values(&x->wide, &x->centre, of->offset);
}

/* Adds an upper bound of |x| to a sum. */
static void add_size(double *sum, const both_jets *x, const affine *of, double by)
{
    const ld_interval size = ld_interval_of(ld_interval_mag(values_of(x, of)));
    *sum = ld_interval_add(ld_interval_of(*sum), ld_interval_mul(size, ld_interval_of(by))).hi;
}

/* Lemma. Let N = n0 + C n1 + S n2, C and S being those of an angle A, and F(x, y) be x^T E y, E
 * symmetric. F(N, N) is F(n0, n0) + 1/2 F(n1, n1) + 1/2 F(n2, n2) + C (F(n0, n1) + F(n1, n0)) + S
 * (F(n0, n2) + F(n2, n0)) + 1/2 cos 2A (F(n1, n1) - F(n2, n2)) + 1/2 sin 2A (F(n1, n2) + F(n2,
 * n1)), as C^2 = 1/2 + 1/2 cos 2A, S^2 = 1/2 - 1/2 cos 2A and C S = 1/2 sin 2A; none of the factors
 * is greater than 1. w^T N is w^T n0 + C w^T n1 + S w^T n2. */
static void take_element(const orbit *o, ld_interval e[3][3], int i, int k, turned_form *to)
{
    both_jets f[3][3];
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) f[a][b] = form_of_both(&o->n[a], &o->n[b], e, i, k);
    const both_jets squares = sum_of(&f[1][1], &f[2][2], 1), mean = sum_of(&f[0][0], &squares, 0.5);
    const both_jets swing[4] = {sum_of(&f[0][1], &f[1][0], 1), sum_of(&f[0][2], &f[2][0], 1),
                                sum_of(&f[1][1], &f[2][2], -1), sum_of(&f[1][2], &f[2][1], 1)};
    to->mean[i][k] = to->mean[k][i] = values_of(&mean, &o->n[0]);
    double sum = 0;
    for (int n = 0; n < 4; ++n) add_size(&sum, &swing[n], &o->n[0], n < 2 ? 1 : 0.5);
    to->swing[i][k] = to->swing[k][i] = sum;
}

/* False: no map turns, or some may not be affine. */
static bool take_turned(const form_course *f, size_t by, double lo, double hi, orbit *o,
                        turned_form *to)
{
    orbit_take_by(f->p, by, lo, hi, o);
    if (!o->is_known || !o->turns) return false;
    for (int i = 0; i < 3; ++i) {
        const jet at = jet_constant(1, ld_interval_of(f->c[i]));
        o->n[0].wide[i][3] = jet_sub(&o->n[0].wide[i][3], &at);
        o->n[0].centre[i][3] = jet_sub(&o->n[0].centre[i][3], &at);
    }
    for (int i = 0; i < 4; ++i)
        for (int k = i; k < 4; ++k) take_element(o, f->e, i, k, to);
    for (int k = 0; k < 4; ++k)
        for (int m = 0; m < 3; ++m) {
            const both_jets lift = {lift_of(o->n[m].wide, f->w, k),
                                    lift_of(o->n[m].centre, f->w, k)};
            if (m == 0) to->mean[4][k] = values_of(&lift, &o->n[0]), to->swing[4][k] = 0;
            if (m > 0) add_size(&to->swing[4][k], &lift, &o->n[0], 1);
        }
    return true;
}

/* Whether anything but the angle depends on time. */
static bool is_steady(const orbit *o)
{
    int on = 0;
    for (int m = 0; m < 3; ++m)
        for (int i = 0; i < 3; ++i)
            for (int c = 0; c < 4; ++c) on |= o->n[m].wide[i][c].on;
    return on == 0;
}

/* The changes are those of the means, and what the angle does then and at the middle. */
bool form_turned_changes(const form_course *f, form_changes *to)
{
    orbit o;
    turned_form before, now;
    const double at = middle(f->lo, f->hi);
    double from = f->lo;
    orbit_take(f->p, f->lo, f->hi, &o);
    const size_t by = o.is_known ? o.stage : 0;
    if (by == 0 || !take_turned(f, by, f->lo, f->hi, &o, &now)) return false;
    const bool steady = is_steady(&o);
    if (!take_turned(f, by, at, at, &o, &before)) return false;
    to->are_known = true;
    for (int n = 0; n < CHANGE_PARTS; ++n) {
        const double share = (n + 1.0) / CHANGE_PARTS;
        const double end =
            n + 1 < CHANGE_PARTS ? proof_smaller(f->lo + (f->hi - f->lo) * share, f->hi) : f->hi;
        if (!steady && !take_turned(f, by, from, end, &o, &now)) return false;
        for (int i = 0; i < 5; ++i)
            for (int k = 0; k < 4; ++k) {
                double *most = i < 4 ? &to->most[n][i][k] : &to->lift[n][k];
                const ld_interval change = ld_interval_sub(now.mean[i][k], before.mean[i][k]);
                *most = ld_interval_add(ld_interval_of(ld_interval_mag(change)),
                                        ld_interval_add(ld_interval_of(now.swing[i][k]),
                                                        ld_interval_of(before.swing[i][k])))
                            .hi;
            }
        from = end;
    }
    return true;
}
