/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SEPARATION_H
#define CORE_SEPARATION_H

#include "relative.h"

/* When can two nodes be near?
 * ===========================
 * Times in a window at which no axis shows the two inclusions apart. Outside the window that
 * is left, the nodes' points are farther than `clearance` from each other: proved, rounding
 * included. A NaN or an infinity anywhere leaves the window as it is. */

/* Shrinks `window`, which lies in both nodes' times; false: nothing of it is left. `axis` is as for
 * axes_cut. */
bool separation_by_models(const node *a, const node *b, double clearance, time_window *window,
                          vec3 *axis);

/* The paper's test: bounding boxes over the whole of the nodes' times (eqs. 20-22), or balls
 * (section 3.2), farther apart than `clearance`. */
bool separation_of_boxes(const node *a, const node *b, double clearance);
bool separation_of_balls(const node *a, const node *b, double clearance);

/* Length of the longest way from a point of one to a point of the other, about; the paper's
 * termination (eq. 6) compares it with gamma. */
double separation_farthest_of_boxes(const node *a, const node *b);
double separation_farthest_of_balls(const node *a, const node *b);

/* Squared distance of the polynomials' centres at time t; for the order of the heap only. */
double separation_centres(const node *a, const node *b, double t);

#endif
