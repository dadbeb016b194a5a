/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/half_plane.h"

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/feature.h"

bool surface_may_have_half_plane(const surface *s)
{
    return surface_has_symmetry(s) && carried_exactly(s);
}

/* --- The half plane --------------------------------------------------------------------------- */

/* A surface is often cut along planes of coordinates. Nodes on both sides would touch a half plane
 * that lies in one, and more of them one that stands oblique to their rows. */
#define OBLIQUE 0x1p-6

/* k and e: two directions of length 1, about, which together with the line's are about orthogonal.
 * The half plane is that of e. */
static void choose_directions(const feature *line, double k[3], double e[3])
{
    const double length = feature_inverse_length(&line->of);
    double n[3], p[3], size = 0;
    int least = 0;
    for (int i = 0; i < 3; ++i) n[i] = line->axis[i].a * length;
    for (int i = 1; i < 3; ++i)
        if (fabs(n[i]) < fabs(n[least])) least = i;
    for (int i = 0; i < 3; ++i) p[i] = (i == least) - n[i] * n[least];
    for (int i = 0; i < 3; ++i) size += p[i] * p[i];
    size = 1 / sqrt(size);
    for (int i = 0; i < 3; ++i) p[i] *= size;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        const double q = n[j] * p[l] - n[l] * p[j];
        e[i] = p[i] + OBLIQUE * q;
        k[i] = q - OBLIQUE * p[i];
    }
}

static imp_model times_number(const double k[3], const imp_model x[3])
{
    const imp_model numbers[3] = {imp_num(k[0]), imp_num(k[1]), imp_num(k[2])};
    return imp_dot3(numbers, x);
}

static double greatest(const double k[3], const imp_model x[3])
{
    const imp_model product = times_number(k, x);
    return imp_interval_mag(imp_model_range(&product));
}

/* What a half plane's points on a surface satisfy. Lemma. Let the line go through c along the unit
 * vector n, K >= |k.n|, L >= |e.n|, L <= 1/4, M >= |k.e|, and e' = e - (e.n) n, so that |e'| >= 1/2
 * where |e|^2 >= 5/16. A point x of the half plane of e with |x - c| <= R is c + h n + b e' / |e'|,
 * |h| <= R, 0 <= b <= R. So
 *
 *   |k.(x - c)| = |h k.n + b (k.e - (e.n)(k.n)) / |e'|| <= R (K + 2 (M + L K)),
 *   e.(x - c) = h e.n + b |e'| >= -R L.
 *
 * Of a point within s of such an x, less than 2 s more, as |k|, |e| < 2. Roundings: those of the
 * inverse length 8, products and sums of non-negative numbers, 8 at most. */
PAD_COVERS(32, 8 + 8);
bool half_plane_hold(const feature *line, double reach, double s, half_plane *h)
{
    double k[3], e[3];
    imp_model direction[3];
    choose_directions(line, k, e);
    const double length = feature_inverse_length(&line->of);
    for (int i = 0; i < 3; ++i) direction[i] = imp_num(e[i]);
    const double off_k = greatest(k, line->axis) * length + AXES_OFF,
                 off_e = greatest(e, line->axis) * length + AXES_OFF, both = greatest(k, direction);
    const double square_k = k[0] * k[0] + k[1] * k[1] + k[2] * k[2],
                 square_e = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
    if (!(off_e <= 0.125 && square_e >= 0.5 && square_e <= 2 && square_k <= 2)) return false;
    const double room = padded_upper(reach * (off_k + 2 * (both + off_e * off_k)) + 2 * s, 32);
    const double behind = padded_upper(reach * off_e + 2 * s, 32);
    const imp_model across = times_number(k, line->center), along = times_number(e, line->center);
    const imp_interval c = imp_model_range(&across), a = imp_model_range(&along);
    memcpy(h->across, k, sizeof k);
    memcpy(h->along, e, sizeof e);
    h->across_lo = difference_lower(c.lo, room);
    h->across_hi = sum_upper(c.hi, room);
    h->along_lo = difference_lower(a.lo, behind);
    memset(h->up, 0, sizeof h->up);
    h->height_lo = -INFINITY;
    h->height_hi = INFINITY;
    return h->across_lo > -INFINITY && h->across_hi < INFINITY && h->along_lo > -INFINITY;
}

/* --- Two surfaces ----------------------------------------------------------------------------- */

/* Lemma. At one time let F be a rigid motion that takes the line or center of b's closed symmetry
 * to a's line L, and moves no point of b farther than s; x a point of a and y one of b. Some
 * rotation about L takes x to x' of the half plane, and another F y to z of it. x' belongs to a, z
 * to F b, and y' = F^-1 z to b, within s of z. Points of one half plane are the nearest of their
 * circles about L: |x' - z| <= |x - F y|. So |x' - y'| <= |x - y| + 2 s. F turns about b's center
 * c_b by the angle between the axes, by at most |y - c_b| |n_a - n_b|, and shifts by how far c_b is
 * from L. Roundings: product, sum.
 *
 * Where a and b are closed but for slacks d and e, x' and z are within these of points x'' of a and
 * F y'' of F b, so that y'' is within s + e of z, and |x'' - y''| <= |x - y| + 2 s + d + e: those
 * points are kept that are within d, or s + e, of one of the half plane. */
PAD_COVERS(16, 1 + 1);
static double slip_upper(const feature *a, const feature *b, const double lo[3], const double hi[3])
{
    double d = 0, angle = 0;
    feature_compare_lines(a, b, &d, &angle);
    if (b->of.kind == IMP_SYMMETRY_ABOUT_POINT) return d;
    return padded_upper(feature_reach_upper(lo, hi, b->center) * angle + d, 16);
}

imp_status surface_half_plane(const surface *const s[2], const half_plane_boxes *boxes,
                              const imp_region *times, half_plane of[2], double *slip, int *asked)
{
    imp_symmetry found[2];
    feature f[2];
    *slip = INFINITY;
    for (int k = 0; k < 4; ++k) {
        *asked = k % 2;
        const imp_status status = k < 2 ? surface_closed_symmetry(s[k], true, &found[k])
                                        : feature_carry(s[k - 2], &found[k - 2], times, &f[k - 2]);
        if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
        if (k == 1 && found[0].kind != IMP_SYMMETRY_ABOUT_LINE &&
            found[1].kind != IMP_SYMMETRY_ABOUT_LINE)
            return IMP_STATUS_OK;
    }
    const int a = found[0].kind == IMP_SYMMETRY_ABOUT_LINE ? 0 : 1;
    const double way = slip_upper(&f[a], &f[!a], boxes->lo[!a], boxes->hi[!a]);
    double slack[2];
    for (int k = 0; k < 2; ++k) {
        slack[k] = symmetry_slack_upper(&found[k], boxes->lo[k], boxes->hi[k]);
        const double reach = feature_reach_upper(boxes->lo[k], boxes->hi[k], f[a].center);
        const double more = k == a ? slack[k] : sum_upper(way, slack[k]);
        if (!half_plane_hold(&f[a], sum_upper(reach, more), more, &of[k])) return IMP_STATUS_OK;
    }
    if (way >= 0) *slip = sum_upper(2 * way, sum_upper(slack[0], slack[1]));
    return IMP_STATUS_OK;
}
