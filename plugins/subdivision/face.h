/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_FACE_H
#define PLUGINS_SUBDIVISION_FACE_H

#include "plugins/subdivision/corner.h"

/* The surface over one face of a control mesh
 * ===========================================
 * Of a quad of Catmull and Clark's, u and v are in [0, 1]; (0,0) is the corner that may be
 * extraordinary. A regular quad is a bicubic patch. An extraordinary corner is surrounded by rings:
 * what is left of the quad at level k, the square of side h = 2^-k, is but for its last quarter
 * three bicubic patches of side h / 2, whose control points k + 1 steps give (corner.h). A region
 * inside one of them has its bounds; one that reaches into several, a quadratic for all
 * (plugins/patch/pieces.h); and after some levels more, the corner's square lies within its control
 * points, which approach the limit point like lambda^k, lambda from 0.41 to 0.66.
 *
 * The rings end at a depth where the control points are within 2^-50 of the quad's size of the
 * limit. In that last square the surface is replaced by straight lines from its border to the limit
 * point, which lie in the same box as the surface itself, so that all bounds hold for both; rates
 * are thus bounded, which they are not at corners of five and more faces.
 *
 * A triangle of Loop's with the corners A B C has barycentric coordinates 1 - u, u (1 - v), u v, as
 * other triangles have; A may be extraordinary. So the edge u = 0 is that corner, halving u leads
 * toward it, and what is left at level k, u <= h, is but for its half nearer to A a ring of three
 * quartic patches, which meet in curves (box_patch.h). lambda is from 0.25 to 0.625. */

enum { FACE_DEPTH_MAX = 100 };

/* Bounds for the whole of a face with an extraordinary corner. */
typedef struct face_gauge {
    double rate[2][3],
        rate_motion[2][3]; /* at least |df/du|, |df/dv| at t = 0, and of its velocity */
    int depth;             /* of the last square, or triangle */
} face_gauge;

typedef struct face {
    const control_mesh *mesh;
    const face_gauge *gauge; /* NULL: it is regular */
    uint32_t start;          /* half-edge that begins at the corner (0,0) */
} face;

/* Fills the gauge of a face; its corner (0,0) is extraordinary. */
void face_measure(const face *q, face_gauge *gauge);

/* Implement the callbacks of imp_surface_type; `self` is a face. */
imp_status face_eval(const void *self, size_t n, const double *p, double *x, double *error);
imp_status face_include(const face *q, const imp_region *region, imp_model model[3]);
imp_status face_net(const face *q, const imp_region *region, imp_net *net);
imp_status face_write(const face *q, const imp_text_sink *to);

#endif
