/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef IMPINGE_BASELINE_H
#define IMPINGE_BASELINE_H

#include <impinge/impinge.h>

/* Baseline: the algorithm of 1990 ("the paper", <impinge/surface.h>), to compare with
 * ======================================================================================
 * imp_options.baseline is one of the first three, and of the others at most one may be added. */
enum {
    IMP_BASELINE_NONE = 0,          /* the default method: order-2 inclusions, windows in time */
    IMP_BASELINE_BOXES = 1,         /* the paper's, with bounding boxes */
    IMP_BASELINE_SPHERES = 2,       /* the paper's, with bounding spheres */
    IMP_BASELINE_COLUMN_RATES = 4,  /* for u, v and t each one rate: the norm of its column */
    IMP_BASELINE_CONSTANT_RATES = 8 /* one rate: the Frobenius norm of the matrix */
};

#endif /* IMPINGE_BASELINE_H */
