/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_DIVIDING_CHOICE_H
#define CORE_BOUNDS_DIVIDING_CHOICE_H

#include "core/bounds/normal_turn.h"
#include "core/bounds/tangent_forms.h"

/* The dividing surface of two nodes
 * =================================
 * Terms of second order along the tangents bend the lines of a parametrization, so that a height of
 * second order over the tangents, seen from the parameters, has terms of third and fourth order. C
 * and Q take these off. They are chosen for tightness: dividing_surface.c proves its bounds for any
 * numbers. */

/* h(p) = slope.p + K(p, p) / 2 + C(p, p, p) / 6 + Q(p, p, p, p) / 24. */
typedef struct dividing {
    double slope[2];
    form k;
    cubic c;
    quartic q;
} dividing;

/* Chooses h for the faces that a field of curvature K follows; `v` are the slices in its frame.
 * False: it follows edges. */
bool dividing_choose(const frame *f, const local_view *v, const form *k, dividing *h);

#endif
