/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/node.h"

#include <assert.h>
#include <stddef.h>
#include <string.h>

#include "core/base/status.h"
#include "core/tree/tree_internal.h"

/* --- Memory ----------------------------------------------------------------------------------- */

/* Halves are mostly made in pairs. Most trees of large scenes have some ten nodes: these get blocks
 * of one after the first, which leaves little unused. */
static const arena_growth node_growth = {2 * sizeof(node), sizeof(node), 10, 64 * sizeof(node)};

/* Reserves memory for a node, which is then published or given back. NULL: no memory. */
static node *node_reserve(tree *t, tree_growth *growth)
{
    node *n = NULL;
    if (atomic_load_explicit(&t->spare, memory_order_relaxed) == NULL)
        n = arena_next(&t->nodes, sizeof *n);
    if (n != NULL) return n;
    pthread_mutex_lock(&t->lock);
    n = atomic_load_explicit(&t->spare, memory_order_relaxed);
    if (n != NULL)
        atomic_store_explicit(&t->spare, n->parent, memory_order_relaxed);
    else
        n = arena_take(&t->nodes, &node_growth, sizeof *n, &growth->bytes, t->plan.store);
    pthread_mutex_unlock(&t->lock);
    return n;
}

static void node_give_back(tree *t, node *n)
{
    pthread_mutex_lock(&t->lock);
    n->parent = atomic_load_explicit(&t->spare, memory_order_relaxed);
    atomic_store_explicit(&t->spare, n, memory_order_relaxed);
    pthread_mutex_unlock(&t->lock);
}

/* --- Making ----------------------------------------------------------------------------------- */

/* Audits a node with its net. If the net is not made yet, one is made for the audit alone, and
 * again when it is needed. */
static imp_code audit(tree *t, node *n, tree_growth *growth, imp_error *error)
{
    net_buffer buffer;
    const net *made;
    if (node_net_is_asked(n)) return t->plan.audit(n->surface, n, error);
    imp_code code = node_net_find(t, n, false, &buffer, &made, growth, error);
    if (code != IMP_SUCCESS) return code;
    atomic_store_explicit(&n->net, made, memory_order_relaxed);
    code = t->plan.audit(n->surface, n, error);
    atomic_store_explicit(&n->net, NULL, memory_order_relaxed);
    return code;
}

/* Decides once per surface whether nodes take their models from their nets, so that models depend
 * on the region alone, not on earlier calls. Such models are worth the nets only where patches
 * bend. */
static node_source follows(const node *n)
{
    if (!node_is_part(n)) return FOLLOWS_SURFACE;
    if (node_is_part(n->parent)) return n->parent->follows;
    if (n->along == NODE_AS_TUBE) return FOLLOWS_LINE;
    const bool bends = n->many == NULL && node_bends(n->parent);
    return bends && surface_offers_net(n->surface) ? FOLLOWS_NET : FOLLOWS_SURFACE;
}

/* Initialises every field that filling does not set, and the bounds to which rates are added. */
static void node_begin(const tree *t, const node_place *place, node *n)
{
    const size_t set = t->plan.kind == TREE_MODELS ? offsetof(node, bounded) : 0;
    memset((char *)n + set, 0, sizeof *n - set);
    if (place->is_half)
        region_set_half(&n->region, &place->parent->region, place->along, place->side);
    else
        region_set(&n->region, place->lo, place->hi);
    n->radius = 0;
    n->surface = place->surface;
    n->many = place->many;
    n->parent = place->parent;
    n->along = (unsigned char)place->along;
    n->side = (unsigned char)place->side;
    if (t->plan.kind == TREE_MODELS) n->follows = (unsigned char)follows(n);
}

imp_code node_fill(tree *t, const node_place *place, node *n, tree_growth *growth, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    node_begin(t, place, n);
    if (t->plan.kind == TREE_MODELS && n->parent != NULL) code = posing_begin(t, n, growth, error);
    bool done = false;
    if (code == IMP_SUCCESS && n->follows == FOLLOWS_NET && n->shape == NULL)
        code = node_fill_from_net(t, n, &done, growth, error);
    if (code == IMP_SUCCESS && !done) code = node_bounds_find(t, n, error);
    if (code == IMP_SUCCESS && t->plan.audit != NULL && n->many == NULL)
        code = audit(t, n, growth, error);
    return code;
}

/* Returns the half in the list of halves that is of this kind; NULL: there is none. Most nodes have
 * two. */
static node *find_half(node *first, parameter j, int side, bool is_bare)
{
    while (first != NULL && (first->along != j || first->side != side || first->is_bare != is_bare))
        first = first->sibling;
    return first;
}

static node *half_of(const node *parent, parameter j, int side, bool is_bare)
{
    node *first = atomic_load_explicit(&parent->halves, memory_order_acquire);
    return find_half(first, j, side, is_bare);
}

/* Adds a reserved, filled node to its parent's halves, or gives it back if another thread has added
 * one like it. Returns the one that is there. */
