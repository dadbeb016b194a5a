/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/rounding.h"
#include "core/broad_phase/frame_list.h"
#include "core/surface/held.h"

/* Surfaces of a pair that turn within themselves while they move, such as rollers, wheels and
 * spindles, and whose first maps are held.
 *
 * Lemma. Points of the surface held are within its slip of points of the surface, and conversely,
 * at each time (surface_held_maps). So a distance of c, proved of the pair with one or both held,
 * is one of c less the sum of both slips, which the list's slip is not below. This holds at each
 * time, and so in slices of time. */

static bool is_held_apart(const collection *all, const surface *s)
{
    return all->slip_most >= 0 && all->may_halve && surface_map_count(s) > 0 &&
           surface_has_symmetry(s) && surface_is_rigid(s);
}

bool frames_may_be_held(const collection *all, const candidate_pair *p)
{
    return is_held_apart(all, tree_surface(p->side[0]->tree)) ||
           is_held_apart(all, tree_surface(p->side[1]->tree));
}

/* Finds out which maps of a frame's surface, with a root, may be held; once. */
static imp_code look(const collection *all, frame *f, imp_error *error)
{
    const surface *s = tree_surface(f->made.tree);
    const node *root = tree_root(f->made.tree);
    imp_model bare[3];
    if (f->is_looked_at) return IMP_SUCCESS;
    f->is_looked_at = true;
    if (!is_held_apart(all, s) || !node_bare_models(root, bare)) return IMP_SUCCESS;
    const imp_region *r = &root->region;
    const imp_region times =
        region_make((double[3]){0, 0, r->lo[PARAMETER_T]}, (double[3]){0, 0, r->hi[PARAMETER_T]});
    const imp_status status =
        surface_held_maps(s, bare, &times, 0.25 * all->slip_most, &f->may_hold);
    return status == IMP_STATUS_OK ? IMP_SUCCESS : distance_fault(s, status, error);
}

/* Whether the other surface, as this one sees it, only moves by this one's symmetry: its nodes are
 * then taken at one moment (distance_sides.c), as long as both move. */
static imp_code slides_along(const collection *all, const frame *own, const frame *other,
                             const time_window *times, bool *slides, imp_error *error)
{
    const surface *s = tree_surface(own->made.tree), *t = tree_surface(other->made.tree);
    const imp_region over = window_region(times);
    imp_model bare[3];
    double slip;
    *slides = false;
    if (surface_piece_count(s) > 0 || !node_bare_models(tree_root(other->made.tree), bare))
        return IMP_SUCCESS;
    const imp_status status = surface_slip(t, s, bare, &over, times->lo, 0, &slip);
    *slides = status == IMP_STATUS_OK && slip <= all->slip_most;
    return status == IMP_STATUS_OK ? IMP_SUCCESS : distance_fault(s, status, error);
}

imp_code frames_hold_pair(collection *all, frame_list *frames, size_t k, double *slip,
                          imp_error *error)
{
    const candidate_pair *p = &all->list->pairs[k];
    size_t *of_pair = frames->of_pair[k];
    time_window times;
    imp_code code = frames_make_roots(all, frames, k, &times, error);
    if (code != IMP_SUCCESS || !(times.lo < times.hi) || p->rests) return code;
    bool slides[2] = {false, false};
    double sum = 0;
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side) {
        frame *f = &frames->at[of_pair[side]];
        if (!isnan(f->view.moment) || f->view.aside.which != 0) return IMP_SUCCESS;
        code = look(all, f, error);
        if (code == IMP_SUCCESS && f->may_hold.count > 0)
            code = slides_along(all, f, &frames->at[of_pair[!side]], &times, &slides[side], error);
    }
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side) {
        const frame *f = &frames->at[of_pair[side]];
        if (f->may_hold.count == 0 || slides[side]) continue;
        surface_view view = f->view;
        const surface_glance seen = f->seen;
        const double own = f->may_hold.slip;
        view.held = f->may_hold;
        code = frames_find(all, frames, p->side[side], &view, &of_pair[side], error);
        if (code != IMP_SUCCESS || of_pair[side] == NONE) return code;
        frames->at[of_pair[side]].seen = seen; /* center and line move alike */
        sum = sum_upper(sum, own);
    }
    if (sum > 0) *slip = sum_upper(*slip, sum);
    if (*slip > all->list->slip) all->list->slip = *slip;
    return code;
}
