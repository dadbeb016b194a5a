/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <assert.h>
#include <stddef.h>
#include <string.h>

#include "core/base/status.h"
#include "core/tree/tree_internal.h"

/* A tree keeps a box as lo and hi, side by side as in a node. */
_Static_assert(offsetof(node, hi) == offsetof(node, lo) + 3 * sizeof(double), "lo, then hi");

static node *own_root(tree *t)
{
    assert(t->begins_with_root);
    return (node *)(void *)t->rest;
}

/* Makes the hierarchy of the pieces, if there are several. */
static imp_code make_hierarchy(tree *t, tree_growth *growth, imp_error *error)
{
    if (surface_piece_count(t->surface) <= 1 || t->pieces != NULL) return IMP_SUCCESS;
    const imp_code code = hierarchy_of(t->surface, t->plan.t_start, t->plan.t_end, &growth->watch,
                                       t->plan.store, &t->pieces, error);
    if (code != IMP_SUCCESS) return code;
    growth->ended = t->pieces == NULL;
    if (growth->ended) return IMP_ERROR_USAGE; /* without a text: whoever set the watch knows */
    growth->bytes += hierarchy_bytes(t->pieces);
    return IMP_SUCCESS;
}

static node_place place_of_root(const tree *t)
{
    const double from = t->plan.t_start, to = t->plan.t_end;
    if (t->pieces != NULL)
        return node_place_of_cluster(t->surface, hierarchy_root(t->pieces), from, to);
    node_place place = node_place_of_surface(t->surface, from, to);
    if (surface_piece_count(t->surface) == 1) place.surface = surface_piece(t->surface, 0);
    return place;
}

static imp_code root_fill(tree *t, node *root, tree_growth *growth, imp_error *error)
{
    const imp_code code = make_hierarchy(t, growth, error);
    if (code != IMP_SUCCESS) return code;
    const node_place place = place_of_root(t);
    return node_fill(t, &place, root, growth, error);
}

typedef struct root_box {
    double lo[3], hi[3];
} root_box;

static size_t tree_bytes(bool with_root)
{
    return sizeof(tree) + (with_root ? sizeof(node) : sizeof(root_box));
}

/* Makes a tree whose root is not filled yet. NULL: no memory. */
static tree *tree_begin(const surface *s, const tree_plan *plan, bool with_root)
{
    tree *t = arena_store_room(plan->store, tree_bytes(with_root));
    if (t == NULL) return NULL;
    *t = (tree){.surface = s,
                .plan = *plan,
                .begins_with_root = with_root,
                .lock = PTHREAD_MUTEX_INITIALIZER};
    return t;
}

static void set_root(tree *t, node *root)
{
    atomic_store_explicit(&t->root, root, memory_order_release);
}

static imp_code begin_root(tree *t, tree_growth *growth, imp_error *error)
{
    node passing, *root = t->begins_with_root ? own_root(t) : &passing;
    const imp_code code = root_fill(t, root, growth, error);
    if (code != IMP_SUCCESS) return code;
    if (t->begins_with_root)
        set_root(t, root);
    else
        memcpy(t->rest, root->lo, sizeof(root_box));
    growth->nodes += t->begins_with_root;
    growth->bytes += tree_bytes(t->begins_with_root);
    return IMP_SUCCESS;
}

static imp_code make_tree(const surface *s, const tree_plan *plan, bool with_root, tree **made,
                          tree_growth *growth, imp_error *error)
{
    tree *t = tree_begin(s, plan, with_root);
    if (t == NULL) return error_set_memory(error);
    const imp_code code = begin_root(t, growth, error);
    if (code == IMP_SUCCESS)
        *made = t;
    else
        tree_free(t);
    return code;
}

imp_code tree_new(const surface *s, const tree_plan *plan, tree **made, tree_growth *growth,
                  imp_error *error)
{
    return make_tree(s, plan, true, made, growth, error);
}

imp_code tree_new_without_root(const surface *s, const tree_plan *plan, tree **made,
                               tree_growth *growth, imp_error *error)
{
    return make_tree(s, plan, false, made, growth, error);
}

