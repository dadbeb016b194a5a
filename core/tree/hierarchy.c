/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/hierarchy.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include <impinge/quad.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/surface/region.h"

struct hierarchy {
    _Atomic(size_t) holders;
    double lo, hi, c, d; /* the times, as in imp_region */
    uint32_t *order;     /* the pieces; those of a cluster are adjacent */
    cluster *clusters; /* count - 1 of them, a parent before its children; the root is the first */
    size_t count;      /* number of pieces */
    size_t used;       /* number of clusters made */
};

/* --- The bounds of one piece ------------------------------------------------------------------ */

static void bound_nothing(cluster_bound *b)
{
    memset(b, 0, sizeof *b);
    for (int i = 0; i < 3; ++i) b->e[i] = b->rate[i] = INFINITY;
}

/* Lemma. Terms linear in t are kept; all other terms of the model are at most their coefficients,
 * as |s| <= 1: two slopes, six coefficients, the remainder, 8 sums. A model that does not depend on
 * t is replaced by its range, half of which is two roundings off. */
PAD_COVERS(16, 8);
PAD_COVERS(4, 2);
static void bound_piece(cluster_bound *b, int i, const imp_model *m)
{
    b->rate[i] = m->rate[2];
    if (!(m->depends & 1u << PARAMETER_T)) {
        b->a[i] = 0.5 * m->lo + 0.5 * m->hi;
        const double below = b->a[i] - m->lo, above = m->hi - b->a[i];
        b->b[i] = 0;
        b->e[i] = padded_upper(below > above ? below : above, 4);
        return;
    }
    double sum = m->e + fabs(m->b[0]) + fabs(m->b[1]);
    for (int k = 0; k < 6; ++k) sum += fabs(m->q[k]);
    b->a[i] = m->a;
    b->b[i] = m->b[2];
    b->e[i] = padded_upper(sum, 16);
}

static bool is_bound(const cluster_bound *b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += fabs(b->a[i]) + fabs(b->b[i]) + b->e[i] + b->rate[i];
    return sum < INFINITY;
}

static imp_code take_piece(const hierarchy *h, const surface *s, size_t k, cluster_bound *b,
                           imp_error *error)
{
    const surface *piece = surface_piece(s, k);
    double lo[3], hi[3];
    imp_model model[3];
    surface_domain(piece, lo, hi);
    lo[2] = h->lo, hi[2] = h->hi;
    const imp_region region = region_make(lo, hi);
    const imp_status status = surface_include_bare(piece, &region, model);
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) {
        surface_fault(piece, error, "over its domain, t [%.17g, %.17g]: %s", h->lo, h->hi,
                      surface_status_message(piece, status).text);
        return surface_set_code(status, error);
    }
    for (int i = 0; i < 3; ++i) bound_piece(b, i, &model[i]);
    if (status == IMP_STATUS_UNBOUNDED || !is_bound(b)) bound_nothing(b);
    return IMP_SUCCESS;
}

/* --- The bounds of two together --------------------------------------------------------------- */

/* Lemma. With the mean slope b, each of the two stays within e' = e + |its b - b| of its a, since
 * |s| <= 1; let a be the middle of the range that both cover, and e its distance from the ends.
 * Roundings: e' 3, its ends 1, their distance from a 1; ends are moved outward by their rounding,
 * which is relative to |a|. */
PAD_COVERS(8, 3 + 1 + 1);
static void bound_both(cluster_bound *to, const cluster_bound *x, const cluster_bound *y)
{
    for (int i = 0; i < 3; ++i) {
        const double b = 0.5 * x->b[i] + 0.5 * y->b[i];
        const double ex = padded_upper(x->e[i] + fabs(x->b[i] - b), 8);
        const double ey = padded_upper(y->e[i] + fabs(y->b[i] - b), 8);
        const double lo_x = difference_lower(x->a[i], ex), hi_x = sum_upper(x->a[i], ex);
        const double lo_y = difference_lower(y->a[i], ey), hi_y = sum_upper(y->a[i], ey);
        const double lo = lo_x < lo_y ? lo_x : lo_y, hi = hi_x > hi_y ? hi_x : hi_y;
        to->b[i] = b;
        to->a[i] = 0.5 * lo + 0.5 * hi;
        const double below = sum_upper(to->a[i], -lo), above = sum_upper(hi, -to->a[i]);
        to->e[i] = below > above ? below : above;
        to->rate[i] = x->rate[i] > y->rate[i] ? x->rate[i] : y->rate[i];
    }
    if (!is_bound(x) || !is_bound(y) || !is_bound(to)) bound_nothing(to);
}

