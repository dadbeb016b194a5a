/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/base/status.h"
#include "core/tree/net_series.h"
#include "core/tree/tree_internal.h"

const net net_none;

/* Reserves memory for a net. NULL: no memory. */
static net *net_alloc(tree *t, size_t bytes, tree_growth *growth)
{
    const arena_growth sizes = {bytes, bytes, 100, 64 * bytes};
    net *n = arena_next(&t->nets, bytes);
    if (n != NULL) return n;
    pthread_mutex_lock(&t->lock);
    n = arena_take(&t->nets, &sizes, bytes, &growth->bytes, t->plan.store);
    pthread_mutex_unlock(&t->lock);
    return n;
}

/* Calls the surface's net callback, into the buffer. NULL: there is no net that can be used. */
static imp_code call_net(const node *n, net_buffer *buffer, const net **made, imp_error *error)
{
    imp_net given;
    const imp_status status = surface_net(n->surface, &n->region, &given);
    *made = NULL;
    if (status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    if (status != IMP_STATUS_OK) return node_status_fault(n, status, error);
    if (net_take(net_in(buffer), &given, &n->region)) *made = net_in(buffer);
    return IMP_SUCCESS;
}

static bool may_have_net(const tree *t, const node *n)
{
    return t->plan.kind == TREE_MODELS && n->bounded && n->many == NULL &&
           surface_offers_net(n->surface);
}

/* Whether the node's net is a half of its parent's net, `whole`. */
static bool is_half_of(const node *n, const net *whole)
{
    return whole != NULL && n->along != PARAMETER_T && n->bounded &&
           net_can_halve(&n->parent->region, n->along);
}

/* Makes the net in the buffer, if possible by halving the parent's net `whole`, which may be in the
 * buffer. Returns it, or `whole` itself; NULL: there is none. */
static imp_code fill_net(const tree *t, const node *n, const net *whole, net_buffer *buffer,
                         const net **made, imp_error *error)
{
    *made = NULL;
    if (!may_have_net(t, n)) return IMP_SUCCESS;
    if (is_half_of(n, whole)) {
        net_halve(whole, n->along, n->side, net_in(buffer));
        *made = net_in(buffer);
    } else if (whole != NULL && n->along == PARAMETER_T) {
        *made = whole;
    } else {
        return call_net(n, buffer, made, error);
    }
    return IMP_SUCCESS;
}

/* Copies a net from the buffer into the tree. NULL: no memory. */
static const net *net_copy(tree *t, const net *filled, tree_growth *growth)
{
    const size_t bytes = net_bytes(filled);
    net *kept = net_alloc(t, bytes, growth);
    return kept != NULL ? memcpy(kept, filled, bytes) : NULL;
}

/* Publishes the net of n and returns it, or another thread's that was published already; the memory
 * of this one is then unused. NULL: it has none. */
static const net *net_publish(node *n, const net *made)
{
    const net *there = NULL;
    if (made == NULL) made = &net_none;
    if (!atomic_compare_exchange_strong_explicit(&n->net, &there, made, memory_order_acq_rel,
                                                 memory_order_acquire))
        made = there;
    return made != &net_none ? made : NULL;
}

/* Publishes *made, NULL if there is none; a net in the buffer is copied first. False: no memory. */
static bool net_keep(tree *t, node *n, const net **made, const net_buffer *buffer,
                     tree_growth *growth)
{
    const bool is_in_buffer = *made == (const void *)buffer->memory;
    const net *kept = is_in_buffer ? net_copy(t, *made, growth) : *made;
    if (is_in_buffer && kept == NULL) return false;
    *made = net_publish(n, kept);
    return true;
}

/* Makes the half of a net in the tree's memory. False: no memory. */
static bool net_keep_half(tree *t, node *n, const net *whole, const net **made, tree_growth *growth)
{
    net *half = net_alloc(t, net_bytes(whole), growth);
    if (half == NULL) return false;
    net_halve(whole, n->along, n->side, half);
    *made = net_publish(n, half);
    return true;
}

/* Makes the net and publishes it. */
static imp_code make_net(tree *t, node *n, const net *whole, net_buffer *buffer, const net **made,
                         tree_growth *growth, imp_error *error)
{
    bool is_kept;
    if (is_half_of(n, whole)) {
        is_kept = net_keep_half(t, n, whole, made, growth);
    } else {
        const imp_code code = fill_net(t, n, whole, buffer, made, error);
        if (code != IMP_SUCCESS) return code;
        is_kept = net_keep(t, n, made, buffer, growth);
    }
    return is_kept ? IMP_SUCCESS : error_set_memory(error);
}

imp_code node_net_find(tree *t, node *n, bool is_to_keep, net_buffer *buffer, const net **made,
                       tree_growth *growth, imp_error *error)
{
    node *at = n;
    while (node_is_part(at) && !node_net_is_asked(at->parent)) at = at->parent;
    const net *whole = node_is_part(at) ? node_net_made(at->parent) : NULL;
    for (;;) {
        const bool keeps = at == n ? is_to_keep : !at->is_bare;
        const imp_code code = keeps ? make_net(t, at, whole, buffer, &whole, growth, error)
                                    : fill_net(t, at, whole, buffer, &whole, error);
        if (code != IMP_SUCCESS || at == n) return *made = whole, code;
        node *below = n;
        while (below->parent != at) below = below->parent;
        at = below;
    }
}

imp_code node_net(tree *t, node *n, const net **found, tree_growth *growth, imp_error *error)
{
    if (!node_net_is_asked(n)) {
        net_buffer buffer;
        const net *made;
        const imp_code code = node_net_find(t, n, true, &buffer, &made, growth, error);
        if (code != IMP_SUCCESS) return code;
    }
    *found = node_net_made(n);
    return IMP_SUCCESS;
}

imp_code node_fill_from_net(tree *t, node *n, bool *done, tree_growth *growth, imp_error *error)
{
    net_buffer buffer;
    const net *made;
    n->bounded = true;
    const imp_code code = node_net_find(t, n, true, &buffer, &made, growth, error);
    if (code != IMP_SUCCESS) return code;
    *done = made != NULL && net_series_take(made, n);
    if (made != NULL && !*done) n->follows = FOLLOWS_SURFACE;
    return IMP_SUCCESS;
}
