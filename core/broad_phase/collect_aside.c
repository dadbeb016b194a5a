/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/rounding.h"
#include "core/broad_phase/frame_list.h"

/* Pairs whose surfaces share motion that is not at the end of their maps, or that cancels: it is
 * set aside.
 *
 * Lemma. With these maps set aside, the distance of both surfaces differs by at most the slip from
 * the true one, at each time (surface_shared_aside). So a distance of c, proved without them, is
 * one of c less the slip, which the list's slip is not below. */

/* Rigid maps of one surface that are not left out. -1: others, too. */
static int own_maps(const surface *s, size_t motion)
{
    if (surface_map_count(s) > 0 && !surface_is_rigid(s)) return -1;
    return (int)(surface_map_count(s) - motion);
}

/* Two maps at least move alike or cancel: one of each surface, which need not be given in the same
 * words, or two of one. */
bool frames_may_set_aside(const collection *all, const candidate_pair *p)
{
    if (all->slip_most < 0 || !all->may_halve) return false;
    const surface *a = tree_surface(p->side[0]->tree), *b = tree_surface(p->side[1]->tree);
    const size_t motion = surface_common_motion(a, b);
    const int m = own_maps(a, motion), n = own_maps(b, motion);
    return m >= 0 && n >= 0 && m + n >= 2;
}

imp_code frames_set_aside(collection *all, frame_list *frames, size_t k, double *slip,
                          imp_error *error)
{
    const candidate_pair *p = &all->list->pairs[k];
    size_t *of_pair = frames->of_pair[k];
    const double enough = 0.25 * all->slip_most;
    const surface *s[2];
    imp_model bare[2][3];
    time_window times;
    imp_code code = frames_make_roots(all, frames, k, &times, error);
    if (code != IMP_SUCCESS || !(times.lo < times.hi)) return code;
    const imp_region over = window_region(&times);
    aside_look *const looks[2] = {&frames->at[of_pair[0]].aside, &frames->at[of_pair[1]].aside};
    const tree *const t[2] = {frames->at[of_pair[0]].made.tree, frames->at[of_pair[1]].made.tree};
    for (int side = 0; side < 2; ++side) s[side] = tree_surface(t[side]);
    if (!surface_may_set_aside(s, &over, enough, looks)) return IMP_SUCCESS;
    for (int side = 0; side < 2; ++side)
        if (!node_bare_models(tree_root(t[side]), bare[side])) return IMP_SUCCESS;
    shared_aside shared;
    int asked = 0;
    const imp_status status =
        surface_shared_aside(s, bare, &over, enough, &all->spans, looks, &shared, &asked);
    if (status != IMP_STATUS_OK) return distance_fault(s[asked], status, error);
    for (int side = 0; side < 2; ++side) {
        if (shared.which[side] == 0) continue;
        surface_view view = frames->at[of_pair[side]].view;
        view.aside = (maps_aside){shared.which[side], shared.slip};
        code = frames_find(all, frames, p->side[side], &view, &of_pair[side], error);
        if (code != IMP_SUCCESS || of_pair[side] == NONE) return code;
    }
    if (shared.slip > 0) *slip = sum_upper(*slip, shared.slip);
    if (*slip > all->list->slip) all->list->slip = *slip;
    return IMP_SUCCESS;
}
