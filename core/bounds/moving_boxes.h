/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_MOVING_BOXES_H
#define CORE_BOUNDS_MOVING_BOXES_H

#include "core/bounds/difference.h"

/* Cuts the window by boxes around the nodes that move linearly, for a tenth of the work of
 * separation_window. Shrinks `window`, which lies in both nodes' times, to the times in which these
 * may be within the gamma_clear; false: nothing of it is left. A NaN leaves it as it is. */
bool moving_boxes_cut(const node *a, const node *b, double gamma_clear, time_window *window);

#endif
