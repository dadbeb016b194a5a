/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"

#include <math.h>

imp_status axis_check(int row, const double axis[3], imp_create_error *why)
{
    for (int i = 0; i < 3; ++i)
        if (fabs(axis[i]) >= AXIS_MIN) return IMP_STATUS_OK;
    return imp_reject(why, row, -1,
                      "[%g,%g,%g] has no direction; must be any vector but 0 (some component at "
                      "least %g)",
                      axis[0], axis[1], axis[2], AXIS_MIN);
}

/* --- Constant vectors and matrices ------------------------------------------------------------ */

static bool near_is_zero(near_constant k) { return k.value == 0 && k.error == 0; }

imp_model axis_dot(const near_constant k[3], const imp_model w[3])
{
    imp_model sum = imp_num(0);
    for (int j = 0; j < 3; ++j)
        if (!near_is_zero(k[j])) sum = imp_add(sum, near_scale(w[j], k[j]));
    return sum;
}

void axis_unit(const imp_model axis[3], imp_model unit[3])
{
    imp_model length = imp_sqrt(imp_dot3(axis, axis));
    for (int i = 0; i < 3; ++i) unit[i] = imp_div(axis[i], length);
}

bool axis_is_aligned(const double axis[3])
{
    return (axis[0] != 0) + (axis[1] != 0) + (axis[2] != 0) == 1;
}

void axis_unit_of(const double axis[3], imp_model unit[3])
{
    const bool aligned = axis_is_aligned(axis);
    for (int i = 0; i < 3; ++i)
        unit[i] = imp_num(aligned ? (axis[i] > 0) - (axis[i] < 0) : axis[i]);
    if (!aligned) axis_unit(unit, unit);
}

void axis_cross(const imp_model a[3], const imp_model b[3], imp_model out[3])
{
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = imp_sub(imp_mul(a[j], b[k]), imp_mul(a[k], b[j]));
    }
}

static imp_interval interval_of(near_constant k)
{
    return imp_interval_make(imp_sum_down(k.value - k.error), imp_sum_up(k.value + k.error));
}

/* --- Turning ---------------------------------------------------------------------------------- */

/* Entry i, j of the matrix that takes w to k x w. */
static near_constant turned_at(const axis_frame *frame, int i, int j)
{
    if (i == j) return near_exact(0);
    const near_constant k = frame->unit[3 - i - j];
    return j == (i + 1) % 3 ? (near_constant){-k.value, k.error} : k;
}

axis_frame axis_frame_of(const double axis[3])
{
    axis_frame frame;
    imp_model k[3];
    axis_unit_of(axis, k);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            imp_model both = imp_mul(k[i], k[j]);
            frame.along[i][j] = near_of(both);
            frame.across[i][j] = near_of(imp_sub(imp_num(i == j), both));
        }
        frame.unit[i] = near_of(k[i]);
    }
    return frame;
}

/* One entry of along + cos across + sin turned. */
static imp_model axis_entry(const axis_frame *frame, int i, int j, imp_model cosine, imp_model sine)
{
    imp_model sum = imp_num(0);
    const near_constant across = frame->across[i][j], turned = turned_at(frame, i, j);
    if (!near_is_zero(across)) sum = near_scale(cosine, across);
    if (!near_is_zero(turned)) sum = imp_add(sum, near_scale(sine, turned));
    return near_shift(sum, frame->along[i][j]);
}

/* (along + cos across + sin turned) w. The matrix comes first: added up, its entries are at most 1,
 * while their shares of w would be bounded one by one. */
static void axis_transform(const axis_frame *frame, imp_model cosine, imp_model sine,
                           const imp_model w[3], imp_model out[3])
{
    for (int i = 0; i < 3; ++i) {
        imp_model row[3];
        for (int j = 0; j < 3; ++j) row[j] = axis_entry(frame, i, j, cosine, sine);
        out[i] = imp_dot3(row, w);
    }
}

bool axis_is_point(const imp_model *angle)
{
    const double most = 0x1p-30; /* rad; what imp_is_point allows for a value of 1 */
    return !angle->depends && angle->e <= most && angle->lo <= angle->a && angle->a <= angle->hi;
}

/* Returns the matrix of an angle within e of 0.
 *
 * Lemma. R(A) - 1 = sin A turned - (1 - cos A) across, where |sin A| <= e, and 1 - cos A <= e since
 * it is at most e^2 / 2 and at most 2. Entries of across and turned are within their errors. An
 * entry of 0 or 1 is exact: a turned point has only the roundings of w, of products and of sums. An
 * entry of 0 gets as much: a checker that rounds the formula's entries could not prove less. */
static axis_point_matrix matrix_near_rest(const axis_frame *frame, double e)
{
    enum { REST_ROUNDING = 4 }; /* w, product, sums: 1 + 3 */
    axis_point_matrix matrix;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const near_constant across = frame->across[i][j], turned = turned_at(frame, i, j);
            const double moving =
                fabs(across.value) + across.error + fabs(turned.value) + turned.error;
            matrix.entry[i][j] = i == j;
            matrix.off[i][j] = e * moving + REST_ROUNDING * IMP_U + IMP_TINY;
        }
    return matrix;
}

