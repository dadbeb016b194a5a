/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_FIXED_AXES_H
#define CORE_BOUNDS_FIXED_AXES_H

#include "core/bounds/gap_lines.h"

/* Separating axes that stay fixed over the window
 * ===============================================
 * Four axes at a time in vector lanes: the one that gjk_axis.h finds, and three that the nodes
 * suggest. What an axis proves does not depend on how it was found. */

/* Cuts the range of w to the w at which no axis proves the nodes farther apart than gamma_clear.
 * False: none is left. `axis` holds the axis that was best for the parents, or 0; it becomes the
 * best axis at the focus, of any length, or 0 if none separates the nodes there. The lower bounds
 * of the distance that the axes prove are added to `lines`, unless NULL. */
bool fixed_axes_cut(const difference *r, double gamma_clear, w_range *s, vec3 *axis,
                    gap_lines *lines);

/* Like fixed_axes_cut, but without a search: cuts along `axis`, both normals and the line of
 * centres. */
bool fixed_axes_cut_along(const difference *r, double gamma_clear, w_range *s, vec3 axis);

#endif
