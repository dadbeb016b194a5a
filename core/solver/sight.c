/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/sight.h"

#include <string.h>

sight sight_none(const pair *p) { return (sight){p->window, false, 0, -1, {0, 0, 0}}; }

/* Lemma. The nodes' points are points of their whole surfaces: the distance of one node's points from all of
 * the other surface is no greater than that of the two nodes. Each side cuts what the other has left. */
imp_code sight_take(const pair *p, const candidate_pair *both, double clearance, sight *seen,
                    imp_error *error)
{
    for (int side = 0; side < 2 && !seen->is_apart && seen->side < 0; ++side) {
        const node *own = side == 0 ? p->a : p->b, *other = side == 0 ? p->b : p->a;
        distance_view view;
        if (!distance_is_known(own, other, both->side[!side]->still_maps)) continue;
        const imp_code code = distance_cut(own, other, clearance, &seen->left, &view, error);
        if (code != IMP_SUCCESS) return code;
        seen->is_apart = view.is_apart;
        if (view.lower > seen->lower) seen->lower = view.lower;
        if (!view.is_promising) continue;
        seen->side = side;
        memcpy(seen->bend, view.bend, sizeof seen->bend);
    }
    return IMP_SUCCESS;
}
