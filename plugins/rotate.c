/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "near.h"
#include "plugin.h"
#include "polynomial.h"

#include <impinge/formula.h>

/* With the unit vector k = axis / |axis| and w = (x,y,z) - center, a rotation by the angle A is
 *
 *   center + along + cos A across + sin A (k x w),   along = k k^T w, across = (1 - k k^T) w.
 *
 * Its three matrices k k^T, 1 - k k^T and k x are constants, made once. */

enum { AXIS, CENTER, RATE, ANGLE };

#define AXIS_MIN 1e-100
#define AXIS_MAX 1e100

static const imp_parameter parameters[] = {
    [AXIS] = {.name = "axis",
              .unit = "1",
              .doc = "direction of the axis, of any length but 0; right-handed",
              .preset = "[0,0,1]",
              .kind = IMP_NUMBER,
              .rank = 1,
              .extent = {3},
              .min = -AXIS_MAX,
              .max = AXIS_MAX},
    [CENTER] = ROW_VECTOR("center", "length", "[0,0,0]", 0, "a point of the axis"),
    [RATE] = {.name = "rate",
              .unit = "rad/time",
              .doc = "constant angular velocity",
              .kind = IMP_NUMBER,
              .flags = IMP_OPTIONAL,
              .min = -INFINITY,
              .max = INFINITY},
    [ANGLE] = ROW_NUMBERS("angle", "rad/time^k", NULL, IMP_OPTIONAL,
                          "instead: coefficients of t^0, t^1, t^2 ... of the angle"),
};

typedef struct rotate_instance {
    double center[3];
    near_constant along[3][3], across[3][3], turned[3][3];
    polynomial angle;
    double coefficients[];
} rotate_instance;

/* The constants, by model arithmetic on numbers. An axis along x, y or z keeps them exact. */
static void set_axis(rotate_instance *s, const double axis[3])
{
    imp_model a[3], k[3], square, length;
    for (int i = 0; i < 3; ++i) a[i] = imp_num(axis[i]);
    bool aligned = (axis[0] != 0) + (axis[1] != 0) + (axis[2] != 0) == 1;
    square = imp_dot3(a, a);
    length = imp_sqrt(square);
    for (int i = 0; i < 3; ++i)
        k[i] = aligned ? imp_num((axis[i] > 0) - (axis[i] < 0)) : imp_div(a[i], length);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            imp_model both = imp_mul(k[i], k[j]);
            s->along[i][j] = near_of(both);
            s->across[i][j] = near_of(imp_sub(imp_num(i == j), both));
            s->turned[i][j] = near_exact(0);
        }
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, l = (i + 2) % 3;
        s->turned[i][l] = near_of(k[j]);
        s->turned[i][j] = near_of(imp_neg(k[l]));
    }
}

static imp_status check_axis(const double axis[3], imp_complaint *why)
{
    for (int i = 0; i < 3; ++i)
        if (fabs(axis[i]) >= AXIS_MIN) return IMP_OK;
    return complain(why, AXIS, -1,
                    "[%g,%g,%g] has no direction; allowed is any vector but 0 (some component at "
                    "least %g)",
                    axis[0], axis[1], axis[2], AXIS_MIN);
}

static imp_status rotate_create(const imp_value *values, void **self, imp_complaint *why)
{
    imp_status status = check_axis(values[AXIS].number, why);
    if (status == IMP_OK) status = check_one_of(values, RATE, ANGLE, why, parameters);
    if (status != IMP_OK) return status;
    size_t numbers = polynomial_count(&values[RATE], &values[ANGLE]);
    rotate_instance *s = malloc(sizeof *s + numbers * sizeof(double));
    if (!s) return IMP_INTERNAL;
    set_axis(s, values[AXIS].number);
    copy_vector(s->center, &values[CENTER]);
    s->angle = polynomial_read(&values[RATE], &values[ANGLE], 1, s->coefficients);
    *self = s;
    return IMP_OK;
}

