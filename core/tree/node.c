/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/node.h"

#include <assert.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/tree/node_model.h"
#include "core/tree/posing.h"

/* Chunks of 4, 16, 64, 64, ... nodes beside the root. */
enum { CHUNK_GROWTH = 4, CHUNK_NODES_MAX = 64 };

typedef struct chunk {
    struct chunk *next;
    size_t used, capacity;
    node nodes[];
} chunk;

/* Blocks of nets: room for 1, 4, 16, 64, 64, ... as the chunks. */
typedef struct arena {
    struct arena *next;
    size_t used, capacity; /* bytes */
    double memory[];
} arena;

struct tree {
    const surface *surface;
    tree_plan plan;
    tree *next;
    _Atomic(node *) root; /* NULL: not made yet */
    bool begins_with_root;
    pthread_mutex_t lock; /* of chunks, spare nodes, the root, and nets while one is published */
    chunk *chunks;
    node *spare;       /* reserved, but not published; each one's parent is the next */
    hierarchy *pieces; /* NULL: it is one surface */
    arena *nets;
    posing posing;
    double rest[]; /* the root, if the tree begins with it; else the root's box */
};

static node *own_root(tree *t)
{
    assert(t->begins_with_root);
    return (node *)(void *)t->rest;
}

/* --- Memory ------------------------------------------------------------------- */

static node *node_alloc(tree *t, tree_growth *growth)
{
    if (t->chunks == NULL || t->chunks->used == t->chunks->capacity) {
        const size_t wanted = t->chunks == NULL ? CHUNK_GROWTH : CHUNK_GROWTH * t->chunks->capacity;
        const size_t capacity = wanted < CHUNK_NODES_MAX ? wanted : CHUNK_NODES_MAX;
        const size_t bytes = sizeof(chunk) + capacity * sizeof(node);
        chunk *fresh = malloc(bytes);
        if (fresh == NULL) return NULL;
        *fresh = (chunk){.next = t->chunks, .capacity = capacity};
        t->chunks = fresh;
        growth->bytes += bytes;
    }
    return &t->chunks->nodes[t->chunks->used++];
}

/* Room for a node, which is then published or given back; NULL: no memory. */
static node *node_reserve(tree *t, tree_growth *growth)
{
    pthread_mutex_lock(&t->lock);
    node *n = t->spare;
    if (n != NULL)
        t->spare = n->parent;
    else
        n = node_alloc(t, growth);
    pthread_mutex_unlock(&t->lock);
    return n;
}

static void node_give_back(tree *t, node *n)
{
    pthread_mutex_lock(&t->lock);
    n->parent = t->spare;
    t->spare = n;
    pthread_mutex_unlock(&t->lock);
}

/* Room for a net; NULL: no memory. */
static net *net_alloc(tree *t, size_t bytes, tree_growth *growth)
{
    if (t->nets == NULL || t->nets->capacity - t->nets->used < bytes) {
        const size_t wanted = t->nets == NULL ? bytes : CHUNK_GROWTH * t->nets->capacity;
        const size_t most = CHUNK_NODES_MAX * bytes;
        const size_t capacity = wanted < bytes ? bytes : wanted < most ? wanted : most;
        arena *fresh = malloc(sizeof *fresh + capacity);
        if (fresh == NULL) return NULL;
        *fresh = (arena){.next = t->nets, .capacity = capacity};
        t->nets = fresh;
        growth->bytes += sizeof *fresh + capacity;
    }
    net *n = (net *)(void *)((char *)t->nets->memory + t->nets->used);
    t->nets->used += bytes;
    return n;
}

/* --- Faults of plugins ---------------------------------------------------------- */

static imp_code fault(const node *n, const char *what, imp_error *error)
{
    const imp_region *r = &n->region;
    return surface_fault(n->surface, error,
                         "over u [%.17g, %.17g], v [%.17g, %.17g], t [%.17g, %.17g]: %s", r->lo[0],
                         r->hi[0], r->lo[1], r->hi[1], r->lo[2], r->hi[2], what);
}

static imp_code status_fault(const node *n, imp_status status, imp_error *error)
{
    fault(n, surface_status_told(n->surface, status).text, error);
    return surface_set_code(status, error);
}

/* --- Nodes of models -------------------------------------------------------------- */

