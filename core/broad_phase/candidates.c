/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/candidates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/bounds/tuning.h"
#include "core/broad_phase/collection.h"
#include "core/scene/tolerances.h"

#include <impinge/baseline.h>

/* --- The order of pairs ----------------------------------------------------------------------- */

typedef enum sort_key { KEY_SURFACE_B, KEY_SURFACE_A, KEY_BODY_B, KEY_BODY_A, SORT_KEYS } sort_key;

static size_t key_of(const candidate *candidates, const candidate_pair *p, sort_key key)
{
    const candidate *c = p->side[key == KEY_SURFACE_A || key == KEY_BODY_A ? 0 : 1];
    return key >= KEY_BODY_B ? c->body : (size_t)(c - candidates);
}

/* The order of a list's pairs, by their indices: an index takes a twelfth of a pair's bytes. */
typedef struct pair_order {
    uint32_t *at, *to; /* now, and room for the next */
    size_t *start;     /* room for one element per key and one more */
    size_t keys;
    arena_store *store; /* of their memory */
} pair_order;

static void order_clear(pair_order *order)
{
    arena_store_free_room(order->store, order->at);
    arena_store_free_room(order->store, order->to);
    arena_store_free_room(order->store, order->start);
}

/* False: no memory; then too it has to be cleared. */
static bool order_begin(pair_order *order, size_t pairs, size_t keys, arena_store *store)
{
    *order = (pair_order){.at = arena_store_room(store, (pairs + 1) * sizeof *order->at),
                          .to = arena_store_room(store, (pairs + 1) * sizeof *order->to),
                          .start = arena_store_room(store, (keys + 1) * sizeof *order->start),
                          .keys = keys,
                          .store = store};
    if (order->at == NULL || order->to == NULL || order->start == NULL) return false;
    for (size_t k = 0; k < pairs; ++k) order->at[k] = (uint32_t)k;
    return true;
}

/* A stable counting sort. False: all keys are equal, and nothing is moved. */
static bool sort_pass(const candidate_list *list, sort_key key, pair_order *order)
{
    size_t *start = order->start;
    memset(start, 0, (order->keys + 1) * sizeof *start);
    for (size_t k = 0; k < list->pair_count; ++k)
        start[key_of(list->candidates, &list->pairs[k], key) + 1] += 1;
    if (start[key_of(list->candidates, &list->pairs[0], key) + 1] == list->pair_count) return false;
    for (size_t k = 0; k < order->keys; ++k) start[k + 1] += start[k];
    for (size_t k = 0; k < list->pair_count; ++k) {
        const uint32_t pair = order->at[k];
        order->to[start[key_of(list->candidates, &list->pairs[pair], key)]++] = pair;
    }
    uint32_t *sorted = order->to;
    order->to = order->at;
    order->at = sorted;
    return true;
}

/* Moves each pair to its place, along the cycles of the order, which is used up. */
static void move_pairs(candidate_pair *pairs, size_t count, uint32_t *order)
{
    for (size_t k = 0; k < count; ++k) {
        const candidate_pair first = pairs[k];
        size_t at = k;
        while (order[at] != k) {
            const size_t next = order[at];
            pairs[at] = pairs[next];
            order[at] = (uint32_t)at;
            at = next;
        }
        pairs[at] = first;
        order[at] = (uint32_t)at;
    }
}

/* Gives back what the list has room for beyond its pairs and one more. False: no memory. */
static bool shrink_pairs(candidate_list *list)
{
    const size_t bytes = (list->pair_count + 1) * sizeof *list->pairs;
    if (list->pair_capacity <= list->pair_count + 1) return true;
    candidate_pair *fitting = arena_store_regrow(list->store, list->pairs, bytes, bytes);
    if (fitting == NULL) return false;
    list->pairs = fitting;
    list->pair_capacity = list->pair_count + 1;
    return true;
}

/* Sorts by body of a, body of b, surface of a, surface of b, least significant key first: the order
 * of the scene, so that ties on the heap do not depend on the order of the sweep, which depends on
 * the query's times. It is a radix sort, so that limits can be checked between its passes. */
static imp_code sort_pairs(collection *all, bool *done, imp_error *error)
{
    candidate_list *list = all->list;
    pair_order order;
    const size_t bodies = scene_body_count(all->scene);
    const int last = bodies > 2 ? SORT_KEYS : KEY_BODY_B; /* two bodies are in order already */
    bool is_moved = false;
    *done = order_begin(&order, list->pair_count, list->count > bodies ? list->count : bodies,
                        list->store);
    bool has_memory = *done;
    for (int key = 0; *done && key < last; ++key) {
        if (!sort_pass(list, (sort_key)key, &order)) continue;
        is_moved = true;
        *done = !collection_must_end(all);
    }
    if (*done && is_moved) {
        move_pairs(list->pairs, list->pair_count, order.at);
        has_memory = *done = shrink_pairs(list);
    }
    order_clear(&order);
    return has_memory ? IMP_SUCCESS : error_set_memory(error);
}

/* Whether pairs may be left for later: in large scenes, where most take more time and memory than
 * another box of each surface. */
