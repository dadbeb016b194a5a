/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

#include "core/bounds/separation.h"
#include "core/bounds/tuning.h"
#include "core/solver/world.h"

/* The search for the earliest violation of the required distance in one task, or the proof that
 * there is none. */

void clearance_begin_violation(clearance_search *c)
{
    const imp_clearance *answer = &c->answer;
    c->violation = (impact){.gamma = c->asked.required,
                            .gamma_clear = clearance_searched(c),
                            .window = {answer->t_start, answer->t_end},
                            .baseline = IMP_BASELINE_NONE,
                            .max_pairs = c->options.max_pairs,
                            .candidate_pairs = c->list->pairs,
                            .stats = c->stats,
                            .heap = {.store = scene_store(c->scene)},
                            .proof = c->proof != NULL ? &c->proof->contact : NULL,
                            .t_lower = answer->t_start};
    c->tested = 0;
    c->turn_from = c->stats->pairs;
    c->turn = TUNING_DECIDE_PAIRS + 2 * (uint64_t)clearance_group_of(c)->count;
    c->stage = STAGE_VIOLATION;
}

static imp_code take_violation(const clearance_search *c, imp_clearance *answer, imp_error *error)
{
    const impact *im = &c->violation;
    const uint32_t k = im->found_candidate;
    world_witness in_world;
    imp_code code = clearance_check_witness(c, answer, clearance_relaxed(c), im->t_lower, error);
    if (code == IMP_SUCCESS)
        code = world_witness_of(c->scene, &c->list->pairs[k], &im->found, im->t_lower, INFINITY,
                                &in_world, error);
    answer->verdict = IMP_REQUIREMENT_VIOLATED;
    if (code == IMP_SUCCESS && im->found.gap_upper < answer->upper)
        code = clearance_take_witness(c, k, &im->found, im->t_lower, answer, error);
    if (code != IMP_SUCCESS || c->asked.slices > 1) return code;
    answer->t_violated = im->t_lower;
    answer->gap_violated = in_world.gap;
    answer->a_violated = in_world.side[0];
    answer->b_violated = in_world.side[1];
    return IMP_SUCCESS;
}

/* Continues with the distance alone after double precision has ended the search for contact,
 * because it cannot resolve a millionth of the required distance; a witness, or the bracket, may
 * still decide. */
static void go_on_with_distance(clearance_search *c)
{
    impact_clear(&c->violation);
    c->stage = STAGE_DISTANCE;
}

static imp_code conclude_violation(clearance_search *c, impact_state state, imp_reason *reason,
                                   imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    imp_clearance *answer = &c->answer;
    switch (state) {
    case IMPACT_RUNNING:
        if (answer->verdict != IMP_REQUIREMENT_UNDECIDED || !clearance_turn_ends(c)) return code;
        c->takes_turns = true;
        c->stage = STAGE_DISTANCE;
        return code;
    case IMPACT_NO_MEMORY:
        *reason = IMP_REASON_MEMORY;
        return code;
    case IMPACT_CONTACT:
        c->by_violation = true;
        code = take_violation(c, answer, error);
        if (code == IMP_SUCCESS)
            code = clearance_check_witness(c, answer, answer->lower, INFINITY, error);
        break;
    case IMPACT_CLEAR: /* between `relaxed` and `required` both verdicts are right */
        answer->verdict = IMP_REQUIREMENT_HOLDS;
        c->by_violation = true;
        if (answer->lower < clearance_relaxed(c)) answer->lower = clearance_relaxed(c);
        code = clearance_check_witness(c, answer, answer->lower, INFINITY, error);
        break;
    case IMPACT_RESOLUTION:
        if (answer->verdict == IMP_REQUIREMENT_UNDECIDED) {
            c->unresolved = true;
            go_on_with_distance(c);
            return code;
        }
        answer->reason = IMP_REASON_RESOLUTION;
        break;
    }
    if (code == IMP_SUCCESS) clearance_finish_task(c, answer->reason);
    return code;
}

/* Whether a candidate pair is too far apart to matter; a clearance's list has pairs at any
 * distance. */
static bool is_far(const clearance_search *c, size_t k)
{
    const candidate_pair *both = &c->list->pairs[k];
    const node *a = tree_root(both->side[0]->tree), *b = tree_root(both->side[1]->tree);
    return a->bounded && b->bounded && separation_of_boxes(a, b, clearance_searched(c));
}

imp_code clearance_search_violation(clearance_search *c, imp_reason *reason, imp_error *error)
{
    const clearance_group *group = clearance_group_of(c);
    impact_state state = IMPACT_RUNNING;
    imp_code code;
    if (c->tested < group->count && is_far(c, group->first + c->tested)) {
        c->tested += 1;
        return IMP_SUCCESS;
    }
    if (c->tested < group->count) {
        code = impact_add_candidate(&c->violation, (uint32_t)(group->first + c->tested), &state,
                                    error);
        if (state == IMPACT_RUNNING) c->tested += 1;
    } else {
        code = impact_advance(&c->violation, &state, error);
    }
    return code == IMP_SUCCESS ? conclude_violation(c, state, reason, error) : code;
}
