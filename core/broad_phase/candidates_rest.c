/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/candidates_rest.h"

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/broad_phase/frame_list.h"
#include "core/surface/screws.h"

static size_t count_resting(const candidate_pair *pairs, size_t count)
{
    size_t sides = 0;
    for (size_t k = 0; k < count; ++k) sides += pairs[k].rests || pairs[k].screws ? 2 : 0;
    return sides;
}

/* Returns the times of a slice at which both surfaces of a pair exist. */
static time_window times_in(const candidate_pair *p, const time_window *within)
{
    return window_common(*within,
                         pair_times(tree_root(p->side[0]->tree), tree_root(p->side[1]->tree)));
}

/* Makes the tree of a side at this moment. */
static imp_code begin_moment(const candidate_pair *p, int side, double moment, candidate_moment *m,
                             imp_stats *stats, imp_error *error)
{
    tree_growth growth = {0};
    m->side = side;
    m->whole = p->side[side];
    m->at = *m->whole;
    const imp_code code = tree_new_at(m->whole->tree, moment, &m->at.tree, &growth, error);
    m->at.eval_error = -1;
    stats->nodes += growth.nodes;
    stats->bytes += growth.bytes;
    return code;
}

/* Makes the trees of both sides of pair k. */
static imp_code begin_moments(candidate_pair *p, size_t k, double moment, candidate_moments *all,
                              imp_stats *stats, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side) {
        candidate_moment *m = &all->at[all->count];
        m->pair = k;
        code = begin_moment(p, side, moment, m, stats, error);
        all->count += code == IMP_SUCCESS;
    }
    return code;
}

static void end_moment(candidate_moment *m, imp_stats *stats)
{
    stats->bytes -= tree_own_bytes(m->at.tree);
    tree_free(m->at.tree);
}

/* --- Screws ----------------------------------------------------------------------------------- */

/* A pair that is looked at in a slice. */
typedef struct screw_slice {
    candidate_pair *pair;
    size_t index;
    time_window times;
    double before, slip_most; /* the list's slip, and the most of both; length */
} screw_slice;

/* Finds for how near points, and with which slip, the slice's first moment stands for it. */
static imp_code find_rest(const screw_slice *q, screw_rest *rest, imp_error *error)
{
    const candidate_pair *p = q->pair;
    const surface *s[2];
    imp_model bare[2][3];
    *rest = (screw_rest){.slip = INFINITY};
    for (int k = 0; k < 2; ++k) {
        s[k] = tree_surface(p->side[k]->tree);
        if (!node_bare_models(tree_root(p->side[k]->tree), bare[k])) return IMP_SUCCESS;
    }
    const imp_region times = window_region(&q->times);
    const screw_rest_times at = {&times, q->times.lo, 0.5 * q->slip_most};
    int asked;
    const imp_status status = surface_screw_rest(s, bare, &at, rest, &asked);
    return status == IMP_STATUS_OK ? IMP_SUCCESS : distance_fault(s[asked], status, error);
}

/* Lets a half plane stand for both sides at the moment, if they are threads of one line and lead.
 * *slip grows by what that slips. */
static imp_code halve(const screw_slice *q, candidate_moment sides[2], double near, double *slip,
                      imp_error *error)
{
    const surface *const s[2] = {tree_surface(sides[0].at.tree), tree_surface(sides[1].at.tree)};
    const time_window moment = {q->times.lo, q->times.lo};
    const imp_region at = window_region(&moment);
    double lo[2][3], hi[2][3], more;
    half_plane of[2];
    int asked;
    if (!surface_is_screw_piece(s[0]) || !surface_is_screw_piece(s[1])) return IMP_SUCCESS;
    for (int k = 0; k < 2; ++k) tree_box(sides[k].at.tree, lo[k], hi[k]);
    const half_plane_boxes boxes = {{lo[0], lo[1]}, {hi[0], hi[1]}};
    const imp_status status = surface_screw_section(s, &boxes, &at, near, of, &more, &asked);
    if (status != IMP_STATUS_OK) return distance_fault(s[asked], status, error);
    if (!(sum_upper(*slip, more) <= q->slip_most)) return IMP_SUCCESS;
    *slip = sum_upper(*slip, more);
    for (int k = 0; k < 2; ++k) {
        sides[k].half = of[k];
        sides[k].at.half = &sides[k].half;
    }
    return IMP_SUCCESS;
}

