/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_GLANCE_H
#define CORE_SURFACE_GLANCE_H

#include "core/surface/surface.h"

/* A glance at a surface: where it is at a few moments
 * ===================================================
 * Bounds of how surfaces slip along each other cost thousands of operations, and say nothing of
 * most pairs of a large scene, which drift and turn at will. Glances at both surfaces, made once
 * for each, tell these pairs apart. They prove nothing: a wrong answer costs time, or pairs. */

enum { GLANCES = 3 };

typedef struct surface_glance {
    double from, to;         /* the times */
    bool has_middle;         /* else it tells nothing */
    bool is_known;           /* the maps could be evaluated */
    bool is_about;           /* all that its type is closed under are rotations about a point or a
                               line: the symmetry that its distance has */
    bool has_axis;           /* it is closed under rotations about a line */
    double at[GLANCES][3];   /* its middle: of the closed symmetry, if there is one; length */
    double axis[GLANCES][3]; /* unit, where it has one */
} surface_glance;

/* What the middle of a surface is taken from, before its maps. */
typedef struct glance_middle {
    bool is_closed;      /* by `closed`, whose center it is */
    imp_symmetry closed; /* each of its rotations keeps the surface */
    double point[3];     /* where not: to be set to any point that the surface carries */
} glance_middle;

/* Finds whether a closed symmetry tells the middle. A status other than OK: its type broke the
 * ABI. */
imp_status surface_find_middle(const surface *s, glance_middle *found);

/* Glances at the surface from one time to another. */
void surface_glance_at(const surface *s, const glance_middle *middle, double from, double to,
                       surface_glance *g);

/* Whether two surfaces surely do not only turn within themselves: as long as they do, their middles
 * are always as far apart. */
bool glances_part(const surface_glance *a, const surface_glance *b);

/* Half of how much the distance of two middles varies: no greater than surface_slip along b if b
 * `is_about`, up to rounding. */
double glances_vary(const surface_glance *a, const surface_glance *b);

/* Half of how much its axis turns; 0 if it has none. The slip of surface_carry_slip is no less than
 * this times the distance of a point from the middle, up to rounding. */
double glance_turns(const surface_glance *g);

/* Whether b's middle is surely farther than `most` from a's line at the first time. */
bool glances_are_off_line(const surface_glance *a, const surface_glance *b, double most);

#endif
