/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/broad_phase/frame_list.h"
#include "core/surface/screws.h"

/* What glances show of pairs, before bounds are computed: glance.h. */

static frame *frame_of(const frame_list *frames, size_t k, int side)
{
    return &frames->at[frames->of_pair[k][side]];
}

imp_code frames_make_roots(collection *all, const frame_list *frames, size_t k, time_window *times,
                           imp_error *error)
{
    const tree *t[2];
    *times = (time_window){INFINITY, -INFINITY};
    for (int side = 0; side < 2; ++side) {
        tree_growth growth = {0};
        tree *own = frame_of(frames, k, side)->made.tree;
        const imp_code code = tree_make_root(own, &growth, error);
        if (code != IMP_SUCCESS) return code;
        collection_count(all, &growth);
        t[side] = own;
    }
    *times = pair_times(tree_root(t[0]), tree_root(t[1]));
    return IMP_SUCCESS;
}

static bool is_seen(const frame *f, const time_window *times)
{
    return f->seen.from == times->lo && f->seen.to == times->hi;
}

/* Glances at a frame's surface, unless that is done. *has_middle false: there is no point to
 * follow. */
static imp_code look(frame *f, const time_window *times, bool *has_middle, imp_error *error)
{
    const tree *t = f->made.tree;
    const surface *s = tree_surface(t);
    imp_model bare[3];
    glance_middle middle;
    *has_middle = is_seen(f, times) && f->seen.has_middle;
    if (is_seen(f, times)) return IMP_SUCCESS;
    const imp_status status = surface_find_middle(s, &middle);
    if (status != IMP_STATUS_OK) return distance_fault(s, status, error);
    if (!middle.is_closed && !node_bare_models(tree_root(t), bare)) {
        f->seen = (surface_glance){.from = times->lo, .to = times->hi};
        return IMP_SUCCESS;
    }
    for (int i = 0; i < 3 && !middle.is_closed; ++i) middle.point[i] = bare[i].a;
    surface_glance_at(s, &middle, times->lo, times->hi, &f->seen);
    *has_middle = true;
    return IMP_SUCCESS;
}

/* No point of a box is nearer than this to all of its corners. */
static double half_diagonal(const tree *t)
{
    double lo[3], hi[3], square = 0;
    tree_box(t, lo, hi);
    for (int i = 0; i < 3; ++i) square += (hi[i] - lo[i]) * (hi[i] - lo[i]);
    return 0.5 * sqrt(square);
}

/* Notes slips along b that are larger than any of use. They are not computed then. */
static void note_slips(const collection *all, const frame *a, const frame *b, int side,
                       distance_slips *slips)
{
    const double useful = all->slip_useful;
    if (glances_vary(&a->seen, &b->seen) > useful) slips->slip[side] = INFINITY;
    if (glance_turns(&b->seen) * half_diagonal(a->made.tree) > useful)
        slips->carry[side] = INFINITY;
}

/* How many of both are pieces of screws, which may rest although their middles do not. */
static int count_screws(frame *const f[2])
{
    return surface_is_screw_piece(tree_surface(f[0]->made.tree)) +
           surface_is_screw_piece(tree_surface(f[1]->made.tree));
}

imp_code frames_look_at_pair(collection *all, frame_list *frames, size_t k,
                             const time_window *times, bool *may_rest, imp_error *error)
{
    frame *const f[2] = {frame_of(frames, k, 0), frame_of(frames, k, 1)};
    bool has_middle = true;
    imp_code code = IMP_SUCCESS;
    *may_rest = false;
    for (int side = 0; side < 2 && has_middle && code == IMP_SUCCESS; ++side)
        code = look(f[side], times, &has_middle, error);
    if (code != IMP_SUCCESS || !has_middle) return code;
    for (int side = 0; side < 2; ++side)
        note_slips(all, f[side], f[!side], side, &all->list->pairs[k].slips);
    *may_rest = (all->may_halve && count_screws(f) > 0) || !glances_part(&f[0]->seen, &f[1]->seen);
    return IMP_SUCCESS;
}

bool frames_have_two_lines(const frame_list *frames, size_t k)
{
    const surface_glance *const seen[2] = {&frame_of(frames, k, 0)->seen,
                                           &frame_of(frames, k, 1)->seen};
    return seen[0]->has_axis && seen[1]->has_axis && glances_are_off_line(seen[0], seen[1], 0);
}

bool frames_lack_common_line(const collection *all, const frame_list *frames, size_t k,
                             const time_window *times)
{
    frame *const f[2] = {frame_of(frames, k, 0), frame_of(frames, k, 1)};
    if (!is_seen(f[0], times) || !is_seen(f[1], times) || count_screws(f) == 2) return false;
    const int a = f[0]->seen.has_axis ? 0 : 1;
    return glances_are_off_line(&f[a]->seen, &f[!a]->seen, all->slip_most);
}