static bool may_wait(const collection *all)
{
    return all->may_wait && all->list->count > ROOTS_AT_ONCE && all->list->count < UINT32_MAX &&
           all->options->t_start < all->options->t_end && !scene_has_solids(all->scene);
}

static imp_code collect_pairs(collection *all, bool *done, imp_error *error)
{
    *done = true;
    if (scene_counts_pairs(all->scene) && imp_scene_pair_count(all->scene) == 0) return IMP_SUCCESS;
    if (all->is_nearest && all->list->count > ROOTS_AT_ONCE) collection_limit_distance(all);
    if (may_wait(all)) {
        all->list->later = later_pairs_new(all->list->store, all->options->t_start);
        if (all->list->later == NULL) return *done = false, error_set_memory(error);
    }
    *done = collection_add_pairs(all);
    if (all->out_of_memory) return error_set_memory(error);
    if (*done && scene_has_solids(all->scene)) {
        const imp_code code = collection_add_solids(all, done, error);
        if (code != IMP_SUCCESS) return code;
    }
    if (*done && all->list->later != NULL) return collection_sort_later(all, done, error);
    if (!*done || all->list->pair_count < 2) return IMP_SUCCESS;
    return sort_pairs(all, done, error);
}

/* Allocates working memory. False: no memory. */
static bool prepare(collection *all)
{
    size_t most = 1; /* malloc(0) may return NULL */
    for (size_t b = 0; b < scene_body_count(all->scene); ++b)
        most += scene_surface_count(all->scene, b);
    all->boxes = most <= BOXES_AT_HAND
                     ? all->at_hand
                     : arena_store_room(all->list->store, most * sizeof *all->boxes);
    all->list->candidates =
        most <= CANDIDATES_AT_HAND
            ? all->list->at_hand
            : arena_store_room(all->list->store, most * sizeof *all->list->candidates);
    if (all->boxes == NULL || all->list->candidates == NULL) return false;
    all->with_roots =
        most <= ROOTS_AT_ONCE ||
        !(all->is_nearest || all->gamma_clear < INFINITY); /* all surfaces are in pairs then */
    if (!parallel_is_on(all->options)) return true;
    all->surfaces = malloc(SURFACES_A_ROUND * sizeof *all->surfaces);
    all->sweep = calloc(TASKS_A_ROUND, sizeof *all->sweep);
    return all->surfaces != NULL && all->sweep != NULL;
}

double collection_slip_most(const imp_options *options, const candidate_search *search)
{
    if (options->baseline != IMP_BASELINE_NONE) return -1;
    const double clear = tolerances_clear(options->gamma, options->gamma_clear);
    const double room = options->gamma - clear;
    const double most = (clear < room ? clear : room) / TUNING_REST_SLIP;
    return search->slip_most < most ? search->slip_most : most;
}

imp_code candidates_find(candidate_list *list, imp_scene *scene, const imp_options *options,
                         const candidate_search *search, const candidate_limit *limit,
                         imp_stats *stats, imp_error *error)
{
    const bool models =
        options->baseline == IMP_BASELINE_NONE; /* the paper's algorithm has no frames */
    collection all = {.scene = scene,
                      .slip_most = collection_slip_most(options, search),
                      .in_slices = search->in_slices,
                      .slip_useful = search->slip_useful,
                      .may_halve = search->may_halve,
                      .spans = SPANS_A_QUERY,
                      .common_motion = models ? collection_common_motion(scene) : 0,
                      .options = options,
                      .limit = limit,
                      .stats = stats,
                      .gamma_clear = search->gamma_clear,
                      .is_nearest = search->is_nearest,
                      .may_wait = models && search->may_wait,
                      .list = list};
    bool done = false;
    imp_code code =
        prepare(&all) ? collection_add_surfaces(&all, &done, error) : error_set_memory(error);
    collection_count_rest(&all);
    if (done) code = collect_pairs(&all, &done, error);
    if (done && models && !search->in_parts) code = collection_use_frames(&all, &done, error);
    if (done && code == IMP_SUCCESS && !search->in_parts)
        code = collection_make_roots(&all, &done, error);
    if (all.tree_ended && collection_must_end(&all)) code = IMP_SUCCESS, done = false;
    if (all.boxes != all.at_hand) arena_store_free_room(list->store, all.boxes);
    free(all.surfaces);
    free(all.sweep);
    list->complete = done && code == IMP_SUCCESS;
    if (!list->complete) candidates_clear(list);
    return code;
}

uint64_t candidates_bytes(const candidate_list *list)
{
    return list->count * sizeof *list->candidates + list->pair_capacity * sizeof *list->pairs +
           list->half_planes * sizeof(half_plane) + later_pairs_bytes(list->later);
}

void candidates_clear(candidate_list *list)
{
    for (size_t k = 0; list->owns_trees && list->candidates != NULL && k < list->count; ++k)
        tree_free(list->candidates[k].tree);
    for (size_t k = 0; list->half_planes > 0 && list->candidates != NULL && k < list->count; ++k)
        arena_store_free_room(list->store, list->candidates[k].half);
    if (list->candidates != list->at_hand) arena_store_free_room(list->store, list->candidates);
    arena_store_free_room(list->store, list->pairs);
    later_pairs_free(list->later);
    *list = (candidate_list){.store = list->store};
}
