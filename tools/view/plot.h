/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_PLOT_H
#define TOOLS_VIEW_PLOT_H

#include "tools/view/canvas.h"

/* Curves and bands in a frame with scales, on a canvas or as text. */

typedef enum plot_kind {
    PLOT_BAND,  /* between y and high, from x[k] to x[k + 1]: count is that of the steps */
    PLOT_LINE,  /* y over x, joined, with a dot at each */
    PLOT_POINTS /* dots alone */
} plot_kind;

typedef struct plot_series {
    char name[64];
    plot_kind kind;
    colour tint;
    char letter; /* its mark in text plots */
    double *x, *y, *high;
    size_t count;
} plot_series;

enum { PLOT_SERIES_MAX = 16 };

/* Logarithmic scales leave out what is not above 0. */
typedef struct plot {
    char title[160], x_label[64], y_label[64];
    bool log_x, log_y;
    plot_series series[PLOT_SERIES_MAX];
    size_t count;
    bool marked; /* a vertical line, */
    double mark; /* at this x, */
    char mark_label[64];
    bool has_level; /* a horizontal line, */
    double level;   /* at this y, */
    char level_label[64];
    bool has_point; /* one highlighted point */
    double point[2];
    char point_label[192];
} plot;

/* Adds a series for `count` steps (and count + 1 numbers x). NULL: no memory, or too many
 * series. */
plot_series *plot_add(plot *p, const char *name, plot_kind kind, size_t count);
void plot_free(plot *p);

/* The ends of the two scales: [0] x, [1] y; powers of ten where they are logarithmic. A plot
 * without a number goes from 0 to 1. */
typedef struct plot_scale {
    double lo[2], hi[2];
} plot_scale;
plot_scale plot_measure(const plot *p);

/* Returns the place of x (axis 0) or y (1) between the ends: 0 to 1; NAN: it has none. */
double plot_place(const plot *p, const plot_scale *s, int axis, double value);

/* Chooses the marks along an axis; returns how many, at most `most`. */
size_t plot_ticks(const plot *p, const plot_scale *s, int axis, double *ticks, size_t most);

void plot_draw(const plot *p, canvas *c);

/* Prints the plot in this many columns and rows of ASCII in all. False: no memory. */
bool plot_print(const plot *p, FILE *to, size_t columns, size_t rows);

#endif
