/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_TRIANGLES_H
#define PLUGINS_MESH_TRIANGLES_H

#include <impinge/plugin.h>

/* Triangles between common points, and how they are added one by one from what may be anything.
 * Where faces are kept whole, they stay the polygons that they were. */

/* Farthest coordinate, so that every number below stays finite. */
#define TRIANGLES_FAR 1e100

typedef struct triangles {
    double *point; /* x, y, z of each */
    size_t point_count, point_capacity;
    uint32_t *
        corner; /* three points of each triangle; or those of each face, one face after the other */
    size_t count, capacity;
    size_t faces;     /* added, of any number of corners */
    bool keeps_faces; /* set before the first: keep `count` faces of any size, not triangles */
    uint32_t *first;  /* of each face kept: where its corners begin */
    size_t first_capacity, corner_count;
} triangles; /* begins as {0}, or with keeps_faces set; triangles_clear frees */

void triangles_clear(triangles *t);

/* What is wrong with a face, or with a text, and where. */
typedef struct triangles_fault {
    size_t line; /* from 1; 0: not in a line */
    char text[160];
} triangles_fault;

/* Sets the text, as printf does, and answers IMP_STATUS_PARAMETER. */
imp_status triangles_refuse(triangles_fault *fault, size_t line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* IMP_STATUS_PARAMETER: a coordinate is not finite or too large, or there are too many points.
 * IMP_STATUS_INTERNAL: no memory. */
imp_status triangles_add_point(triangles *t, const double x[3], size_t line,
                               triangles_fault *fault);

/* A polygon of points that are there, by number from 0, as a fan of triangles from its first
 * corner, or whole. IMP_STATUS_PARAMETER: fewer than three corners, or a corner that is not there;
 * of a fan also four and more corners that do not lie in a plane (a thousandth of its size off), or
 * are not convex, so that a fan is not what is meant. */
imp_status triangles_add_face(triangles *t, const int64_t *corner, size_t count, size_t line,
                              triangles_fault *fault);

#endif
