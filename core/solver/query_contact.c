/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_test.h"
#include "core/solver/query_internal.h"

/* The search for the earliest contact, and what ends it. */

imp_reason query_reason_of_clear(const imp_query *query)
{
    if (!query->examined.any_pair) return IMP_REASON_NO_PAIRS;
    return query->examined.lo <= query->examined.hi ? IMP_REASON_NONE : IMP_REASON_NO_TIME;
}

/* Lemma. At the middle of u and v, a surface of the model a + bt s + qtt s^2 +- e is displaced by
 * 2 bt +- 2 e from s = -1 to s = 1. Where |bt| > e it moves. */
static bool is_seen_to_move(const node *root)
{
    bool moves = false;
    if (!root->bounded || root->is_bare || root->many != NULL) return false;
    for (int i = 0; i < 3; ++i) moves = moves || fabs(root->f.bt[i]) > root->e[i];
    return moves;
}

/* Whether one surface of the contact is at rest during all of the query's times. Rates are computed
 * only if no point of it was seen to move. */
static bool is_at_rest(const imp_query *query, int side)
{
    const candidate *c = query->candidates.pairs[query->impact.found_candidate].side[side];
    const surface *s = scene_surface(query->scene, c->body, c->surface);
    const node *root = tree_root(c->tree);
    const imp_region *times = &root->region;
    double lo[3], hi[3];
    imp_rate_matrix rates;
    const bool is_as_given = c->left_out == 0 && c->held.count == 0 && c->aside.which == 0;
    if (is_as_given && (c->moves || is_seen_to_move(root))) return false;
    if (surface_piece_count(s) > 0) s = surface_piece(s, query->impact.found.piece[side]);
    surface_domain(s, lo, hi);
    lo[2] = times->lo[2], hi[2] = times->hi[2];
    const imp_region region = region_make(lo, hi);
    if (surface_rate(s, &region, &rates) != IMP_STATUS_OK) return false;
    bool rests = true;
    for (int i = 0; i < 3; ++i) rests = rests && rates.m[i][PARAMETER_T] == 0;
    return rests;
}

static imp_code conclude_contact(imp_query *query, imp_error *error)
{
    const impact *im = &query->impact;
    const candidate_pair *both = &query->candidates.pairs[im->found_candidate];
    query_finish(query, IMP_VERDICT_CONTACT, IMP_REASON_NONE);
    query->kind = IMP_CONTACT_TOUCH;
    query->at_rest = is_at_rest(query, 0) && is_at_rest(query, 1);
    return world_witness_of(query->scene, both, &im->found, im->t_lower, im->gamma, &query->contact,
                            error);
}

/* Ends a search that has found nothing at the start, where it is not known whether one of two
 * bodies was inside the other then. */
static void conclude_unknown(imp_query *query)
{
    query->impact.found_candidate = (uint32_t)query->unknown_candidate;
    query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_RESOLUTION);
}

static imp_code conclude(imp_query *query, impact_state state, imp_error *error)
{
    const bool at_start =
        state == IMPACT_CONTACT && query->impact.t_lower <= query->options.t_start;
    if (query->inside_unknown && !at_start && (state == IMPACT_CLEAR || state == IMPACT_CONTACT)) {
        conclude_unknown(query);
        return IMP_SUCCESS;
    }
    switch (state) {
    case IMPACT_RUNNING:
        break;
    case IMPACT_CONTACT:
        return conclude_contact(query, error);
    case IMPACT_CLEAR:
        query_finish(query, IMP_VERDICT_CLEAR, query_reason_of_clear(query));
        break;
    case IMPACT_RESOLUTION:
        query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_RESOLUTION);
        break;
    case IMPACT_NO_MEMORY:
        query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_MEMORY);
        break;
    }
    return IMP_SUCCESS;
}

imp_code query_search_contact(imp_query *query, imp_error *error)
{
    impact_state state = IMPACT_RUNNING;
    imp_code code = IMP_SUCCESS;
    if (query_may_be_inside(query)) return query_look_inside(query, error);
    if (query->impact.candidate_pair_count < query->candidates.pair_count) {
        code = query_take_candidates(query, error);
    } else if (query->candidates_tested < query->candidates.pair_count) {
        pair_test_look_ahead(&query->impact, (uint32_t)query->candidates_tested,
                             query->candidates.pair_count, &query->options);
        code =
            impact_add_candidate(&query->impact, (uint32_t)query->candidates_tested, &state, error);
        if (state == IMPACT_RUNNING) query->candidates_tested += 1;
    } else if (impact_lacks_candidates(&query->impact)) {
        code = query_collect_more(query, error);
    } else {
        code = impact_advance(&query->impact, &state, error);
    }
    return code == IMP_SUCCESS ? conclude(query, state, error) : code;
}
