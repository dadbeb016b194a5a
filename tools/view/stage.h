/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_STAGE_H
#define TOOLS_VIEW_STAGE_H

#include "tools/view/allowance.h"
#include "tools/view/cloud.h"
#include "tools/view/mesh.h"

/* A scene to be drawn
 * ===================
 * It has the bodies' surfaces as meshes, the answer about their contact, and the moments to
 * show. */

/* The answer of a query, or from a file of results. */
typedef struct stage_contact {
    bool is_known; /* false: no search for a contact was made */
    imp_verdict verdict;
    double t; /* with CONTACT its time; else t_lower */
    double gap, gamma;
} stage_contact;

/* Where two bodies touch or come nearest, for the picture to show. */
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
    cloud cloud;         /* of all surfaces at the moments */
    double *moments;     /* ascending; times at which the meshes' tolerance holds */
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

/* Moves all meshes to time t, and updates the error. stage_is_there is false for surfaces that do
 * not exist then. */
imp_code stage_move(stage *s, double t, imp_error *error);
bool stage_is_there(const stage *s, const mesh *m);

/* Returns the middle of the spot's two points. */
vec stage_spot_point(const stage *s);

/* Returns the length of the box's diagonal; 1 if that is 0. */
double stage_size(const stage *s);

#endif
