/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SHAPE_ORACLE_H
#define TESTS_SUPPORT_SHAPE_ORACLE_H

#include "tests/support/type_oracle.h"

/* The catalogue's surfaces once more, in numbers of 200 bits: each by its textbook definition, not
 * by the way its plugin takes. Rows of the table in type_oracle.c. */

typedef void surface_oracle(const type_arguments *arguments, const number p[3], number x[3]);

surface_oracle ellipsoid_oracle;
surface_oracle cylinder_oracle;
surface_oracle cone_oracle;
surface_oracle disc_oracle;
surface_oracle box_oracle;     /* its first piece */
surface_oracle capsule_oracle; /* its first piece */
surface_oracle thread_oracle;
surface_oracle plane_oracle;
surface_oracle point_oracle;
surface_oracle segment_oracle;
surface_oracle triangle_oracle;
surface_oracle mesh_oracle;            /* the first three corners of the first face */
surface_oracle bezier_triangle_oracle; /* the first face, if there are faces */
surface_oracle subdivision_oracle;     /* its first piece */
surface_oracle loop_oracle;            /* the same of Loop's scheme */
surface_oracle ripple_oracle;
surface_oracle superellipsoid_oracle;
surface_oracle supertoroid_oracle;
surface_oracle revolution_oracle;
surface_oracle sweep_oracle;
surface_oracle product_oracle;
surface_oracle nurbs_oracle;
surface_oracle extrusion_oracle; /* its first piece */

/* What the control points along one parameter weigh. */
typedef struct weighting {
    number of[64];
    size_t count;
} weighting;

/* The point of a patch of control points, "points" by u then v, with "weights" and "velocities". */
void patch_oracle(const type_arguments *arguments, const weighting along[2], number t, number x[3]);

#endif
