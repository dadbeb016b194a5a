/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_DISTANCE_HALVING_H
#define CORE_BOUNDS_DISTANCE_HALVING_H

#include "core/bounds/distance.h"

/* Whether to split a node alone that a distance does not separate
 * ===============================================================
 * This chooses only what to split. */

/* What a distance shows over a window that it leaves. */
typedef struct halving_signs {
    const imp_model *point; /* three: the points whose distance is */
    const imp_model *g;
    double least[2]; /* of the polynomials of g and of -g; length */
    double size;     /* of g's coefficients; length */
    double limit;    /* that |g| is to exceed: gamma_clear, and a ball's radius; length */
} halving_signs;

/* Sets view->is_promising, and adds to view->bend what the distance bends in time beyond its
 * points. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code distance_judge_halving(const distance_question *q, const halving_signs *of,
                                distance_view *view, imp_error *error);

#endif
