/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/broad_phase/collection.h"
#include "core/scene/scene_trees.h"
#include "core/tree/bound_audit.h"

#include <impinge/baseline.h>

static tree_kind kind_of(const imp_options *options)
{
    if (options->baseline == IMP_BASELINE_NONE) return TREE_MODELS;
    if ((options->baseline & IMP_BASELINE_COLUMN_RATES) != 0) return TREE_RATES_COLUMN;
    return (options->baseline & IMP_BASELINE_CONSTANT_RATES) != 0 ? TREE_RATES_CONSTANT
                                                                  : TREE_RATES_FULL;
}

/* Fills the plan of a tree. False: the surface exists at none of the query's times. */
static bool plan_of(const collection *all, const surface_view *view, tree_plan *plan)
{
    const imp_options *options = all->options;
    double lo[3], hi[3];
    surface_domain(scene_surface(all->scene, view->body, view->surface), lo, hi);
    *plan = (tree_plan){.kind = kind_of(options),
                        .t_start = lo[2] > options->t_start ? lo[2] : options->t_start,
                        .t_end = hi[2] < options->t_end ? hi[2] : options->t_end,
                        .audit = options->audit ? bound_audit_run : NULL,
                        .left_out = view->left_out,
                        .held = view->held,
                        .aside = view->aside};
    if (!isnan(view->moment)) plan->t_start = plan->t_end = view->moment;
    return plan->t_start <= plan->t_end;
}

static bool may_go_on(void *context)
{
    const collection *all = context;
    return !all->limit->is_near(all->limit->context, 0, 0);
}

limit_watch collection_watch(collection *all) { return (limit_watch){may_go_on, all}; }

/* Makes the trees of some surfaces ahead of their turn. One that fails is made again in its
 * turn. */
static void make_trees(void *of, size_t task)
{
    collection *all = of;
    surface_ahead *s = all->surfaces + task * SURFACES_A_TASK;
    for (size_t k = task * SURFACES_A_TASK; k < all->ahead && k < (task + 1) * SURFACES_A_TASK;
         ++k, ++s) {
        tree_plan plan;
        tree *t;
        if (collection_may_end(all, 0)) return;
        const surface_view view = {
            .body = s->body, .surface = s->surface, .left_out = all->common_motion, .moment = NAN};
        if (!plan_of(all, &view, &plan)) continue;
        if (scene_tree(all->scene, s->body, s->surface, &plan, all->with_roots, &t, &s->growth,
                       NULL) == IMP_SUCCESS)
            atomic_fetch_add(&all->bytes_ahead, s->growth.bytes);
    }
}

/* Lets threads make the trees of the next surfaces, from this one on. */
static void work_ahead(collection *all, size_t body, size_t index)
{
    const size_t bodies = scene_body_count(all->scene);
    all->used = all->ahead = 0;
    for (size_t b = body, k = index; b < bodies && all->ahead < SURFACES_A_ROUND;)
        if (k < scene_surface_count(all->scene, b))
            all->surfaces[all->ahead++] = (surface_ahead){b, k++, {.watch = collection_watch(all)}};
        else
            b += 1, k = 0;
    atomic_store(&all->bytes_ahead, 0);
    parallel_run(all->options, make_trees, all,
                 (all->ahead + SURFACES_A_TASK - 1) / SURFACES_A_TASK);
}

void collection_count_rest(collection *all)
{
    for (; all->used < all->ahead; ++all->used)
        collection_count(all, &all->surfaces[all->used].growth);
}

imp_code collection_make_tree(collection *all, const surface_view *view, candidate *made,
                              bool *exists, imp_error *error)
{
    tree_plan plan;
    tree *t;
    tree_growth growth = {.watch = collection_watch(all)};
    *exists = plan_of(all, view, &plan);
    if (!*exists) return IMP_SUCCESS;
    const imp_code code = scene_tree(all->scene, view->body, view->surface, &plan, all->with_roots,
                                     &t, &growth, error);
    all->tree_ended = growth.ended;
    if (code != IMP_SUCCESS) return code;
    collection_count(all, &growth);
    all->any_lacks_root = all->any_lacks_root || !tree_has_root(t);
    *made = (candidate){.tree = t,
                        .body = view->body,
                        .surface = view->surface,
                        .left_out = view->left_out,
                        .held = view->held,
                        .aside = view->aside,
                        .eval_error = -1};
    return IMP_SUCCESS;
}

/* Adds one surface, if it exists at any of the query's times. */
static imp_code collect_surface(collection *all, size_t body, size_t index, imp_error *error)
{
    bool exists;
    if (all->surfaces != NULL) {
        if (all->used == all->ahead) work_ahead(all, body, index);
        collection_count(all, &all->surfaces[all->used++].growth);
    }
    const size_t k = all->list->count;
    candidate *made = &all->list->candidates[k];
    const surface_view view = {
        .body = body, .surface = index, .left_out = all->common_motion, .moment = NAN};
    const imp_code code = collection_make_tree(all, &view, made, &exists, error);
    if (code != IMP_SUCCESS || !exists) return code;
    all->list->count += 1;
    swept_box *box = &all->boxes[k];
    box->owner = k;
    box->group = body;
    tree_box(made->tree, box->lo, box->hi);
    return IMP_SUCCESS;
}

/* Whether a limit ends the collection before this surface. Limits are checked if one is near, and
 * after a few surfaces or a large one; only surfaces that had their turn count, so that threads
 * change no result. */
static bool must_end_here(collection *all)
{
    const uint64_t made = all->stats->bytes - all->bytes_checked;
    const size_t count = all->list->count;
    const bool many = (count > 0 && count % SURFACES_PER_CHECK == 0) || made >= BYTES_PER_CHECK;
    if (!many && !all->limit->is_near(all->limit->context, made, 0)) return false;
    all->bytes_checked = all->stats->bytes;
    return collection_must_end(all);
}

imp_code collection_add_surfaces(collection *all, bool *done, imp_error *error)
{
    *done = false;
    const size_t bodies = scene_body_count(all->scene);
    for (size_t b = 0; b < bodies; ++b) {
        const size_t count = scene_surface_count(all->scene, b);
        for (size_t k = 0; k < count; ++k) {
            if (must_end_here(all)) return IMP_SUCCESS;
            const imp_code code = collect_surface(all, b, k, error);
            if (code != IMP_SUCCESS) return code;
        }
    }
    *done = true;
    return IMP_SUCCESS;
}
