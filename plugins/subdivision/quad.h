/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_QUAD_H
#define PLUGINS_SUBDIVISION_QUAD_H

#include "plugins/subdivision/corner.h"

/* The surface over one quad of a control mesh
 * ===========================================
 * u and v are in [0, 1]; (0,0) is the corner that may be extraordinary. A regular quad is a bicubic patch.
 * An extraordinary corner is surrounded by rings: what is left of the quad at level k, the square of side
 * h = 2^-k, is but for its last quarter three bicubic patches of side h / 2, whose control points k + 1
 * steps give (corner.h). A region inside one of them has its bounds; one that reaches into several, a
 * quadratic for all (plugins/patch/pieces.h); and after some levels more, the corner's square lies within
 * its control points, which approach the limit point like lambda^k, lambda from 0.41 to 0.66.
 *
 * The rings end at a depth where the control points are within 2^-50 of the quad's size of the limit. In
 * that last square the surface is replaced by straight lines from its border to the limit point, which
 * lie in the same box as the surface itself, so that all bounds hold for both; rates are thus bounded,
 * which they are not at corners of five and more faces. */

enum { QUAD_DEPTH_MAX = 100 };

/* Of a quad with an extraordinary corner, for all of it. */
typedef struct quad_gauge {
    double rate[2][3], rate_motion[2][3]; /* at least |df/du|, |df/dv| at t = 0, and of its velocity */
    int depth;                            /* of the last square */
} quad_gauge;

typedef struct quad {
    const control_mesh *mesh;
    const quad_gauge *gauge; /* NULL: it is regular */
    uint32_t start;          /* half-edge that begins at the corner (0,0) */
} quad;

/* Fills the gauge of a quad; its corner (0,0) is extraordinary. */
void quad_measure(const quad *q, quad_gauge *gauge);

/* As imp_surface_type's; `self` is a quad. */
imp_status quad_eval(const void *self, size_t n, const double *p, double *x, double *error);
imp_status quad_include(const quad *q, const imp_region *region, imp_model model[3]);
imp_status quad_net(const quad *q, const imp_region *region, imp_net *net);

#endif
