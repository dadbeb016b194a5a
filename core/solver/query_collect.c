/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/solver/query_internal.h"

/* The broad phase of a query, which its limits may end. */

typedef struct collecting {
    imp_query *query;
    double seconds_before, start; /* of this step */
    uint64_t bytes;               /* of candidates that there are already */
    imp_reason reason;
} collecting;

/* Returns the most candidate pairs with which the search can end: each counts as a pair of
 * max_pairs. In a divided query that limit applies to each part. 0: no limit. */
static uint64_t most_candidates(const imp_query *query)
{
    return query->divided > 0 ? 0 : query->options.max_pairs;
}

static bool limit_is_reached(void *context, uint64_t bytes, uint64_t pairs)
{
    collecting *c = context;
    const uint64_t most = most_candidates(c->query);
    query_read_clock(c->query, c->seconds_before, c->start);
    query_note_bytes(c->query, c->bytes + bytes);
    c->reason = query_exhausted_limit(c->query, c->query->stats.seconds);
    if (c->reason == IMP_REASON_NONE && most > 0 && pairs > most) c->reason = IMP_REASON_PAIRS;
    return c->reason != IMP_REASON_NONE;
}

/* Other threads call this while the query's thread waits: only `cancelled` may change meanwhile. */
static bool limit_is_near(void *context, uint64_t bytes, uint64_t pairs)
{
    const collecting *c = context;
    const imp_query *query = c->query;
    const imp_options *options = &query->options;
    const uint64_t most = most_candidates(query);
    return atomic_load_explicit(&query->cancelled, memory_order_relaxed) ||
           (most > 0 && candidates_pairs_in_all(&query->candidates) + pairs > most) ||
           (options->max_bytes > 0 && query->peak_bytes + bytes > options->max_bytes) ||
           (options->max_seconds > 0 &&
            c->seconds_before + (clock_seconds() - c->start) >= options->max_seconds);
}

double query_searched_gamma_clear(const imp_query *query, double gamma_clear)
{
    const double slip = query->candidates.slip;
    gamma_clear += query_proof_room(query);
    return slip > 0 ? sum_upper(gamma_clear, slip) : gamma_clear;
}

static bool in_slices(const imp_query *query)
{
    return query->clearance != NULL && !clearance_is_of_all_times(query->clearance);
}

/* Whether only the nearest pair of all is sought, at each time, and not that of each two bodies. */
static bool is_nearest(const imp_query *query)
{
    return query->clearance != NULL && !clearance_is_each(query->clearance) && query->divided == 0;
}

/* A search for a contact uses slips that are far below gamma_clear, which is always less than this.
 */
static double slip_useful(const imp_query *query)
{
    const bool is_contact = query->clearance == NULL && query->impact.spread == NULL;
    return is_contact ? 2 * query->options.gamma : INFINITY;
}

/* Half planes are left out where a verifier, or a box of values, sees each pair of points. */
static candidate_search search_of(const imp_query *query)
{
    const double near =
        query->clearance == NULL ? query->impact.gamma_clear : clearance_near(query->clearance);
    return (candidate_search){
        .gamma_clear = near,
        .is_nearest = is_nearest(query),
        .in_slices = in_slices(query),
        .slip_useful = slip_useful(query),
        .slip_most = query->clearance != NULL ? clearance_slip_most(query->clearance) : INFINITY,
        .may_halve = query->proof == NULL && query->impact.spread == NULL,
        .may_wait = query->clearance == NULL && query->proof == NULL && query->divided == 0 &&
                    query->impact.spread == NULL && !query->impact.explains,
        .in_parts = query->divided > 0};
}

/* If a limit ends it, the next step starts it again. For a minimum distance without `within`, all
 * surfaces are candidates, however far apart, but where there are many. */
imp_code query_collect(imp_query *query, double start, imp_error *error)
{
    collecting c = {.query = query, .seconds_before = query->stats.seconds, .start = start};
    const candidate_limit limit = {limit_is_reached, limit_is_near, &c};
    const candidate_search search = search_of(query);
    const imp_code code = candidates_find(&query->candidates, query->scene, &query->options,
                                          &search, &limit, &query->stats, error);
    query->impact.gamma_clear = query_searched_gamma_clear(query, query->gamma_clear);
    query->impact.candidate_pairs = query->candidates.pairs;
    query->impact.candidate_pair_count = query->candidates.pair_count;
    query->impact.apart_until = candidates_apart_until(&query->candidates);
    if (code == IMP_SUCCESS && !query->candidates.complete)
        query_finish(query, IMP_VERDICT_UNDECIDED, c.reason);
    return code;
}

/* Lemma. Slips of later pairs only raise gamma_clear: what was proved of earlier pairs holds for
 * their own slips. */
imp_code query_take_candidates(imp_query *query, imp_error *error)
{
    impact *im = &query->impact;
    const candidate_list *list = &query->candidates;
    im->gamma_clear = query_searched_gamma_clear(query, query->gamma_clear);
    if (!impact_take_candidates(im, list->pairs, list->pair_count)) return error_set_memory(error);
    im->apart_until = candidates_apart_until(list);
    return IMP_SUCCESS;
}

/* If a limit ends it, the next step starts it again. */
imp_code query_collect_more(imp_query *query, imp_error *error)
{
    const impact *im = &query->impact;
    candidate_list *list = &query->candidates;
    collecting c = {.query = query,
                    .seconds_before = query->step_from[0],
                    .start = query->step_from[1],
                    .bytes = candidates_bytes(list)};
    const candidate_limit limit = {limit_is_reached, limit_is_near, &c};
    const candidate_search search = search_of(query);
    const double until = im->upper.is_known ? im->upper.t : INFINITY;
    bool done;
    const imp_code code = candidates_more(list, query->scene, &query->options, &search, &limit,
                                          until, &query->stats, &done, error);
    if (code == IMP_SUCCESS && !done) query_finish(query, IMP_VERDICT_UNDECIDED, c.reason);
    return code == IMP_SUCCESS && done ? query_take_candidates(query, error) : code;
}

imp_code query_collect_part(imp_query *part, const imp_query *whole, size_t index, imp_error *error)
{
    const query_parts *parts = whole->parts;
    const size_t first = parts->first[index], count = parts->first[index + 1] - first;
    collecting c = {.query = part, .start = clock_seconds()};
    const candidate_limit limit = {limit_is_reached, limit_is_near, &c};
    const candidate_search search = search_of(whole);
    candidate_list framed = {0};
    imp_stats shared = {0};
    imp_code code = candidates_frame(&framed, &whole->candidates, first, count, part->scene,
                                     &part->options, &search, &limit, &shared, error);
    atomic_fetch_add(&whole->parts->nodes, shared.nodes);
    atomic_fetch_add(&whole->parts->bytes, shared.bytes);
    if (code == IMP_SUCCESS)
        code = candidates_part(&part->candidates, &framed, 0, count, &part->stats, error);
    candidates_clear(&framed);
    part->impact.gamma_clear = query_searched_gamma_clear(part, part->gamma_clear);
    part->impact.candidate_pairs = part->candidates.pairs;
    part->impact.candidate_pair_count = part->candidates.pair_count;
    return code;
}
