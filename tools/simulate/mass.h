/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_MASS_H
#define TOOLS_SIMULATE_MASS_H

#include <impinge/impinge.h>

#include "tools/simulate/rigid.h"

/* Mass properties of what a closed surface encloses, of uniform density
 * =====================================================================
 * By the divergence theorem, with n dA the outward element of area:
 *
 *   V = 1/3 I(x.n),  V c_i = 1/2 I(x_i^2 n_i),  V <x_i^2> = 1/3 I(x_i^3 n_i),
 *   V <x_i x_j> = 1/2 I(x_i^2 x_j n_i)
 *
 * over all surfaces of a body. Each is taken as a polyhedron with corners on a grid of its
 * parameters, whose integrals are exact up to rounding; three grids, each twice as fine, are
 * extrapolated to step 0 (Richardson, errors in even powers of the step). The error reported is
 * what the last extrapolation changed, relative to the body's size.
 *
 * Closed: every edge of every surface's parameters must be a single point, or run along other edges
 * of the body (an edge of a full turn along the opposite one). Distances are compared with 1e-6 of the
 * body's size. Orientation: all surfaces of a closed body must have their normals outward, or all
 * inward; then the vector area I(n) is 0, and the volumes by I(x n_x), I(y n_y) and I(z n_z) agree.
 * The sign of the volume says which it is. */

typedef struct mass_properties {
    double volume; /* length^3, > 0 */
    vec center;    /* of mass, in the scene's coordinates at that time */
    mat3 inertia;  /* about the center, for the mass 1: length^2 */
    double error;  /* estimated, difference */
} mass_properties;

typedef enum mass_verdict {
    MASS_FOUND,
    MASS_OPEN,      /* an edge borders on nothing: it is at `where` */
    MASS_DISORDER,  /* normals of its surfaces, or within one, do not all point outward or inward */
    MASS_UNBOUNDED, /* a domain is infinite, or a point is not defined */
    MASS_TOO_MANY,  /* more than MASS_SURFACES_MAX surfaces */
    MASS_NO_MEMORY,
    MASS_FAULT /* of a plugin: *why */
} mass_verdict;

#define MASS_SURFACES_MAX 256u

mass_verdict mass_integrate(const imp_scene *scene, size_t body, double t, mass_properties *out,
                            vec *where, imp_error *why);

#endif
