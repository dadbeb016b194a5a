/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_MOTIONS_H
#define TOOLS_CHECK_MOTIONS_H

#include <impinge/surface.h>

#include "tools/check/subject.h"

/* Motions of a symmetry: a turn about a line through the center, then a shift. */
typedef struct motion {
    double center[3], axis[3]; /* axis: unit but for rounding */
    double angle;              /* radians */
    double shift[3];           /* length */
} motion;

/* Some motion that a symmetry has, whose shift is of any size up to 2^20 times `size`. */
motion motion_draw(uint64_t *random, const imp_symmetry *of, double size);

/* x is moved, and by less than 2^-49 of the sizes of x, center and shift besides. */
void motion_apply(const motion *m, double x[3]);

/* "turning by 1.2 rad about ...". */
subject_text motion_text(const motion *m);

#endif
