/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_NEWTON_H
#define CORE_SOLVER_NEWTON_H

#include <stdbool.h>

#include "core/tree/vec.h"

/* Damped Newton steps downhill, within bounds
 * ===========================================
 * In four unknowns, u and v of two surfaces. */

enum { NEWTON_UNKNOWNS = 4 };

typedef struct newton_bounds {
    double lo[NEWTON_UNKNOWNS], hi[NEWTON_UNKNOWNS];
} newton_bounds;

/* Of the largest diagonal element of the Hessian: to begin with, and where it is no use to go on; then what a
 * step that leads downhill, or does not, changes it by. */
#define NEWTON_DAMPING 0x1p-20
#define NEWTON_DAMPING_MAX 0x1p10
#define NEWTON_DAMPING_LESS 0x1p-6
#define NEWTON_DAMPING_MORE 0x1p5

/* Gradient and Hessian of |D|^2 / 2, D = x_b - x_a, from its derivatives and second[side], which are
 * D.x'' of a and of b. */
void newton_of_gap(vec3 apart, const vec3 by[NEWTON_UNKNOWNS], const double second[2][2][2],
                   double gradient[NEWTON_UNKNOWNS],
                   double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS]);

double newton_scale(double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS]);

/* A damped step from y that stays within the bounds: unknowns that would leave are held there and
 * the rest solved again. False: there is none, or it overflows. */
bool newton_step(const newton_bounds *bounds, const double *y, const double *gradient,
                 double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], double damping, double *next);

#endif
