/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NORMAL_TURN_H
#define CORE_BOUNDS_NORMAL_TURN_H

#include "core/bounds/difference.h"

/* How a field of normals turns
 * ============================
 * The frame of the field, the two slices in it, and the numbers by which the axis turns with the
 * surfaces and with time. They are chosen for tightness: normal_field.c proves its bounds for any
 * numbers. */

/* A vector in the field's frame: along the tangents t1, t2 and the normal. */
typedef struct local {
    double t[2], n;
} local;

typedef struct frame {
    vec3 t[2], n;
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

/* Makes the frame between the two normals, of unit length up to rounding. False: the surfaces have
 * no normals or are not nearly tangent. */
bool normal_frame_between(const difference *r, frame *f);

static inline double dot2(const double *m, const local *x)
{
    return m[0] * x->t[0] + m[1] * x->t[1];
}

/* How the field turns with one surface's parameters: m = -K x / 2 for each of its terms x, in the
 * tangents. */
typedef struct turn {
    double l[2][2], q[SECONDS][2];
} turn;

/* The numbers m of the lemma. */
typedef struct turns {
    turn a, b;
    double w[2];
} turns;

/* Chooses the numbers m of the lemma. False: the slopes are too nearly parallel. */
bool normal_turns_choose(const local_slice *a, const local_slice *b, turns *m);

#endif