/* --- Halving ---------------------------------------------------------------------------------- */

/* The place of a piece, used only to choose halves: x, y, z and its number. Pieces of one cluster
 * are adjacent. */
typedef struct spot {
    double at[4];
} spot;
enum { PIECE = 3 };

typedef struct building {
    hierarchy *h;
    const cluster_bound *pieces;
    const limit_watch *watch;
    bool ended; /* by the watch: clusters are not halved any more */
} building;

enum { PIECES_PER_LOOK = 1 << 12 }; /* taken, or ordered at once, before the watch is asked again */

static bool is_before(const spot *x, const spot *y, int axis)
{
    return x->at[axis] < y->at[axis] || (x->at[axis] == y->at[axis] && x->at[PIECE] < y->at[PIECE]);
}

static spot middle_of(const spot *x, const spot *y, const spot *z, int axis)
{
    if (is_before(y, x, axis)) return is_before(z, y, axis) ? *y : is_before(z, x, axis) ? *z : *x;
    return is_before(z, x, axis) ? *x : is_before(z, y, axis) ? *z : *y;
}

/* Orders the `count` pieces so that none of the first `half` comes after any other, by Hoare's
 * selection. The order is total, so that the result is the same everywhere. */
static void select_half(spot *spots, size_t count, size_t half, int axis)
{
    size_t first = 0, last = count - 1;
    while (first < last) {
        const spot pivot =
            middle_of(&spots[first], &spots[first + (last - first) / 2], &spots[last], axis);
        size_t i = first, j = last;
        for (;; ++i, --j) {
            while (is_before(&spots[i], &pivot, axis)) ++i;
            while (is_before(&pivot, &spots[j], axis)) --j;
            if (i >= j) break;
            const spot swapped = spots[i];
            spots[i] = spots[j];
            spots[j] = swapped;
        }
        if (half <= j)
            last = j;
        else
            first = j + 1;
    }
}

static int longest_axis(const spot *spots, size_t count)
{
    imp_quad lo = imp_quad_all(INFINITY), hi = imp_quad_all(-INFINITY);
    for (size_t k = 0; k < count; ++k) {
        const imp_quad at = imp_quad_load(spots[k].at);
        lo = imp_quad_min(at, lo);
        hi = imp_quad_max(at, hi);
    }
    const imp_quad length = hi - lo;
    int longest = 0;
    for (int i = 1; i < 3; ++i)
        if (length[i] > length[longest]) longest = i;
    return longest;
}

/* Makes the cluster of `count` pieces, count >= 2. Its halves have the same number of pieces, so
 * that the depth is the logarithm of that number. */
static cluster *build(building *b, spot *spots, size_t count)
{
    cluster *made = &b->h->clusters[b->h->used++];
    const size_t half[2] = {count / 2, count - count / 2};
    const cluster_bound *bounds[2];
    if (count >= PIECES_PER_LOOK && !b->ended) b->ended = !limit_watch_goes_on(b->watch);
    if (b->ended) return made;
    select_half(spots, count, half[0], longest_axis(spots, count));
    made->of = b->h;
    for (int side = 0; side < 2; ++side) {
        spot *from = spots + (side == 0 ? 0 : half[0]);
        made->child[side] = half[side] > 1 ? build(b, from, half[side]) : NULL;
        made->piece[side] = (uint32_t)from->at[PIECE];
        bounds[side] =
            made->child[side] != NULL ? &made->child[side]->bound : &b->pieces[made->piece[side]];
    }
    bound_both(&made->bound, bounds[0], bounds[1]);
    return made;
}

/* --- Hierarchies ------------------------------------------------------------------------------ */

