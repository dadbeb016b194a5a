/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_POLYGON_H
#define PLUGINS_MESH_POLYGON_H

#include <impinge/plugin.h>

/* How a polygon is covered by triangles
 * =====================================
 * A polygon that is plane (a thousandth of its size off) and convex is covered by the fan from its
 * first corner. Any other is seen along its mean normal (Newell's) and cut by its ears: an ear is
 * a corner whose triangle holds no other corner. Either way the triangles have the polygon as their
 * common boundary. */

/* Corners of a polygon that is cut: the time grows with their square, at worst their cube. */
enum { POLYGON_CUT_MAX = 2048 };

/* Whether a fan from the first corner covers it. The corners are numbers of points x, y, z. */
bool polygon_is_fan(const double *point, const int64_t *corner, size_t count);

/* Cuts a polygon of 4 to POLYGON_CUT_MAX corners into count - 2 triangles, whose corners are
 * numbers from 0 of the polygon's. *is_simple is false where it crosses itself, so that no cut is
 * what is meant. IMP_STATUS_INTERNAL: no memory. */
imp_status polygon_cut(const double *point, const int64_t *corner, size_t count, uint32_t *cut,
                       bool *is_simple);

#endif
