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

/* Chunks of 1, 4, 16, 64, 64, ... nodes: most surfaces of a large scene are never split. */
enum { CHUNK_GROWTH = 4, CHUNK_NODES_MAX = 64 };

typedef struct chunk {
    struct chunk *next;
    size_t used, capacity;
    node nodes[];
} chunk;

struct tree {
    const surface *surface;
    tree_plan plan;
    node *root;
    pthread_mutex_t lock; /* of chunks, and of every node's children while one is published */
    chunk *chunks;
};

/* --- Memory ------------------------------------------------------------------- */

static node *node_alloc(tree *t, tree_growth *growth)
{
    if (t->chunks == NULL || t->chunks->used == t->chunks->capacity) {
        const size_t wanted = t->chunks == NULL ? 1 : CHUNK_GROWTH * t->chunks->capacity;
        const size_t capacity = wanted < CHUNK_NODES_MAX ? wanted : CHUNK_NODES_MAX;
        const size_t bytes = sizeof(chunk) + capacity * sizeof(node);
        chunk *fresh = malloc(bytes);
        if (fresh == NULL) return NULL;
        *fresh = (chunk){.next = t->chunks, .capacity = capacity};
        t->chunks = fresh;
        growth->bytes += bytes;
    }
    growth->nodes += 1;
    return &t->chunks->nodes[t->chunks->used++];
}

/* --- Faults of plugins ---------------------------------------------------------- */

static imp_code fault(const tree *t, const imp_region *r, const char *what, imp_error *error)
{
    return surface_fault(t->surface, error,
                         "over u [%.17g, %.17g], v [%.17g, %.17g], t [%.17g, %.17g]: %s", r->lo[0],
                         r->hi[0], r->lo[1], r->hi[1], r->lo[2], r->hi[2], what);
}

static imp_code status_fault(const tree *t, const imp_region *r, imp_status status,
                             imp_error *error)
{
    fault(t, r, surface_status_told(t->surface, status).text, error);
    return surface_set_code(status, error);
}

/* --- Nodes of models -------------------------------------------------------------- */

