/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/lattice.h"

#include "plugins/patch/bernstein.h"
#include "plugins/patch/chebyshev.h"

#include <math.h>

/* Lemma (noise). With u = 2^-53, as functions on the box, the computed series over it and F differ
 * by (l + m + n + 6) beta most        R: three sums of products, 1 each for the rounding of beta;
 *                                    beta: product of the sums of all |beta| of
 * chebyshev_of_bernstein sum |R_ijk| (shift_i + shift_j + shift_k)               shifted T as
 * functions, |T| <= 1 sum |R_ijk| (l + m + n + 3) reach_i reach_j reach_k     the three sums that
 * make C units of u. A polynomial of degree n that is at most `noise` has a derivative of at most
 * n^2 noise (Markov). */

static int lattice_degrees(const lattice *f) { return f->degree[0] + f->degree[1] + f->degree[2]; }

/* Sums along one axis: out_k = sum_j matrix[j * row + k * column] in_j, from j = first_k = k or 0.
 */
static void lattice_contract(const lattice *f, int axis, const double *matrix, int row, int column,
                             int triangular, const double *in, double *out)
{
    const int size = f->degree[axis] + 1;
    const size_t inner = lattice_inner(f, axis), block = inner * (size_t)size;
    for (size_t from = 0; from < lattice_points(f); from += block)
        for (int k = 0; k < size; ++k) {
            double *to = out + from + (size_t)k * inner;
            for (size_t x = 0; x < inner; ++x) to[x] = 0;
            for (int j = triangular ? k : 0; j < size; ++j) {
                const double w = matrix[j * row + k * column];
                const double *of = in + from + (size_t)j * inner;
                for (size_t x = 0; x < inner; ++x) to[x] += w * of[x];
            }
        }
}

/* --- Once ------------------------------------------------------------------------------------- */

/* Computes R from the net and returns beta. `work` has the size of a net. */
static double lattice_set_series(const lattice *f, lattice_lane *lane, double *work)
{
    double beta[LATTICE_SIDE_MAX * LATTICE_SIDE_MAX], product = 1;
    const double *in = lane->net;
    double *out[3] = {lane->series, work, lane->series};
    for (int axis = 0; axis < 3; ++axis) {
        const int size = f->degree[axis] + 1;
        double sum = 0;
        chebyshev_of_bernstein(f->degree[axis], beta);
        lattice_contract(f, axis, beta, 1, size, 0, in, out[axis]);
        in = out[axis];
        for (int k = 0; k < size * size; ++k) sum += fabs(beta[k]);
        product *= sum;
    }
    return product;
}

/* n (net_next - net) along one axis, in units of the cube. */
static imp_interval lattice_slope(const lattice *f, const lattice_lane *lane, int axis)
{
    const int n = f->degree[axis];
    const size_t inner = lattice_inner(f, axis), block = inner * (size_t)(n + 1);
    double lo = INFINITY, hi = -INFINITY;
    for (size_t from = 0; from < lattice_points(f); from += block)
        for (size_t x = 0; x < (size_t)n * inner; ++x) {
            double rise = lane->net[from + x + inner] - lane->net[from + x];
            lo = imp_smaller(lo, rise);
            hi = imp_larger(hi, rise);
        }
    imp_interval rises = {imp_sum_down(lo) - 2 * lane->slip, imp_sum_up(hi) + 2 * lane->slip};
    return imp_interval_scale(imp_interval_add(rises, imp_interval_make(0, 0)), n);
}

/* Everything that follows from net and slip. */
void lattice_set(const lattice *f, lattice_lane *lane, double *work)
{
    const double beta = lattice_set_series(f, lane, work);
    const int degrees = lattice_degrees(f);
    double lo = INFINITY, hi = -INFINITY, units;
    for (size_t i = 0; i < lattice_points(f); ++i) {
        lo = imp_smaller(lo, lane->net[i]);
        hi = imp_larger(hi, lane->net[i]);
    }
    lane->range = imp_interval_add((imp_interval){lo, hi}, (imp_interval){-lane->slip, lane->slip});
    lane->most = imp_larger(fabs(lo), fabs(hi));
    for (int axis = 0; axis < 3; ++axis) lane->slope[axis] = lattice_slope(f, lane, axis);
    units = (degrees + 6) * beta * lane->most;
    lane->sum = 0;
    const double *series = lane->series;
    for (int i = 0; i <= f->degree[0]; ++i)
        for (int j = 0; j <= f->degree[1]; ++j)
            for (int k = 0; k <= f->degree[2]; ++k, ++series) {
                double shifts =
                    chebyshev_shift_error(i) + chebyshev_shift_error(j) + chebyshev_shift_error(k);
                double reach = chebyshev_reach(i) * chebyshev_reach(j) * chebyshev_reach(k);
                units += fabs(*series) * (shifts + (degrees + 3) * reach);
                lane->sum += fabs(*series);
            }
    lane->noise = (units * 0x1p-53 + lane->slip) * LATTICE_SLACK + IMP_TINY;
}

