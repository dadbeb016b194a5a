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
} centre;

/* Guesses the centre of a piece at time t: its normals all meet there. False: no centre was found.
 * A bad guess costs time and proves nothing false. */
bool centre_guess(kept *memory, const place *of, double t, centre *found);

/* Makes the aims of both sides from that centre to points beyond, and an upper bound of how much
 * the distance from it changes for a unit of length. `where` is the box of either side. */
bool centre_aims(kept *memory, const centre *about, const place of[2], const box3 where[2],
                 aim a[2], double *change_upper);

/* The distance from a centre, times |d| if that is a line, with the sign of the aim. */
jet centre_distance(const jet x[3], const aim *a);

#endif
