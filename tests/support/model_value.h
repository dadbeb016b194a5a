/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MODEL_VALUE_H
#define TESTS_SUPPORT_MODEL_VALUE_H

#include <impinge/surface.h>

/* The quadratic of a model at s, without its remainder. */
static inline double quadratic_at(const imp_model *g, const double s[3])
{
    double x = g->a;
    for (int j = 0; j < 3; ++j) x += g->b[j] * s[j];
    for (int j = 0, k = 0; j < 3; ++j)
        for (int l = j; l < 3; ++l, ++k) x += g->q[k] * s[j] * s[l];
    return x;
}

#endif
