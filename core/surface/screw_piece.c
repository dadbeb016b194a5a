/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/screw_piece.h"

#include <impinge/model.h>

#include "core/surface/region.h"
#include "core/surface/screws.h"

static bool is_claimed(const imp_symmetry *of)
{
    return symmetry_is_screw(of) && (of->is_closed & IMP_SYMMETRY_CLOSED) != 0;
}

bool surface_is_screw_piece(const surface *s)
{
    imp_symmetry of;
    return s->piece_count <= 1 && carried_exactly(s) && surface_symmetry(s, &of) == IMP_STATUS_OK &&
           is_claimed(&of);
}

/* Lemma. The surface has the points at the corners of its domain, like any others, each at the
 * times given within its model's range. Units, products and sums are those of models. */
imp_status screw_piece_measure(const surface *s, const imp_region *times, screw_piece *p,
                               bool *is_one)
{
    imp_model square = imp_num(0), unit[3];
    double lo[3], hi[3];
    *is_one = false;
    imp_status status = surface_symmetry(s, &p->of);
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    if (!is_claimed(&p->of) || s->piece_count > 1 || !carried_exactly(s)) return IMP_STATUS_OK;
    for (int i = 0; i < 3; ++i) square = imp_add(square, imp_sqr(imp_num(p->of.axis[i])));
    const imp_model length = imp_sqrt(square);
    for (int i = 0; i < 3; ++i) unit[i] = imp_div(imp_num(p->of.axis[i]), length);
    p->lead = length.a;
    p->lowest = INFINITY, p->highest = -INFINITY;
    surface_domain(s, lo, hi);
    for (int corner = 0; corner < 4; ++corner) {
        const double u = corner % 2 ? hi[0] : lo[0], v = corner / 2 ? hi[1] : lo[1];
        const imp_region at =
            region_make((double[3]){u, v, times->lo[2]}, (double[3]){u, v, times->hi[2]});
        imp_model x[3];
        status = surface_include_bare(s, &at, x);
        if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
        for (int i = 0; i < 3; ++i) x[i] = imp_shift(x[i], -p->of.center[i]);
        const imp_model height = imp_dot3(unit, x);
        const imp_interval range = imp_model_range(&height);
        if (!(range.lo <= range.hi)) return IMP_STATUS_OK;
        if (range.hi < p->lowest) p->lowest = range.hi;
        if (range.lo > p->highest) p->highest = range.lo;
    }
    *is_one = p->lowest < p->highest;
    return IMP_STATUS_OK;
}
