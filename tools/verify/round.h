/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_ROUND_H
#define TOOLS_VERIFY_ROUND_H

#include "tools/verify/shadow.h"

/* What a surface is round about
 * =============================
 * Of two surfaces that are round about one line or point, such as a shaft in its bore or a ball in
 * its socket, one is farther from it than the other: no axis parts more than a strip of them. */

typedef struct centre {
    bool is_line;
    double c[3], d[3]; /* the line through c along d, or the point c */
    double size;       /* of the surface, about */
} centre;

/* Whether two surfaces are round about nearly the same. */
bool centre_is_shared(const centre *a, const centre *b);

/* Guesses the centre of a piece at time t from normals of it, which all meet the centre. False: it
 * has none, as far as is seen. What is computed from a bad guess costs time only. */
bool centre_guess(memory *known, const place *of, double t, centre *found);

/* Whether a centre that was guessed is nearly where it is at both times `t`, too. */
bool centre_rests(memory *known, const place *of, const double t[2], const centre *at);

/* Whether a box of a surface, over its times, is seen from the centre in directions of which none
 * is within a right angle of all, as far as is sampled: no axis parts it from what is round there.
 */
bool centre_is_amid(memory *known, const centre *from, const place *of, const box3 *where);

/* Makes the aims of both sides from that centre to points beyond, which shall be `apart`, and an
 * upper bound of how much what they bound changes for a unit of length. `where` is the box of
 * either side. */
bool centre_aims(memory *known, const centre *about, const place of[2], const box3 where[2],
                 double apart, aim a[2], double *change_upper);

/* Computes x - c, or (x - c) x d where the centre is a line; and then (x - c).d. */
enum { CENTRE_PARTS = 4 };
void centre_parts(const jet x[3], const centre *about, jet r[CENTRE_PARTS]);

/* Computes what an aim bounds, from those parts: the distance from the centre, with the sign of the
 * aim; of a line by the aim's weights, |(x - c) x d| and (x - c).d. */
jet centre_distance(const jet r[CENTRE_PARTS], const aim *a);

/* Bounds how much that changes from the aim's time to its others, for the points of a box whose
 * distance from the line at that time, times |d|, is at least `least`. INFINITY: it is not known.
 * Precondition: the surface does not move by itself. */
double centre_change_upper(memory *known, const place *of, const box3 *where, const aim *a,
                           double least);

#endif
