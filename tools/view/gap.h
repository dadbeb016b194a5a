/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_GAP_H
#define TOOLS_VIEW_GAP_H

#include <impinge/impinge.h>

#include "tools/view/stage.h"

/* The distance between bodies over time, as proved brackets: in slice k, from t[k] to t[k + 1], the
 * least distance is not below lower[k] (proved) and not above upper[k] (evaluated at two
 * points). */
typedef struct gap_profile {
    double *t; /* count + 1 */
    double *lower, *upper;
    size_t count;
} gap_profile;

/* Measures the distance over the times of `options`, in `count` equal slices; each bracket is at
 * most a fraction `width` of its upper end wide, unless the distance is below gamma, or a budget
 * ends or a signal comes: then the rest is as wide as it was. Without anything to be near to, all
 * is infinite. Free in any case.
 */
imp_code gap_measure(imp_scene *scene, const imp_options *options, size_t count, double width,
                     gap_profile *gap, imp_error *error);

/* At single moments: lower[k] and upper[k] are those of time t[k]; t has no number more. Free in
 * any case. */
imp_code gap_at_moments(imp_scene *scene, const imp_options *options, allowance *l, const double *t,
                        size_t count, gap_profile *gap, imp_error *error);
void gap_free(gap_profile *gap);

#endif
