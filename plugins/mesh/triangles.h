/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_TRIANGLES_H
#define PLUGINS_MESH_TRIANGLES_H

#include <impinge/plugin.h>

/* Triangles between common points, and how they are added one by one from what may be anything.
 * Where faces are kept whole, they stay the polygons that they were. */

/* Farthest coordinate, so that every number below stays finite. */
#define TRIANGLES_FAR 1e100

/* What was done with a file that its author may not expect: how often, and where first. */
typedef struct triangles_count {
    size_t count;
    size_t line; /* from 1; 0: not in a line */
} triangles_count;

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
    triangles_count left_out; /* statements of a file that are no points and no faces */
    triangles_count cut;      /* polygons that a fan would not cover */
    bool has_other_files;     /* the file named others, which were read */
    imp_create_error *why;    /* for imp_goes_on, imp_reads; NULL: no limits */
    size_t held;              /* bytes beside these: of files that are being read */
} triangles;                  /* begins as {0}, or with keeps_faces set; triangles_clear frees */

void triangles_clear(triangles *t);

/* Takes all out and keeps the memory, for as many others. */
void triangles_empty(triangles *t);

/* Gives back memory that triangles in use do not need. */
void triangles_fit(triangles *t);

/* What is wrong with a face, or with a text, and where. */
typedef struct triangles_fault {
    size_t line; /* from 1; 0: not in a line */
    char text[160];
    size_t byte;   /* from 1; 0: not at a byte */
} triangles_fault; /* begins as {0, "", 0} */

/* Sets the text, as printf does, and answers IMP_STATUS_PARAMETER. */
imp_status triangles_refuse(triangles_fault *fault, size_t line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* triangles_refuse for a fault at a byte, which is given from 0. */
imp_status triangles_refuse_byte(triangles_fault *fault, size_t byte, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Whether to go on (imp_goes_on), with `more` bytes beside what is there. */
bool triangles_may_take(const triangles *t, size_t more);

/* IMP_STATUS_PARAMETER: a coordinate is not finite or too large, or there are too many points.
 * IMP_STATUS_INTERNAL: no memory, or a limit. */
imp_status triangles_add_point(triangles *t, const double x[3], size_t line,
                               triangles_fault *fault);

/* A polygon of points that are there, by number from 0: whole where faces are kept; as a fan of
 * triangles from its first corner where it is plane and convex; else cut by its ears (polygon.h)
 * and counted in t->cut. IMP_STATUS_PARAMETER: fewer than three corners, a corner that is not
 * there, or a polygon to cut that crosses itself or has more than POLYGON_CUT_MAX corners. */
imp_status triangles_add_face(triangles *t, const int64_t *corner, size_t count, size_t line,
                              triangles_fault *fault);

/* Counts one more, in that line. */
void triangles_note(triangles_count *count, size_t line);

/* Writes what was left out, cut, or has no area, as one sentence, and answers how many of these
 * there are; with 0 the text is empty. */
size_t triangles_tell(const triangles *t, char *text, size_t size);

#endif
