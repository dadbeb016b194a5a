/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_REACH_H
#define TOOLS_CHECK_REACH_H

#include "check_subject.h"

/* What a surface's bounds are worth to a solver
 * ==============================================
 * A plane, across one of the axes, just beyond where the surface ends: how many pairs of a region
 * with that plane are tested until it is proved that they do not touch, at any time? Regions whose
 * bounds are loose are halved again and again. Mean over six planes, one on each side; `gap` is
 * their distance in sizes of the surface. NAN: more than REACH_MOST for one of them, or no bounds.
 */

#define REACH_MOST 4000

double reach_pairs(const subject *s, double gap);

#endif
