/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_SPLINE_H
#define PLUGINS_COMMON_SPLINE_H

#include <impinge/formula_text.h>
#include <impinge/model.h>
#include <stdbool.h>
#include <stddef.h>

/* Smooth curves through many keys
 * ===============================
 * A curve g of several lanes (numbers) has values at keys of increasing times. Its slope at a key
 * is that from the key before to the key after; between two keys it is the cubic with their values
 * and slopes; the first and the last piece are parabolas, as no slope is given at their other ends.
 * For equal steps this is the Catmull-Rom spline, and quadratic motion is reproduced. For others
 * the slopes cannot overshoot: a step up a slope is never more than the way between three keys.
 *
 * Where the slopes at the keys are given, pieces are the cubics with these; where g'' is given at
 * the keys, too, quintics (Hermite interpolation).
 *
 * A piece is kept by the control points of its terms g^(k)/k! as Bezier curves. Each is an interval
 * that holds the exact number, and so does what interval arithmetic makes of it.
 *
 * A span of times within one piece has a series from its terms at the middle. One across several
 * pieces has the value and slope at its middle m, and, as slopes are continuous,
 *
 *   g(m + y) = g(m) + g'(m) y + h y^2,   h between the least and the greatest g''/2 of the span.
 *
 * A curve with kinks has slopes that jump at its keys. It goes straight from key to key, each piece
 * a cubic whose bends are 0, or along parabolas of given accelerations. Across several pieces g is
 * Lipschitz, and differences are means of slopes, so
 *
 *   g(m + y) = g(m) + h y,   h between the least and the greatest slope of the span.
 *
 * A binary tree over the pieces holds the range of each lane, of its slope and of g''/2: a span
 * across a thousand pieces uses some twenty nodes. */

/* Per lane in a node of the tree. Further columns, after those of all lanes, are the owner's. */
enum { SPLINE_VALUE, SPLINE_SLOPE, SPLINE_BEND, SPLINE_COLUMNS };

typedef struct spline {
    size_t pieces, lanes, width; /* width: intervals in a node */
    int degree;                  /* of a piece: 3, or 5 */
    bool kinked;
    double *time;          /* pieces + 1 */
    imp_interval *control; /* of each piece, lane by lane, the control points of all terms */
    imp_interval *tree;    /* node k has children 2k and 2k+1; piece i is node pieces + i */
} spline;

enum { SPLINE_CUBIC = 3, SPLINE_QUINTIC = 5 };

/* The control points of a piece and lane: of all of its terms. */
static inline size_t spline_controls(int degree)
{
    return (size_t)((degree + 1) * (degree + 2) / 2);
}

/* The control points of term k, which is g^(k)/k!: degree + 1 - k of them. */
static inline imp_interval *spline_term(const spline *s, size_t piece, size_t lane, int k)
{
    return s->control + (piece * s->lanes + lane) * spline_controls(s->degree) +
           k * (2 * s->degree + 3 - k) / 2;
}

/* Returns the bytes of a spline with that many further columns. */
size_t spline_bytes(int degree, size_t keys, size_t lanes, size_t further);

/* Lays out a spline in spline_bytes of memory, which stays the caller's; its keys, controls and
 * tree are still to be set. */
spline spline_place(int degree, size_t keys, size_t lanes, size_t further, void *memory);

static inline imp_interval *spline_node(const spline *s, size_t k)
{
    return s->tree + k * s->width;
}

/* Returns the time from one key to another. */
imp_interval spline_step(const spline *s, size_t from, size_t to);

/* Returns the least interval that holds both, or all of them. */
imp_interval spline_hull(imp_interval x, imp_interval y);
imp_interval spline_hull_of(const imp_interval *x, int count);

/* Fills controls and leaves of a cubic spline, from time and from the keys' values, lane by lane.
 * False: the step in time of piece *piece is too short for the change of values in it. */
bool spline_set(const spline *s, const imp_interval *keys, size_t *piece);

/* Fills controls and leaves of a spline that has these slopes at its keys, laid out as the keys
 * are; of a quintic one also `bends`, g'' there. */
bool spline_set_hermite(const spline *s, const imp_interval *keys, const imp_interval *slopes,
                        const imp_interval *bends, size_t *piece);

/* Fills controls and leaves of a curve with kinks whose pieces are parabolas: row i of
 * `accelerations`, a number for each of the first three lanes, is g'' in piece i. NULL: straight
 * lines. */
bool spline_set_parabolas(const spline *s, const imp_interval *keys, const double *accelerations,
                          size_t *piece);

/* Fills the rest of the tree, when the leaves are complete. */
void spline_grow(const spline *s);

/* Evaluates the polynomial of up to six control points, by repeated averages (de Casteljau). */
imp_interval spline_at(const imp_interval *control, int count, imp_interval part);

enum { SPLINE_WIDTH_MAX = 32 };

/* Returns the time within a track that is held beyond its ends: t, or the end nearest to it. Where
 * t crosses an end this has a kink, and the rate 1 on its side of it. */
imp_model spline_hold(const spline *s, imp_model t);

/* What is printed of a spline: lanes by `name` and their number; keys by the callback, their values
 * (order 0), and the slopes (1) and second derivatives (2) that are given. */
typedef struct spline_text {
    const spline *of;
    bool hold;        /* its ends hold before and after it */
    int orders;       /* 0: slopes follow from the values; 1: they are given; 2: g'', too */
    const char *name; /* of the lanes: "name0" ... */
    void (*write_key)(const void *context, int order, size_t key, size_t lane,
                      const imp_text_sink *to);
    const void *context;
} spline_text;

/* Prints the times of a piece, "t in [...]; ", and definitions of all lanes in it. The names t0, h,
 * s and those that begin with the name of the lanes are used. */
void spline_write_part(const spline_text *text, size_t piece, const imp_text_sink *to);

/* Times from lo to hi, in the pieces first ... last; the middle m lies in the piece `at`. */
typedef struct spline_span {
    double lo, hi, m;
    size_t first, last, at;
} spline_span;

/* lo, m and hi are between the first and the last key. */
spline_span spline_span_of(const spline *s, double lo, double m, double hi);

/* Computes models of all lanes over the times of the model t, and in `node` (width intervals) the
 * ranges over all of the pieces that t touches. */
void spline_models(const spline *s, imp_model t, imp_model *lanes, imp_interval *node);

#endif
