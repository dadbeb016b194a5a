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
 * the end: that is what smooths edges. All coordinates here are those of the written picture, y
 * downward; the centre of its first pixel is (0.5, 0.5).
 *
 * What hides something can be drawn into a veil: a second buffer that is laid over the picture,
 * transparent, when the veil ends. */

enum { RASTER_FINE = 3 };

typedef struct colour {
    float r, g, b; /* 0 to 1, as shown */
} colour;

/* What is drawn is cut off at the window. */
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
    double veil_depth;    /* what is nearer than this goes into the veil; INFINITY: nothing does */
    raster_window window; /* all of it, until the caller sets it */
} raster;

/* Bytes that raster_begin takes, and as many again with a veil. */
size_t raster_bytes(double width, double height);

/* False: no memory. */
bool raster_begin(raster *r, size_t width, size_t height, colour background);
void raster_free(raster *r);

/* From here on, what is nearer than `depth` goes into a veil; INFINITY: nothing does. False: no
 * memory. */
bool raster_veil(raster *r, double depth);

/* Lays the veil over the window, and clears it. */
void raster_veil_end(raster *r);

/* A corner of a triangle: x, y, depth; the normal as the camera sees it (right, up, toward). */
typedef struct raster_corner {
    vec at, normal;
} raster_corner;

/* Lit from the upper left, both sides alike; without a normal, in the colour itself. */
void raster_triangle(raster *r, const raster_corner corner[3], colour c);

/* A line `width` wide whose depth counts; without `hidden` it goes over everything. */
void raster_line(raster *r, vec from, vec to, double width, colour c, bool hidden);

/* A convex shape of n points x, y over everything. */
void raster_flat(raster *r, const double *xy, size_t n, colour c);

/* Depth at a point of the window; -INFINITY outside. */
double raster_depth(const raster *r, double x, double y);

/* One row of the written picture: 3 * width bytes. */
void raster_row(const raster *r, size_t y, uint8_t *rgb);

#endif
