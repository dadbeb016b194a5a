/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_GLANCE_H
#define CORE_SOLVER_GLANCE_H

#include "core/solver/relative.h"

/* As separation_by_models, by boxes around the nodes that move linearly, for a tenth of the work.
 * Shrinks `window`, which lies in both nodes' times, to the times in which these may be within the
 * clearance; false: nothing of it is left. A NaN leaves it as it is. */
bool separation_at_a_glance(const node *a, const node *b, double clearance, time_window *window);

#endif
