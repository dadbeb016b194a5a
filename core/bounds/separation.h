/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_SEPARATION_H
#define CORE_BOUNDS_SEPARATION_H

#include "core/bounds/difference.h"
#include "core/bounds/trial_rate.h"

/* When can two nodes be near?
 * ===========================
 * Cuts a window to the times at which no separating axis is proved for the two nodes. Outside the
 * window that is left, the nodes' points are farther than `gamma_clear` from each other: proved,
 * rounding included. A NaN or an infinity anywhere leaves the window unchanged. separation.c tries
 * the bounds that strategy.h chooses; fixed_axes.c (Taylor models), net_axis.c (control nets) and
 * normal_field.c (turning axes) prove them. */

/* Shrinks `window`, which lies in both nodes' times. False: nothing of it is left. `axis` is as for
 * fixed_axes_cut. `turning` counts the candidate pair's trials of turning axes (normal_field.h)
 * after fixed axes have cut the start of the window; NULL: always try them. */
bool separation_window(const node *a, const node *b, double gamma_clear, time_window *window,
                       vec3 *axis, trial_rate *turning);

/* Like separation_window, by the quadratics alone. */
bool separation_without_nets(const node *a, const node *b, double gamma_clear, time_window *window,
                             vec3 *axis, trial_rate *turning);

/* Like separation_window, but where both nodes have control nets and the axis is not 0, only the
 * nets are tried, along that axis. `more`: whether separation_window may leave less. */
bool separation_first_look(const node *a, const node *b, double gamma_clear, time_window *window,
                           vec3 *axis, trial_rate *turning, bool *more);

/* Whether one axis separates the nodes over the whole window: along hulls where these can be tried,
 * else along quadratics. */
bool separation_along(const node *a, const node *b, vec3 axis, double gamma_clear,
                      const time_window *window);

/* What is known of how near two nodes come. */
typedef struct approach {
    double lower;  /* bound of the distance; length */
    double moment; /* where in the window it is lowest, about; axes are chosen for it */
} approach;

/* Like separation_window, and also bounds how near the nodes come: at no time of the window as
 * passed is their distance below both `near->lower` and `gamma_clear`. On entry `near->moment` is a
 * guess. */
bool separation_approach(const node *a, const node *b, double gamma_clear, time_window *window,
                         vec3 *axis, approach *near);

/* Returns a lower bound of the distance of the bounding boxes over the whole of the nodes'
 * times. */
double separation_boxes_lower(const node *a, const node *b);

/* The paper's test: whether bounding boxes over the whole of the nodes' times (eqs. 20-22), or
 * balls (section 3.2), are farther apart than `gamma_clear`. */
bool separation_of_boxes(const node *a, const node *b, double gamma_clear);
bool separation_of_balls(const node *a, const node *b, double gamma_clear);

/* Estimates the greatest distance of a point of one node from a point of the other. The paper's
 * termination (eq. 6) compares it with gamma. */
double separation_farthest_of_boxes(const node *a, const node *b);
double separation_farthest_of_balls(const node *a, const node *b);

/* Squared distance of the polynomials' centres at time t; for the order of the heap only. */
double separation_centres(const node *a, const node *b, double t);

#endif
