/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_FILM_H
#define TOOLS_VIEW_FILM_H

#include "tools/view/request.h"
#include "tools/view/subject.h"

/* A scene in motion: the meshes' points at each of some frames. The contact's moment is a frame. A
 * surface that does not exist at a frame stands there as at the nearest moment at which it does. */

/* Where a rigid body is, as against frame 0: x -> turn(x) + shift; turn: unit quaternion x,y,z,w. */
typedef struct pose {
    double turn[4];
    vec shift;
} pose;

typedef struct track {
    const mesh *mesh;
    size_t count; /* points of the mesh */
    vec *point;   /* [frame * count + k]; world space */
    vec *normal;  /* the same; unit length */
    bool rigid;   /* all frames are poses of the first */
    pose *poses;  /* one a frame, if rigid */
    bool *there;  /* one a frame */
    bool always_there;
} track;

typedef struct film {
    stage stage;
    double *times;                /* ascending; the stage's */
    size_t frames, contact_frame; /* SIZE_MAX: there is none */
    track *tracks;
    size_t count;
} film;

/* With --at, one frame. Free in any case. */
imp_code film_make(const subject *what, const view_request *request, film *f, imp_error *error);
void film_free(film *f);

#endif
