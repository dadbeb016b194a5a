/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_DIVIDING_SURFACE_H
#define CORE_BOUNDS_DIVIDING_SURFACE_H

#include "core/bounds/gap_lines.h"
#include "core/bounds/normal_turn.h"

/* Separation by a surface of fourth order
 * =======================================
 * If one node lies above a surface z = h(p) and the other below it, they are apart. Heights above
 * it, f = z - h(p), change no faster than f's gradient is long: so the distance is at least the
 * least f of B less the greatest f of A, over that length. A field of normals (normal_field.h) is
 * the case of a quadratic h; terms of third and fourth order in h take off what the surfaces' own
 * parametrizations leave of these orders (dividing_choice.h), so that nodes need to be as small as
 * the fifth root of the gap instead of its cube root, but for their remainders. */

/* Cuts the range of w to the w at which the surface does not prove the nodes farther apart than
 * gamma_clear. False: none is left. h is chosen from the field's frame and turns; `v` are the
 * slices in that frame. The lower bounds of the distance are added to `lines`, unless NULL. */
bool dividing_surface_cut(const difference *r, const frame *f, const local_view *v, const turns *m,
                          double gamma_clear, w_range *s, gap_lines *lines);

#endif