static imp_model times(const near_constant row[3], const imp_model w[3])
{
    imp_model sum = imp_num(0);
    for (int j = 0; j < 3; ++j)
        if (row[j].value != 0 || row[j].error != 0) sum = imp_add(sum, near_scale(w[j], row[j]));
    return sum;
}

static void rotate_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                           imp_model out[3])
{
    const rotate_instance *s = self;
    imp_model sine, cosine;
    imp_model w[3] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                      imp_shift(z, -s->center[2])};
    imp_sincos(polynomial_at(&s->angle, 0, t), &sine, &cosine);
    for (int i = 0; i < 3; ++i) {
        imp_model turned =
            imp_add(imp_mul(cosine, times(s->across[i], w)), imp_mul(sine, times(s->turned[i], w)));
        out[i] = imp_shift(imp_add(times(s->along[i], w), turned), s->center[i]);
    }
}
IMP_MAP_FORMULA(rotate_formula)
MAP_AT_ALL_TIMES(rotate)

/* --- Rates --- */

/* The rates of the formula add up the three matrices' shares, and are up to twice too large about
 * an oblique axis. These come from the entries of the rotation R(A) and of R'(A) over the box's
 * angles:
 *
 *   R = k k^T + cos A (1 - k k^T) + sin A k x,   |d/dw_j| <= |R_ij|
 *   R' = cos A k x - sin A (1 - k k^T),          |d/dt| <= |A'| |(R' w)_i| */
static imp_interval interval_of(near_constant k)
{
    return imp_interval_make(imp_sum_down(k.value - k.error), imp_sum_up(k.value + k.error));
}

static imp_interval turned_entry(const rotate_instance *s, int i, int j, imp_interval cosine,
                                 imp_interval sine)
{
    imp_interval across = imp_interval_mul(cosine, interval_of(s->across[i][j]));
    imp_interval turned = imp_interval_mul(sine, interval_of(s->turned[i][j]));
    return imp_interval_add(across, turned);
}

static imp_status rotate_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const rotate_instance *s = self;
    imp_region moment = imp_region_between(box->lo + 1, box->hi + 1); /* of y, z, t */
    imp_model angle = polynomial_at(&s->angle, 0, imp_param(&moment, 2));
    imp_interval turn = imp_interval_make(angle.lo, angle.hi);
    imp_interval cosine = imp_interval_cos(turn), sine = imp_interval_sin(turn);
    double size = 0;
    for (int i = 0; i < 3; ++i) {
        imp_interval speed = imp_interval_make(0, 0);
        for (int j = 0; j < 3; ++j) {
            imp_interval entry = turned_entry(s, i, j, cosine, sine);
            imp_interval slope = turned_entry(s, i, j, imp_interval_neg(sine), cosine);
            imp_interval w = imp_interval_make(imp_sum_down(box->lo[j] - s->center[j]),
                                               imp_sum_up(box->hi[j] - s->center[j]));
            rates->m[i][j] = imp_interval_mag(imp_interval_add(entry, interval_of(s->along[i][j])));
            speed = imp_interval_add(speed, imp_interval_mul(slope, w));
        }
        rates->m[i][3] = imp_round_up(imp_interval_mag(speed) * angle.rate[2]);
        size += rates->m[i][3];
    }
    return size < INFINITY ? IMP_OK : IMP_UNBOUNDED;
}

static const imp_map_type rotate = {
    MAP_CALLS(rotate, rotate_formula),
    .rate = rotate_rate,
    .summary = "turns about an axis, at a constant rate or by a polynomial angle",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, A = rate t or sum_k angle_k t^k: center + "
                "k (k.w) + cos A (w - k (k.w)) + sin A (k x w)",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, appendix B.5",
    .example = "rotate axis=0,0,1 rate=2",
};

PUBLISH_MAP(rotate);