static imp_code fill_from_model(const tree *t, node *n, imp_error *error)
{
    imp_model model[3];
    if (posing_fill(n)) return IMP_SUCCESS;
    if (n->many != NULL) cluster_models(n->many, &n->region, model);
    const imp_status status = n->many != NULL ? surface_include_image(t->surface, &n->region, model)
                                              : surface_include(n->surface, &n->region, model);
    if (status != IMP_OK && status != IMP_UNBOUNDED) return status_fault(n, status, error);
    const char *breach = node_take_model(n, model, status == IMP_UNBOUNDED);
    return breach != NULL ? fault(n, breach, error) : IMP_SUCCESS;
}

/* --- Nodes of rates ----------------------------------------------------------------- */

/* Half-widths and radius from the rate matrix in one of the paper's three forms. Roundings of the
 * longest chain, where a square root halves those of its argument and counts one:
 *
 *   Frobenius norm: square 1, sums 2 + 2, root    (1 + 2 + 2) / 2 + 1 <= 4
 *   |d|: square 1, sums 2, root                   (1 + 2) / 2 + 1     <= 3
 *   reach: their product                          4 + 3 + 1           = 8
 *   radius of the full form: reach 3 each, square 1, sums 2, root
 *                                                 3 + (1 + 2) / 2 + 1 <= 6 */
PAD_COVERS(32, 4 + 3 + 1);
static void reach_from_rates(node *n, tree_kind kind, const imp_rate_matrix *m)
{
    const double *d = n->region.d;
    double column[3] = {0, 0, 0}, all = 0, reach[3], radius = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) column[j] += m->m[i][j] * m->m[i][j];
    for (int j = 0; j < 3; ++j) {
        all += column[j];
        column[j] = sqrt(column[j]);
    }
    for (int i = 0; i < 3; ++i) {
        if (kind == TREE_RATES_FULL)
            reach[i] = m->m[i][0] * d[0] + m->m[i][1] * d[1] + m->m[i][2] * d[2];
        else if (kind == TREE_RATES_COLUMN)
            reach[i] = column[0] * d[0] + column[1] * d[1] + column[2] * d[2];
        else
            reach[i] = sqrt(all) * sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        radius += reach[i] * reach[i];
        n->e[i] += padded_upper(reach[i], 32) + ROOT_UNDERFLOW;
    }
    radius = kind == TREE_RATES_FULL ? sqrt(radius) : reach[0];
    n->radius += padded_upper(radius, 32) + ROOT_UNDERFLOW; /* its sums: separation_of_balls */
    for (int j = 0; j < 3; ++j) n->extent[j] = n->nonlinear_extent[j] = column[j] * d[j];
}

static void take_infinite(node *n)
{
    for (int i = 0; i < 3; ++i) {
        n->lo[i] = -INFINITY;
        n->e[i] = n->hi[i] = INFINITY;
        n->extent[i] = n->nonlinear_extent[i] = n->region.d[i];
    }
    n->radius = INFINITY;
    n->bounded = false;
}

/* A cluster has no rates of its own: its box, and the ball around that. Roundings of the radius: half a
 * side 2, square 1, sums 2, which the root halves, and its own: (2 * 2 + 1 + 2) / 2 + 1 < 8 - 2. */
PAD_COVERS(8, 5);
static imp_code fill_from_box(const tree *t, node *n, imp_error *error)
{
    const imp_code code = fill_from_model(t, n, error);
    if (code != IMP_SUCCESS) return code;
    if (!n->bounded) return take_infinite(n), IMP_SUCCESS;
    memset(&n->f, 0, sizeof n->f);
    for (int i = 0; i < 3; ++i) {
        n->f.a[i] = 0.5 * n->lo[i] + 0.5 * n->hi[i];
        const double below = sum_upper(n->f.a[i], -n->lo[i]);
        const double above = sum_upper(n->hi[i], -n->f.a[i]);
        n->e[i] = below > above ? below : above;
        n->radius += n->e[i] * n->e[i];
    }
    n->radius = padded_upper(sqrt(n->radius), 8) + ROOT_UNDERFLOW;
    return IMP_SUCCESS;
}

