/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/feature.h"
#include "core/surface/region.h"

/* What a symmetry makes of motion and of whole orbits. All maps here are exact rotations and
 * shifts; other motions are not bounded. */

enum { ORBITS = IMP_SYMMETRY_ORBIT_U | IMP_SYMMETRY_ORBIT_V | IMP_SYMMETRY_ORBIT_ALL };

static imp_region at_moment(double moment)
{
    return region_make((double[3]){0, 0, moment}, (double[3]){0, 0, moment});
}

static bool are_finite(const imp_model x[3])
{
    for (int i = 0; i < 3; ++i)
        if (!(x[i].e < INFINITY && x[i].lo > -INFINITY && x[i].hi < INFINITY)) return false;
    return true;
}

/* --- Motion of the center alone --------------------------------------------------------------- */

/* Center and axis at the times of carry_base, or before all maps. */
static imp_status base_of(const surface *b, const imp_symmetry *of, const carry_base *base,
                          feature *f)
{
    const surface bare = {.map_count = 0};
    const imp_region at = at_moment(base->is_bare ? 0 : base->moment);
    return feature_carry(base->is_bare ? &bare : b, of, &at, f);
}

/* Lemma. Let M(t) be what b's maps do, and M0 what they do at the moment, or 1; c(t) and n(t) the
 * images of the symmetry's center and unit axis under M(t), c0 and n0 those under M0; T the shift
 * by c(t) - c0; Q the smallest rotation about c(t) that takes n0 to n(t), or 1 of a ball. S =
 * M(t)^-1 Q T M0 leaves the center where it is and the axis its direction: it is a motion of the
 * symmetry. As M(t)^-1 x = S M0^-1 T^-1 Q^-1 x, what b's type claims of all points within |Q^-1 x -
 * x| <= |x - c(t)| |n(t) - n0| of x - (c(t) - c0), taken back by M0, holds for x at t. Roundings: 8
 * of the inverse length, product, sum, product. */
PAD_COVERS(16, 8 + 1 + 1 + 1);
static imp_status slip_from(const surface *b, const feature *now, const double lo[3],
                            const double hi[3], const carry_base *base, double *slip)
{
    feature then;
    imp_model turn[3];
    *slip = INFINITY;
    const imp_status status = base_of(b, &now->of, base, &then);
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    if (!are_finite(now->center)) return IMP_STATUS_OK;
    if (now->of.kind == IMP_SYMMETRY_ABOUT_POINT) return *slip = 0, IMP_STATUS_OK;
    if (symmetry_is_screw(&now->of)) return IMP_STATUS_OK; /* S may turn without moving along */
    feature_difference(now->axis, then.axis, turn);
    const double angle = surface_size_upper(turn) * feature_inverse_length(&now->of) + AXES_OFF;
    const double most = padded_upper(angle * feature_reach_upper(lo, hi, now->center), 16);
    if (most >= 0) *slip = most;
    return IMP_STATUS_OK;
}

