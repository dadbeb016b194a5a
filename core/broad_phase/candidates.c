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

/* A stable counting sort; `start` has one element per key and one more. False: all keys are equal,
 * and nothing is moved. */
static bool sort_pass(const candidate_list *list, sort_key key, size_t *start, size_t keys,
                      candidate_pair *to)
{
    memset(start, 0, (keys + 1) * sizeof *start);
    for (size_t k = 0; k < list->pair_count; ++k)
        start[key_of(list->candidates, &list->pairs[k], key) + 1] += 1;
    if (start[key_of(list->candidates, &list->pairs[0], key) + 1] == list->pair_count) return false;
    for (size_t k = 0; k < keys; ++k) start[k + 1] += start[k];
    for (size_t k = 0; k < list->pair_count; ++k)
        to[start[key_of(list->candidates, &list->pairs[k], key)]++] = list->pairs[k];
    return true;
}

/* Sorts by body of a, body of b, surface of a, surface of b, least significant key first: the order
 * of the scene, so that ties on the heap do not depend on the order of the sweep, which depends on
 * the query's times. It is a radix sort, so that limits can be checked between its passes. */
static imp_code sort_pairs(collection *all, bool *done, imp_error *error)
{
    candidate_list *list = all->list;
    const size_t bodies = scene_body_count(all->scene);
    const size_t keys = list->count > bodies ? list->count : bodies;
    size_t *start = malloc((keys + 1) * sizeof *start);
    candidate_pair *to = malloc((list->pair_count + 1) * sizeof *to);
    const int last = bodies > 2 ? SORT_KEYS : KEY_BODY_B; /* two bodies are in order already */
    *done = start != NULL && to != NULL;
    const imp_code code = *done ? IMP_SUCCESS : error_set_memory(error);
    for (int key = 0; *done && key < last; ++key) {
        if (!sort_pass(list, (sort_key)key, start, keys, to)) continue;
        candidate_pair *sorted = to;
        to = list->pairs;
        list->pairs = sorted;
        list->pair_capacity = list->pair_count + 1;
        *done = !collection_must_end(all);
    }
    free(start);
    free(to);
    return code;
}

static imp_code collect_pairs(collection *all, bool *done, imp_error *error)
{
    *done = true;
    if (scene_counts_pairs(all->scene) && imp_scene_pair_count(all->scene) == 0) return IMP_SUCCESS;
    *done = collection_add_pairs(all);
    if (all->out_of_memory) return error_set_memory(error);
    if (*done && scene_has_solids(all->scene)) {
        const imp_code code = collection_add_solids(all, done, error);
        if (code != IMP_SUCCESS) return code;
    }
    if (!*done || all->list->pair_count < 2) return IMP_SUCCESS;
    return sort_pairs(all, done, error);
}

/* Allocates working memory. False: no memory. */
static bool prepare(collection *all)
{
    size_t most = 1; /* malloc(0) may return NULL */
    for (size_t b = 0; b < scene_body_count(all->scene); ++b)
        most += scene_surface_count(all->scene, b);
    all->boxes = most <= BOXES_AT_HAND ? all->at_hand : malloc(most * sizeof *all->boxes);
    all->list->candidates = most <= CANDIDATES_AT_HAND
                                ? all->list->at_hand
                                : malloc(most * sizeof *all->list->candidates);
    if (all->boxes == NULL || all->list->candidates == NULL) return false;
    all->with_roots = most <= ROOTS_AT_ONCE ||
                      !(all->gamma_clear < INFINITY); /* all surfaces are in pairs then */
    if (!parallel_is_on(all->options)) return true;
    all->surfaces = malloc(SURFACES_A_ROUND * sizeof *all->surfaces);
    all->sweep = calloc(TASKS_A_ROUND, sizeof *all->sweep);
    return all->surfaces != NULL && all->sweep != NULL;
}

double collection_slip_most(const imp_options *options, bool may_rest)
{
    if (options->baseline != IMP_BASELINE_NONE || !may_rest) return -1;
    const double clear = tolerances_clear(options->gamma, options->gamma_clear);
    const double room = options->gamma - clear;
    return (clear < room ? clear : room) / TUNING_REST_SLIP;
}

imp_code candidates_find(candidate_list *list, imp_scene *scene, const imp_options *options,
                         const candidate_search *search, const candidate_limit *limit,
                         imp_stats *stats, imp_error *error)
{
    const bool models =
        options->baseline == IMP_BASELINE_NONE; /* the paper's algorithm has no frames */
    collection all = {.scene = scene,
                      .slip_most = collection_slip_most(options, search->may_rest),
                      .common_motion = models ? collection_common_motion(scene) : 0,
                      .options = options,
                      .limit = limit,
                      .stats = stats,
                      .gamma_clear = search->gamma_clear,
                      .list = list};
    bool done = false;
    imp_code code =
        prepare(&all) ? collection_add_surfaces(&all, &done, error) : error_set_memory(error);
    collection_count_rest(&all);
    if (done) code = collect_pairs(&all, &done, error);
    if (done && models && !search->in_parts) code = collection_use_frames(&all, &done, error);
    if (done && !search->in_parts) code = collection_make_roots(&all, &done, error);
    if (all.tree_ended && collection_must_end(&all)) code = IMP_SUCCESS, done = false;
    if (all.boxes != all.at_hand) free(all.boxes);
    free(all.surfaces);
    free(all.sweep);
    list->complete = done && code == IMP_SUCCESS;
    if (!list->complete) candidates_clear(list);
    return code;
}

uint64_t candidates_bytes(const candidate_list *list)
{
    return list->count * sizeof *list->candidates + list->pair_capacity * sizeof *list->pairs;
}

void candidates_clear(candidate_list *list)
{
    for (size_t k = 0; list->owns_trees && list->candidates != NULL && k < list->count; ++k)
        tree_free(list->candidates[k].tree);
    if (list->candidates != list->at_hand) free(list->candidates);
    free(list->pairs);
    *list = (candidate_list){0};
}
