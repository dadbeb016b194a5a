/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_GAP_LINES_H
#define CORE_BOUNDS_GAP_LINES_H

#include "core/bounds/difference.h"

/* Lower bounds of the distance of two nodes over a window
 * =======================================================
 * Each separating axis proves a lower bound of the distance that is linear in w (fixed_axes.h,
 * normal_field.h). At every w the greatest of these lines holds: their upper envelope is convex,
 * and its least value over a range of w bounds the distance over that range. */

typedef struct gap_line {
    double low, drift; /* the distance at w is at least low + drift w; length, w in [-1, 1] */
} gap_line;

enum { GAP_LINES = 11 }; /* 0, both sides of four axes, a field of normals, a dividing surface */

typedef struct gap_lines {
    gap_line line[GAP_LINES];
    int count;
} gap_lines;

/* Begins a set of lines with the line 0. */
void gap_lines_begin(gap_lines *lines);

/* `length` times the distance is at least low + drift w, rounding included. Adds nothing where that
 * is never above 0, or NaN. */
void gap_lines_add(gap_lines *lines, double low, double drift, double length);

/* Returns a lower bound of the distance over the range; *w becomes a w near which the envelope is
 * lowest. */
double gap_lines_lower(const gap_lines *lines, w_range range, double *w);

#endif