/* Finds center and axis at the times. *known false: they are not, or move in another way. */
static imp_status carry_at(const surface *b, const imp_region *times, feature *now, bool *known)
{
    imp_symmetry found;
    *known = false;
    if (!carried_exactly(b)) return IMP_STATUS_OK;
    imp_status status = surface_symmetry(b, &found);
    if (status == IMP_STATUS_OK) status = feature_carry(b, &found, times, now);
    *known = status == IMP_STATUS_OK;
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

imp_status surface_carry_slip(const surface *b, const double lo[3], const double hi[3],
                              const imp_region *times, const carry_base *base, double *slip)
{
    feature now;
    bool known;
    *slip = INFINITY;
    const imp_status status = carry_at(b, times, &now, &known);
    return known ? slip_from(b, &now, lo, hi, base, slip) : status;
}

imp_status surface_carry_slip_least(const surface *b, const double lo[3], const double hi[3],
                                    const imp_region *times, double moment, double mere,
                                    bool *is_bare, double *slip)
{
    feature now;
    bool known;
    carry_base base = {moment, true};
    *is_bare = false;
    *slip = INFINITY;
    imp_status status = carry_at(b, times, &now, &known);
    if (!known) return status;
    status = slip_from(b, &now, lo, hi, &base, slip);
    *is_bare = *slip <= mere;
    base.is_bare = false;
    return *is_bare || status != IMP_STATUS_OK ? status : slip_from(b, &now, lo, hi, &base, slip);
}

imp_status surface_carry_way(const surface *b, const imp_region *region, const carry_base *base,
                             imp_model way[3])
{
    imp_symmetry found;
    feature now, then;
    imp_status status = surface_symmetry(b, &found);
    if (status == IMP_STATUS_OK) status = feature_carry(b, &found, region, &now);
    if (status == IMP_STATUS_OK) status = base_of(b, &found, base, &then);
    if (status != IMP_STATUS_OK) return status;
    feature_difference(now.center, then.center, way);
    return are_finite(way) ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

/* --- Orbits ----------------------------------------------------------------------------------- */

/* Lemma. Let S be a rotation about a's line, or about a's center, and F a rigid motion that takes
 * b's line to a's, or b's center to a's: then S' = F^-1 S F is a rotation about b's line or center,
 * a motion of b's symmetry. If F moves no point y in question farther than s,
 *
 *   |S x - S' x| <= |F S' F^-1 x - S' F^-1 x| + |S' F^-1 x - S' x| <= 2 s,
 *
 * so that what b's type claims of all points within 2 s of x holds for S x. Two lines: F turns
 * about b's center c by the angle between the two, which moves y by |y - c| |n_a - n_b| at most,
 * and shifts by the distance d of a's line from c; |F^-1 x - c| <= |x - c| + d. A ball has lines of
 * all directions; across a line all lines of its direction are as good, also the one through a's
 * center. Roundings: sums and products of non-negative numbers, 6 at most.
 *
 * Where points of an orbit are taken to each other but for a slack d, x stands for all points
 * within d of such an S x: what is claimed of all within 2 s + d of x holds for them. */
PAD_COVERS(16, 6);
static double orbit_slip_upper(const feature *a, const feature *b, const double lo[3],
                               const double hi[3])
{
    double d = 0, angle = 0, s;
    feature_compare_lines(a, b, &d, &angle);
    if (b->of.kind == IMP_SYMMETRY_ABOUT_POINT)
        s = d;
    else if (b->of.kind == IMP_SYMMETRY_ACROSS_LINE)
        s = feature_reach_upper(lo, hi, a->center) * angle;
    else
        s = (feature_reach_upper(lo, hi, b->center) + d) * angle + d;
    return padded_upper(2 * s, 16);
}

imp_status surface_has_orbits(const surface *s, bool *has)
{
    imp_symmetry found;
    const imp_status status = surface_symmetry(s, &found);
    *has = status == IMP_STATUS_OK && (found.is_closed & ORBITS) != 0;
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

imp_status surface_orbit_slip(const surface *a, const surface *b, const double lo[3],
                              const double hi[3], const imp_region *times, unsigned *held,
                              double *slip)
{
    imp_symmetry own, other;
    feature of_a, of_b;
    *held = 0;
    *slip = INFINITY;
    if (!IMP_OFFERS(a->type, symmetry) || !carried_exactly(a) || !carried_exactly(b))
        return IMP_STATUS_OK;
    imp_status status = surface_symmetry(a, &own);
    if (status == IMP_STATUS_OK && (own.is_closed & ORBITS) == 0) return IMP_STATUS_OK;
    if (status == IMP_STATUS_OK) status = surface_symmetry(b, &other);
    if (status == IMP_STATUS_OK && symmetry_is_screw(&other)) return IMP_STATUS_OK;
    if (status == IMP_STATUS_OK) status = feature_carry(a, &own, times, &of_a);
    if (status == IMP_STATUS_OK) status = feature_carry(b, &other, times, &of_b);
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    const bool all =
        (own.is_closed & IMP_SYMMETRY_ORBIT_ALL) != 0 && other.kind == IMP_SYMMETRY_ABOUT_POINT;
    if (all) {
        imp_model way[3];
        feature_difference(of_a.center, of_b.center, way);
        *slip = padded_upper(2 * surface_size_upper(way), 16);
        *held = 3;
    }
    const unsigned lines = own.is_closed >> 1 & 3;
    if (lines > 0 && !(all && *slip <= 0x1p-40 * feature_reach_upper(lo, hi, of_b.center))) {
        const double along_lines = orbit_slip_upper(&of_a, &of_b, lo, hi);
        if (along_lines < *slip) *slip = along_lines, *held = lines;
    }
    *slip = sum_upper(*slip, symmetry_slack_upper(&own, lo, hi));
    return IMP_STATUS_OK;
}

/* --- Balls ------------------------------------------------------------------------------------ */

/* Lemma. Where all points of the same t are as far from the center (IMP_SYMMETRY_ORBIT_ALL), each
 * is as far from it as the one in the middle of u and v. The type's own models, whose ranges are
 * taken, hold that point at all times of the region. Where distances from the center differ by at
 * most s = IMP_NEARLY_SLACK of the greatest distance of two points, the greatest of them, R, is at
 * most r + 2 s R, r that of the middle: R <= r / (1 - 2 s) <= r (1 + 4 s). */
PAD_COVERS(8, 1 + 1); /* product, sum */
imp_status surface_bare_ball(const surface *s, const imp_region *region, double center[3],
                             double *radius)
{
    imp_symmetry found;
    imp_model x[3];
    double lo[3], hi[3];
    *radius = INFINITY;
    if (!IMP_OFFERS(s->type, symmetry)) return IMP_STATUS_OK;
    imp_status status = surface_symmetry(s, &found);
    if (status == IMP_STATUS_OK && (found.is_closed & IMP_SYMMETRY_ORBIT_ALL) == 0)
        return IMP_STATUS_OK;
    surface_domain(s, lo, hi);
    for (int j = 0; j < 2; ++j) lo[j] = hi[j] = 0.5 * lo[j] + 0.5 * hi[j];
    lo[2] = region->lo[2], hi[2] = region->hi[2];
    const imp_region middle = region_make(lo, hi);
    if (status == IMP_STATUS_OK) status = surface_include_bare(s, &middle, x);
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    for (int i = 0; i < 3; ++i) x[i] = imp_shift(x[i], -found.center[i]);
    memcpy(center, found.center, sizeof found.center);
    if (are_finite(x)) *radius = surface_size_upper(x);
    if ((found.is_closed & IMP_SYMMETRY_NEARLY) != 0)
        *radius = padded_upper(*radius + 4 * IMP_NEARLY_SLACK * *radius, 8);
    return IMP_STATUS_OK;
}

/* Lemma. Exact rotations and shifts keep distances: x, at any time, is within *radius of the center
 * c that the maps carry. So |x - y| >= |c - y| - *radius for each y. */
imp_status surface_ball(const surface *s, const imp_region *region, imp_model center[3],
                        double *radius)
{
    imp_symmetry found;
    feature now;
    double bare[3], most;
    *radius = INFINITY;
    if (!carried_exactly(s)) return IMP_STATUS_OK;
    imp_status status = surface_bare_ball(s, region, bare, &most);
    if (status != IMP_STATUS_OK || !(most < INFINITY)) return status;
    status = surface_symmetry(s, &found);
    if (status == IMP_STATUS_OK) status = feature_carry(s, &found, region, &now);
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    memcpy(center, now.center, sizeof now.center);
    if (are_finite(now.center)) *radius = most;
    return IMP_STATUS_OK;
}

imp_status surface_ball_slip(const surface *a, const surface *b, const imp_region *times,
                             double moment, double enough, double *slip)
{
    imp_symmetry found;
    imp_model bare[3];
    *slip = INFINITY;
    const imp_status status = surface_symmetry(a, &found);
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    for (int i = 0; i < 3; ++i) bare[i] = imp_num(found.center[i]);
    return surface_slip(a, b, bare, times, moment, enough, slip);
}