/* Lemma (a point). Let w = at - center, off by u |w|, and let `trig` bound how far sine and cosine
 * of the exact angle are from those computed: the angle's error, and (L). With E = |along| +
 * |across| + |turned| an entry is off by the errors of its three constants, trig (|across| +
 * |turned|), since |cos|, |sin| <= 1, and rounding; W = sum_j E_ij |w_j| counts that, in units of
 * u:
 *
 *   w                      1
 *   entry                  3: product, two sums
 *   product, sums          3
 *
 * and the sum with the center rounds once. Underflow: fewer than 32 products, each multiplied by 1
 * or |w_j|. */
axis_point_matrix axis_matrix_of_points(const axis_frame *frame, const imp_model *angle)
{
    enum { POINT_ROUNDING = 8 };
    _Static_assert(1 + 3 + 3 <= POINT_ROUNDING, "rounding of a turned point");
    if (angle->a == 0) return matrix_near_rest(frame, angle->e);
    const double s = sin(angle->a), c = cos(angle->a), trig = angle->e + IMP_LIBM + IMP_TINY;
    axis_point_matrix matrix;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const near_constant along = frame->along[i][j], across = frame->across[i][j],
                                turned = turned_at(frame, i, j);
            const double moving = fabs(across.value) + fabs(turned.value);
            matrix.entry[i][j] = c * across.value + s * turned.value + along.value;
            matrix.off[i][j] = along.error + across.error + turned.error + trig * moving +
                               POINT_ROUNDING * IMP_U * (fabs(along.value) + moving) + IMP_TINY;
        }
    return matrix;
}

bool axis_turn_point(const axis_point_matrix *matrix, const double center[3], const double at[3],
                     double x[3], double error[3])
{
    bool finite = true;
    for (int i = 0; i < 3; ++i) {
        double sum = 0, off = IMP_TINY;
        for (int j = 0; j < 3; ++j) {
            const double w = at[j] - center[j];
            sum += matrix->entry[i][j] * w;
            off += matrix->off[i][j] * fabs(w);
        }
        x[i] = sum + center[i];
        error[i] = (off + IMP_U * fabs(x[i])) * IMP_SLACK;
        finite = finite && error[i] < INFINITY;
    }
    return finite;
}

/* Adds k x, number by number, to what is collected of one entry; x depends on parameter p alone.
 *
 * Lemma. With |K - k| <= kappa, x = P + delta and |x| <= m, K x - k P = K delta + (K - k) P, at
 * most (|k| + kappa) e + kappa (m + e). Each coefficient is a sum of two products, and one constant
 * of a: at most 3 roundings of what their sizes add up to. K x lies in k [lo, hi], widened by kappa
 * m. */
static void add_share(near_constant k, const imp_model *x, int p, imp_model *sum, double *size)
{
    static const int square[3] = {IMP_UU, IMP_VV, IMP_TT};
    const double most = imp_interval_mag(imp_model_range(x)), share = fabs(k.value) + k.error;
    const double slip = (k.error * most + IMP_TINY) * IMP_SLACK;
    const double below = k.value * (k.value > 0 ? x->lo : x->hi);
    const double above = k.value * (k.value > 0 ? x->hi : x->lo);
    const double a = k.value * x->a, b = k.value * x->b[p], q = k.value * x->q[square[p]];
    sum->a += a;
    sum->b[p] += b;
    sum->q[square[p]] += q;
    sum->rate[p] = (sum->rate[p] + share * x->rate[p]) * IMP_SLACK;
    sum->e += share * x->e + k.error * (most + x->e);
    sum->lo = imp_sum_down(sum->lo + imp_sum_down(imp_round_down(below) - slip));
    sum->hi = imp_sum_up(sum->hi + imp_sum_up(imp_round_up(above) + slip));
    sum->depends |= x->depends;
    *size += fabs(a) + fabs(b) + fabs(q);
}

/* along + cos across + sin turned at once. A column of the matrix is a unit vector, which an angle
 * moves by no more than itself. */
static imp_model matrix_entry(const axis_frame *frame, int i, int j, const imp_model *cosine,
                              const imp_model *sine, const imp_model *angle)
{
    const int p = angle->depends & 1u ? 0 : angle->depends & 2u ? 1 : 2;
    const near_constant along = frame->along[i][j];
    double size = fabs(along.value);
    imp_model sum = imp_known(along.value, along.error);
    const near_constant across = frame->across[i][j], turned = turned_at(frame, i, j);
    if (!near_is_zero(across)) add_share(across, cosine, p, &sum, &size);
    if (!near_is_zero(turned)) add_share(turned, sine, p, &sum, &size);
    sum.e = (sum.e + (3 * IMP_U * size + IMP_TINY)) * IMP_SLACK;
    sum.rate[p] = imp_smaller(sum.rate[p], angle->rate[p]);
    return imp_model_within(sum, imp_interval_make(-1, 1));
}

