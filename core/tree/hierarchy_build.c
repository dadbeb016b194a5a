/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include <impinge/quad.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/surface/region.h"
#include "core/tree/hierarchy_internal.h"

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

/* --- All of it -------------------------------------------------------------------------------- */

imp_code hierarchy_fill(hierarchy *h, const surface *s, const limit_watch *watch,
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
