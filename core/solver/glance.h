/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_GLANCE_H
#define CORE_SOLVER_GLANCE_H

#include "core/solver/relative.h"

/* Shrinks `window`, which lies in both nodes' times, to when the boxes around the nodes, which move linearly,
 * may be within the clearance; false: nothing of it is left. As separation_by_models, for a tenth of the work.
 * A NaN leaves it as it is. */
bool separation_at_a_glance(const node *a, const node *b, double clearance, time_window *window);

#endif
