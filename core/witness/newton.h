/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_NEWTON_H
#define CORE_WITNESS_NEWTON_H

#include <stdbool.h>

#include "core/tree/vec.h"

/* Damped Newton steps downhill, within bounds
 * ===========================================
 * In four unknowns, u and v of two surfaces. */

enum { NEWTON_UNKNOWNS = 4 };

typedef struct newton_bounds {
    double lo[NEWTON_UNKNOWNS], hi[NEWTON_UNKNOWNS];
} newton_bounds;

/* Gradient and Hessian of |D|^2 / 2, D = x_b - x_a, from its derivatives and second[side], which
 * are D.x'' of a and of b. */
void newton_of_gap(vec3 apart, const vec3 by[NEWTON_UNKNOWNS], const double second[2][2][2],
                   double gradient[NEWTON_UNKNOWNS],
                   double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS]);

/* The state of a descent: from each place that is better than the last, steps are tried with its
 * derivatives until one leads to a better place. */
typedef struct newton_way {
    const newton_bounds *bounds;
    double gradient[NEWTON_UNKNOWNS],
        hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS]; /* at the last place */
    double damping;                                /* of the Hessian's largest diagonal element */
    int steps;                                     /* steps tried */
} newton_way;

newton_way newton_begin(const newton_bounds *bounds);

/* A step from y that stays within the bounds: unknowns that would leave them are held there, and
 * the rest is solved again. False: no step is worth it, or too many were tried. */
bool newton_try(newton_way *way, const double *y, double *next);

/* Returns by how much the step would reduce |D|^2 / 2 if that were quadratic. */
double newton_promise(const newton_way *way, const double *y, const double *next);

/* Notes whether the step led to a better place, whose derivatives the caller sets before the next
 * try. */
void newton_judge(newton_way *way, bool is_better);

#endif
