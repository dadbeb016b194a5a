/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_POLYGONS_H
#define TESTS_SUPPORT_POLYGONS_H

#include "tests/support/type_oracle.h"

/* Polygons for oracles of subdivision surfaces: a list that is searched for neighbours. */

enum { POLYGONS_POINTS = 400, POLYGONS_FACES = 200, POLYGONS_CORNERS = 8 };

typedef struct polygons {
    size_t points, faces;
    mpfi_t x[POLYGONS_POINTS][3];
    size_t corner[POLYGONS_FACES][POLYGONS_CORNERS], corners[POLYGONS_FACES];
} polygons;

/* Two for what is finer and coarser in turn, and one between. */
polygons *polygons_room(int which);

/* The points and faces of the parameters, at time t. */
void polygons_read(const type_arguments *arguments, number t, polygons *m);

/* A point at 0; point p plus `factor` times another's point k; point p through a number. */
size_t polygons_new_point(polygons *m);
void polygons_add(polygons *to, size_t p, const polygons *from, size_t k, double factor);
void polygons_divide(polygons *m, size_t p, double by);

/* Corner k of a face, counted round. */
size_t polygons_corner(const polygons *m, size_t f, size_t k);
bool polygons_has_corner(const polygons *m, size_t f, size_t p);
size_t polygons_faces_at(const polygons *m, size_t p);

/* The face with an edge from a to b, and which of its edges that is. */
bool polygons_find_edge(const polygons *m, size_t a, size_t b, size_t *face, size_t *k);
bool polygons_is_border_edge(const polygons *m, size_t a, size_t b);
bool polygons_is_border(const polygons *m, size_t p);

/* Adds to point `at` of another what a step makes of border point p. */
void polygons_smooth_border(const polygons *m, size_t p, polygons *to, size_t at);

/* The faces that share a point with f, which becomes the first of them and begins at its corner
 * `first`. */
void polygons_take_around(const polygons *m, size_t f, size_t first, polygons *to);

/* The hull of all points. */
void polygons_hull(const polygons *m, number x[3]);

#endif
