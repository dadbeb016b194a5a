/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_CLEARANCE_COST_H
#define TOOLS_CHECK_CLEARANCE_COST_H

#include "tools/check/subject.h"

/* How good a surface's bounds are for a solver
 * ============================================
 * The number of pairs of a region and a plane that are tested until it is proved that surface and
 * plane do not touch at any time. The plane is perpendicular to an axis, at a small distance from
 * the surface; regions with loose bounds are halved repeatedly. The mean over six planes, one on
 * each side; `gap` is their distance in sizes of the surface. NAN: more than REACH_MOST for one of
 * them, or no bounds. */

#define REACH_MOST 4000

double reach_pairs(const subject *s, double gap);

#endif
