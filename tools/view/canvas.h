/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_CANVAS_H
#define TOOLS_VIEW_CANVAS_H

#include <stdio.h>

#include "tools/view/raster.h"

/* Flat drawing, into pixels or as SVG
 * ===================================
 * Draws lines, filled convex shapes and text, in pixels of the picture, y downward. Later shapes
 * cover earlier ones. */

typedef struct pen {
    colour colour;
    double width; /* pixels */
} pen;

typedef enum canvas_anchor { CANVAS_LEFT, CANVAS_MIDDLE, CANVAS_RIGHT } canvas_anchor;

typedef struct canvas {
    double width, height;
    raster *raster; /* pixels go there, */
    FILE *file;     /* or elements of SVG here */
} canvas;

/* Write the beginning and the end of an SVG picture. */
canvas canvas_svg_begin(FILE *file, double width, double height);
void canvas_svg_end(const canvas *c);

/* Draws a line through n points x, y, x, y ... */
void canvas_line(canvas *c, const double *xy, size_t n, pen p);
void canvas_shape(canvas *c, const double *xy, size_t n, colour fill);
void canvas_disc(canvas *c, double x, double y, double radius, colour fill);

/* Draws text whose baseline begins, has its middle, or ends at x, y; `size` is the height of a line
 * of text, pixels. In raster pictures, characters other than ASCII become '?'. */
void canvas_text(canvas *c, double x, double y, double size, canvas_anchor anchor, colour tint,
                 const char *text);

/* Words that begin at x, y and are exactly canvas_text_width wide, whatever the typeface. */
void canvas_text_fixed(canvas *c, double x, double y, double size, colour tint, const char *text);
double canvas_text_width(const canvas *c, double size, const char *text);

/* Returns how many bytes of the text fit `room` pixels: all, or those before a space; 0: its first
 * word does not fit. */
size_t canvas_first_line(const canvas *c, double size, double room, const char *text);

/* Copies the text, or as much of it as fits `room` pixels and `length` bytes, with dots at its
 * end. */
void canvas_fitted(const canvas *c, double size, double room, const char *text, char *fitted,
                   size_t length);

#endif
