/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_GJK_AXIS_H
#define CORE_BOUNDS_GJK_AXIS_H

#include "core/bounds/difference.h"

/* The axis along which two Taylor models are farthest apart: GJK
 * ==============================================================
 * At one moment of the window, GJK (gjk.h) searches the convex hull of B - A, widened by the box of
 * its slack. fixed_axes.c proves what the axis shows. */

/* Turns `axis`, which may be any direction but 0, to a separating axis at w. False: the hulls
 * intersect at w, so that no axis shows a gap; `axis` is unchanged. */
bool gjk_axis(const difference *r, double w, vec3 *axis);

#endif
