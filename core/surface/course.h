/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_COURSE_H
#define CORE_SURFACE_COURSE_H

#include "core/surface/surface.h"

/* How one surface moves as seen from another, where that is simple
 * ================================================================
 * A point y of b, before b's last maps, is at each time t of the course, in the coordinates of a
 * before a's last maps, within `off` of
 *
 *   S(t) (turn y + shift) + way(t) + x(t),
 *
 * where S(t) is a rotation about the line through `center` along `axis`, by any angle, if the
 * course spins, and the identity else; x(t) is across the axis and no longer than `wander`, which
 * is 0 unless b slides across the line about which it turns. All distances at t are those of the
 * scene. The last maps are all after the first surface_inner_maps, and exact rotations and
 * shifts. */
typedef struct surface_course {
    bool is_known; /* else nothing holds */
    bool spins;    /* `way` is then along the axis */
    double turn[3][3], shift[3];
    double center[3], axis[3]; /* |axis| is within 8 u of 1 */
    imp_model way[3];          /* over the times of the course */
    double off, wander;        /* length */
} surface_course;

/* Counts the maps up to the last one that is no exact rotation or shift. */
size_t surface_inner_maps(const surface *s);

/* Finds the course of b as a sees it. `bare` holds models of b before its last maps, of which only
 * the ranges are used; neither surface moves by itself. The moment is one of the times. */
imp_status surface_course_of(const surface *a, const surface *b, const imp_model bare[3],
                             const imp_region *times, double moment, surface_course *course);

/* Finds a line, |axis| within 8 u of 1, rotations about which change no distance that s's type
 * claims: if those about all lines through a point do, that along the course's axis. */
imp_status surface_line_of(const surface *s, const surface_course *course, double center[3],
                           double axis[3], bool *has);

#endif
