/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_CLOSED_H
#define TOOLS_CHECK_CLOSED_H

#include "tools/check/subject.h"

/* That rotations of a symmetry with is_closed take points of the surface to points of it, and screw
 * motions those that they do not take beyond its ends. A claim
 * is refuted by a point that is taken away from the surface: boxes around all parts of the surface,
 * by its own bounds, show that. False: it is refuted. */
bool closed_check(const subject *s, uint64_t *random, const imp_symmetry *of);

/* That points of one orbit, as its flags say, are as far from the center, and for orbits along u or
 * v as high along the axis. False: it is refuted. */
bool orbit_check(const subject *s, uint64_t *random, const imp_symmetry *of);

#endif
