/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/distance.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"

distance_outcome distance_outcome_none(const time_window *window)
{
    return (distance_outcome){.left = *window, .side = -1};
}

/* Bounds how far one surface slides along the other over their common times: along `plane`, or, if
 * that is NULL, modulo the other's symmetry, to be `enough` (surface_slip). INFINITY: no bound is
 * known, for instance where the other has many pieces, each with its own symmetry. */
static imp_code find_slip(const node *own, const node *other, const surface_plane *plane,
                          const time_window *times, double moment, double enough, double *slip,
                          imp_error *error)
{
    imp_model bare[3];
    *slip = INFINITY;
    if ((plane == NULL && other->many != NULL) || !surface_may_slip(own->surface))
        return IMP_SUCCESS;
    if (!node_bare_models(own, bare)) return IMP_SUCCESS;
    const imp_region all = window_region(times);
    const surface *a = own->surface, *b = other->surface;
    const imp_status status =
        plane == NULL ? surface_slip(a, b, bare, &all, moment, enough, slip)
                      : surface_slip_along(a, b, plane, bare, &all, moment, enough, slip);
    return status == IMP_STATUS_OK ? IMP_SUCCESS : distance_fault(b, status, error);
}

/* Whether maps of the other side rotate its surface, so that distances hold only with a slip. */
bool distance_is_turned(const distance_sides *of, int side)
{
    const surface *own = of->node[side]->surface, *other = of->node[!side]->surface;
    const size_t common = surface_common_maps(own, other);
    return surface_map_count(other) - common > of->still_maps[!side];
}

/* A slip below this part of the points' distance is rounding. */
#define MERE_ROUNDING 0x1p-40

/* Finds out whether, and how nearly, the other surface moves as its center does; from where it is
 * before its maps if these leave the axis its direction. */
static imp_code find_carry(const distance_sides *of, int side, const time_window *times,
                           double moment, double *slip, imp_error *error)
{
    const node *own = of->root[side];
    const surface *other = of->root[!side]->surface;
    const imp_region all = window_region(times);
    double size = 0;
    *slip = INFINITY;
    if (of->root[!side]->many != NULL || !own->bounded) return IMP_SUCCESS;
    if (surface_common_maps(own->surface, other) > 0) return IMP_SUCCESS;
    for (int i = 0; i < 3; ++i) size += own->hi[i] - own->lo[i];
    const imp_status status =
        surface_carry_slip_least(other, own->lo, own->hi, &all, moment, MERE_ROUNDING * size,
                                 &of->slips->is_bare[side], slip);
    return status == IMP_STATUS_OK ? IMP_SUCCESS : distance_fault(other, status, error);
}

/* Finds out which parameters of a side's node need not vary. */
static imp_code find_orbit(const distance_sides *of, int side, const time_window *times,
                           unsigned *held, double *slip, imp_error *error)
{
    const node *own = of->node[side], *root = of->root[side];
    const surface *a = own->surface, *b = of->node[!side]->surface;
    const imp_region all = window_region(times);
    *held = 0;
    *slip = INFINITY;
    if (!root->bounded || surface_common_maps(a, b) > 0) return IMP_SUCCESS;
    const imp_status status = surface_orbit_slip(a, b, root->lo, root->hi, &all, held, slip);
    return status == IMP_STATUS_OK ? IMP_SUCCESS : distance_fault(b, status, error);
}

/* Takes it that the other surface moves as its center does, if it does so nearly enough. */
static imp_code add_carry(const distance_sides *of, int side, const time_window *times,
                          distance_question *q, imp_error *error)
{
    float *known = &of->slips->carry[side];
    if (*known == 0) {
        double found;
        const imp_code code = find_carry(of, side, times, q->moment, &found, error);
        if (code != IMP_SUCCESS) return code;
        *known = float_upper(found);
    }
    if (!distance_slip_is_small(*known, q->gamma_clear)) return IMP_SUCCESS;
    q->is_carried = true;
    q->is_bare = of->slips->is_bare[side];
    q->slip = *known;
    return IMP_SUCCESS;
}

