/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_AXES_H
#define CORE_AXES_H

#include "relative.h"

/* Separation along fixed axes
 * ===========================
 * Eight axes, four at a time in vector lanes: three that the nodes suggest and the one that served
 * their parents best; then four on the way uphill from the best of these. Any axis proves what it
 * proves: how it was come by decides only how much. */

/* Cuts the share to the w at which no axis shows the nodes apart; false: none is left. `axis` holds
 * a direction that may serve, or 0, and is given the one that served best; no length is meant. */
bool axes_cut(const relative *r, double clearance, share *s, vec3 *axis);

#endif
