/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_AXES_H
#define CORE_AXES_H

#include "relative.h"

/* Separation along fixed axes
 * ===========================
 * Four axes at a time in vector lanes: the one that nearest_axis.h finds, and three that the nodes
 * suggest. Any axis proves what it proves: how it was come by decides only how much. */

/* Cuts the share to the w at which no axis shows the nodes apart; false: none is left. `axis` holds
 * the axis that was best for the parents, or 0, and is given the best; no length is meant. */
bool axes_cut(const relative *r, double clearance, share *s, vec3 *axis);

#endif
