/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_BOX_STENCIL_H
#define PLUGINS_PATCH_BOX_STENCIL_H

#include "plugins/patch/box_patch.h"

/* 24 times the control points of the triangle as one of Bezier, of degree 4, in the order of
 * triangle.h. */

enum { BOX_BEZIER = (BOX_DEGREE + 1) * (BOX_DEGREE + 2) / 2 };

extern const signed char box_stencil[BOX_BEZIER][BOX_POINTS];

#endif
