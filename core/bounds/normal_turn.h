/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NORMAL_TURN_H
#define CORE_BOUNDS_NORMAL_TURN_H

#include "core/bounds/difference.h"

/* How a field of normals turns
 * ============================
 * The frame of the field, the two slices in it, and the numbers by which the axis turns with the
 * surfaces and with time. They are chosen for tightness: normal_field.c proves its bounds for any
 * numbers.
 *
 * The field is the normals of a surface between the two, of curvature K. It follows what touches:
 * the mean of two faces; one face, where an edge or a corner of the other side touches it; or two
 * edges that cross, K being the curvature of each along itself. */

/* A vector in the field's frame: along the tangents t1, t2 and the normal. */
typedef struct local {
    double t[2], n;
} local;

/* How a surface touches the other one along an axis: with its inside, with an edge along u or v, or
 * with a corner. */
typedef enum touch { TOUCH_EDGE_U, TOUCH_EDGE_V, TOUCH_FACE, TOUCH_CORNER } touch;

typedef struct frame {
    vec3 t[2], n;
    touch side[2];
} frame;

static inline local to_local(const frame *f, const double *x)
{
    const vec3 v = vec3_from(x);
    return (local){{vec3_dot(f->t[0], v), vec3_dot(f->t[1], v)}, vec3_dot(f->n, v)};
}

/* Terms of second order: s_u^2, s_u s_v, s_v^2, s_u w, s_v w. */
enum { UU, UV, VV, UW, VW, SECONDS };

/* A slice in the frame: slopes along u and v, and terms of second order. */
typedef struct local_slice {
    local l[2], q[SECONDS];
    double qw[3]; /* how UU, UV and VV change with w, along the normal */
} local_slice;

/* `is_posed`: the slice has terms UU, UV and VV that change with w. */
static inline local_slice normal_slice_to_local(const frame *f, const slice *s, bool is_posed)
{
    local_slice l = {{to_local(f, s->bu), to_local(f, s->bv)},
                     {to_local(f, s->quu), to_local(f, s->quv), to_local(f, s->qvv),
                      to_local(f, s->quw), to_local(f, s->qvw)},
                     {0, 0, 0}};
    if (is_posed) {
        l.qw[UU] = vec3_dot(f->n, vec3_from(s->uuw));
        l.qw[UV] = vec3_dot(f->n, vec3_from(s->uvw));
        l.qw[VV] = vec3_dot(f->n, vec3_from(s->vvw));
    }
    return l;
}

/* The offset, drift and bend of the difference in the frame. */
typedef struct path {
    local delta, drift, bend;
} path;

static inline path normal_path_to_local(const frame *f, const difference *r)
{
    return (path){to_local(f, r->delta), to_local(f, r->drift), to_local(f, r->bend)};
}

/* Both slices and the path of the difference in the frame. */
typedef struct view {
    local_slice a, b;
    path x;
} local_view;

static inline local_view view_in(const frame *f, const difference *r)
{
    return (local_view){normal_slice_to_local(f, &r->a, r->posed > 0),
                        normal_slice_to_local(f, &r->b, r->posed > 0), normal_path_to_local(f, r)};
}

/* Makes the frame between the two normals or, if the surfaces are not nearly tangent, the frame of
 * the face or the two edges that touch along `axis`, which nearly separates them; 0: none is known.
 * Its vectors are of unit length up to rounding. False: there is no such frame. */
bool normal_frame_between(const difference *r, vec3 axis, frame *f);

static inline double dot2(const double *m, const local *x)
{
    return m[0] * x->t[0] + m[1] * x->t[1];
}

/* A symmetric 2 x 2 matrix. */
typedef struct form {
    double xx, xy, yy;
} form;

/* How the field turns with one surface's parameters: m = -K x / 2 for each of its terms x, in the
 * tangents. */
typedef struct turn {
    double l[2][2], q[SECONDS][2];
} turn;

/* The numbers m of the lemma; and what is to be added to the frame's normal, along the tangents,
 * since the middle between the two centres is not where the face is touched. */
typedef struct turns {
    form k; /* K */
    turn a, b;
    double w[2], tilt[2];
} turns;

/* Chooses the numbers m of the lemma. False: the slopes are too nearly parallel. */
bool normal_turns_choose(const frame *f, const local_slice *a, const local_slice *b, const path *x,
                         turns *m);

#endif
