/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_KNOTS_H
#define PLUGINS_PATCH_KNOTS_H

#include <impinge/plugin.h>
#include <stdbool.h>
#include <stddef.h>

/* B-splines of one parameter
 * ==========================
 * Degree p, count control points, count + p + 1 knots k_0 <= k_1 <= ...; the domain is [k_p,
 * k_count]. Between two different neighbours k_i < k_(i+1) of it, a span, the spline is a
 * polynomial that depends on control points i - p ... i alone.
 *
 * Everything here adds and multiplies numbers >= 0 only, so relative errors stay small: `units`
 * below are of 2^-53. */

/* Knots and their distances, unless 0, keep every number below finite. */
#define KNOT_FAR 1e50
#define KNOT_NEAR 1e-100

typedef struct knots {
    int degree;
    size_t count; /* control points */
    size_t spans;
    double *at;   /* all knots */
    double *ends; /* spans + 1: where spans begin and end */
    size_t *last; /* per span, its last control point */
} knots;

/* One direction's numbers, and their place in the parameters, for messages. */
typedef struct knot_row {
    const double *number;
    size_t length;
    int parameter;
    int64_t element; /* -1: the numbers themselves are the parameter's elements */
} knot_row;

/* Checks a row of knots for that degree. */
imp_status knots_check(const knot_row *row, int degree, imp_create_error *why);

/* Frees the arrays. */
void knots_free(knots *k);

/* Makes knots from checked numbers. False: no memory; call knots_free even then. */
bool knots_make(knots *k, const knot_row *row, int degree);

/* Makes knots from other checked numbers, in their memory. False: there is no room for these, or
 * they have another number of spans; then only knots_free is left. */
bool knots_renew(knots *k, const knot_row *row, int degree);

static inline double knots_lo(const knots *k) { return k->ends[0]; }

static inline double knots_hi(const knots *k) { return k->ends[k->spans]; }

/* The last span that begins at or before u, which is in the domain. */
size_t knots_span(const knots *k, double u);

/* The last span that [lo, hi] reaches into, and not just touches, from `first` on. */
size_t knots_last_span(const knots *k, double hi, size_t first);

/* The p + 1 basis functions at u that are not 0 in a span, within 6 p units of themselves. */
void knots_basis(const knots *k, size_t span, double u, double *basis);

/* Bezier control points of a span: point i is sum_j matrix[i * (p + 1) + j] times the span's j-th
 * control point; entries are >= 0, within 5 p units of themselves. */
void knots_extract(const knots *k, size_t span, double *matrix);

#endif
