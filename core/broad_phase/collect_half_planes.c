/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/broad_phase/frame_list.h"
#include "core/common/array.h"
#include "core/surface/screws.h"
#include "core/witness/witness.h"

/* Pairs of which a half plane stands for all
 * ==========================================
 * Lemma. Let two points of a pair, at any time, have companions at that time in a half plane that
 * are at most s farther from each other (surface_half_plane). If all points in the half plane are
 * farther than c + s apart, all points are farther than c. So nodes that miss it are left out. */

bool frames_may_have_half_planes(const collection *all, const candidate_pair *p)
{
    return all->may_halve && all->slip_most >= 0 &&
           surface_may_have_half_plane(tree_surface(p->side[0]->tree)) &&
           surface_may_have_half_plane(tree_surface(p->side[1]->tree));
}

frame *frame_list_next(frame_list *frames)
{
    frame *grown = arena_store_reserve(frames->store, frames->at, frames->count, &frames->capacity,
                                       sizeof *grown);
    if (grown == NULL) return NULL;
    frames->at = grown;
    return &grown[frames->count];
}

/* Gives one side of a pair a frame of its own, with a half plane. */
static imp_code add_half_plane(collection *all, frame_list *frames, size_t *of_side,
                               const half_plane *half, imp_error *error)
{
    frame *made = frame_list_next(frames);
    half_plane *own = made != NULL ? arena_store_room(frames->store, sizeof *own) : NULL;
    if (own == NULL) return error_set_memory(error);
    *made = frames->at[*of_side];
    *own = *half;
    made->made.half = own;
    made->next = frames->first[made->of];
    *of_side = frames->first[made->of] = frames->count++;
    all->list->half_planes += 1;
    return IMP_SUCCESS;
}

imp_code frames_some_distance(tree *const t[2], double time, double *distance_upper,
                              imp_error *error)
{
    const node *const roots[2] = {tree_root(t[0]), tree_root(t[1])};
    witness w;
    const imp_code code = witness_seek(roots, time, INFINITY, &w, error);
    if (code == IMP_SUCCESS) *distance_upper = w.gap_upper;
    return code;
}

imp_code frames_halve_pair(collection *all, frame_list *frames, size_t k, double slip,
                           imp_error *error)
{
    double lo[2][3], hi[2][3], more;
    const surface *s[2];
    half_plane of[2];
    size_t *of_pair = frames->of_pair[k];
    time_window times;
    imp_code code = frames_make_roots(all, frames, k, &times, error);
    if (code != IMP_SUCCESS || times.lo > times.hi) return code;
    if (frames_lack_common_line(all, frames, k, &times)) return IMP_SUCCESS;
    for (int side = 0; side < 2; ++side) {
        const tree *t = frames->at[of_pair[side]].made.tree;
        s[side] = tree_surface(t);
        tree_box(t, lo[side], hi[side]);
    }
    const half_plane_boxes boxes = {{lo[0], lo[1]}, {hi[0], hi[1]}};
    const imp_region over = window_region(&times);
    int asked;
    imp_status status = surface_half_plane(s, &boxes, &over, of, &more, &asked);
    /* Sections hold points that are near at one time: each slice has its own (candidates_rest). */
    if (status == IMP_STATUS_OK && !(more < INFINITY) && !all->in_slices &&
        surface_is_screw_piece(s[0]) && surface_is_screw_piece(s[1])) {
        double near = sum_upper(all->gamma_clear, slip); /* at the moment, if the pair rests */
        tree *const t[2] = {frames->at[of_pair[0]].made.tree, frames->at[of_pair[1]].made.tree};
        if (!(near < INFINITY)) code = frames_some_distance(t, times.lo, &near, error);
        if (code != IMP_SUCCESS) return code;
        status = surface_screw_section(s, &boxes, &over, near, of, &more, &asked);
    }
    if (status != IMP_STATUS_OK) return distance_fault(s[asked], status, error);
    slip = sum_upper(slip, more);
    if (!(slip <= all->slip_most)) return IMP_SUCCESS;
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side)
        code = add_half_plane(all, frames, &of_pair[side], &of[side], error);
    if (slip > all->list->slip) all->list->slip = slip;
    return code;
}

void frames_forget_half_planes(candidate_list *list, const frame_list *frames)
{
    for (size_t f = 0; f < frames->count; ++f)
        arena_store_free_room(list->store, frames->at[f].made.half);
    list->half_planes = 0;
}