static imp_code fill_from_rates(const tree *t, node *n, imp_error *error)
{
    imp_rate_matrix rates;
    imp_status status = surface_rate(n->surface, &n->region, &rates);
    if (status == IMP_UNBOUNDED) return take_infinite(n), IMP_SUCCESS;
    if (status != IMP_OK) return status_fault(n, status, error);
    status = surface_eval(n->surface, 1, n->region.c, n->f.a, n->e);
    if (status != IMP_OK) return status_fault(n, status, error);
    n->bounded = true;
    for (int i = 0; i < 3; ++i) {
        if (!(n->e[i] >= 0 && isfinite(n->f.a[i])))
            return fault(n, "the centre's value or error is not a number", error);
        n->radius += n->e[i];
    }
    reach_from_rates(n, t->plan.kind, &rates);
    for (int i = 0; i < 3; ++i) {
        PAD_COVERS(2, 1); /* the error of the centre's value and the reach, summed */
        n->e[i] = padded_upper(n->e[i], 2);
        n->lo[i] = difference_lower(n->f.a[i], n->e[i]);
        n->hi[i] = sum_upper(n->f.a[i], n->e[i]);
        n->bounded = n->bounded && n->lo[i] > -INFINITY && n->hi[i] < INFINITY;
    }
    return IMP_SUCCESS;
}

/* A box, as a tree keeps it. */
_Static_assert(offsetof(node, hi) == offsetof(node, lo) + 3 * sizeof(double), "lo, then hi");

const net net_none;

/* --- Nets -------------------------------------------------------------------------------- */

/* The net as the type gives it, in the room; NULL where it has none that can be computed with. */
static imp_code ask_net(const node *n, net_buffer *room, const net **made, imp_error *error)
{
    imp_net given;
    const imp_status status = surface_net(n->surface, &n->region, &given);
    *made = NULL;
    if (status == IMP_UNBOUNDED) return IMP_SUCCESS;
    if (status != IMP_OK) return status_fault(n, status, error);
    if (net_take(net_in(room), &given, &n->region)) *made = net_in(room);
    return IMP_SUCCESS;
}

static bool may_have_net(const tree *t, const node *n)
{
    return t->plan.kind == TREE_MODELS && n->bounded && n->many == NULL &&
           surface_offers_net(n->surface);
}

/* Whether the node's net is a half of its parent's, which is `whole`. */
static bool is_half_of(const tree *t, const node *n, const net *whole)
{
    return whole != NULL && n->along != PARAMETER_T && may_have_net(t, n) &&
           net_can_halve(&n->parent->region, n->along);
}

/* The net in the room, or that of the parent itself, which is `whole`; NULL: it has none. From the parent's
 * where that can be halved; it may lie in the room. */
static imp_code fill_net(const tree *t, const node *n, const net *whole, net_buffer *room,
                         const net **made, imp_error *error)
{
    *made = NULL;
    if (!may_have_net(t, n)) return IMP_SUCCESS;
    if (is_half_of(t, n, whole)) {
        net_halve(whole, n->along, n->side, net_in(room));
        *made = net_in(room);
    } else if (whole != NULL && n->along == PARAMETER_T) {
        *made = whole;
    } else {
        return ask_net(n, room, made, error);
    }
    return IMP_SUCCESS;
}

/* A copy in the tree of a net in the room. NULL: no memory. */
static const net *net_copy(tree *t, const net *filled, tree_growth *growth)
{
    const size_t bytes = net_bytes(filled);
    net *kept = net_alloc(t, bytes, growth);
    return kept != NULL ? memcpy(kept, filled, bytes) : NULL;
}

/* Publishes *made, NULL if there is none. If another thread's is there already, *made becomes that
 * one. False: no memory. */
static bool net_keep(tree *t, node *n, const net **made, const net_buffer *room,
                     tree_growth *growth)
{
    pthread_mutex_lock(&t->lock);
    const net *kept = atomic_load_explicit(&n->net, memory_order_relaxed);
    if (kept == NULL) {
        const bool is_in_room = *made == (const void *)room->memory;
        kept = *made == NULL ? &net_none : is_in_room ? net_copy(t, *made, growth) : *made;
        if (kept != NULL) atomic_store_explicit(&n->net, kept, memory_order_release);
    }
    pthread_mutex_unlock(&t->lock);
    *made = kept != &net_none ? kept : NULL;
    return kept != NULL;
}

/* The same of half a net, made where it is kept. False: no memory. */
static bool net_keep_half(tree *t, node *n, const net *whole, const net **made, tree_growth *growth)
{
    pthread_mutex_lock(&t->lock);
    const net *kept = atomic_load_explicit(&n->net, memory_order_relaxed);
    if (kept == NULL) {
        net *half = net_alloc(t, net_bytes(whole), growth);
        if (half != NULL) {
            net_halve(whole, n->along, n->side, half);
            atomic_store_explicit(&n->net, half, memory_order_release);
        }
        kept = half;
    }
    pthread_mutex_unlock(&t->lock);
    *made = kept != &net_none ? kept : NULL;
    return kept != NULL;
}

