/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_trees.h"

#include "core/base/status.h"
#include "core/scene/scene_internal.h"
#include "core/surface/aside.h"
#include "core/surface/held.h"

static void inner_free(const imp_scene *scene, inner *i)
{
    surface_free(i->surface);
    arena_store_free_room(scene->store, i);
}

void scene_free_trees(const imp_scene *scene, member *m)
{
    for (tree *t = m->trees, *next; t != NULL; t = next) {
        next = tree_next(t);
        tree_free(t);
    }
    for (inner *i = m->inners, *next; i != NULL; i = next) {
        next = i->next;
        inner_free(scene, i);
    }
}

/* Returns the first tree of the list that is of this plan; NULL: there is none yet. */
static tree *find_tree(tree *t, const tree_plan *plan)
{
    while (t != NULL && !tree_is_of(t, plan)) t = tree_next(t);
    return t;
}

/* Adds the tree to the list, unless another thread has added one: then `made` is freed and that one
 * returned. */
static tree *keep_tree(member *m, const tree_plan *plan, tree *made)
{
    tree *first = atomic_load_explicit(&m->trees, memory_order_acquire);
    do {
        tree *found = find_tree(first, plan);
        if (found != NULL) {
            tree_free(made);
            return found;
        }
        tree_set_next(made, first);
    } while (!atomic_compare_exchange_weak_explicit(&m->trees, &first, made, memory_order_release,
                                                    memory_order_acquire));
    return made;
}

static const surface *find_inner(const inner *i, const tree_plan *plan)
{
    while (i != NULL &&
           (i->left_out != plan->left_out || !held_maps_are_equal(i->held, plan->held) ||
            !maps_aside_are_equal(i->aside, plan->aside)))
        i = i->next;
    return i != NULL ? i->surface : NULL;
}

static surface *new_inner(const surface *s, const tree_plan *plan)
{
    const size_t maps = surface_map_count(s) - plan->left_out;
    if (plan->aside.which != 0) return surface_new_aside(s, maps, plan->aside);
    return plan->held.count > 0 ? surface_new_held(s, maps, plan->held)
                                : surface_new_inner(s, maps);
}

/* Returns the surface of the plan, made now if it is asked for first. NULL: no memory. */
static const surface *surface_in_frame(const imp_scene *scene, member *m, const tree_plan *plan,
                                       tree_growth *growth)
{
    if (plan->left_out == 0 && plan->held.count == 0 && plan->aside.which == 0) return m->surface;
    inner *first = atomic_load_explicit(&m->inners, memory_order_acquire);
    const surface *found = find_inner(first, plan);
    if (found != NULL) return found;
    inner *made = arena_store_room(scene->store, sizeof *made);
    if (made == NULL) return NULL;
    *made = (inner){NULL, new_inner(m->surface, plan), plan->left_out, plan->held, plan->aside};
    if (made->surface == NULL) {
        arena_store_free_room(scene->store, made);
        return NULL;
    }
    do {
        found = find_inner(first, plan);
        if (found != NULL) {
            inner_free(scene, made);
            return found;
        }
        made->next = first;
    } while (!atomic_compare_exchange_weak_explicit(&m->inners, &first, made, memory_order_release,
                                                    memory_order_acquire));
    growth->bytes += sizeof *made + surface_bytes(made->surface);
    for (size_t k = 1; k <= plan->held.count; ++k)
        growth->bytes += instance_bytes(surface_origin(made->surface, k));
    return made->surface;
}

/* Threads may make trees of one surface at once; one of each plan is kept. */
imp_code scene_tree(imp_scene *scene, size_t body, size_t index, const tree_plan *plan,
                    bool with_root, tree **found, tree_growth *growth, imp_error *error)
{
    member *m = &scene->bodies[body].members[index];
    tree *made;
    tree_growth own = {.watch = growth->watch};
    *found = find_tree(atomic_load_explicit(&m->trees, memory_order_acquire), plan);
    if (*found != NULL) return IMP_SUCCESS;
    const surface *s = surface_in_frame(scene, m, plan, growth);
    if (s == NULL) return error_set_memory(error);
    tree_plan stored = *plan;
    stored.store = scene->store;
    const imp_code code = with_root ? tree_new(s, &stored, &made, &own, error)
                                    : tree_new_without_root(s, &stored, &made, &own, error);
    growth->ended = own.ended;
    if (code != IMP_SUCCESS) return code;
    *found = keep_tree(m, plan, made);
    if (*found == made) growth->nodes += own.nodes, growth->bytes += own.bytes;
    return IMP_SUCCESS;
}
