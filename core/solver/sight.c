/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/sight.h"

#include <string.h>

sight sight_none(const pair *p) { return (sight){p->window, false, 0, -1, {0, 0, 0}}; }

/* Of the one along the other, over all times of both; INFINITY: nothing is known, as of surfaces of many
 * pieces, of which each has its own. */
static imp_code find_slip(const node *own, const node *other, const time_window *times,
                          double moment, double *slip, imp_error *error)
{
    imp_model bare[3];
    *slip = INFINITY;
    if (own->many != NULL || other->many != NULL) return IMP_SUCCESS;
    if (surface_include_bare(own->surface, &own->region, bare) != IMP_OK) return IMP_SUCCESS;
    for (int i = 0; i < 3; ++i)
        if ((bare[i].depends >> PARAMETER_T & 1) != 0) return IMP_SUCCESS; /* it moves by itself */
    const imp_region all = region_make((double[3]){0, 0, times->lo}, (double[3]){0, 0, times->hi});
    const imp_status status = surface_slip(own->surface, other->surface, bare, &all, moment, slip);
    if (status == IMP_OK) return IMP_SUCCESS;
    surface_fault(other->surface, error, ": %s", surface_status_told(other->surface, status).text);
    return surface_set_code(status, error);
}

/* Whether maps turn the other node's surface further, so that only a slip helps. */
static bool is_turned(const node *own, const node *other, const candidate *of_other)
{
    const size_t common = surface_common_maps(own->surface, other->surface);
    return surface_map_count(other->surface) - common > of_other->still_maps;
}

/* What is asked of one side. Models of a node that moves uniformly are as good as those of one moment. */
static imp_code question_of(const pair *p, candidate_pair *both, int side, double clearance,
                            distance_question *q, imp_error *error)
{
    const node *own = side == 0 ? p->a : p->b, *other = side == 0 ? p->b : p->a;
    *q = (distance_question){own, other, clearance, 0, INFINITY};
    if (!surface_has_symmetry(other->surface)) return IMP_SUCCESS;
    if (own->still == NULL && !is_turned(own, other, both->side[!side])) return IMP_SUCCESS;
    const node *root = tree_root(both->side[side]->tree),
               *others = tree_root(both->side[!side]->tree);
    const time_window times = pair_times(root, others);
    float *slip = &both->slip[side];
    q->moment = 0.5 * times.lo + 0.5 * times.hi;
    if (*slip == 0) {
        double found;
        const imp_code code = find_slip(root, others, &times, q->moment, &found, error);
        if (code != IMP_SUCCESS) return code;
        *slip = nextafterf((float)found, INFINITY);
    }
    q->slip = *slip;
    return IMP_SUCCESS;
}

/* Lemma. The nodes' points are points of their whole surfaces: the distance of one node's points from all of
 * the other surface is no greater than that of the two nodes. Each side cuts what the other has left. */
imp_code sight_take(const pair *p, candidate_pair *both, double clearance, sight *seen,
                    imp_error *error)
{
    for (int side = 0; side < 2 && !seen->is_apart && seen->side < 0; ++side) {
        const node *own = side == 0 ? p->a : p->b, *other = side == 0 ? p->b : p->a;
        distance_view view;
        if (!distance_is_known(own, other)) continue;
        distance_question asked;
        imp_code code = question_of(p, both, side, clearance, &asked, error);
        if (code != IMP_SUCCESS) return code;
        if (!distance_slides(&asked) && is_turned(own, other, both->side[!side])) continue;
        code = distance_cut(&asked, &seen->left, &view, error);
        if (code != IMP_SUCCESS) return code;
        seen->is_apart = view.is_apart;
        if (view.lower > seen->lower) seen->lower = view.lower;
        if (!view.is_promising) continue;
        seen->side = side;
        memcpy(seen->bend, view.bend, sizeof seen->bend);
    }
    return IMP_SUCCESS;
}
