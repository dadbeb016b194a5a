/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/pieces.h"

/* --- A quadratic through points --------------------------------------------------------------- */

/* Nodes of Chebyshev's quadratic interpolation: 0 and +- this, sqrt(3)/2. */
#define PIECES_OFF 0.8660254037844386

/* (u, v, t) where s is `off` times these. */
static void pieces_place(const imp_region *region, double u, double v, double t, double p[3])
{
    const double s[3] = {u, v, t};
    for (int j = 0; j < 3; ++j) {
        const double x = region->c[j] + region->d[j] * s[j];
        p[j] = imp_smaller(imp_larger(x, region->lo[j]), region->hi[j]);
    }
}

enum { PIECES_STILL = 9, PIECES_MOVED = 5, PIECES_SAMPLES = PIECES_STILL + PIECES_MOVED };

/* Coordinate i of the samples: the nine places 3 (s_u + 1) + (s_v + 1) at the middle time; then, at
 * the last time, centre, -u, +u, -v, +v. Linear in t: q_tt stays 0. */
static imp_model pieces_quadratic(double x[PIECES_SAMPLES][3], int i)
{
    const double off = PIECES_OFF, centre = x[4][i], u = x[7][i] - x[1][i], v = x[5][i] - x[3][i];
    imp_model g = imp_model_zero();
    g.a = centre;
    g.b[0] = u / (2 * off);
    g.b[1] = v / (2 * off);
    g.b[2] = x[9][i] - centre;
    g.q[IMP_UU] = (0.5 * (x[7][i] + x[1][i]) - centre) / (off * off);
    g.q[IMP_VV] = (0.5 * (x[5][i] + x[3][i]) - centre) / (off * off);
    g.q[IMP_UV] = ((x[8][i] + x[0][i]) - (x[2][i] + x[6][i])) / (4 * off * off);
    g.q[IMP_UT] = ((x[11][i] - x[10][i]) - u) / (2 * off);
    g.q[IMP_VT] = ((x[13][i] - x[12][i]) - v) / (2 * off);
    return g;
}

imp_status pieces_sample(pieces_eval *eval, const void *self, const imp_region *region,
                         imp_model model[3])
{
    const double off = PIECES_OFF;
    double p[PIECES_SAMPLES][3], x[PIECES_SAMPLES][3];
    for (int k = 0; k < PIECES_STILL; ++k)
        pieces_place(region, off * (k / 3 - 1), off * (k % 3 - 1), 0, p[k]);
    pieces_place(region, 0, 0, 1, p[PIECES_STILL]);
    for (int side = 0; side < 2; ++side) {
        pieces_place(region, side ? off : -off, 0, 1, p[PIECES_STILL + 1 + side]);
        pieces_place(region, 0, side ? off : -off, 1, p[PIECES_STILL + 3 + side]);
    }
    imp_status status = eval(self, PIECES_SAMPLES, p[0], x[0], NULL);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i) model[i] = pieces_quadratic(x, i);
    return status;
}

/* --- Its distance from a piece ---------------------------------------------------------------- */

/* The two parameters that coefficient q[k] multiplies. */
static const int pieces_first[6] = {0, 0, 0, 1, 1, 2}, pieces_second[6] = {0, 1, 2, 1, 2, 2};

pieces_shift pieces_shift_of(const imp_region *whole, const imp_region *piece)
{
    pieces_shift s = {{0, 0, 0}, {0, 0, 0}};
    for (int j = 0; j < 3; ++j)
        if (whole->d[j] > 0) {
            s.sigma[j] = (piece->c[j] - whole->c[j]) / whole->d[j];
            s.delta[j] = piece->d[j] / whole->d[j];
        }
    return s;
}

/* The quadratic `whole` in the piece's parameters. Rounding: |sigma|, |delta| <= 1 within 2 units,
 * and a coefficient is a sum of at most ten products of four factors: below 32 units of its size.
 */
static imp_model pieces_restrict(const imp_model *whole, const pieces_shift *shift)
{
    const double *sigma = shift->sigma, *delta = shift->delta;
    imp_model g = imp_model_zero();
    g.a = whole->a;
    for (int j = 0; j < 3; ++j) {
        g.a += whole->b[j] * sigma[j];
        g.b[j] = whole->b[j] * delta[j];
    }
    for (int k = 0; k < 6; ++k) {
        const int j = pieces_first[k], l = pieces_second[k];
        g.a += whole->q[k] * sigma[j] * sigma[l];
        g.b[j] += whole->q[k] * sigma[l] * delta[j];
        g.b[l] += whole->q[k] * sigma[j] * delta[l];
        g.q[k] = whole->q[k] * delta[j] * delta[l];
    }
    return g;
}

/* At least |whole - g| over the piece, g being the piece's model. */
static double pieces_distance_upper(const imp_model *whole, const imp_model *g,
                                    const pieces_shift *shift)
{
    imp_model apart = pieces_restrict(whole, shift);
    apart.a -= g->a;
    for (int j = 0; j < 3; ++j) apart.b[j] -= g->b[j];
    for (int k = 0; k < 6; ++k) apart.q[k] -= g->q[k];
    apart.e = g->e + 64 * IMP_U * (imp_model_size(whole) + imp_model_size(g));
    return imp_interval_mag(imp_model_poly_range(&apart)) * IMP_SLACK;
}

/* --- Together --------------------------------------------------------------------------------- */

void pieces_begin(imp_model *whole)
{
    whole->e = 0;
    whole->lo = INFINITY;
    whole->hi = -INFINITY;
}

void pieces_add(imp_model *whole, const imp_model *g, const pieces_shift *shift)
{
    whole->e = imp_larger(whole->e, pieces_distance_upper(whole, g, shift));
    whole->lo = imp_smaller(whole->lo, g->lo);
    whole->hi = imp_larger(whole->hi, g->hi);
    whole->depends |= g->depends;
    for (int j = 0; j < 3; ++j) whole->rate[j] = imp_larger(whole->rate[j], g->rate[j]);
}

/* After the last piece. What the whole does not depend on has left rounding in its quadratic. */
imp_model pieces_end(const imp_model *whole)
{
    imp_model g = *whole;
    for (int j = 0; j < 3; ++j)
        if (!(g.depends >> j & 1)) g.e += fabs(g.b[j]), g.b[j] = 0;
    for (int k = 0; k < 6; ++k)
        if (!(g.depends >> pieces_first[k] & 1) || !(g.depends >> pieces_second[k] & 1))
            g.e += fabs(g.q[k]), g.q[k] = 0;
    g.e *= IMP_SLACK;
    return imp_model_finish(g);
}