/* --- A point ---------------------------------------------------------------------------------- */

void lattice_weigh(const lattice *f, const double at[3], lattice_weights *weights)
{
    for (int axis = 0; axis < 3; ++axis)
        bernstein_weights(weights->w[axis], 0, 0, f->degree[axis], at[axis]);
}

/* F; *error: of the sums, by the lemmas of bernstein.h, (4 (l + m + n) + 3) most, and of the net.
 */
double lattice_at(const lattice *f, const lattice_lane *lane, const lattice_weights *weights,
                  double *error)
{
    const double *net = lane->net;
    double sum = 0;
    for (int i = 0; i <= f->degree[0]; ++i) {
        double plane = 0;
        for (int j = 0; j <= f->degree[1]; ++j) {
            double row = 0;
            for (int k = 0; k <= f->degree[2]; ++k) row += weights->w[2][k] * *net++;
            plane += weights->w[1][j] * row;
        }
        sum += weights->w[0][i] * plane;
    }
    double units = (4 * lattice_degrees(f) + 3) * lane->most;
    *error = (units * 0x1p-53 + lane->slip) * LATTICE_SLACK + IMP_TINY;
    return sum;
}

/* --- A box ------------------------------------------------------------------------------------ */

/* Coordinates centre[j] -+ half[j], inside [0, 1] but for rounding. */
void lattice_enter(const lattice *f, const double centre[3], const double half[3], lattice_box *box)
{
    for (int axis = 0; axis < 3; ++axis)
        chebyshev_shift(f->degree[axis], 2 * centre[axis] - 1, 2 * half[axis], box->shift[axis],
                        f->degree[axis] + 1);
}

/* Computes C from the series; both buffers are large enough, and it returns one of them. */
static const double *lattice_move(const lattice *f, const lattice_box *box, const double *series,
                                  double *out, double *work)
{
    for (int axis = 0; axis < 3; ++axis) {
        double *to = axis % 2 ? work : out;
        lattice_contract(f, axis, box->shift[axis], f->degree[axis] + 1, 1, 1, series, to);
        series = to;
    }
    return series;
}

static void lattice_add_term(lattice_terms *sum, const int i[3], double c)
{
    static const int square[3] = {IMP_UU, IMP_VV, IMP_TT}, cross[3] = {IMP_VT, IMP_UT, IMP_UV};
    const int order = i[0] + i[1] + i[2];
    if (order == 0) sum->mean = c;
    if (order >= 1) sum->size += fabs(c);
    if (order >= 2) sum->bowed += fabs(c);
    if (order >= 3) sum->rest += fabs(c);
    for (int j = 0; j < 3; ++j) {
        if (order == 1 && i[j] == 1) sum->linear[j] = c;
        if (order == 2 && i[j] == 2) sum->product[square[j]] = c;
        if (order == 2 && i[j] == 0 && i[(j + 1) % 3] == 1) sum->product[cross[j]] = c;
        if (order >= 2) sum->along[j] += i[j] * i[j] * fabs(c);
    }
}

lattice_terms lattice_over(const lattice *f, const lattice_box *box, const double *series)
{
    double out[LATTICE_POINTS_MAX], work[LATTICE_POINTS_MAX];
    const double *c = lattice_move(f, box, series, out, work);
    lattice_terms sum = {.mean = 0};
    for (int i = 0; i <= f->degree[0]; ++i)
        for (int j = 0; j <= f->degree[1]; ++j)
            for (int k = 0; k <= f->degree[2]; ++k)
                lattice_add_term(&sum, (const int[3]){i, j, k}, *c++);
    return sum;
}
