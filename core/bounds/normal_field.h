/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NORMAL_FIELD_H
#define CORE_BOUNDS_NORMAL_FIELD_H

#include "core/bounds/gap_lines.h"

/* Separation along a field of normals
 * ===================================
 * Where two surfaces are nearly tangent, the bound along a fixed axis contains the curvature of
 * both, although only their difference decides whether they touch. So the axis turns with the
 * surfaces, n(s) = n0 - K (y_a + y_b) / 2, where y are tangential coordinates of the two points and
 * K is the mean of the two curvatures, and with time as the mean of the two normals does. Then n.(B
 * - A) is the sum of one quadratic for each surface, in which only the difference of the curvatures
 * is left, up to terms of third order. Near contact, nodes and windows need to be as small as the
 * cube root of the gap instead of its square root.
 *
 * An edge or a corner on a face, and two edges that cross, are alike: a hollow face meets a fixed
 * axis with its curvature, two edges that bend towards each other with both. There K is that of the
 * face, or of each edge along itself (normal_turn.h). */

/* Cuts the range of w to the w at which the nodes are not proved farther apart than gamma_clear, by
 * the field or by a dividing surface (dividing_surface.h), which is tried instead of it or after it
 * where terms of third order hide the gap. False: none is left. `axis` is as for
 * normal_frame_between. The lower bounds of the distance that are proved are added to `lines`,
 * unless NULL. */
bool normal_field_cut(const difference *r, vec3 axis, double gamma_clear, w_range *s,
                      gap_lines *lines);

#endif
