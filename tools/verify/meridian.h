/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_MERIDIAN_H
#define TOOLS_VERIFY_MERIDIAN_H

#include "tools/verify/round.h"

/* Axes in the half planes that a line bounds
 * ==========================================
 * Where two surfaces that are round about one line become wider and narrower along it, such as a
 * cone in a cone, neither is farther from the line than the other everywhere. What parts them is an
 * axis that turns about the line with the points: weights of the distance from the line and of the
 * height along it. */

/* A side of a cell, by its middle: distance from the line and height, each times |d|; how half the
 * widths of u, v and t change them; and the direction of the normal there, of length 1 or less. */
typedef struct meridian {
    double at[2], way[VARIABLES][2], normal[2];
} meridian;

/* Measures a side from its jets. */
void meridian_measure(const centre *about, const kept *of, meridian *m);

/* Chooses the weights n of distance and height from A to B: those of the distance alone, where they
 * seem to part the sides by `apart`; else those of a normal, or from one middle to the other,
 * if these seem to and both sides are round about the line there. */
void meridian_choose(const meridian side[2], double apart, double n[2]);

#endif
