/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_PIECE_PLANES_H
#define CORE_BOUNDS_PIECE_PLANES_H

#include "core/bounds/piece_shadow.h"

/* Planes that part cells of one surface from all that another sweeps
 * ================================================================== */

/* Tries planes across one cell, then the one that GJK finds, and adds to *one what they show of the
 * cell's distance. */
void piece_planes_of_cell(const piece_course *of, const piece_shadow *s, const piece_cell *cell,
                          double gamma_clear, piece_view *one);

/* Tries one plane for all of a: of few pieces that of the one which is farthest from b if all of a
 * is behind it, since side pieces of a convex body have no plane of their own that parts them from
 * what is in front of another; else that which GJK finds. Adds what it shows to *all. */
void piece_planes_of_all(const piece_course *of, const piece_shadow *s, double gamma_clear,
                         const time_window *window, piece_view *all);

#endif
