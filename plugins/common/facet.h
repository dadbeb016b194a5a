/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_FACET_H
#define PLUGINS_COMMON_FACET_H

#include "plugins/common/linear.h"

#include <impinge/formula.h>

/* Parallelograms at rest that know how far a point is from their plane. */

typedef struct facet {
    linear surface;             /* first member: linear.h uses the instance as this */
    double normal[3], flatness; /* facet_gap */
} facet;

/* Returns the greatest absolute value of a component. */
double facet_greatest(const double x[3]);

/* The parallelogram origin + u edge_u + v edge_v; the edges are not parallel. */
void facet_span(facet *s, const double origin[3], const double edge_u[3], const double edge_v[3]);

/* A g with |g| at most the distance of the point from the facet (capability distance). */
imp_model facet_gap(const facet *s, imp_model x, imp_model y, imp_model z);

/* Implements imp_surface_type.symmetry. */
imp_status facet_symmetry(const void *self, imp_symmetry *symmetry);

#endif
