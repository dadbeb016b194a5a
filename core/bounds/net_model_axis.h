/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_MODEL_AXIS_H
#define CORE_BOUNDS_NET_MODEL_AXIS_H

#include "core/bounds/difference.h"

/* Separating axes of a control net and a Taylor model
 * ===================================================
 * One of the two nodes has a net, the other, whose surface is of another kind or turns, none: the
 * hull of the one against the quadratic of the other. Both nodes are bounded. As net_axis.h
 * otherwise. */

bool net_model_axis_seek(const node *a, const node *b, double t, vec3 *axis);

bool net_model_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear,
                        time_window *window);

#endif