imp_code tree_make_root(tree *t, tree_growth *growth, imp_error *error)
{
    if (tree_has_root(t)) return IMP_SUCCESS;
    node *filled = arena_store_room(t->plan.store, sizeof *filled);
    if (filled == NULL) return error_set_memory(error);
    const imp_code code = root_fill(t, filled, growth, error);
    pthread_mutex_lock(&t->lock);
    if (code == IMP_SUCCESS && !tree_has_root(t)) {
        set_root(t, filled);
        growth->nodes += 1;
        growth->bytes += sizeof *filled;
        filled = NULL;
    }
    pthread_mutex_unlock(&t->lock);
    arena_store_free_room(t->plan.store, filled);
    return code;
}

imp_code tree_new_from_root(const tree *t, tree **made, tree_growth *growth, imp_error *error)
{
    const node *root = tree_root(t);
    tree *copy = tree_begin(t->surface, &t->plan, true);
    if (copy == NULL) return error_set_memory(error);
    memset(own_root(copy), 0, sizeof(node));
    memcpy(own_root(copy), root, offsetof(node, net)); /* no thread changes it */
    set_root(copy, own_root(copy));
    growth->bytes += tree_bytes(true);
    *made = copy;
    return IMP_SUCCESS;
}

imp_code tree_new_at(const tree *t, double moment, tree **made, tree_growth *growth,
                     imp_error *error)
{
    tree_plan plan = t->plan;
    plan.t_start = plan.t_end = moment;
    tree *at = tree_begin(t->surface, &plan, true);
    if (at == NULL) return error_set_memory(error);
    at->pieces = hierarchy_hold(t->pieces); /* bounds over longer times hold at the moment, too */
    const imp_code code = begin_root(at, growth, error);
    if (code == IMP_SUCCESS)
        *made = at;
    else
        tree_free(at);
    return code;
}

imp_code tree_box_within(const tree *t, double from, double to, bool *exists, double lo[3],
                         double hi[3], imp_error *error)
{
    tree_plan plan = t->plan;
    tree_growth growth = {0};
    if (from > plan.t_start) plan.t_start = from;
    if (to < plan.t_end) plan.t_end = to;
    *exists = plan.t_start <= plan.t_end;
    if (!*exists) return IMP_SUCCESS;
    tree *within = tree_begin(t->surface, &plan, false);
    if (within == NULL) return error_set_memory(error);
    within->pieces = hierarchy_hold(t->pieces); /* bounds over longer times hold */
    const imp_code code = begin_root(within, &growth, error);
    if (code == IMP_SUCCESS) tree_box(within, lo, hi);
    tree_free(within);
    return code;
}

size_t tree_own_bytes(const tree *t)
{
    return tree_bytes(t->begins_with_root) + arena_bytes(&t->nodes) + arena_bytes(&t->nets) +
           arena_bytes(&t->posing.memory);
}

void tree_free(tree *t)
{
    if (t == NULL) return;
    arena_clear(&t->nodes, t->plan.store);
    hierarchy_release(t->pieces);
    arena_clear(&t->nets, t->plan.store);
    arena_clear(&t->posing.memory, t->plan.store);
    pthread_mutex_destroy(&t->lock);
    arena_store *store = t->plan.store;
    if (!t->begins_with_root)
        arena_store_free_room(store, atomic_load_explicit(&t->root, memory_order_relaxed));
    arena_store_free_room(store, t);
}

tree *tree_next(const tree *t) { return t->next; }

void tree_set_next(tree *t, tree *next) { t->next = next; }

bool tree_has_root(const tree *t)
{
    return atomic_load_explicit(&t->root, memory_order_acquire) != NULL;
}

node *tree_root(const tree *t)
{
    assert(tree_has_root(t));
    return atomic_load_explicit(&t->root, memory_order_acquire);
}

void tree_box(const tree *t, double lo[3], double hi[3])
{
    const double *box = t->begins_with_root ? tree_root(t)->lo : t->rest;
    memcpy(lo, box, 3 * sizeof *lo);
    memcpy(hi, box + 3, 3 * sizeof *hi);
}

const surface *tree_surface(const tree *t) { return t->surface; }

bool tree_is_of(const tree *t, const tree_plan *plan)
{
    return t->plan.kind == plan->kind && t->plan.t_start == plan->t_start &&
           t->plan.t_end == plan->t_end && t->plan.audit == plan->audit &&
           t->plan.left_out == plan->left_out && held_maps_are_equal(t->plan.held, plan->held) &&
           maps_aside_are_equal(t->plan.aside, plan->aside);
}

bool tree_is_audited(const tree *t) { return t->plan.audit != NULL; }

arena_store *tree_store(const tree *t) { return t->plan.store; }
