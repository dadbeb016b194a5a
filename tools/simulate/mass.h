/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_MASS_H
#define TOOLS_SIMULATE_MASS_H

#include "tools/simulate/patches.h"

/* Mass properties of what closed surfaces enclose, of uniform density
 * ===================================================================
 * By the divergence theorem, with n dA the outward element of area:
 *
 *   V = 1/3 I(x.n),  V c_i = 1/2 I(x_i^2 n_i),  V <x_i^2> = 1/3 I(x_i^3 n_i),
 *   V <x_i x_j> = 1/2 I(x_i^2 x_j n_i)
 *
 * over all patches of a body. Each is taken as a polyhedron with corners on a grid of its
 * parameters, whose integrals are exact up to rounding; several grids, each twice as fine, are
 * extrapolated to step 0 (Romberg, errors in even powers of the step). The error reported is what
 * the coarsest grid has changed, relative to the body's size. Grids are refined until it is below
 * MASS_ERROR_GOAL, or as fine as the number of patches allows.
 *
 * The surfaces must be closed (shells.h); the side on which their normals point does not matter,
 * since outside is where the volume of a shell comes out positive. A shell inside an odd number of
 * others is the wall of a cavity. Shells that overlap count twice where they do. */

#define MASS_ERROR_GOAL 1e-9

typedef struct mass_properties {
    double volume; /* length^3, > 0 */
    vec center;    /* of mass, in the scene's coordinates at that time */
    mat3 inertia;  /* about the center, for the mass 1: length^2 */
    double error;  /* estimated, difference */
} mass_properties;

/* *where is set with SHAPE_OPEN and SHAPE_ONE_SIDED, *why with SHAPE_FAULT. */
shape_verdict mass_integrate(const patches *p, mass_properties *out, vec *where, imp_error *why);

#endif
