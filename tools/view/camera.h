/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_CAMERA_H
#define TOOLS_VIEW_CAMERA_H

#include "tools/cli/vec.h"

/* A parallel projection: it preserves the scale, so an error in the world is the same length on the
 * picture. */

typedef struct camera {
    vec right, up, toward; /* unit, perpendicular to each other; `toward` points to the viewer */
    vec target;            /* the point that is projected to `middle` */
    double scale;          /* pixels per length */
    double middle[2];      /* pixels, y downward */
} camera;

/* Returns pixels, y downward; the third number is the depth, greater is nearer, in pixels too. */
static inline vec camera_see(const camera *c, vec p)
{
    const vec d = vec_sub(p, c->target);
    return (vec){{c->middle[0] + c->scale * vec_dot(d, c->right),
                  c->middle[1] - c->scale * vec_dot(d, c->up), c->scale * vec_dot(d, c->toward)}};
}

/* Returns a camera that looks from this azimuth (from +x toward +y) and elevation (above the xy
 * plane), in degrees, at the origin, which is at pixel 0,0; one pixel is one unit of length. */
static inline camera camera_toward(double azimuth, double elevation)
{
    const double a = azimuth * (3.14159265358979323846 / 180);
    const double e = elevation * (3.14159265358979323846 / 180);
    return (camera){.right = {{-sin(a), cos(a), 0}},
                    .up = {{-sin(e) * cos(a), -sin(e) * sin(a), cos(e)}},
                    .toward = {{cos(e) * cos(a), cos(e) * sin(a), sin(e)}},
                    .scale = 1};
}

#endif