/* Lemma. Let two points of the pair be d apart at the slice's first moment t0, d no more than the
 * rest is known for. If two points are nearer than d at a time of the slice, they have companions
 * at t0 that are farther by the slip at most (surface_screw_rest). If they are not, they are as far
 * as some are at t0. So the least distance of the slice is at least that of t0 less the slip, and
 * no more than that of t0. At t0 the section holds what is within d (surface_screw_section). */
static imp_code rest_along_screw(const screw_slice *q, candidate_moments *all, imp_stats *stats,
                                 imp_error *error)
{
    screw_rest rest;
    const size_t before = all->count;
    candidate_moment *sides = &all->at[before];
    imp_code code = find_rest(q, &rest, error);
    double slip = sum_upper(q->before, rest.slip), near;
    if (code != IMP_SUCCESS || !(slip <= q->slip_most)) return code;
    code = begin_moments(q->pair, q->index, q->times.lo, all, stats, error);
    if (code != IMP_SUCCESS) return code;
    tree *const t[2] = {sides[0].at.tree, sides[1].at.tree};
    code = frames_some_distance(t, q->times.lo, &near, error);
    if (code != IMP_SUCCESS) return code;
    near = sum_upper(near, q->before);
    if (near <= rest.near) {
        code = halve(q, sides, near, &slip, error);
        if (slip - q->before > all->slip) all->slip = sum_upper(slip, -q->before);
        return code;
    }
    for (; all->count > before; --all->count) end_moment(&all->at[all->count - 1], stats);
    return IMP_SUCCESS;
}

/* --- Slices ----------------------------------------------------------------------------------- */

imp_code candidates_rest(const candidate_list *list, size_t first, size_t count,
                         const time_window *within, double slip_most, candidate_moments *moments,
                         imp_stats *stats, imp_error *error)
{
    candidate_pair *pairs = list->pairs;
    const size_t sides = count_resting(pairs + first, count);
    if (sides == 0) return IMP_SUCCESS;
    moments->at = arena_store_room(list->store, sides * sizeof *moments->at);
    if (moments->at == NULL) return error_set_memory(error);
    moments->capacity = sides;
    imp_code code = IMP_SUCCESS;
    for (size_t k = first; k < first + count && code == IMP_SUCCESS; ++k) {
        if (!pairs[k].rests && !pairs[k].screws) continue;
        const screw_slice q = {&pairs[k], k, times_in(&pairs[k], within), list->slip, slip_most};
        if (!(q.times.lo <= q.times.hi)) continue;
        code = pairs[k].rests ? begin_moments(&pairs[k], k, q.times.lo, moments, stats, error)
                              : rest_along_screw(&q, moments, stats, error);
    }
    for (size_t j = 0; j < moments->count && code == IMP_SUCCESS; ++j)
        pairs[moments->at[j].pair].side[moments->at[j].side] = &moments->at[j].at;
    if (code != IMP_SUCCESS) candidates_wake(list, moments, stats);
    return code;
}

void candidates_wake(const candidate_list *list, candidate_moments *moments, imp_stats *stats)
{
    for (size_t j = 0; j < moments->count; ++j) {
        candidate_moment *m = &moments->at[j];
        list->pairs[m->pair].side[m->side] = m->whole;
        end_moment(m, stats);
    }
    arena_store_free_room(list->store, moments->at);
    *moments = (candidate_moments){0};
}
