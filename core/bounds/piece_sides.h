/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_PIECE_SIDES_H
#define CORE_BOUNDS_PIECE_SIDES_H

#include "core/bounds/distance.h"
#include "core/surface/course.h"

/* Surfaces of many pieces, parted piece by piece from all of another
 * ==================================================================
 * A mesh in a mesh that is alike, a shaft of flat sides in its bore, a lid on its box: each piece
 * has many neighbours on the other surface, but some plane has the piece on one side and all of the
 * other surface on the other: that of the piece, or one that GJK finds, as at the ends of a tube.
 * Or the other surface, or a piece of it, is round about the line about which the pieces turn, and
 * tells how far a piece is by how far it is from that line. Where the one moves as the other sees
 * it by a shift, or turns about a line by any angle (surface_course), that holds at all times at
 * once. */

/* The most pieces of a surface for which it is tried. */
enum { PIECES_MOST = 2048 };

/* A piece, or a part of one, before its last maps: each of its points is within `slack` of
 *
 *   sum over k of w_k (corner[k] + radius[k] e_k),   w_k >= 0, of sum 1,
 *
 * e_k unit vectors across the axis. Of a hoop, which is round about a line, the corners are on the
 * line; else the radii are 0. */
typedef struct piece_cell {
    vec3 corner[4], axis; /* |axis| is within 8 u of 1, if it is a hoop */
    double radius[4], slack;
    bool is_hoop;
} piece_cell;

/* Makes the cell, no hoop, of a part of a surface that has these models. False: it moves, or has no
 * bounds. */
bool piece_cell_of(const imp_model x[3], piece_cell *cell);

/* Cells of all pieces of a surface. */
typedef struct piece_corners {
    arena_store *store; /* of its memory; NULL: the heap */
    piece_cell *of;
    size_t *piece; /* of each cell, in ascending order */
    size_t count;
    double slack; /* besides that of the cells; length */
    double reach; /* >= |x| + radius + its cell's slack of each corner; length */
} piece_corners;  /* piece_corners_clear frees */

/* Takes all pieces, or at most `most` of them, spread over all, in memory of the store. *known
 * false: pieces move by themselves, or have no bounds over the times. */
imp_code piece_corners_take(const surface *s, const time_window *times, size_t most,
                            arena_store *store, piece_corners *corners, bool *known,
                            imp_error *error);
void piece_corners_clear(piece_corners *corners);

/* Nearly the point lowest along n, of any length, of a circle about an axis; its center, if the
 * circle is across n. */
vec3 piece_circle_lowest(vec3 center, vec3 axis, double radius, vec3 n);

/* The two surfaces, b's points at all times as a sees them. */
typedef struct piece_course {
    const surface *a, *b;
    const piece_corners *own, *other; /* of a and b */
    surface_course course;
    imp_region times; /* of the course */
} piece_course;

/* What was found. */
typedef struct piece_view {
    bool is_apart;    /* farther than gamma_clear during the whole window */
    time_window left; /* of the window; outside, they are farther apart than gamma_clear */
    double lower;     /* bound of the distance over the window, or 0; length */
    piece_hint hint;  /* where it is that bound */
} piece_view;

/* What is left of a window by several pieces is what any of them leaves. */
void piece_view_join(piece_view *all, const piece_view *one);

/* Whether nothing is shown that the window did not. */
bool piece_view_is_useless(const piece_view *view, const time_window *window);

/* By planes that part one of a's pieces each from all of b, or by what round pieces know.
 * IMP_ERROR_MEMORY, IMP_ERROR_PLUGIN. */
imp_code piece_planes_cut(const piece_course *of, double gamma_clear, const time_window *window,
                          piece_view *view, imp_error *error);

/* By the distance of `own`, a piece of a, from circles that hold all points of a piece of b at all
 * times. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code piece_rings_cut(const piece_course *of, const surface *own, double gamma_clear,
                         const time_window *window, piece_view *view, imp_error *error);

/* Like piece_rings_cut, where `own` is a ball (surface_ball), by how far its center is from the
 * circles. */
imp_code piece_ball_cut(const piece_course *of, const surface *own, double gamma_clear,
                        const time_window *window, piece_view *view, imp_error *error);

/* Tries both surfaces of a pair of roots, one of which has many pieces, unless that was tried in a
 * search with this bit, and adds what they show to *seen. IMP_ERROR_PLUGIN, IMP_ERROR_MEMORY. */
imp_code piece_sides_cut(const distance_sides *of, unsigned search, double gamma_clear,
                         distance_outcome *seen, imp_error *error);

#endif
