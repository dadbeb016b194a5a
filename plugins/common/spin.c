/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/spin.h"

#include <stdbool.h>
#include <string.h>

/* --- Making one ------------------------------------------------------------------------------- */

typedef struct matrix {
    imp_interval at[3][3];
} matrix;

static imp_interval exact(double x) { return imp_interval_make(x, x); }

static matrix matrix_mul(const matrix *a, const matrix *b)
{
    matrix r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            r.at[i][j] = exact(0);
            for (int k = 0; k < 3; ++k)
                r.at[i][j] =
                    imp_interval_add(r.at[i][j], imp_interval_mul(a->at[i][k], b->at[k][j]));
        }
    return r;
}

/* The rotation of q / |q|: 1 + 2 (w [v] + v v' - v'v) / |q|^2. */
static matrix matrix_of_quaternion(const double *q)
{
    matrix r;
    imp_interval square[4], sum = exact(0);
    for (int i = 0; i < 4; ++i) {
        square[i] = imp_interval_sqr(exact(q[i]));
        sum = imp_interval_add(sum, square[i]);
    }
    const imp_interval twice = imp_interval_div(exact(2), sum);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        imp_interval both = imp_interval_mul(exact(q[1 + i]), exact(q[1 + j]));
        imp_interval turn = imp_interval_mul(exact(q[0]), exact(q[1 + k]));
        imp_interval lost = imp_interval_mul(imp_interval_add(square[1 + j], square[1 + k]), twice);
        r.at[i][i] = imp_interval_sub(exact(1), lost);
        r.at[i][j] = imp_interval_mul(imp_interval_sub(both, turn), twice);
        r.at[j][i] = imp_interval_mul(imp_interval_add(both, turn), twice);
    }
    return r;
}

/* The parts of a turn about w: k k', 1 - k k' and k x, for k = w / |w|; and |w|. */
typedef struct turn_parts {
    matrix along, across, turned;
    imp_interval speed;
} turn_parts;

static turn_parts parts_of_spin(const double *w)
{
    turn_parts p = {.speed = exact(0)};
    imp_interval k[3];
    for (int i = 0; i < 3; ++i) p.speed = imp_interval_add(p.speed, imp_interval_sqr(exact(w[i])));
    p.speed = imp_interval_sqrt(p.speed);
    const bool still = w[0] == 0 && w[1] == 0 && w[2] == 0;
    for (int i = 0; i < 3; ++i) k[i] = still ? exact(0) : imp_interval_div(exact(w[i]), p.speed);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            imp_interval both = i == j ? imp_interval_sqr(k[i]) : imp_interval_mul(k[i], k[j]);
            p.along.at[i][j] = both;
            p.across.at[i][j] = imp_interval_sub(exact(i == j), both);
        }
        p.turned.at[i][i] = exact(0);
        p.turned.at[i][(i + 2) % 3] = k[(i + 1) % 3];
        p.turned.at[i][(i + 1) % 3] = imp_interval_neg(k[(i + 2) % 3]);
    }
    return p;
}

static near_constant near_within(imp_interval x)
{
    const double m = imp_interval_mid(x);
    return (near_constant){m, imp_interval_radius_upper(x, m)};
}

spin_turn spin_turn_make(const double spin[3], const double from[4], const double to[4],
                         imp_interval h, imp_interval bound[2])
{
    spin_turn r;
    turn_parts p = parts_of_spin(spin);
    const matrix first = matrix_of_quaternion(from), last = matrix_of_quaternion(to);
    const imp_interval angle = imp_interval_mul(p.speed, h);
    const imp_interval cosine = imp_interval_cos(angle), sine = imp_interval_sin(angle);
    p.along = matrix_mul(&p.along, &first);
    p.across = matrix_mul(&p.across, &first);
    p.turned = matrix_mul(&p.turned, &first);
    double most = 0, miss = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            imp_interval end = imp_interval_mul(cosine, p.across.at[i][j]);
            end = imp_interval_add(end, imp_interval_mul(sine, p.turned.at[i][j]));
            end = imp_interval_sub(last.at[i][j], imp_interval_add(end, p.along.at[i][j]));
            const imp_interval drift = imp_interval_div(end, h);
            miss = imp_larger(imp_interval_mag(end), miss);
            most = imp_larger(imp_interval_mag(drift), most);
            r.along[i][j] = near_within(p.along.at[i][j]);
            r.across[i][j] = near_within(p.across.at[i][j]);
            r.turned[i][j] = near_within(p.turned.at[i][j]);
            r.drift[i][j] = near_within(drift);
        }
    r.speed = near_within(p.speed);
    memcpy(r.spin, spin, sizeof r.spin);
    const double speed = miss <= SPIN_MISMATCH ? imp_sum_up(p.speed.hi + most) : INFINITY;
    bound[0] = imp_interval_make(0, speed);
    bound[1] = imp_interval_make(0, 3 * most * (1 + angle.hi) * IMP_SLACK);
    return r;
}

/* --- Over times ------------------------------------------------------------------------------- */

/* An entry of R, at most 1 + SPIN_MISMATCH, rates at most `speed`. */
static imp_model entry(imp_model r, const imp_model *t, double speed)
{
    const double most = 1 + 2 * SPIN_MISMATCH;
    for (int j = 0; j < 3; ++j)
        if (r.depends >> j & 1)
            r.rate[j] = imp_smaller(r.rate[j], imp_round_up(speed * t->rate[j]));
    return imp_model_within(r, imp_interval_make(-most, most));
}

void spin_matrix(const spin_turn *r, double start, imp_model t, double speed, imp_model out[3][3])
{
    const imp_model s = imp_shift(t, -start);
    imp_model sine, cosine;
    imp_sincos(near_scale(s, r->speed), &sine, &cosine);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            imp_model sum =
                imp_add(near_scale(cosine, r->across[i][j]), near_scale(sine, r->turned[i][j]));
            sum = imp_add(sum, near_scale(s, r->drift[i][j]));
            out[i][j] = entry(near_shift(sum, r->along[i][j]), &t, speed);
        }
}

double spin_size_upper(const imp_model x[3])
{
    imp_interval square = exact(0);
    for (int i = 0; i < 3; ++i)
        square = imp_interval_add(square, imp_interval_sqr(imp_interval_make(x[i].lo, x[i].hi)));
    return imp_interval_sqrt(square).hi;
}

void spin_apply(imp_model r[3][3], const imp_model x[3], imp_model out[3])
{
    const double most = imp_round_up(spin_size_upper(x) * (1 + 4 * SPIN_MISMATCH));
    for (int i = 0; i < 3; ++i)
        out[i] = imp_model_within(imp_dot3(r[i], x), imp_interval_make(-most, most));
}
