/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/distance.h"

#include <string.h>

#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"

distance_outcome distance_outcome_none(const time_window *window)
{
    return (distance_outcome){*window, false, 0, -1, {0, 0, 0}};
}

/* Bounds how far one surface slides along the other over their common times: along `plane`, or, if
 * that is NULL, modulo the other's symmetry. INFINITY: no bound is known, as where the other has
 * many pieces, each with its own symmetry. */
static imp_code find_slip(const node *own, const node *other, const surface_plane *plane,
                          const time_window *times, double moment, double *slip, imp_error *error)
{
    imp_model bare[3];
    *slip = INFINITY;
    if ((plane == NULL && other->many != NULL) || !node_bare_models(own, bare)) return IMP_SUCCESS;
    const imp_region all = region_make((double[3]){0, 0, times->lo}, (double[3]){0, 0, times->hi});
    const surface *a = own->surface, *b = other->surface;
    const imp_status status = plane == NULL
                                  ? surface_slip(a, b, bare, &all, moment, slip)
                                  : surface_slip_along(a, b, plane, bare, &all, moment, slip);
    if (status == IMP_STATUS_OK) return IMP_SUCCESS;
    surface_fault(other->surface, error, ": %s", surface_status_told(other->surface, status).text);
    return surface_set_code(status, error);
}

/* Whether maps of the other side rotate its surface, so that distances hold only with a slip. */
static bool is_turned(const distance_sides *of, int side)
{
    const surface *own = of->node[side]->surface, *other = of->node[!side]->surface;
    const size_t common = surface_common_maps(own, other);
    return surface_map_count(other) - common > of->still_maps[!side];
}

/* Fills the input of distance_cut for one side. A node that moves uniformly needs no slip: its
 * models are as tight as those of one moment. */
static imp_code question_of(const distance_sides *of, int side, double gamma_clear,
                            distance_question *q, imp_error *error)
{
    const node *own = of->node[side], *other = of->node[!side];
    *q = (distance_question){own, other, NULL, gamma_clear, 0, INFINITY, of->is_audited};
    if (!surface_has_symmetry(other->surface)) return IMP_SUCCESS;
    if (own->still == NULL && !is_turned(of, side)) return IMP_SUCCESS;
    const time_window times = pair_times(of->root[side], of->root[!side]);
    float *slip = &of->slip[side];
    q->moment = 0.5 * times.lo + 0.5 * times.hi;
    if (*slip == 0) {
        double found;
        const imp_code code =
            find_slip(of->root[side], of->root[!side], NULL, &times, q->moment, &found, error);
        if (code != IMP_SUCCESS) return code;
        *slip = nextafterf((float)found, INFINITY);
    }
    q->slip = *slip;
    return IMP_SUCCESS;
}

/* --- Faces ------------------------------------------------------------------------------------ */

/* Cuts by the distance of one side's points from the plane of the other side's node, along which
 * they slide. */
static imp_code cut_along_face(const distance_sides *of, int side, double gamma_clear,
                               time_window *window, distance_view *view, imp_error *error)
{
    const node *own = of->node[side], *other = of->node[!side];
    surface_plane plane;
    *view = distance_view_none(own);
    if (surface_common_maps(own->surface, other->surface) > 0) return IMP_SUCCESS;
    if (surface_plane_of(other->surface, &other->region, &plane) != IMP_STATUS_OK)
        return IMP_SUCCESS;
    if (!(TUNING_DISTANCE_SLIP * plane.off <= gamma_clear)) return IMP_SUCCESS;
    const time_window times = pair_times(of->root[side], of->root[!side]);
    distance_question q = {
        own, other, &plane, gamma_clear, 0.5 * times.lo + 0.5 * times.hi, INFINITY, of->is_audited};
    const imp_code code =
        find_slip(of->root[side], other, &plane, &times, q.moment, &q.slip, error);
    return code == IMP_SUCCESS && distance_slides(&q) ? distance_cut(&q, window, view, error)
                                                      : code;
}

/* --- Both ------------------------------------------------------------------------------------- */

static imp_code cut_side(const distance_sides *of, int side, double gamma_clear,
                         time_window *window, distance_view *view, imp_error *error)
{
    const node *own = of->node[side], *other = of->node[!side];
    distance_question asked;
    *view = distance_view_none(own);
    if (!distance_is_known(own, other)) {
        if (!strategy_slides_on_face(own, other)) return IMP_SUCCESS;
        return cut_along_face(of, side, gamma_clear, window, view, error);
    }
    const imp_code code = question_of(of, side, gamma_clear, &asked, error);
    if (code != IMP_SUCCESS) return code;
    if (!distance_slides(&asked) && is_turned(of, side)) return IMP_SUCCESS;
    return distance_cut(&asked, window, view, error);
}

/* Lemma. A node's points belong to its whole surface: the distance of one node's points from all of
 * the other surface, or from the plane of its node, is no greater than that of the two nodes. Each
 * side cuts what the other has left. */
imp_code distance_cut_sides(const distance_sides *of, double gamma_clear, distance_outcome *seen,
                            imp_error *error)
{
    for (int side = 0; side < 2 && !seen->is_apart && seen->side < 0; ++side) {
        distance_view view;
        const imp_code code = cut_side(of, side, gamma_clear, &seen->left, &view, error);
        if (code != IMP_SUCCESS) return code;
        seen->is_apart = view.is_apart;
        if (view.lower > seen->lower) seen->lower = view.lower;
        if (!view.is_promising) continue;
        seen->side = side;
        memcpy(seen->bend, view.bend, sizeof seen->bend);
    }
    return IMP_SUCCESS;
}
