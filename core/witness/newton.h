/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_NEWTON_H
#define CORE_WITNESS_NEWTON_H

#include <stdbool.h>

#include "core/tree/vec.h"

/* Damped Newton steps within bounds
 * =================================
 * They minimise the distance of two points; the four unknowns are u and v on both surfaces. */

enum { NEWTON_UNKNOWNS = 4 };

typedef struct newton_bounds {
    double lo[NEWTON_UNKNOWNS], hi[NEWTON_UNKNOWNS];
} newton_bounds;

/* Computes gradient and Hessian of |D|^2 / 2, D = x_b - x_a, from the derivatives of D and
 * second[side], which are D.x'' of a and of b. */
void newton_of_gap(vec3 apart, const vec3 by[NEWTON_UNKNOWNS], const double second[2][2][2],
                   double gradient[NEWTON_UNKNOWNS],
                   double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS]);

/* The state of a descent. From the best point so far, steps with its derivatives and growing
 * damping are tried until one reduces the distance. */
typedef struct newton_way {
    const newton_bounds *bounds;
    double gradient[NEWTON_UNKNOWNS],
        hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS]; /* at the best point */
    double damping; /* relative to the Hessian's largest diagonal element */
    int steps;      /* steps tried */
} newton_way;

newton_way newton_begin(const newton_bounds *bounds);

/* Computes a step from y that stays within the bounds: unknowns that would leave them are fixed
 * there, and the rest is solved again. False: there is no useful step, or too many were tried. */
bool newton_try(newton_way *way, const double *y, double *next);

/* Returns by how much the step would reduce |D|^2 / 2 if that were quadratic. */
double newton_promise(const newton_way *way, const double *y, const double *next);

/* Records whether the step reduced the distance. If it did, the caller sets the derivatives at the
 * new point before the next newton_try. */
void newton_judge(newton_way *way, bool is_better);

#endif
