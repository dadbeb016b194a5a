/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/quaternion.h"

/* --- Keys ------------------------------------------------------------------------------------- */

static double quaternion_dot(const double *p, const double *q)
{
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

imp_status quaternion_keys_check(int row, const imp_value *rotations, imp_create_error *why)
{
    for (size_t i = 1; i < rotations->count / 4; ++i) {
        const double *q = rotations->number + 4 * i, cosine = fabs(quaternion_dot(q - 4, q));
        if (!(cosine >= QUATERNION_NEAR_MIN))
            return imp_reject(why, row, (int64_t)i,
                              "turned by %.0f degrees from the key before; must be at most 170, or "
                              "the direction of rotation is ambiguous: add a key between them",
                              acos(imp_smaller(cosine, 1)) * 360 / IMP_PI_LOWER);
    }
    return IMP_STATUS_OK;
}

void quaternion_keys_set(const imp_value *rotations, size_t lanes, imp_interval *key)
{
    double sign = 1;
    for (size_t i = 0; i < rotations->extent[0]; ++i, key += lanes) {
        const double *q = rotations->number + 4 * i;
        imp_interval square = imp_interval_make(0, 0);
        if (i > 0 && quaternion_dot(q - 4, q) < 0) sign = -sign;
        for (int j = 0; j < 4; ++j)
            square = imp_interval_add(square, imp_interval_sqr(imp_interval_make(q[j], q[j])));
        for (int j = 0; j < 4; ++j)
            key[j] = imp_interval_div(imp_interval_make(sign * q[j], sign * q[j]),
                                      imp_interval_sqrt(square));
    }
}

/* --- Rotations -------------------------------------------------------------------------------- */

/* An entry of R: within [-1, 1]. Its rate is at most the angular speed, as a column of R moves
 * like a point at distance 1. */
static imp_model entry(imp_model r, const imp_model *t, double speed)
{
    for (int j = 0; j < 3; ++j)
        if (r.depends >> j & 1)
            r.rate[j] = imp_smaller(r.rate[j], imp_round_up(speed * t->rate[j]));
    return imp_model_within(r, imp_interval_make(-1, 1));
}

/* R = 1 + 2 (w [v] + [v]^2) / |q|^2; [v]^2 = v v^T - v^T v. */
void quaternion_matrix(const imp_model q[4], imp_interval square_range, const imp_model *t,
                       double speed, imp_model r[3][3])
{
    const imp_model w = q[0], *v = q + 1;
    imp_model square[3];
    for (int i = 0; i < 3; ++i) square[i] = imp_sqr(v[i]);
    imp_model sum = imp_add(imp_add(imp_sqr(w), square[0]), imp_add(square[1], square[2]));
    imp_model twice = imp_div(imp_num(2), imp_model_within(sum, square_range));
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        imp_model both = imp_mul(v[i], v[j]), turn = imp_mul(w, v[k]);
        imp_model lost = imp_mul(imp_add(square[j], square[k]), twice);
        r[i][i] = entry(imp_sub(imp_num(1), lost), t, speed);
        r[i][j] = entry(imp_mul(imp_sub(both, turn), twice), t, speed);
        r[j][i] = entry(imp_mul(imp_add(both, turn), twice), t, speed);
    }
}

/* R x is as long as x. */
void quaternion_turn(imp_model r[3][3], const imp_model x[3], imp_model out[3])
{
    imp_interval square = imp_interval_make(0, 0);
    for (int i = 0; i < 3; ++i)
        square = imp_interval_add(square, imp_interval_sqr(imp_interval_make(x[i].lo, x[i].hi)));
    double most = imp_interval_sqrt(square).hi;
    for (int i = 0; i < 3; ++i)
        out[i] = imp_model_within(imp_dot3(r[i], x), imp_interval_make(-most, most));
}