/* Makes the net and publishes it. */
static imp_code make_net(tree *t, node *n, const net *whole, net_buffer *room, const net **made,
                         tree_growth *growth, imp_error *error)
{
    bool is_kept;
    if (is_half_of(t, n, whole)) {
        is_kept = net_keep_half(t, n, whole, made, growth);
    } else {
        const imp_code code = fill_net(t, n, whole, room, made, error);
        if (code != IMP_SUCCESS) return code;
        is_kept = net_keep(t, n, made, room, growth);
    }
    return is_kept ? IMP_SUCCESS : error_set_memory(error);
}

static bool has_parent(const node *n)
{
    return n->parent != NULL && n->parent->surface == n->surface;
}

/* The net of n, which was not asked for it: published, if n is to keep it, or in the room, or in the tree; NULL:
 * it has none. Its ancestors come first, from the top. Bare ones keep none. */
static imp_code find_net(tree *t, node *n, bool is_to_keep, net_buffer *room, const net **made,
                         tree_growth *growth, imp_error *error)
{
    node *at = n;
    while (has_parent(at) && !node_net_is_asked(at->parent)) at = at->parent;
    const net *whole = has_parent(at) ? node_net_made(at->parent) : NULL;
    for (;;) {
        const bool keeps = at == n ? is_to_keep : !at->is_bare;
        const imp_code code = keeps ? make_net(t, at, whole, room, &whole, growth, error)
                                    : fill_net(t, at, whole, room, &whole, error);
        if (code != IMP_SUCCESS || at == n) return *made = whole, code;
        node *below = n;
        while (below->parent != at) below = below->parent;
        at = below;
    }
}

imp_code node_net(tree *t, node *n, const net **found, tree_growth *growth, imp_error *error)
{
    if (!node_net_is_asked(n)) {
        net_buffer room;
        const net *made;
        const imp_code code = find_net(t, n, true, &room, &made, growth, error);
        if (code != IMP_SUCCESS) return code;
    }
    *found = node_net_made(n);
    return IMP_SUCCESS;
}

/* --- Any node ----------------------------------------------------------------------------- */

/* Which points a node is to bound, and when; which half of which node it is. */
typedef struct node_place {
    imp_region region;
    const surface *surface;
    const cluster *many;
    node *parent; /* NULL: it is the root */
    parameter along;
    int side;
} node_place;

/* With the net, which is made again when it is needed. */
static imp_code audit(tree *t, node *n, tree_growth *growth, imp_error *error)
{
    net_buffer room;
    const net *made;
    imp_code code = find_net(t, n, false, &room, &made, growth, error);
    if (code != IMP_SUCCESS) return code;
    atomic_store_explicit(&n->net, made, memory_order_relaxed);
    code = t->plan.audit(n->surface, n, error);
    atomic_store_explicit(&n->net, NULL, memory_order_relaxed);
    return code;
}

/* Sets all that filling does not, in memory that may hold anything. Filling sets models, and adds to the bounds
 * of rates. */
static void node_begin(const tree *t, const node_place *place, node *n)
{
    const size_t set = t->plan.kind == TREE_MODELS ? offsetof(node, bounded) : 0;
    memset((char *)n + set, 0, sizeof *n - set);
    n->region = place->region;
    n->radius = 0;
    n->surface = place->surface;
    n->many = place->many;
    n->parent = place->parent;
    n->along = place->along;
    n->side = place->side;
}

static imp_code node_fill(tree *t, const node_place *place, node *n, tree_growth *growth,
                          imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    node_begin(t, place, n);
    if (t->plan.kind == TREE_MODELS && n->parent != NULL)
        code = posing_begin(&t->posing, n, growth, error);
    if (code != IMP_SUCCESS) return code;
    code = t->plan.kind == TREE_MODELS ? fill_from_model(t, n, error)
           : n->many != NULL           ? fill_from_box(t, n, error)
                                       : fill_from_rates(t, n, error);
    if (code == IMP_SUCCESS && t->plan.audit != NULL && n->many == NULL)
        code = audit(t, n, growth, error);
    return code;
}

