/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_MOVING_BOXES_H
#define CORE_BOUNDS_MOVING_BOXES_H

#include "core/bounds/difference.h"

/* Shrinks `window`, which lies in both nodes' times, to the times at which two boxes around the
 * nodes, which move linearly, are within gamma_clear of each other. False: nothing of it is left. A
 * NaN leaves it unchanged. This takes a tenth of the work of separation_window. */
bool moving_boxes_cut(const node *a, const node *b, double gamma_clear, time_window *window);

#endif
