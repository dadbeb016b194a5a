/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_PRISM_H
#define PLUGINS_COMMON_PRISM_H

#include "plugins/common/facet.h"

/* One segment of a polygon in the plane z = 0 that is moved along a vector: a parallelogram, and at
 * either end a triangle. */

enum { PRISM_SIDE, PRISM_LOWER, PRISM_UPPER, PRISM_PARTS };

typedef struct prism {
    facet face;          /* first member, as in facet.h */
    double corner[3][3]; /* p, q, and the vector or the center: prism_write */
    int part;
} prism;

/* Makes one of the parts, of the segment p q; the center of the ends is not read for a side. In all
 * f_u x f_v points outward where the polygon runs counter-clockwise. Numbers are within LINEAR_FAR
 * / 10. */
void prism_make(prism *s, int part, const double p[2], const double q[2], const double center[2],
                const double vector[3]);

/* The point of the plane, plus the vector unless that is NULL, rounded to doubles. */
void prism_place(double to[3], const double at[2], const double *vector);

/* Prints the whole formula, of exact numbers. */
void prism_write(const prism *s, const imp_text_sink *to);

#endif