/* Puts a reserved node, filled, into the slot. If another thread's is there already, it is given back. Returns
 * the one in the slot. */
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

/* --- Trees ------------------------------------------------------------------------------ */

/* The whole of one surface, during these times. */
static node_place place_of_surface(const surface *s, double t_start, double t_end)
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    assert(lo[2] <= t_start && t_start <= t_end && t_end <= hi[2]);
    lo[2] = t_start;
    hi[2] = t_end;
    return (node_place){.region = region_make(lo, hi), .surface = s};
}

static node_place place_of_cluster(const cluster *many, double t_start, double t_end)
{
    const double lo[3] = {-1, 0, t_start}, hi[3] = {1, 0, t_end};
    return (node_place){
        .region = region_make(lo, hi), .surface = hierarchy_surface(many->of), .many = many};
}

static imp_code place_of_root(tree *t, node_place *place, tree_growth *growth, imp_error *error)
{
    const double from = t->plan.t_start, to = t->plan.t_end;
    const size_t pieces = surface_piece_count(t->surface);
    if (pieces > 1 && t->pieces == NULL) {
        const imp_code code = hierarchy_new(t->surface, from, to, &t->pieces, error);
        if (code != IMP_SUCCESS) return code;
        growth->bytes += hierarchy_bytes(t->pieces);
    }
    *place = pieces > 1 ? place_of_cluster(hierarchy_root(t->pieces), from, to)
                        : place_of_surface(t->surface, from, to);
    if (pieces == 1) place->surface = surface_piece(t->surface, 0);
    return IMP_SUCCESS;
}

static imp_code root_fill(tree *t, node *root, tree_growth *growth, imp_error *error)
{
    node_place place;
    const imp_code code = place_of_root(t, &place, growth, error);
    return code == IMP_SUCCESS ? node_fill(t, &place, root, growth, error) : code;
}

typedef struct root_box {
    double lo[3], hi[3];
} root_box;

static size_t tree_bytes(bool with_root)
{
    return sizeof(tree) + (with_root ? sizeof(node) : sizeof(root_box));
}

/* The root is not filled yet. NULL: no memory. */
static tree *tree_begin(const surface *s, const tree_plan *plan, bool with_root)
{
    tree *t = malloc(tree_bytes(with_root));
    if (t == NULL) return NULL;
    *t = (tree){.surface = s,
                .plan = *plan,
                .begins_with_root = with_root,
                .lock = PTHREAD_MUTEX_INITIALIZER,
                .posing = {.lock = &t->lock}};
    return t;
}

static void set_root(tree *t, node *root)
{
    t->posing.root = root;
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
    node *filled = malloc(sizeof *filled);
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
    free(filled);
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

void tree_free(tree *t)
{
    if (t == NULL) return;
    while (t->chunks != NULL) {
        chunk *next = t->chunks->next;
        free(t->chunks);
        t->chunks = next;
    }
    hierarchy_free(t->pieces);
    while (t->nets != NULL) {
        arena *next = t->nets->next;
        free(t->nets);
        t->nets = next;
    }
    posing_clear(&t->posing);
    pthread_mutex_destroy(&t->lock);
    if (!t->begins_with_root) free(atomic_load_explicit(&t->root, memory_order_relaxed));
    free(t);
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
           t->plan.t_end == plan->t_end && t->plan.audit == plan->audit;
}

/* Which points a half of a node is to bound. */
static node_place points_of_half(const node *parent, parameter j, int side)
{
    const imp_region *r = &parent->region;
    if (parent->many == NULL || j != PARAMETER_U)
        return (node_place){
            .region = region_half(r, j, side), .surface = parent->surface, .many = parent->many};
    const cluster *half = parent->many->child[side];
    if (half != NULL) return place_of_cluster(half, r->lo[2], r->hi[2]);
    return place_of_surface(surface_piece(parent->surface, parent->many->piece[side]), r->lo[2],
                            r->hi[2]);
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
    if (status != IMP_OK)
        return surface_fault(n->surface, error, "at u = %.17g, v = %.17g, t = %.17g: %s", p[0],
                             p[1], p[2], surface_status_told(n->surface, status).text);
    return fault(n,
                 t->plan.kind == TREE_MODELS
                     ? "has no bounds there, however small the region; shrink its domain, or the "
                       "times asked for, to where it (and each map on it) is bounded"
                     : "has no bounds of its rates there, however small the region; shrink its "
                       "domain, or use another method than the paper's",
                 error);
}
