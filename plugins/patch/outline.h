/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_OUTLINE_H
#define PLUGINS_PATCH_OUTLINE_H

#include "plugins/patch/knots.h"

/* The plane curve of an extrusion
 * ===============================
 * A Bezier curve, a B-spline or a rational one, read from parameters and checked. */

/* Rows of the type's parameters, in this order. */
enum {
    OUTLINE_PROFILE,
    OUTLINE_DEGREE,
    OUTLINE_KNOTS,
    OUTLINE_WEIGHTS,
    OUTLINE_VECTOR,
    OUTLINE_ENDS,
    OUTLINE_CENTER
};

/* The curve, checked; knots are the parameter's, or made. */
typedef struct outline {
    size_t count;
    int degree;
    const double *profile, *weights; /* weights: NULL where all are 1 */
    double center[2];                /* outline_close sets it */
    double *knots, *joined;          /* joined: the profile if its last point was moved, or NULL */
    knot_row row;
} outline;

/* Reads all but the ends. outline_clear it, whatever is returned. */
imp_status outline_read(const imp_value *values, outline *o, imp_create_error *why);

/* Reads the center of the ends and checks that all of the curve is seen from there; k are the knots
 * of the row. */
imp_status outline_close(const imp_value *values, const knots *k, outline *o,
                         imp_create_error *why);

/* Frees what the outline owns. */
void outline_clear(outline *o);

#endif
