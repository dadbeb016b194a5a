/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_CONVEX_LINE_H
#define CORE_BOUNDS_CONVEX_LINE_H

#include <impinge/surface.h>

/* A line in time below a convex quadratic
 * =======================================
 * The squared distance of points that move uniformly is convex in place and time together. Its
 * tangent plane at the nearest place in the middle of a window loses nothing there, where chords in
 * time lose what the motion bends. */

typedef struct convex_line {
    double low, drift;
} convex_line;

/* Bounds sign * (polynomial of g) over s_u and s_v in [-1, 1] and s_t = middle + reach w: it is at
 * least low + drift w for all w in [-1, 1]. `size` is at least the sum of the sizes of g's
 * coefficients; |middle| + reach is at most 1 but for rounding. */
convex_line convex_line_below(const imp_model *g, double sign, double middle, double reach,
                              double size);

#endif
