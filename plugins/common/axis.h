/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_AXIS_H
#define PLUGINS_COMMON_AXIS_H

#include "plugins/common/near.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>
#include <stdbool.h>

/* Axes, and maps that turn, stretch and bend along them
 * =====================================================
 * An axis is given by a vector of any length. Its unit vector k, and the matrices that take w apart
 * and turn it,
 *
 *   along = k k^T,   across = 1 - k k^T,   turned = k x,
 *
 * are constants, made once. An axis along x, y or z keeps them exact. */

#define AXIS_MIN 1e-100
#define AXIS_MAX 1e100

#define ROW_AXIS(NAME, DEFAULT, DOC)                                                               \
    IMP_ROW(NAME, "1", DEFAULT, 0, 1, 3, 0, -AXIS_MAX, AXIS_MAX, DOC)

/* Checks that some component of the axis is at least AXIS_MIN. */
imp_status axis_check(int row, const double axis[3], imp_create_error *why);

/* An angle in time, by a constant rate or by its coefficients (polynomial.h). */
#define ROW_TURNING_RATE(DOC)                                                                      \
    IMP_ROW("rate", "rad/time", NULL, IMP_PARAMETER_OPTIONAL, 0, 0, 0, -INFINITY, INFINITY, DOC)

#define ROW_TURNING_ANGLE                                                                          \
    IMP_ROW_NUMBERS("angle", "rad/time^k", NULL, IMP_PARAMETER_OPTIONAL | IMP_PARAMETER_SCALAR_OK, \
                    "instead: coefficients of t^0, t^1, t^2 ... of the angle")

/* Returns k . w. Terms that are surely 0 are left out. */
imp_model axis_dot(const near_constant k[3], const imp_model w[3]);

/* Returns the unit vector along `axis`, as models of constants. */
void axis_unit(const imp_model axis[3], imp_model unit[3]);

/* Along x, y or z. */
bool axis_is_aligned(const double axis[3]);

/* Returns the unit vector along a given axis, exactly if the axis lies along x, y or z. */
void axis_unit_of(const double axis[3], imp_model unit[3]);

/* a x b. */
void axis_cross(const imp_model a[3], const imp_model b[3], imp_model out[3]);

/* Formulas of maps about an axis with the parameters `axis` and `center`: definitions of its unit
 * vector, k0 ... k2, of (x,y,z) - center as w0 ... w2, and of k . w as d; then the three
 * coordinates, turned by the angle A, which is defined between both. */
#define AXIS_TEXT                                                                                  \
    "l = hypot(axis0, axis1, axis2); k0 = axis0/l; k1 = axis1/l; k2 = axis2/l; "                   \
    "w0 = x - center0; w1 = y - center1; w2 = z - center2; d = k0*w0 + k1*w1 + k2*w2; "
#define AXIS_TURN_TEXT                                                                             \
    "C = cos(A); S = sin(A); center0 + k0*d + C*(w0 - k0*d) + S*(k1*w2 - k2*w1); "                 \
    "center1 + k1*d + C*(w1 - k1*d) + S*(k2*w0 - k0*w2); "                                         \
    "center2 + k2*d + C*(w2 - k2*d) + S*(k0*w1 - k1*w0)"

/* Entries of `turned` are those of the unit vector, and are not kept: large scenes have many
 * frames. */
typedef struct axis_frame {
    near_constant unit[3], along[3][3], across[3][3];
} axis_frame;

/* Makes the constants of an axis that passed axis_check. */
axis_frame axis_frame_of(const double axis[3]);

/* Turns w by an angle. */
void axis_turn(const axis_frame *frame, imp_model angle, const imp_model w[3], imp_model out[3]);

/* The matrix that turns points by one angle, and bounds of what each entry adds to their errors. */
typedef struct axis_point_matrix {
    double entry[3][3], off[3][3]; /* 1 */
} axis_point_matrix;

/* Whether an angle is known so well that the matrix of its middle serves. Its error counts beside 1
 * rad: imp_is_point would refuse each angle that is nearly 0. */
bool axis_is_point(const imp_model *angle);

/* Makes it of an angle that is a point (axis_is_point, or imp_is_point). */
axis_point_matrix axis_matrix_of_points(const axis_frame *frame, const imp_model *angle);

/* Turns a point about the axis through the center, and bounds its errors, at a small part of what
 * the models cost. False: it is not finite. */
bool axis_turn_point(const axis_point_matrix *matrix, const double center[3], const double at[3],
                     double x[3], double error[3]);

/* Makes the matrix that turns by an angle, which depends on one parameter at most. */
void axis_matrix(const axis_frame *frame, imp_model angle, imp_model turn[3][3]);

/* Scales w by a factor across the axis. */
void axis_stretch(const axis_frame *frame, imp_model factor, const imp_model w[3],
                  imp_model out[3]);

/* Returns t over a box, as a model of its third parameter. */
imp_model axis_moment(const imp_box4 *box);

/* Computes rates over a box of a turn by `angle` about the axis through the center, with an advance
 * by angle times the vector `advance`; `angle` is over the times of the box. */
imp_status axis_turn_rates(const axis_frame *frame, const double center[3],
                           const near_constant advance[3], imp_model angle, const imp_box4 *box,
                           imp_map_rates *rates);

/* w = (x,y,z) - center. */
void axis_from_center(const double center[3], imp_model x, imp_model y, imp_model z,
                      imp_model w[3]);

/* Undoes that: out + center. */
void axis_add_center(const double center[3], imp_model out[3]);

#define ROW_RANGE(DEFAULT, DOC)                                                                    \
    IMP_ROW("range", "length", DEFAULT, 0, 1, 2, 0, -AXIS_MAX, AXIS_MAX, DOC)

/* Checks that the second number of a range is greater than the first. */
imp_status axis_check_range(int row, const double range[2], imp_create_error *why);

/* Returns x if it is in the range, else the nearer end. */
imp_model axis_clamp(imp_model x, double lo, double hi);

#endif