/* The entries at one angle, which are known within their errors. */
static void matrix_at_point(const axis_frame *frame, const imp_model *angle, imp_model turn[3][3])
{
    const axis_point_matrix matrix = axis_matrix_of_points(frame, angle);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            turn[i][j] = imp_known(matrix.entry[i][j], matrix.off[i][j] * IMP_SLACK);
}

void axis_matrix(const axis_frame *frame, imp_model angle, imp_model turn[3][3])
{
    if (imp_is_point(&angle)) {
        matrix_at_point(frame, &angle, turn);
        return;
    }
    imp_model sine, cosine;
    imp_sincos(angle, &sine, &cosine);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) turn[i][j] = matrix_entry(frame, i, j, &cosine, &sine, &angle);
}

static bool depends_on_one(const imp_model *x) { return (x->depends & (x->depends - 1)) == 0; }

void axis_turn(const axis_frame *frame, imp_model angle, const imp_model w[3], imp_model out[3])
{
    if (angle.depends != 0 && depends_on_one(&angle)) {
        imp_model turn[3][3];
        axis_matrix(frame, angle, turn);
        for (int i = 0; i < 3; ++i) out[i] = imp_dot3(turn[i], w);
        return;
    }
    imp_model sine, cosine;
    imp_sincos(angle, &sine, &cosine);
    axis_transform(frame, cosine, sine, w, out);
}

void axis_stretch(const axis_frame *frame, imp_model factor, const imp_model w[3], imp_model out[3])
{
    axis_transform(frame, factor, imp_num(0), w, out);
}

/* --- Rates of turning ---
 *
 * The rates in time of the formula add up, entry by entry, what partly cancels in R'(A) w: they are
 * up to twice too large. These come from the entries of the rotation R(A), of R'(A), and of an
 * advance by A along some vector, over the box's angles:
 *
 *   R = k k^T + cos A (1 - k k^T) + sin A k x,   |d/dw_j| <= |R_ij|
 *   R' = cos A k x - sin A (1 - k k^T),          |d/dt| <= |A'| |(R' w)_i + advance_i| */

imp_model axis_moment(const imp_box4 *box)
{
    imp_region moment = imp_region_between(box->lo + 1, box->hi + 1); /* of y, z, t */
    return imp_param(&moment, 2);
}

static imp_interval turned_entry(const axis_frame *frame, int i, int j, imp_interval cosine,
                                 imp_interval sine)
{
    imp_interval across = imp_interval_mul(cosine, interval_of(frame->across[i][j]));
    imp_interval turned = imp_interval_mul(sine, interval_of(turned_at(frame, i, j)));
    return imp_interval_add(across, turned);
}

imp_status axis_turn_rates(const axis_frame *frame, const double center[3],
                           const near_constant advance[3], imp_model angle, const imp_box4 *box,
                           imp_map_rates *rates)
{
    const imp_interval turn = imp_interval_make(angle.lo, angle.hi);
    const imp_interval cosine = imp_interval_cos(turn), sine = imp_interval_sin(turn);
    double size = 0;
    for (int i = 0; i < 3; ++i) {
        imp_interval speed = interval_of(advance[i]);
        for (int j = 0; j < 3; ++j) {
            imp_interval entry = turned_entry(frame, i, j, cosine, sine);
            imp_interval slope = turned_entry(frame, i, j, imp_interval_neg(sine), cosine);
            imp_interval w = imp_interval_make(imp_sum_down(box->lo[j] - center[j]),
                                               imp_sum_up(box->hi[j] - center[j]));
            entry = imp_interval_add(entry, interval_of(frame->along[i][j]));
            rates->m[i][j] = imp_interval_mag(entry);
            speed = imp_interval_add(speed, imp_interval_mul(slope, w));
        }
        rates->m[i][3] = imp_round_up(imp_interval_mag(speed) * angle.rate[2]);
        size += rates->m[i][3];
    }
    return size < INFINITY ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

/* --- Centres ---------------------------------------------------------------------------------- */

/* w = (x,y,z) - center, and back. */
void axis_from_center(const double center[3], imp_model x, imp_model y, imp_model z, imp_model w[3])
{
    w[0] = imp_shift(x, -center[0]);
    w[1] = imp_shift(y, -center[1]);
    w[2] = imp_shift(z, -center[2]);
}

void axis_add_center(const double center[3], imp_model out[3])
{
    for (int i = 0; i < 3; ++i) out[i] = imp_shift(out[i], center[i]);
}

/* --- A range along an axis -------------------------------------------------------------------- */

#define RANGE_MIN 1e-100

imp_status axis_check_range(int row, const double range[2], imp_create_error *why)
{
    if (range[1] - range[0] >= RANGE_MIN) return IMP_STATUS_OK;
    return imp_reject(
        why, row, -1,
        "[%g,%g] is no range; the second number must be greater than the first, by %g "
        "at least",
        range[0], range[1], RANGE_MIN);
}

imp_model axis_clamp(imp_model x, double lo, double hi)
{
    return imp_min(imp_max(x, imp_num(lo)), imp_num(hi));
}
