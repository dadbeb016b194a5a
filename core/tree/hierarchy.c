/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/hierarchy_internal.h"

#include <assert.h>
#include <string.h>

#include <impinge/quad.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/surface/region.h"

/* The caller holds it. *made is NULL where the watch ended it. */
static imp_code hierarchy_new(const surface *s, double t_start, double t_end,
                              const limit_watch *watch, arena_store *store, hierarchy **made,
                              imp_error *error)
{
    const imp_region times = region_make((double[3]){0, 0, t_start}, (double[3]){0, 0, t_end});
    hierarchy *h = arena_store_room(store, sizeof *h);
    if (h == NULL) return error_set_memory(error);
    *h = (hierarchy){.store = store,
                     .holders = 1,
                     .lo = t_start,
                     .hi = t_end,
                     .c = times.c[2],
                     .d = times.d[2],
                     .count = surface_piece_count(s)};
    h->order = arena_store_room(store, h->count * sizeof *h->order);
    h->clusters = arena_store_room(store, (h->count - 1) * sizeof *h->clusters);
    cluster_bound *pieces = arena_store_room(store, h->count * sizeof *pieces);
    spot *spots = arena_store_room(store, h->count * sizeof *spots);
    bool ended = false;
    const imp_code code = h->order == NULL || h->clusters == NULL || pieces == NULL || spots == NULL
                              ? error_set_memory(error)
                              : hierarchy_fill(h, s, watch, pieces, spots, &ended, error);
    arena_store_free_room(store, spots);
    arena_store_free_room(store, pieces);
    *made = code == IMP_SUCCESS && !ended ? h : NULL;
    if (*made == NULL) hierarchy_release(h);
    return code;
}

hierarchy *hierarchy_hold(hierarchy *h)
{
    if (h != NULL) atomic_fetch_add_explicit(&h->holders, 1, memory_order_relaxed);
    return h;
}

void hierarchy_release(hierarchy *h)
{
    if (h == NULL) return;
    if (atomic_fetch_sub_explicit(&h->holders, 1, memory_order_acq_rel) > 1) return;
    arena_store *store = h->store;
    arena_store_free_room(store, h->order);
    arena_store_free_room(store, h->clusters);
    arena_store_free_room(store, h);
}

static void release_kept(void *h) { hierarchy_release(h); }

/* The hierarchy over these times on the shelf, held for the caller; NULL: none. The shelf is
 * locked. */
static hierarchy *find_kept(instance_shelf *shelf, double t_start, double t_end)
{
    for (int k = 0; k < INSTANCE_KEPT_MAX && shelf->kept[k].what != NULL; ++k) {
        hierarchy *h = shelf->kept[k].what;
        if (h->lo == t_start && h->hi == t_end) return hierarchy_hold(h);
    }
    return NULL;
}

/* Two threads may make it at once; both are equal, and the first one stays. */
imp_code hierarchy_of(const surface *s, double t_start, double t_end, const limit_watch *watch,
                      arena_store *store, hierarchy **found, imp_error *error)
{
    assert(surface_piece_count(s) >= 2);
    instance_shelf *shelf = surface_origin(s, 0)->shelf;
    pthread_mutex_lock(&shelf->lock);
    *found = find_kept(shelf, t_start, t_end);
    pthread_mutex_unlock(&shelf->lock);
    if (*found != NULL) return IMP_SUCCESS;
    hierarchy *made = NULL;
    const imp_code code = hierarchy_new(s, t_start, t_end, watch, store, &made, error);
    if (code != IMP_SUCCESS || made == NULL) return code;
    pthread_mutex_lock(&shelf->lock);
    *found = find_kept(shelf, t_start, t_end);
    if (*found == NULL)
        instance_shelf_add(shelf, (instance_kept){hierarchy_hold(*found = made), release_kept});
    else
        hierarchy_release(made);
    pthread_mutex_unlock(&shelf->lock);
    return IMP_SUCCESS;
}

const cluster *hierarchy_root(const hierarchy *h) { return h->clusters; }

const uint32_t *hierarchy_order(const hierarchy *h) { return h->order; }

size_t hierarchy_bytes(const hierarchy *h)
{
    return sizeof *h + h->count * sizeof *h->order + (h->count - 1) * sizeof *h->clusters;
}

size_t hierarchy_sample(const hierarchy *h, size_t k, size_t n)
{
    return h->order[h->count * k / n];
}

/* Lemma. t = c' + d' s', so s = (c' - c) / d + (d' / d) s', both at most about 1 in magnitude: a'
 * and b' are off by at most 8 u (|a| + |b|), from five roundings each. Two points of a cluster are
 * no farther apart than 2 e' at any one time, and each moves at its rate. */
enum { TIMES_ROUNDING = 8 };
PAD_COVERS(8, 4);
void cluster_models(const cluster *c, const imp_region *region, imp_model model[3])
{
    const hierarchy *h = c->of;
    const cluster_bound *bound = &c->bound;
    const double shift = h->d > 0 ? (region->c[2] - h->c) / h->d : 0;
    const double scale = h->d > 0 ? region->d[2] / h->d : 0;
    memset(model, 0, 3 * sizeof *model);
    for (int i = 0; i < 3; ++i) {
        imp_model *m = &model[i];
        m->a = bound->a[i] + bound->b[i] * shift;
        m->b[2] = bound->b[i] * scale;
        m->e = padded_upper(bound->e[i] + TIMES_ROUNDING * UNIT_ROUNDOFF *
                                              (fabs(bound->a[i]) + fabs(bound->b[i])),
                            8) +
               PRODUCTS_UNDERFLOW;
        const double reach = sum_upper(m->e, fabs(m->b[2]));
        m->lo = difference_lower(m->a, reach);
        m->hi = sum_upper(m->a, reach);
        m->rate[0] = 2 * m->e;
        m->rate[2] = bound->rate[i];
        m->depends = 1u << PARAMETER_U | (bound->rate[i] > 0 ? 1u << PARAMETER_T : 0);
    }
}
