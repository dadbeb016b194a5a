/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_BALANCE_H
#define TOOLS_SIMULATE_BALANCE_H

#include "tools/simulate/impact.h"

/* The impulses of contacts, each in its cone of friction, that leave bodies with the least kinetic
 * energy
 * ========================================================================================
 * If there are impulses that stop all bodies, it finds them: that is whether contacts can hold what
 * pushes the bodies. The energy is a convex quadratic function of the impulses, with the velocities
 * at the points as its gradient. It is minimized by Nesterov's accelerated projected gradient
 * descent with restarts, which takes some n steps for a stack of n bodies, while sweeps of Gauss
 * and Seidel take n^2.
 *
 * Ends when no point, and no centre of a body that yields, is faster than `enough`, or when nothing
 * comes of it. `bodies` are then as the best impulses leave them. */
void balance_find(impact_body *bodies, size_t body_count, impact_contact *contacts, size_t count,
                  double enough);

#endif
