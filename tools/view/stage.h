/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_STAGE_H
#define TOOLS_VIEW_STAGE_H

#include "tools/view/allowance.h"
#include "tools/view/cloud.h"
#include "tools/view/mesh.h"

/* A scene to be drawn
 * ===================
 * The bodies' surfaces as meshes, what is known of their contact, and the moments worth showing. */

/* What a query, or a file of results, tells. */
typedef struct stage_contact {
    bool is_known; /* false: nobody asked when they touch */
    imp_verdict verdict;
    double t; /* CONTACT; else what is proved: t_lower */
    double gap, gamma;
} stage_contact;

/* Where two bodies touch or come nearest: what a picture is to show. */
typedef struct stage_spot {
    bool is_known;
    bool is_contact;
    double t;
    vec point[2];   /* on the first body, on the second */
    size_t body[2]; /* which */
    bool has_normal;
    vec normal;          /* from the first to the second, unit length */
    double lower, upper; /* the least distance of all times is at least, and at most; length */
} stage_spot;

typedef struct stage {
    const imp_scene *scene;
    allowance *allowance;  /* NULL: none */
    double t_start, t_end; /* drawn */
    stage_contact contact;
    stage_spot spot;
    size_t body_count; /* bodies from here on are not drawn */
    mesh *meshes;      /* one for each surface, those of a body one after another */
    size_t count;
    double now;          /* the meshes' time */
    cloud cloud;         /* of all that stands at the moments */
    double *moments;     /* ascending; what the meshes' tolerance holds at */
    size_t moment_count; /* at least 1 */
    double error_upper;  /* of the pictures made so far: how far a surface is from its triangles */
} stage;

/* How the meshes are made. */
typedef struct stage_detail {
    double tolerance;    /* length; 0: the size of all there is by 2000 */
    size_t max_cells;    /* of all surfaces together */
    double focus_radius; /* about the spot; INFINITY: everywhere */
} stage_detail;

/* Makes meshes for s->moments, and s->cloud. The caller has set scene, allowance, times, contact,
 * spot, body_count, moments (allocated; stage_free frees them) and moment_count. */
imp_code stage_make(stage *s, const stage_detail *detail, imp_error *error);
void stage_free(stage *s);

/* Puts everything where it is at time t, and keeps account of the error. What does not exist then
 * is left out of stage_is_there. */
imp_code stage_move(stage *s, double t, imp_error *error);
bool stage_is_there(const stage *s, const mesh *m);

/* The middle of the spot's two points. */
vec stage_spot_point(const stage *s);

/* Length of the box's diagonal; 1 where it has none. */
double stage_size(const stage *s);

#endif