static imp_code fill_from_model(const tree *t, node *n, imp_error *error)
{
    imp_model model[3];
    const imp_status status = surface_include(t->surface, &n->region, model);
    if (status != IMP_OK && status != IMP_UNBOUNDED)
        return status_fault(t, &n->region, status, error);
    const char *breach = node_take_model(n, model, status == IMP_UNBOUNDED);
    return breach != NULL ? fault(t, &n->region, breach, error) : IMP_SUCCESS;
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

static imp_code fill_from_rates(const tree *t, node *n, imp_error *error)
{
    imp_rate_matrix rates;
    imp_status status = surface_rate(t->surface, &n->region, &rates);
    if (status == IMP_UNBOUNDED) return take_infinite(n), IMP_SUCCESS;
    if (status != IMP_OK) return status_fault(t, &n->region, status, error);
    status = surface_eval(t->surface, 1, n->region.c, n->f.a, n->e);
    if (status != IMP_OK) return status_fault(t, &n->region, status, error);
    n->bounded = true;
    for (int i = 0; i < 3; ++i) {
        if (!(n->e[i] >= 0 && isfinite(n->f.a[i])))
            return fault(t, &n->region, "the centre's value or error is not a number", error);
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

static imp_code node_fill(const tree *t, imp_region region, node *n, imp_error *error)
{
    *n = (node){.region = region};
    imp_code code =
        t->plan.kind == TREE_MODELS ? fill_from_model(t, n, error) : fill_from_rates(t, n, error);
    if (code == IMP_SUCCESS && t->plan.audit != NULL) code = t->plan.audit(t->surface, n, error);
    return code;
}

/* A copy of a filled node, in the slot unless another thread's is there already. NULL: no memory. */
static node *node_publish(tree *t, const node *filled, _Atomic(node *) *slot, tree_growth *growth)
{
    pthread_mutex_lock(&t->lock);
    node *n = atomic_load_explicit(slot, memory_order_relaxed);
    if (n == NULL) {
        n = node_alloc(t, growth);
        if (n != NULL) {
            *n = *filled;
            atomic_store_explicit(slot, n, memory_order_release);
        }
    }
    pthread_mutex_unlock(&t->lock);
    return n;
}

static imp_code node_make(tree *t, imp_region region, _Atomic(node *) *slot, node **made,
                          tree_growth *growth, imp_error *error)
{
    node filled;
    const imp_code code = node_fill(t, region, &filled, error);
    if (code != IMP_SUCCESS) return code;
    *made = node_publish(t, &filled, slot, growth);
    return *made != NULL ? IMP_SUCCESS : error_set_memory(error);
}

/* --- Trees ------------------------------------------------------------------------------ */

imp_code tree_new(const surface *s, const tree_plan *plan, tree **made, tree_growth *growth,
                  imp_error *error)
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    assert(lo[2] <= plan->t_start && plan->t_start <= plan->t_end && plan->t_end <= hi[2]);
    lo[2] = plan->t_start;
    hi[2] = plan->t_end;
    tree *t = calloc(1, sizeof *t);
    if (t == NULL) return error_set_memory(error);
    *t = (tree){.surface = s, .plan = *plan};
    pthread_mutex_init(&t->lock, NULL);
    _Atomic(node *) root = NULL;
    const imp_code code = node_make(t, region_make(lo, hi), &root, &t->root, growth, error);
    if (code == IMP_SUCCESS) {
        growth->bytes += sizeof *t;
        *made = t;
    } else {
        tree_free(t);
    }
    return code;
}

imp_code tree_new_from_root(const tree *t, tree **made, tree_growth *growth, imp_error *error)
{
    tree_growth of_root = {0};
    tree *copy = calloc(1, sizeof *copy);
    if (copy == NULL) return error_set_memory(error);
    *copy = (tree){.surface = t->surface, .plan = t->plan};
    pthread_mutex_init(&copy->lock, NULL);
    copy->root = node_alloc(copy, &of_root);
    if (copy->root == NULL) {
        tree_free(copy);
        return error_set_memory(error);
    }
    memset(copy->root, 0, sizeof *copy->root);
    memcpy(copy->root, t->root, offsetof(node, child)); /* what is before, which no thread changes */
    growth->bytes += sizeof *copy + of_root.bytes;
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
    pthread_mutex_destroy(&t->lock);
    free(t);
}

node *tree_root(const tree *t) { return t->root; }

const surface *tree_surface(const tree *t) { return t->surface; }

bool tree_is_of(const tree *t, const tree_plan *plan)
{
    return t->plan.kind == plan->kind && t->plan.t_start == plan->t_start &&
           t->plan.t_end == plan->t_end && t->plan.audit == plan->audit;
}

imp_code node_child(tree *t, node *parent, parameter j, int side, node **child, tree_growth *growth,
                    imp_error *error)
{
    _Atomic(node *) *slot = &parent->child[j][side];
    node *made = atomic_load_explicit(slot, memory_order_acquire);
    if (made == NULL) {
        const imp_region half = region_half(&parent->region, j, side);
        const imp_code code = node_make(t, half, slot, &made, growth, error);
        if (code != IMP_SUCCESS) return code;
    }
    *child = made;
    return IMP_SUCCESS;
}

imp_code node_unbounded_fault(const tree *t, const node *n, imp_error *error)
{
    double x[3];
    const double *p = n->region.c;
    const imp_status status = surface_eval(t->surface, 1, p, x, NULL);
    if (status != IMP_OK)
        return surface_fault(t->surface, error, "at u = %.17g, v = %.17g, t = %.17g: %s", p[0],
                             p[1], p[2], surface_status_told(t->surface, status).text);
    return fault(t, &n->region,
                 t->plan.kind == TREE_MODELS
                     ? "has no bounds there, however small the region; shrink its domain, or the "
                       "times asked for, to where it (and each map on it) is bounded"
                     : "has no bounds of its rates there, however small the region; shrink its "
                       "domain, or use another method than the paper's",
                 error);
}