/* Lets one point stand for its orbit, if that is one of the other's symmetry nearly enough. Pieces
 * of either side have orbits and symmetries of their own: nothing is kept of theirs. */
static imp_code add_orbit(const distance_sides *of, int side, const time_window *times,
                          distance_question *q, imp_error *error)
{
    const bool is_piece = of->root[0]->many != NULL || of->root[1]->many != NULL;
    unsigned held = of->slips->held[side];
    double slip = of->slips->orbit[side];
    if (is_piece || slip == 0) {
        const imp_code code = find_orbit(of, side, times, &held, &slip, error);
        if (code != IMP_SUCCESS) return code;
        slip = float_upper(slip);
    }
    if (!is_piece) {
        of->slips->orbit[side] = (float)slip;
        of->slips->held[side] = (unsigned char)held;
    }
    const double all = sum_upper(q->slip, slip);
    if (!distance_slip_is_small(all, q->gamma_clear)) return IMP_SUCCESS;
    q->held = held;
    q->slip = all;
    return IMP_SUCCESS;
}

/* Bounds in q->slip how far the side slides along the other, found once for each candidate pair. A
 * verifier of certificates knows no screws, and would cut leaves that span much time due to one. */
static imp_code add_slip(const distance_sides *of, int side, const time_window *times,
                         distance_question *q, imp_error *error)
{
    float *slip = &of->slips->slip[side];
    if (*slip == 0) {
        const double enough = of->takes_orbits ? distance_slip_enough(q->gamma_clear) : 0;
        double found;
        const imp_code code = find_slip(of->root[side], of->root[!side], NULL, times, q->moment,
                                        enough, &found, error);
        if (code != IMP_SUCCESS) return code;
        *slip = float_upper(found);
    }
    q->slip = *slip;
    return IMP_SUCCESS;
}

/* Finds out whether one point of a side may stand for its orbit. Each piece has a symmetry of its
 * own. */
static imp_code find_orbits(const distance_sides *of, int side, bool *has, imp_error *error)
{
    const surface *own = of->node[side]->surface;
    signed char *known = &of->slips->orbits[side];
    *has = of->takes_orbits && *known > 0;
    if (!of->takes_orbits || *known != 0) return IMP_SUCCESS;
    const imp_status status = surface_has_orbits(own, has);
    if (status != IMP_STATUS_OK) return distance_fault(own, status, error);
    if (of->root[side]->many == NULL) *known = *has ? 1 : -1;
    return IMP_SUCCESS;
}

/* Fills the input of distance_cut for one side. A node that moves uniformly needs no slip, unless
 * one point stands for its orbit: its models are as tight as those of one moment. */
static imp_code question_of(const distance_sides *of, int side, double gamma_clear,
                            distance_question *q, imp_error *error)
{
    const node *own = of->node[side], *other = of->node[!side];
    imp_code code = IMP_SUCCESS;
    *q = (distance_question){.a = own,
                             .b = other,
                             .gamma_clear = gamma_clear,
                             .slip = INFINITY,
                             .seeks_contact = of->seeks_contact,
                             .is_audited = of->is_audited};
    if (!surface_has_symmetry(other->surface)) return IMP_SUCCESS;
    const time_window times = pair_times(of->root[side], of->root[!side]);
    const bool at_once = times.lo == times.hi, turned = distance_is_turned(of, side);
    const bool turns = own->still != NULL || turned;
    bool has_orbits;
    code = find_orbits(of, side, &has_orbits, error);
    if (code != IMP_SUCCESS) return code;
    q->moment = 0.5 * times.lo + 0.5 * times.hi;
    if (turns || has_orbits) code = add_slip(of, side, &times, q, error);
    const bool slides = distance_slides(q);
    if (code == IMP_SUCCESS && !slides) {
        q->slip = at_once ? 0 : INFINITY;
        if (!at_once && (turned || has_orbits)) code = add_carry(of, side, &times, q, error);
    }
    if (code == IMP_SUCCESS && has_orbits && q->slip < INFINITY)
        code = add_orbit(of, side, &times, q, error);
    const bool pays = slides ? turns : q->is_carried && turned;
    if (q->held == 0 && !pays) q->slip = INFINITY, q->is_carried = q->is_bare = false;
    return code;
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
    distance_question q = {.a = own,
                           .b = other,
                           .plane = &plane,
                           .gamma_clear = gamma_clear,
                           .moment = 0.5 * times.lo + 0.5 * times.hi,
                           .slip = INFINITY,
                           .seeks_contact = of->seeks_contact,
                           .is_audited = of->is_audited};
    const imp_code code = find_slip(of->root[side], other, &plane, &times, q.moment,
                                    distance_slip_enough(gamma_clear), &q.slip, error);
    return code == IMP_SUCCESS && distance_slides(&q) ? distance_cut(&q, window, view, error)
                                                      : code;
}

