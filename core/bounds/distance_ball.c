/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/distance.h"

#include "core/base/rounding.h"

/* Bounds in q->slip how far the center slides along the other surface, found once for each
 * candidate pair. Pieces have centers of their own: nothing is kept of theirs, and they are asked
 * for all times only. */
static imp_code add_slip(const distance_sides *of, int side, distance_question *q, imp_error *error)
{
    const bool is_piece = of->root[0]->many != NULL || of->root[1]->many != NULL;
    const time_window times = pair_times(of->root[0], of->root[1]);
    const imp_region *r = &q->a->region;
    if (is_piece && (r->lo[2] > times.lo || r->hi[2] < times.hi)) return IMP_SUCCESS;
    const imp_region all = window_region(&times);
    float *known = &of->slips->ball[side];
    q->moment = 0.5 * times.lo + 0.5 * times.hi;
    if (is_piece || *known == 0) {
        double found;
        const imp_status status = surface_ball_slip(q->a->surface, q->b->surface, &all, q->moment,
                                                    distance_slip_enough(q->gamma_clear), &found);
        if (status != IMP_STATUS_OK) return distance_fault(q->b->surface, status, error);
        q->slip = float_upper(found);
        if (!is_piece) *known = (float)q->slip;
    } else {
        q->slip = *known;
    }
    if (!distance_slides(q)) q->slip = INFINITY;
    return IMP_SUCCESS;
}

/* Lemma. Each point x of the ball is within its radius of its center c, so that |x - y| >= |c - y|
 * - radius for each y of the other surface, whose type bounds |c - y|: at all times if the center
 * slides within its symmetry, or its maps do not turn it (distance_cut). */
imp_code distance_cut_ball(const distance_sides *of, int side, double gamma_clear,
                           time_window *window, distance_view *view, imp_error *error)
{
    const node *own = of->node[side], *other = of->node[!side];
    imp_model center[3];
    distance_question q = {.a = own,
                           .b = other,
                           .gamma_clear = gamma_clear,
                           .slip = INFINITY,
                           .is_ball = true,
                           .seeks_contact = of->seeks_contact,
                           .is_audited = of->is_audited};
    *view = distance_view_none(own);
    if (!of->takes_orbits || other->many != NULL || !surface_is_whole(own->surface, &own->region))
        return IMP_SUCCESS;
    if (!surface_has_distance(other->surface)) return IMP_SUCCESS;
    if (surface_common_maps(own->surface, other->surface) > 0) return IMP_SUCCESS;
    const imp_status status = surface_ball(own->surface, &own->region, center, &q.radius);
    if (status != IMP_STATUS_OK) return distance_fault(own->surface, status, error);
    if (!(q.radius < INFINITY)) return IMP_SUCCESS;
    if (surface_has_symmetry(other->surface)) {
        const imp_code code = add_slip(of, side, &q, error);
        if (code != IMP_SUCCESS) return code;
    }
    if (!distance_slides(&q) && distance_is_turned(of, side)) return IMP_SUCCESS;
    const imp_code code = distance_cut(&q, window, view, error);
    if (code != IMP_SUCCESS || !of->seeks_start || view->is_apart || distance_slides(&q))
        return code;
    view->has_start = true;
    return distance_cut_start(&q, window, &view->is_apart, error);
}
