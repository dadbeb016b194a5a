/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_FILM_H
#define TOOLS_VIEW_FILM_H

#include "tools/view/request.h"
#include "tools/view/subject.h"

/* A scene in motion: the meshes' points at each of some frames. The times of the contact, or of the
 * nearest approach, and of events are frames. A surface that does not exist at a frame has the
 * points of the nearest moment at which it does. */

/* The motion of a rigid body since frame 0: x -> turn(x) + shift; turn: unit quaternion x,y,z,w. */
typedef struct pose {
    double turn[4];
    vec shift;
} pose;

typedef struct track {
    const mesh *mesh;
    size_t count; /* points of the mesh */
    vec *point;   /* [frame * count + k], of a rigid track frame 0 alone; world space */
    vec *normal;  /* as point; unit length */
    bool rigid;   /* all frames are poses of the first */
    pose *poses;  /* one a frame, if rigid */
    bool *there;  /* one a frame */
    bool always_there;
} track;

typedef struct film {
    stage stage;
    double *times;             /* ascending; the stage's */
    size_t frames, spot_frame; /* SIZE_MAX: there is none */
    track *tracks;
    size_t count;
} film;

/* Returns the image of a point. */
vec pose_apply(const pose *p, vec x);

/* Return a point or a normal of a track at a frame. */
vec track_point(const track *t, size_t frame, size_t k);
vec track_normal(const track *t, size_t frame, size_t k);

/* With --at, one frame. Free in any case. */
imp_code film_make(subject *what, const view_request *request, film *f, imp_error *error);
void film_free(film *f);

#endif
