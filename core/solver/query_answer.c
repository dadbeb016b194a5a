/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/broad_phase/later_pairs.h"
#include "core/solver/query_internal.h"

static size_t unresolved(const imp_query *query, int side)
{
    return query->candidates.pairs[query->impact.found_candidate].side[side]->body;
}

static imp_result result_of(const imp_query *query)
{
    const impact *im = &query->impact;
    imp_result r = {.struct_size = (uint32_t)sizeof r,
                    .verdict = query->verdict,
                    .reason = query->reason,
                    .t = NAN,
                    .t_lower = im->t_lower,
                    .gap = NAN,
                    .gamma = im->gamma,
                    .gamma_clear = query->gamma_clear,
                    .stats = query->stats,
                    .t_start = query->options.t_start,
                    .t_end = query->options.t_end,
                    .t_examined = {NAN, NAN}};
    if (query->examined.lo <= query->examined.hi)
        r.t_examined[0] = query->examined.lo, r.t_examined[1] = query->examined.hi;
    r.stats.bytes = query->peak_bytes;
    if (query->parts != NULL) {
        r.stats.nodes += atomic_load(&query->parts->nodes);
        r.stats.bytes += atomic_load(&query->parts->bytes);
    }
    if (query->inside_unknown && r.verdict == IMP_VERDICT_UNDECIDED) r.t_lower = r.t_start;
    if (r.reason == IMP_REASON_RESOLUTION) {
        r.a.body = unresolved(query, 0);
        r.b.body = unresolved(query, 1);
    }
    if (r.verdict != IMP_VERDICT_CONTACT) return r;
    r.at_rest = query->at_rest;
    r.kind = query->kind;
    r.t = im->t_lower;
    if (r.kind == IMP_CONTACT_INSIDE) {
        r.gap = 0;
        r.a = query->inside.side[0];
        r.b = query->inside.side[1];
        return r;
    }
    r.gap = query->contact.gap;
    r.a = query->contact.side[0];
    r.b = query->contact.side[1];
    r.has_normal = im->found.has_normal;
    memcpy(r.normal, query->contact.normal, sizeof r.normal);
    return r;
}

/* Size of imp_result in the first release. */
#define RESULT_FIRST sizeof(imp_result)

imp_code imp_query_get_result(const imp_query *query, imp_result *result, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_get_result");
    const imp_code code = sized_check("imp_result", result, RESULT_FIRST, error);
    if (code != IMP_SUCCESS) return code;
    const imp_result own = result_of(query);
    sized_write(result, &own);
    return code;
}

/* Describes a side in u and v from lo to hi. */
static struct imp_pending_side side_within(const candidate *c, size_t piece, const double *lo,
                                           const double *hi)
{
    return (struct imp_pending_side){c->body,
                                     c->surface,
                                     piece,
                                     {lo[PARAMETER_U], hi[PARAMETER_U]},
                                     {lo[PARAMETER_V], hi[PARAMETER_V]}};
}

/* Describes one side of a pair on the heap or, with no node, of a candidate pair that was not
 * tested yet. */
static struct imp_pending_side pending_side(const imp_query *query, size_t k, int side,
                                            const node *n)
{
    const candidate *c = query->candidates.pairs[k].side[side];
    const node *of = n != NULL ? n : tree_root(c->tree);
    const size_t piece = of->many != NULL ? SIZE_MAX : surface_piece_index(of->surface);
    return side_within(c, piece, of->region.lo, of->region.hi);
}

/* Describes one side of a candidate pair that was not even made ready. */
static struct imp_pending_side later_side(const imp_query *query, size_t k, int side)
{
    const candidate_list *list = &query->candidates;
    const candidate *c = &list->candidates[list->later->pair[k][side]];
    const surface *s = tree_surface(c->tree);
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    return side_within(c, surface_piece_count(s) > 1 ? SIZE_MAX : 0, lo, hi);
}

static bool later_pending(const imp_query *query, size_t k, imp_pending *pending)
{
    const later_pairs *later = query->candidates.later;
    if (later == NULL || k >= later->count) return false;
    *pending = (imp_pending){later->until, later_side(query, k, 0), later_side(query, k, 1)};
    return true;
}

/* Pairs on the heap come first, then the candidates whose roots were not tested yet, and those that
 * were not made ready. */
bool imp_query_pending(const imp_query *query, size_t index, imp_pending *pending)
{
    if (query == NULL || pending == NULL) return false;
    const pair_heap *heap = &query->impact.heap;
    pair first;
    const pair *waiting = NULL;
    if (index < heap->count) first = pair_heap_at(heap, index), waiting = &first;
    const size_t k = waiting != NULL ? waiting->candidate_pair
                                     : query->candidates_tested + (index - heap->count);
    if (query->clearance != NULL) return false;
    if (k >= query->candidates.pair_count)
        return later_pending(query, k - query->candidates.pair_count, pending);
    *pending = (imp_pending){waiting != NULL ? waiting->window.lo : query->options.t_start,
                             pending_side(query, k, 0, waiting != NULL ? waiting->a : NULL),
                             pending_side(query, k, 1, waiting != NULL ? waiting->b : NULL)};
    return true;
}

imp_code imp_scene_solve(imp_scene *scene, const imp_options *options, imp_result *result,
                         imp_error *error)
{
    imp_error own;
    imp_error *why = error != NULL ? error : &own;
    if (sized_check("imp_result", result, RESULT_FIRST, why) != IMP_SUCCESS) return why->code;
    imp_query *query = imp_query_new(scene, options, why);
    if (query == NULL) return why->code;
    imp_code code = imp_query_step(query, 0, why);
    if (code == IMP_SUCCESS) code = imp_query_get_result(query, result, why);
    imp_query_free(query);
    return code;
}
