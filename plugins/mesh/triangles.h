/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_TRIANGLES_H
#define PLUGINS_MESH_TRIANGLES_H

#include <impinge/plugin.h>

/* Triangles between common points, and how they are added one by one from what may be anything. */

/* Farthest coordinate, so that every number below stays finite. */
#define TRIANGLES_FAR 1e100

typedef struct triangles {
    double *point; /* x, y, z of each */
    size_t point_count, point_capacity;
    uint32_t *corner; /* three points of each triangle */
    size_t count, capacity;
    size_t faces; /* added, of any number of corners */
} triangles;      /* begins as {0}; triangles_clear frees */

void triangles_clear(triangles *t);

/* What is wrong with a face, or with a text, and where. */
typedef struct triangles_fault {
    size_t line; /* from 1; 0: not in a line */
    char text[160];
} triangles_fault;

/* Sets the text, as printf does, and answers IMP_PARAMETER. */
imp_status triangles_refuse(triangles_fault *fault, size_t line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* IMP_PARAMETER: a coordinate is not finite or too large, or there are too many points.
 * IMP_INTERNAL: no memory. */
imp_status triangles_add_point(triangles *t, const double x[3], size_t line,
                               triangles_fault *fault);

/* A polygon of points that are there, by number from 0, as a fan of triangles from its first corner.
 * IMP_PARAMETER: fewer than three corners, a corner that is not there, or four and more that do not lie
 * in a plane (a thousandth of its size off), or are not convex, so that a fan is not what is meant. */
imp_status triangles_add_face(triangles *t, const int64_t *corner, size_t count, size_t line,
                              triangles_fault *fault);

#endif
