/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/broad_phase/collection.h"

#include <impinge/baseline.h>

/* The candidates of one side of some pairs of the same two bodies, which are neighbours in the
 * list. */
typedef struct candidate_span {
    const candidate *first;
    size_t count;
} candidate_span;

static candidate_span span_of(const candidate_pair *pairs, size_t count, int side)
{
    const candidate *lo = pairs[0].side[side], *hi = lo;
    for (size_t k = 1; k < count; ++k) {
        const candidate *c = pairs[k].side[side];
        lo = c < lo ? c : lo;
        hi = c > hi ? c : hi;
    }
    return (candidate_span){lo, (size_t)(hi - lo) + 1};
}

/* Returns the part's own candidate, with a tree, for one of the whole list. NULL: no memory. */
static candidate *own_candidate(candidate *slot, const candidate *from, imp_stats *stats)
{
    if (slot->tree != NULL) return slot;
    *slot = (candidate){.body = from->body,
                        .surface = from->surface,
                        .left_out = from->left_out,
                        .held = from->held,
                        .aside = from->aside,
                        .eval_error = -1};
    if (from->half != NULL) {
        slot->half = arena_store_room(NULL, sizeof *slot->half); /* its list has no store */
        if (slot->half == NULL) return NULL;
        *slot->half = *from->half;
    }
    tree_growth growth = {0};
    if (tree_new_from_root(from->tree, &slot->tree, &growth, NULL) != IMP_SUCCESS) return NULL;
    stats->bytes += growth.bytes;
    return slot;
}

imp_code candidates_part(candidate_list *list, const candidate_list *whole, size_t first,
                         size_t count, imp_stats *stats, imp_error *error)
{
    const candidate_pair *pairs = whole->pairs + first;
    const candidate_span span[2] = {span_of(pairs, count, 0), span_of(pairs, count, 1)};
    *list = (candidate_list){.count = span[0].count + span[1].count,
                             .pair_count = count,
                             .pair_capacity = count,
                             .slip = whole->slip,
                             .half_planes = whole->half_planes,
                             .complete = true,
                             .owns_trees = true};
    list->candidates = arena_store_zeroed(NULL, list->count * sizeof *list->candidates);
    list->pairs = arena_store_room(NULL, count * sizeof *list->pairs);
    bool ok = list->candidates != NULL && list->pairs != NULL;
    for (size_t k = 0; ok && k < count; ++k) {
        list->pairs[k] = (candidate_pair){.side = {NULL, NULL},
                                          .slips = pairs[k].slips,
                                          .rests = pairs[k].rests,
                                          .screws = pairs[k].screws};
        for (int side = 0; side < 2; ++side) {
            const candidate *from = pairs[k].side[side];
            const size_t before = side == 0 ? 0 : span[0].count;
            candidate *slot = list->candidates + before + (size_t)(from - span[side].first);
            list->pairs[k].side[side] = own_candidate(slot, from, stats);
            ok = ok && list->pairs[k].side[side] != NULL;
        }
    }
    if (ok) return IMP_SUCCESS;
    candidates_clear(list);
    return error_set_memory(error);
}

/* --- Frames ----------------------------------------------------------------------------------- */

/* Copies `count` pairs of another list from `first` on, with its trees. False: no memory. */
static bool copy_pairs(candidate_list *list, const candidate_list *whole, size_t first,
                       size_t count)
{
    const candidate_pair *pairs = whole->pairs + first;
    const candidate_span span[2] = {span_of(pairs, count, 0), span_of(pairs, count, 1)};
    *list = (candidate_list){.count = span[0].count + span[1].count,
                             .pair_count = count,
                             .pair_capacity = count,
                             .complete = true};
    list->candidates = list->count <= CANDIDATES_AT_HAND
                           ? list->at_hand
                           : arena_store_room(NULL, list->count * sizeof *list->candidates);
    list->pairs = arena_store_room(NULL, count * sizeof *list->pairs);
    if (list->candidates == NULL || list->pairs == NULL) return false;
    memcpy(list->candidates, span[0].first, span[0].count * sizeof *list->candidates);
    memcpy(list->candidates + span[0].count, span[1].first,
           span[1].count * sizeof *list->candidates);
    for (size_t k = 0; k < count; ++k) {
        list->pairs[k] = (candidate_pair){.side = {NULL, NULL}};
        for (int side = 0; side < 2; ++side) {
            const size_t before = side == 0 ? 0 : span[0].count;
            list->pairs[k].side[side] =
                list->candidates + before + (size_t)(pairs[k].side[side] - span[side].first);
        }
    }
    return true;
}

/* Makes the roots that the trees of the pairs lack, whatever the limits. */
static imp_code make_roots(collection *all, imp_error *error)
{
    const candidate_list *list = all->list;
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < 2 * list->pair_count && code == IMP_SUCCESS; ++k) {
        tree_growth growth = {0};
        code = tree_make_root(list->pairs[k / 2].side[k % 2]->tree, &growth, error);
        collection_count(all, &growth);
    }
    return code;
}

/* Pairs for which a limit ends the making of frames keep the trees that they have: bounds of these
 * hold, too. */
imp_code candidates_frame(candidate_list *list, const candidate_list *whole, size_t first,
                          size_t count, imp_scene *scene, const imp_options *options,
                          const candidate_search *search, const candidate_limit *limit,
                          imp_stats *stats, imp_error *error)
{
    collection all = {.scene = scene,
                      .gamma_clear = search->gamma_clear,
                      .slip_most = collection_slip_most(options, search),
                      .in_slices = search->in_slices,
                      .slip_useful = search->slip_useful,
                      .may_halve = search->may_halve,
                      .spans = SPANS_A_QUERY,
                      .options = options,
                      .limit = limit,
                      .stats = stats,
                      .list = list};
    bool done = true;
    imp_code code = copy_pairs(list, whole, first, count) ? IMP_SUCCESS : error_set_memory(error);
    if (code == IMP_SUCCESS && options->baseline == IMP_BASELINE_NONE)
        code = collection_use_frames(&all, &done, error);
    if (all.tree_ended && collection_must_end(&all)) code = IMP_SUCCESS, done = false;
    if (code == IMP_SUCCESS && !done) {
        candidates_clear(list);
        if (!copy_pairs(list, whole, first, count)) code = error_set_memory(error);
    }
    if (code == IMP_SUCCESS) code = make_roots(&all, error);
    if (code != IMP_SUCCESS) candidates_clear(list);
    return code;
}