/* --- Both ------------------------------------------------------------------------------------- */

/* What is asked about one side. */
typedef struct side_plan {
    distance_question q;
    bool is_asked; /* q, of the other's type */
    bool is_face;  /* the plane of the other's node */
    bool is_still; /* time costs nothing, or only by how the other's center moves */
} side_plan;

static imp_code plan_side(const distance_sides *of, int side, double gamma_clear, side_plan *plan,
                          imp_error *error)
{
    const node *own = of->node[side], *other = of->node[!side];
    *plan = (side_plan){.is_asked = distance_is_known(own, other)};
    if (!plan->is_asked) {
        plan->is_face = strategy_slides_on_face(own, other);
        return IMP_SUCCESS;
    }
    const imp_code code = question_of(of, side, gamma_clear, &plan->q, error);
    plan->is_still = distance_slides(&plan->q) || plan->q.is_carried;
    plan->is_asked = plan->is_still || !distance_is_turned(of, side);
    return code;
}

static imp_code cut_side(const distance_sides *of, int side, const side_plan *plan,
                         double gamma_clear, time_window *window, distance_view *view,
                         imp_error *error)
{
    *view = distance_view_none(of->node[side]);
    if (plan->is_face) return cut_along_face(of, side, gamma_clear, window, view, error);
    return plan->is_asked ? distance_cut(&plan->q, window, view, error) : IMP_SUCCESS;
}

/* Lemma. A node's points belong to its whole surface: the distance of one node's points from all of
 * the other surface, or from the plane of its node, is no greater than that of the two nodes. Each
 * side cuts what the other has left, first as a ball. Both are asked even where the first is worth
 * splitting alone, so that the choice does not depend on their order: a sphere's node may need 600
 * pairs against an ellipsoid whose nodes need 140 against the sphere. Of equal bounds the first
 * side keeps the choice: a search that changes sides then takes more pairs than one that stays. */
imp_code distance_cut_sides(const distance_sides *of, double gamma_clear, distance_outcome *seen,
                            imp_error *error)
{
    side_plan plan[2];
    for (int side = 0; side < 2; ++side) {
        const imp_code code = plan_side(of, side, gamma_clear, &plan[side], error);
        if (code != IMP_SUCCESS) return code;
    }
    const int first = plan[1].is_still && !plan[0].is_still ? 1 : 0;
    double best = 0; /* the lower bound of the side to split */
    for (int k = 0; k < 4 && !seen->is_apart && !(k == 2 && seen->side >= 0); ++k) {
        const int side = k % 2 == 0 ? first : !first;
        distance_view view;
        const imp_code code =
            k < 2 ? distance_cut_ball(of, side, gamma_clear, &seen->left, &view, error)
                  : cut_side(of, side, &plan[side], gamma_clear, &seen->left, &view, error);
        if (code != IMP_SUCCESS) return code;
        seen->is_apart = view.is_apart;
        seen->has_start = seen->has_start || view.has_start;
        if (view.lower > seen->lower) seen->lower = view.lower;
        if (!view.is_promising) continue;
        if (seen->side >= 0 && !(view.lower > best)) continue;
        best = view.lower;
        seen->side = side;
        memcpy(seen->bend, view.bend, sizeof seen->bend);
    }
    return IMP_SUCCESS;
}
