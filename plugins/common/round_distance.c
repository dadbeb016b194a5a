/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/round_distance.h"

#include "plugins/common/cone_distance.h"
#include "plugins/common/squares.h"

static imp_model distance_of_kind(const round_profile *p, const imp_model m[3])
{
    const imp_model w[3] = {m[0], m[1], imp_shift(m[2], -p->height)};
    if (p->kind == ROUND_CYLINDER) return beyond_radius(sum_of_squares(m, 2), p->radius);
    if (p->kind == ROUND_PLANE) return w[2];
    if (p->kind == ROUND_CONE) return cone_distance(p->radius, p->apex, w);
    if (p->ring == 0) return beyond_radius(sum_of_squares(w, 3), p->radius);
    const imp_model tube[2] = {imp_shift(imp_sqrt(sum_of_squares(m, 2)), -p->ring), w[2]};
    return beyond_radius(sum_of_squares(tube, 2), p->radius);
}

/* Lemma. Let (q, z) be the distance of a point of space from the axis and its height; two points
 * are at least as far apart as theirs are. Those of the surface are the profile's, or, where it
 * crosses the axis, mirrored there, as planes and circles about points of the axis are. Let (q, z)
 * be D away from the line, half line or circle, of which the profile is within `off`: the surface
 * is at least D - off away. The function above finds a G, |G| <= D. The distance g with the sign of
 * G and |g| = max(|G| - off, 0) is within `off` of G. */
imp_model round_profile_distance(const round_profile *p, const imp_model m[3])
{
    if (p->kind == ROUND_NONE) return imp_unbounded(0);
    const imp_model apart = distance_of_kind(p, m);
    return p->off > 0 ? imp_add(apart, imp_between(-p->off, p->off)) : apart;
}

void round_profile_symmetry(const round_profile *p, imp_symmetry *symmetry)
{
    symmetry->kind = p->kind == ROUND_CYLINDER ? IMP_SYMMETRY_ALONG_LINE
                     : p->kind == ROUND_PLANE  ? IMP_SYMMETRY_ACROSS_LINE
                                               : IMP_SYMMETRY_ABOUT_LINE;
    symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    symmetry->axis[2] = 1;
}
