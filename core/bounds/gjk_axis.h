/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_GJK_AXIS_H
#define CORE_BOUNDS_GJK_AXIS_H

#include "core/bounds/difference.h"

/* The separating axis along which two nodes are farthest apart: GJK
 * =================================================================
 * At one moment of the window, B - A and the box of its slack fill a set, whose convex hull is
 * searched (gjk.h). fixed_axes.h proves what the axis shows. */

/* Turns `axis`, which may be any direction but 0, to the separating axis of the moment w. False:
 * the hulls meet then, so that no axis shows a gap; `axis` is as it was. */
bool gjk_axis(const difference *r, double w, vec3 *axis);

#endif