/* *ended: the watch ended it, and the clusters mean nothing. */
static imp_code fill(hierarchy *h, const surface *s, const limit_watch *watch,
                     cluster_bound *pieces, spot *spots, bool *ended, imp_error *error)
{
    for (size_t k = 0; k < h->count; ++k) {
        *ended = (k + 1) % PIECES_PER_LOOK == 0 && !limit_watch_goes_on(watch);
        if (*ended) return IMP_SUCCESS;
        const imp_code code = take_piece(h, s, k, &pieces[k], error);
        if (code != IMP_SUCCESS) return code;
        memcpy(spots[k].at, pieces[k].a, sizeof pieces[k].a);
        spots[k].at[PIECE] = (double)k;
    }
    building b = {.h = h, .pieces = pieces, .watch = watch};
    build(&b, spots, h->count);
    *ended = b.ended;
    for (size_t k = 0; k < h->count; ++k) h->order[k] = (uint32_t)spots[k].at[PIECE];
    return IMP_SUCCESS;
}

/* The caller holds it. *made is NULL where the watch ended it. */
static imp_code hierarchy_new(const surface *s, double t_start, double t_end,
                              const limit_watch *watch, hierarchy **made, imp_error *error)
{
    const imp_region times = region_make((double[3]){0, 0, t_start}, (double[3]){0, 0, t_end});
    hierarchy *h = calloc(1, sizeof *h);
    if (h == NULL) return error_set_memory(error);
    *h = (hierarchy){.holders = 1,
                     .lo = t_start,
                     .hi = t_end,
                     .c = times.c[2],
                     .d = times.d[2],
                     .count = surface_piece_count(s)};
    h->order = malloc(h->count * sizeof *h->order);
    h->clusters = malloc((h->count - 1) * sizeof *h->clusters);
    cluster_bound *pieces = malloc(h->count * sizeof *pieces);
    spot *spots = malloc(h->count * sizeof *spots);
    bool ended = false;
    const imp_code code = h->order == NULL || h->clusters == NULL || pieces == NULL || spots == NULL
                              ? error_set_memory(error)
                              : fill(h, s, watch, pieces, spots, &ended, error);
    free(spots);
    free(pieces);
    *made = code == IMP_SUCCESS && !ended ? h : NULL;
    if (*made == NULL) hierarchy_release(h);
    return code;
}

static hierarchy *hold(hierarchy *h)
{
    atomic_fetch_add_explicit(&h->holders, 1, memory_order_relaxed);
    return h;
}

void hierarchy_release(hierarchy *h)
{
    if (h == NULL) return;
    if (atomic_fetch_sub_explicit(&h->holders, 1, memory_order_acq_rel) > 1) return;
    free(h->order);
    free(h->clusters);
    free(h);
}

static void release_kept(void *h) { hierarchy_release(h); }

/* The hierarchy over these times on the shelf, held for the caller; NULL: none. The shelf is
 * locked. */
static hierarchy *find_kept(instance_shelf *shelf, double t_start, double t_end)
{
    for (int k = 0; k < INSTANCE_KEPT_MAX && shelf->kept[k].what != NULL; ++k) {
        hierarchy *h = shelf->kept[k].what;
        if (h->lo == t_start && h->hi == t_end) return hold(h);
    }
    return NULL;
}

/* Two threads may make it at once; both are equal, and the first one stays. */
imp_code hierarchy_of(const surface *s, double t_start, double t_end, const limit_watch *watch,
                      hierarchy **found, imp_error *error)
{
    assert(surface_piece_count(s) >= 2);
    instance_shelf *shelf = surface_origin(s, 0)->shelf;
    pthread_mutex_lock(&shelf->lock);
    *found = find_kept(shelf, t_start, t_end);
    pthread_mutex_unlock(&shelf->lock);
    if (*found != NULL) return IMP_SUCCESS;
    hierarchy *made = NULL;
    const imp_code code = hierarchy_new(s, t_start, t_end, watch, &made, error);
    if (code != IMP_SUCCESS || made == NULL) return code;
    pthread_mutex_lock(&shelf->lock);
    *found = find_kept(shelf, t_start, t_end);
    if (*found == NULL)
        instance_shelf_add(shelf, (instance_kept){hold(*found = made), release_kept});
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
