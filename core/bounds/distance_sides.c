/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/distance.h"

#include <string.h>

distance_outcome distance_outcome_none(const time_window *window)
{
    return (distance_outcome){*window, false, 0, -1, {0, 0, 0}};
}

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

/* Whether maps turn the surface of the other side further, so that only a slip helps. */
static bool is_turned(const distance_sides *of, int side)
{
    const surface *own = of->node[side]->surface, *other = of->node[!side]->surface;
    const size_t common = surface_common_maps(own, other);
    return surface_map_count(other) - common > of->still_maps[!side];
}

/* What is asked of one side. Models of a node that moves uniformly are as good as those of one moment. */
static imp_code question_of(const distance_sides *of, int side, double clearance,
                            distance_question *q, imp_error *error)
{
    const node *own = of->node[side], *other = of->node[!side];
    *q = (distance_question){own, other, clearance, 0, INFINITY};
    if (!surface_has_symmetry(other->surface)) return IMP_SUCCESS;
    if (own->still == NULL && !is_turned(of, side)) return IMP_SUCCESS;
    const time_window times = pair_times(of->root[side], of->root[!side]);
    float *slip = &of->slip[side];
    q->moment = 0.5 * times.lo + 0.5 * times.hi;
    if (*slip == 0) {
        double found;
        const imp_code code =
            find_slip(of->root[side], of->root[!side], &times, q->moment, &found, error);
        if (code != IMP_SUCCESS) return code;
        *slip = nextafterf((float)found, INFINITY);
    }
    q->slip = *slip;
    return IMP_SUCCESS;
}

/* Lemma. The nodes' points are points of their whole surfaces: the distance of one node's points from all of
 * the other surface is no greater than that of the two nodes. Each side cuts what the other has left. */
imp_code distance_cut_sides(const distance_sides *of, double clearance, distance_outcome *seen,
                            imp_error *error)
{
    for (int side = 0; side < 2 && !seen->is_apart && seen->side < 0; ++side) {
        distance_view view;
        if (!distance_is_known(of->node[side], of->node[!side])) continue;
        distance_question asked;
        imp_code code = question_of(of, side, clearance, &asked, error);
        if (code != IMP_SUCCESS) return code;
        if (!distance_slides(&asked) && is_turned(of, side)) continue;
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
