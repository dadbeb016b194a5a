/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/status.h"
#include "core/broad_phase/collection.h"

static bool any_is_missing(const candidate_list *list)
{
    bool any = false;
    for (size_t k = 0; k < list->pair_count && !any; ++k)
        any = !tree_has_root(list->pairs[k].side[0]->tree) ||
              !tree_has_root(list->pairs[k].side[1]->tree);
    return any;
}

/* Lists the surfaces of pairs that lack a root, in the order of the list of pairs. False: no
 * memory. */
static bool find_missing(collection *all)
{
    const candidate_list *list = all->list;
    bool *paired = arena_store_zeroed(list->store, (list->count + 1) * sizeof *paired);
    all->roots = arena_store_zeroed(list->store, (list->count + 1) * sizeof *all->roots);
    const bool ok = paired != NULL && all->roots != NULL;
    for (size_t k = 0; ok && k < list->pair_count; ++k)
        for (int side = 0; side < 2; ++side)
            paired[list->pairs[k].side[side] - list->candidates] = true;
    for (size_t k = 0; ok && k < list->count; ++k)
        if (paired[k] && !tree_has_root(list->candidates[k].tree))
            all->roots[all->root_count++].tree = list->candidates[k].tree;
    arena_store_free_room(list->store, paired);
    return ok;
}

/* Makes a root ahead of its turn. One that fails is made again in its turn. */
static void make_some(void *of, size_t task)
{
    collection *all = of;
    const size_t first = all->first_root + task * SURFACES_A_TASK;
    for (size_t k = first; k < all->root_count && k < first + SURFACES_A_TASK; ++k) {
        root_ahead *r = &all->roots[k];
        if (collection_may_end(all, 0)) return;
        if (tree_make_root(r->tree, &r->growth, NULL) == IMP_SUCCESS)
            atomic_fetch_add(&all->bytes_ahead, r->growth.bytes);
    }
}

static void work_ahead(collection *all)
{
    const size_t rest = all->root_count - all->first_root;
    const size_t some = rest < SURFACES_A_ROUND ? rest : SURFACES_A_ROUND;
    atomic_store(&all->bytes_ahead, 0);
    parallel_run(all->options, make_some, all, (some + SURFACES_A_TASK - 1) / SURFACES_A_TASK);
}

/* Makes or takes all roots in their order. A root made ahead is counted in its turn, or at the
 * end. */
static imp_code take_roots(collection *all, bool *done, imp_error *error)
{
    const bool ahead = parallel_is_on(all->options);
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < all->root_count; ++k) {
        root_ahead *r = &all->roots[k];
        if (*done && code == IMP_SUCCESS && ahead && k % SURFACES_A_ROUND == 0) {
            all->first_root = k;
            work_ahead(all);
        }
        *done = *done && !collection_must_end(all);
        if (*done && code == IMP_SUCCESS) code = tree_make_root(r->tree, &r->growth, error);
        collection_count(all, &r->growth);
    }
    return code;
}

imp_code collection_make_roots(collection *all, bool *done, imp_error *error)
{
    if (!all->any_lacks_root || !any_is_missing(all->list)) return IMP_SUCCESS;
    imp_code code = find_missing(all) ? IMP_SUCCESS : error_set_memory(error);
    if (code == IMP_SUCCESS) code = take_roots(all, done, error);
    arena_store_free_room(all->list->store, all->roots);
    return code;
}
