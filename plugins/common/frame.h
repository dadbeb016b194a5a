/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_FRAME_H
#define PLUGINS_COMMON_FRAME_H

#include "plugins/common/axis.h"

#include <impinge/formula_text.h>

/* Three unit vectors a, b, k = a x b, perpendicular to each other, as constants with error bounds:
 * the frame of a surface about an axis along k. Exact for an axis along x, y or z. */

typedef struct frame {
    near_constant a[3], b[3], k[3];
} frame;

/* k is along the axis, whose components are constants, one of them AXIS_MIN at least in size. */
frame frame_about(const imp_model axis[3]);

/* Prints definitions of the vectors as a0 ... a2, b0 ... b2 and k0 ... k2, from those of an axis,
 * w0 ... w2, which are defined before. */
void frame_write(const frame *f, const imp_text_sink *to);

/* r (a cos u + b sin u), where r may be any model. */
void frame_ring(const frame *f, imp_model r, imp_model u, imp_model out[3]);

/* Squares of the distance of m from the axis through 0: (a.m)^2 + (b.m)^2. */
imp_model frame_across_squared(const frame *f, const imp_model m[3]);

#endif
