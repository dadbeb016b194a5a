/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_STAGE_H
#define TOOLS_VIEW_STAGE_H

#include "tools/view/mesh.h"

/* A scene to be drawn
 * ===================
 * The bodies' surfaces as meshes, what is known of their contact, and the moments worth showing. */

/* When and where they touch, as a query or a file of results tells. */
typedef struct stage_contact {
    imp_verdict verdict;
    double t;        /* CONTACT; else what is proved: t_lower */
    vec point[2];    /* CONTACT: on body a, on body b */
    size_t body[2];  /* CONTACT: which */
    bool has_normal; /* of a to b, unit length */
    vec normal;
    double gap, gamma;
} stage_contact;

typedef struct stage {
    const imp_scene *scene;
    double t_start, t_end; /* drawn */
    stage_contact contact;
    size_t body_count; /* bodies from here on are not drawn */
    mesh *meshes;
    size_t count;
    double now;  /* the meshes' time */
    vec_box box; /* around all that stands at the moments */
    vec *cloud;  /* points of it, to frame pictures by */
    size_t cloud_count;
    double *moments;     /* ascending; what the meshes' tolerance holds at */
    size_t moment_count; /* at least 1 */
    double error_upper;  /* of the pictures made so far: how far a surface is from its triangles */
} stage;

/* How the meshes are made. */
typedef struct stage_detail {
    double tolerance;    /* length; 0: the size of all there is by 2000 */
    size_t max_cells;    /* of all surfaces together */
    double focus_radius; /* about the contact; INFINITY: everywhere */
} stage_detail;

/* Makes meshes for s->moments, and s->box and s->cloud. The caller has set scene, times, contact, body_count,
 * moments (allocated; stage_free frees them) and moment_count. */
imp_code stage_make(stage *s, const stage_detail *detail, imp_error *error);
void stage_free(stage *s);

/* Puts everything where it is at time t, and keeps account of the error. What does not exist then
 * is left out of stage_is_there. */
imp_code stage_move(stage *s, double t, imp_error *error);
bool stage_is_there(const stage *s, const mesh *m);

/* The middle of the contact's two points. */
vec stage_contact_point(const stage *s);

/* Length of the box's diagonal; 1 where it has none. */
double stage_size(const stage *s);

#endif
