/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_RASTER_H
#define TOOLS_VIEW_RASTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tools/cli/vec.h"

/* A z-buffer
 * ==========
 * Pixels are kept RASTER_FINE times finer in both directions than they are written, and averaged in
 * the end, which smooths edges. All coordinates here are those of the written picture, y downward;
 * the centre of its first pixel is (0.5, 0.5).
 *
 * Shapes that hide something can be drawn into a veil: a second buffer that is blended over the
 * picture when the veil ends. */

enum { RASTER_FINE = 3 };

typedef struct colour {
    float r, g, b; /* 0 to 1, as shown */
} colour;

/* Drawing is clipped to the window. */
typedef struct raster_window {
    double x, y, width, height;
} raster_window;

/* Fine pixels. */
typedef struct raster_layer {
    uint8_t *rgb;
    float *depth; /* greater is nearer; -INFINITY: nothing there */
} raster_layer;

typedef struct raster {
    size_t width, height;     /* of the written picture */
    raster_layer front, veil; /* front: the picture; veil: NULLs until there is one */
    double veil_depth;        /* shapes nearer than this are drawn into the veil; INFINITY: none */
    raster_window window;     /* all of it, until the caller sets it */
} raster;

/* Bytes that raster_begin takes, and as many again with a veil. */
size_t raster_bytes(double width, double height);

/* False: no memory. */
bool raster_begin(raster *r, size_t width, size_t height, colour background);
void raster_free(raster *r);

/* From now on, shapes nearer than `depth` are drawn into a veil; INFINITY: none. False: no
 * memory. */
bool raster_veil(raster *r, double depth);

/* Lays the veil over the window, and clears it. */
void raster_veil_end(raster *r);

/* A corner of a triangle: x, y, depth; the normal in camera coordinates (right, up, toward). */
typedef struct raster_corner {
    vec at, normal;
} raster_corner;

/* Draws a triangle, lit from the upper left on either side; without a normal, in the plain
 * colour. */
void raster_triangle(raster *r, const raster_corner corner[3], colour c);

/* Draws a line `width` wide that nearer shapes hide; without `hidden` it is drawn over
 * everything. */
void raster_line(raster *r, vec from, vec to, double width, colour c, bool hidden);

/* Draws a convex shape of n points x, y over everything. */
void raster_flat(raster *r, const double *xy, size_t n, colour c);

/* Returns the depth at a point of the window; -INFINITY outside. */
double raster_depth(const raster *r, double x, double y);

/* Writes one row of the picture: 3 width bytes. */
void raster_row(const raster *r, size_t y, uint8_t *rgb);

#endif
