/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/base/rounding.h"
#include "core/surface/region.h"
#include "core/surface/screw_piece.h"
#include "core/surface/screws.h"

/* Bounds heights along q's line, from its center, of a's points at the moment: from `middle` up
 * and down by `half`. Lemma. a's maps take y to x(m) + Q (y - m), Q an exact rotation, so that
 * n.(x(y) - c) is n.(x(m) - c) and at most the sum of |n.Q e_i| |y_i - m_i| besides. */
static imp_status heights_of(const surface *a, const imp_model bare[3], const feature *q,
                             const imp_region *then, imp_interval *middle, double *half)
{
    carried m = {.off = 0};
    imp_model turn[3][3], spread[3], axis[3];
    const double length = feature_inverse_length(&q->of);
    for (int i = 0; i < 3; ++i) {
        const double at = 0.5 * bare[i].lo + 0.5 * bare[i].hi;
        m.at[i] = imp_num(at);
        spread[i] = imp_sub(imp_between(bare[i].lo, bare[i].hi), imp_num(at));
        axis[i] = imp_scale(q->axis[i], length);
        for (int j = 0; j < 3; ++j) turn[i][j] = imp_num(i == j);
    }
    const imp_status status = carried_through(a, then, &m, 3, turn);
    if (status != IMP_STATUS_OK) return status;
    imp_model way[3];
    feature_difference(m.at, q->center, way);
    const imp_model height = imp_dot3(axis, way);
    *middle = imp_model_range(&height);
    *half = m.off;
    for (int i = 0; i < 3; ++i) {
        const imp_model part = imp_mul(imp_dot3(axis, turn[i]), spread[i]);
        *half = sum_upper(*half, imp_interval_mag(imp_model_range(&part)));
    }
    return IMP_STATUS_OK;
}

/* Lemma. Let b be the piece, and let a move along it by its screw motions but for `slip`: for each
 * y of a there is one, S, such that S^-1 M(t) y is within `slip` of M(t0) y (slip_screw.c). Let x
 * on b be within d of M(t) y. S^-1 x is as far from S^-1 M(t) y, so that its height is within d +
 * slip of that of M(t0) y. If b reaches that far, b holds S^-1 x but for what is loose, within |x -
 * M(t) y| + slip of M(t0) y. The pad covers the sums: two for either height, two more. */
PAD_COVERS(64, 2 + 2);
static imp_status rest_along(const surface *a, const surface *b, const imp_model bare_a[3],
                             const imp_model bare_b[3], const screw_rest_times *at,
                             screw_rest *rest)
{
    const imp_region *times = at->times,
                     then = region_make((double[3]){times->lo[0], times->lo[1], at->moment},
                                        (double[3]){times->hi[0], times->hi[1], at->moment});
    screw_piece p;
    bool is_one;
    feature line;
    imp_interval middle;
    double half = 0, slip = INFINITY;
    imp_status status = screw_piece_measure(b, times, &p, &is_one);
    if (status != IMP_STATUS_OK || !is_one) return status;
    status = surface_slip(a, b, bare_a, times, at->moment, at->enough, &slip);
    if (status != IMP_STATUS_OK || !(slip < INFINITY)) return status;
    status = feature_carry(b, &p.of, &then, &line);
    if (status == IMP_STATUS_OK) status = heights_of(a, bare_a, &line, &then, &middle, &half);
    if (status != IMP_STATUS_OK) return status;
    imp_model way[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_shift(bare_b[i], -p.of.center[i]);
    const double above = p.highest - (middle.hi + half), below = middle.lo - half - p.lowest;
    const double size = fabs(p.lowest) + fabs(p.highest) + imp_interval_mag(middle) + half;
    rest->near = (above < below ? above : below) - slip - 64 * UNIT_ROUNDOFF * size;
    const double loose = screw_loose_upper(surface_size_upper(way), p.lead);
    if (rest->near > 0) rest->slip = sum_upper(slip, loose);
    return IMP_STATUS_OK;
}

imp_status surface_screw_rest(const surface *const s[2], const imp_model bare[2][3],
                              const screw_rest_times *at, screw_rest *rest, int *asked)
{
    *rest = (screw_rest){.slip = INFINITY};
    for (int k = 0; k < 2 && !(rest->slip < INFINITY); ++k) {
        *asked = k;
        const imp_status status = rest_along(s[!k], s[k], bare[!k], bare[k], at, rest);
        if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) return status;
    }
    return IMP_STATUS_OK;
}