static node *node_publish(tree *t, node *n)
{
    node *first = atomic_load_explicit(&n->parent->halves, memory_order_acquire);
    do {
        node *there = find_half(first, n->along, n->side, n->is_bare);
        if (there != NULL) {
            node_give_back(t, n);
            return there;
        }
        n->sibling = first;
    } while (!atomic_compare_exchange_weak_explicit(&n->parent->halves, &first, n,
                                                    memory_order_acq_rel, memory_order_acquire));
    return n;
}

static imp_code node_make(tree *t, const node_place *place, node **made, tree_growth *growth,
                          imp_error *error)
{
    node *n = node_reserve(t, growth);
    if (n == NULL) return error_set_memory(error);
    const imp_code code = node_fill(t, place, n, growth, error);
    if (code != IMP_SUCCESS) {
        node_give_back(t, n);
        return code;
    }
    *made = node_publish(t, n);
    growth->nodes += *made == n;
    return IMP_SUCCESS;
}

/* --- Halves ----------------------------------------------------------------------------------- */

node_place node_place_of_surface(const surface *s, double t_start, double t_end)
{
    node_place place = {.surface = s};
    surface_domain(s, place.lo, place.hi);
    assert(place.lo[2] <= t_start && t_start <= t_end && t_end <= place.hi[2]);
    place.lo[2] = t_start;
    place.hi[2] = t_end;
    return place;
}

node_place node_place_of_cluster(const surface *s, const cluster *many, double t_start,
                                 double t_end)
{
    return (node_place){.lo = {-1, 0, t_start}, .hi = {1, 0, t_end}, .surface = s, .many = many};
}

/* Returns which points and times a half of a node is to bound. */
static node_place points_of_half(const node *parent, parameter j, int side)
{
    const imp_region *r = &parent->region;
    const cluster *many = parent->many;
    if (many != NULL && j == PARAMETER_U) {
        const cluster *half = many->child[side];
        if (half != NULL) return node_place_of_cluster(parent->surface, half, r->lo[2], r->hi[2]);
        return node_place_of_surface(surface_piece(parent->surface, many->piece[side]), r->lo[2],
                                     r->hi[2]);
    }
    return (node_place){.is_half = true, .surface = parent->surface, .many = many};
}

static node_place place_of_half(node *parent, parameter j, int side)
{
    node_place half = points_of_half(parent, j, side);
    half.parent = parent, half.along = j, half.side = side;
    return half;
}

imp_code node_child(tree *t, node *parent, parameter j, int side, node **child, tree_growth *growth,
                    imp_error *error)
{
    node *there = half_of(parent, j, side, false);
    if (there == NULL) {
        const node_place half = place_of_half(parent, j, side);
        const imp_code code = node_make(t, &half, &there, growth, error);
        if (code != IMP_SUCCESS) return code;
    }
    *child = there;
    return IMP_SUCCESS;
}

imp_code node_tube(tree *t, node *root, node **tube, tree_growth *growth, imp_error *error)
{
    assert(root->parent == NULL && root->many == NULL);
    *tube = half_of(root, NODE_AS_TUBE, 0, false);
    if (*tube != NULL) return IMP_SUCCESS;
    node *n = node_reserve(t, growth);
    if (n == NULL) return error_set_memory(error);
    const double *lo = root->region.lo, *hi = root->region.hi;
    node_place all = node_place_of_surface(root->surface, lo[PARAMETER_T], hi[PARAMETER_T]);
    all.parent = root, all.along = NODE_AS_TUBE;
    const imp_code code = node_fill(t, &all, n, growth, error);
    if (code != IMP_SUCCESS) return node_give_back(t, n), code;
    *tube = node_publish(t, n);
    growth->nodes += *tube == n;
    return IMP_SUCCESS;
}

imp_code node_child_bare(tree *t, node *parent, parameter j, int side, node **child,
                         tree_growth *growth, imp_error *error)
{
    assert(parent->many == NULL && j != PARAMETER_T);
    node *there = half_of(parent, j, side, false);
    if (there == NULL) there = half_of(parent, j, side, true);
    if (there != NULL) {
        *child = there;
        return IMP_SUCCESS;
    }
    node *n = node_reserve(t, growth);
    if (n == NULL) return error_set_memory(error);
    const node_place half = place_of_half(parent, j, side);
    node_begin(t, &half, n);
    n->bounded = n->is_bare = true;
    *child = node_publish(t, n);
    return IMP_SUCCESS;
}

imp_code node_unbounded_fault(const tree *t, const node *n, imp_error *error)
{
    double x[3];
    const double *p = n->region.c;
    const imp_status status = surface_eval(n->surface, 1, p, x, NULL);
    if (status != IMP_STATUS_OK)
        return surface_fault(n->surface, error, "at u = %.17g, v = %.17g, t = %.17g: %s", p[0],
                             p[1], p[2], surface_status_message(n->surface, status).text);
    return node_fault(
        n,
        t->plan.kind == TREE_MODELS
            ? "has no bounds there, however small the region; shrink its domain, or the "
              "times asked for, to where it (and each map on it) is bounded"
            : "has no bounds of its rates there, however small the region; shrink its "
              "domain, or use another method than the paper's",
        error);
}
