/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_MODEL_AXIS_H
#define CORE_BOUNDS_NET_MODEL_AXIS_H

#include "core/bounds/difference.h"

/* Separating axes of a control net and a Taylor model
 * ===================================================
 * These functions do what those of net_axis.h do where one node has a net and the other, which may
 * turn or be of another type, has none: the hull of the net is tested against the other's Taylor
 * model. Precondition: both nodes are bounded. */

bool net_model_axis_seek(const node *a, const node *b, double t, vec3 *axis);

bool net_model_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear,
                        time_window *window);

#endif
