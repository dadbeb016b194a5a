/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_ORBIT_H
#define TOOLS_VERIFY_ORBIT_H

#include "tools/verify/motion_internal.h"
#include "tools/verify/turn.h"

/* All angles of a map that turns, at once
 * =======================================
 * Where a map of a chain turns by an angle A (turn.h), and the other maps are affine, the chain
 * takes x to n[0] x + cos A n[1] x + sin A n[2] x at each time: to a point of an ellipse that moves
 * as the other maps do. What holds for all of the ellipse holds for any A, however fast it goes. */

typedef struct orbit {
    bool is_known; /* false: maps may not be affine, or follow other clocks */
    bool turns;    /* false: no map does, and n[0] is all */
    size_t stage;  /* of the chain, that turns; else 0 */
    double span;   /* by which the angle changes, about */
    affine n[3];   /* the shifts of n[1] and n[2] are those of these maps */
} orbit;

/* Returns by how much an angle changes in some times, at most, about, and the stage that turns so.
 * */
double orbit_span(const place *p, double lo, double hi, size_t *stage_index);

/* Takes the chain over the times from lo to hi, by the map that turns most. */
void orbit_take(const place *p, double lo, double hi, orbit *to);

/* Takes it by the map of a stage, which may turn or not; of stage 0 by none. */
void orbit_take_by(const place *p, size_t stage_index, double lo, double hi, orbit *to);

/* v.n[m], its shift last, as jets of u, v and t, over the times and at their middle. */
typedef struct orbit_rows {
    double v[3];
    jet wide[3][4], centre[3][4];
} orbit_rows;
void orbit_take_rows(const orbit *o, const double v[3], orbit_rows *to);

/* The numbers v.n[m] s[k] of a shape s[0] + cos B s[1] + sin B s[2], or s[0] alone, as jets of its
 * u, v and t. */
typedef struct orbit_parts {
    int turns, circles; /* 3 or 1 */
    jet at[3][CIRCLE_PARTS];
} orbit_parts;
void orbit_take_parts(const jet rows[][4], int turns, const jet s[][3], int circles,
                      orbit_parts *to);

/* What they sum up to at most for all angles A and B. */
jet orbit_reach(const orbit_parts *r);

/* Writes the direction that turns leave as it is, about. False: there is none. */
bool orbit_axis(const orbit *o, double axis[3]);

/* Whether it turns about the line through c along d, about, for a shape of some size. */
bool orbit_is_about(const orbit *o, const double c[3], const double d[3], double size);

/* Writes the middle of the ellipse of a point of the shape at the middle of the times, and a radius
 * of it, about. */
void orbit_points(const orbit *o, const double x[3], double centre[3], double radius[3]);

#endif
