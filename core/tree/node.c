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

/* Halves are mostly made in pairs. */
static const arena_growth node_growth = {2 * sizeof(node), 2 * sizeof(node), 50, 64 * sizeof(node)};

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
static bool follows_net(const node *n)
{
    if (!node_is_part(n)) return false;
    if (node_is_part(n->parent)) return n->parent->follows_net;
    return n->many == NULL && node_bends(n->parent) && surface_offers_net(n->surface);
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
    n->along = place->along;
    n->side = place->side;
    n->follows_net = t->plan.kind == TREE_MODELS && follows_net(n);
}

imp_code node_fill(tree *t, const node_place *place, node *n, tree_growth *growth, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    node_begin(t, place, n);
    if (t->plan.kind == TREE_MODELS && n->parent != NULL)
        code = posing_begin(&t->posing, n, growth, error);
    bool done = false;
    if (code == IMP_SUCCESS && n->follows_net && n->shape == NULL)
        code = node_fill_from_net(t, n, &done, growth, error);
    if (code == IMP_SUCCESS && !done) code = node_bounds_find(t, n, error);
    if (code == IMP_SUCCESS && t->plan.audit != NULL && n->many == NULL)
        code = audit(t, n, growth, error);
    return code;
}

/* Puts a reserved, filled node into the slot, or gives it back if the slot holds another thread's
 * node already. Returns the node in the slot. */
static node *node_publish(tree *t, node *n, _Atomic(node *) *slot)
{
    node *there = NULL;
    if (atomic_compare_exchange_strong_explicit(slot, &there, n, memory_order_acq_rel,
                                                memory_order_acquire))
        return n;
    node_give_back(t, n);
    return there;
}

static imp_code node_make(tree *t, const node_place *place, _Atomic(node *) *slot, node **made,
                          tree_growth *growth, imp_error *error)
{
    node *n = node_reserve(t, growth);
    if (n == NULL) return error_set_memory(error);
    const imp_code code = node_fill(t, place, n, growth, error);
    if (code != IMP_SUCCESS) {
        node_give_back(t, n);
        return code;
    }
    *made = node_publish(t, n, slot);
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
    _Atomic(node *) *slot = &parent->child[j][side];
    node *made = atomic_load_explicit(slot, memory_order_acquire);
    if (made == NULL) {
        const node_place half = place_of_half(parent, j, side);
        const imp_code code = node_make(t, &half, slot, &made, growth, error);
        if (code != IMP_SUCCESS) return code;
    }
    *child = made;
    return IMP_SUCCESS;
}

imp_code node_child_bare(tree *t, node *parent, parameter j, int side, node **child,
                         tree_growth *growth, imp_error *error)
{
    assert(parent->many == NULL && j != PARAMETER_T);
    *child = atomic_load_explicit(&parent->child[j][side], memory_order_acquire);
    if (*child == NULL) *child = atomic_load_explicit(&parent->bare[j][side], memory_order_acquire);
    if (*child != NULL) return IMP_SUCCESS;
    node *n = node_reserve(t, growth);
    if (n == NULL) return error_set_memory(error);
    const node_place half = place_of_half(parent, j, side);
    node_begin(t, &half, n);
    n->bounded = n->is_bare = true;
    *child = node_publish(t, n, &parent->bare[j][side]);
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
