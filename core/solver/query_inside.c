/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/solver/query_internal.h"

/* Bodies inside solid ones, asked before the search for a contact: what is found ends it. */

static bool limit_is_far(void *context)
{
    imp_query *query = context;
    const double limit = query->options.max_seconds;
    const double spent = query->step_from[0] + (clock_seconds() - query->step_from[1]);
    query->watch_ended = atomic_load_explicit(&query->cancelled, memory_order_relaxed) ||
                         (limit > 0 && spent >= limit);
    return !query->watch_ended;
}

void query_begin_watch(imp_query *query) { query->watch = (limit_watch){limit_is_far, query}; }

void query_forget_insides(imp_query *query)
{
    inside_free(query->insides);
    query->insides = NULL;
    query->insides_next = 0;
}

bool query_may_be_inside(const imp_query *query)
{
    return query->insides_next < query->candidates.pair_count && scene_has_solids(query->scene);
}

/* Ends the search with what was found of the pair that is asked about. */
static void take_answer(imp_query *query, const inside_answer *answer)
{
    const size_t k = query->insides_next;
    if (answer->state == INSIDE_STOPPED) return;
    query->insides_next += 1;
    if (answer->state == INSIDE_UNKNOWN && !query->inside_unknown) {
        query->inside_unknown = true;
        query->unknown_candidate = k;
    }
    if (answer->state != INSIDE_FOUND) return;
    query->impact.found_candidate = (uint32_t)k;
    query->impact.t_lower = query->options.t_start;
    query->kind = IMP_CONTACT_INSIDE;
    query->inside = *answer;
    query->at_rest = false;
    query_finish(query, IMP_VERDICT_CONTACT, IMP_REASON_NONE);
}

static imp_code begin(imp_query *query, imp_error *error)
{
    const inside_plan plan = {
        query->scene,         query->impact.gamma, query->gamma_clear, query->options.t_start,
        query->options.t_end, &query->watch,       query->seam};
    if (query->insides != NULL) return IMP_SUCCESS;
    query->insides = inside_new(&plan);
    query->inside_unknown = false;
    return query->insides != NULL ? IMP_SUCCESS : error_set_memory(error);
}

imp_code query_look_inside(imp_query *query, imp_error *error)
{
    const candidate_pair *pairs = query->candidates.pairs;
    const bool *passed = query->impact.passed;
    imp_code code = begin(query, error);
    while (query->insides_next < query->candidates.pair_count) {
        const size_t k = query->insides_next;
        const size_t body[2] = {pairs[k].side[0]->body, pairs[k].side[1]->body};
        const bool counts = candidate_pair_is_first(pairs, k) && (passed == NULL || !passed[k]);
        if (counts &&
            (scene_is_solid(query->scene, body[0]) || scene_is_solid(query->scene, body[1])))
            break;
        query->insides_next += 1;
    }
    if (code != IMP_SUCCESS || query->insides_next >= query->candidates.pair_count) return code;
    const candidate_pair *both = &pairs[query->insides_next];
    inside_answer answer;
    tree_growth growth = {0};
    code = inside_find(query->insides, (const size_t[2]){both->side[0]->body, both->side[1]->body},
                       query->options.t_start, &answer, &growth, error);
    query->stats.nodes += growth.nodes;
    query->stats.bytes += growth.bytes;
    if (code == IMP_SUCCESS) take_answer(query, &answer);
    return code;
}
