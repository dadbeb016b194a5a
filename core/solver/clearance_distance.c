/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

/* The search for the minimum distance of one task. Where a distance is required, it alternates with
 * the search for a violation (clearance_violation.c). */

imp_code clearance_begin_distance(clearance_search *c, const clearance_group *group,
                                  imp_error *error)
{
    const double required = c->asked.required;
    c->distance = (min_distance){
        .window = {c->answer.t_start, c->answer.t_end},
        .tolerance = c->asked.tolerance,
        .gamma = required > 0 && required < c->options.gamma ? required : c->options.gamma,
        .required = required,
        .max_pairs = c->options.max_pairs,
        .relaxed = clearance_searched(c),
        .slip = clearance_slip(c),
        .candidates = c->list->pairs,
        .stats = c->stats,
        .heap = {.store = scene_store(c->scene)},
        .proof = c->proof != NULL ? &c->proof->distance : NULL};
    const imp_code code = min_distance_begin(&c->distance, group->first, group->count, error);
    if (code == IMP_SUCCESS)
        c->stage = STAGE_DISTANCE;
    else
        min_distance_clear(&c->distance);
    return code;
}

/* Returns the lower bound proved for the current task. Lemma. All surfaces that come within
 * asked.within are candidates, so that other pairs are never nearer than that. */
static double lower_of(const clearance_search *c)
{
    const double lower = min_distance_lower(&c->distance), near = clearance_near(c);
    return lower < near ? lower : near;
}

bool clearance_is_beyond(const clearance_search *c)
{
    return c->asked.within > 0 && lower_of(c) >= c->asked.within;
}

static imp_requirement requirement_of(const clearance_search *c, double lower, double upper)
{
    if (!(c->asked.required > 0)) return IMP_REQUIREMENT_NONE;
    if (upper <= c->asked.required) return IMP_REQUIREMENT_VIOLATED;
    return lower >= clearance_kept(c) ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_UNDECIDED;
}

imp_code clearance_take_bracket(const clearance_search *c, imp_clearance *answer, imp_error *error)
{
    const min_distance *m = &c->distance;
    answer->lower = lower_of(c);
    answer->upper = m->upper;
    answer->verdict = requirement_of(c, answer->lower, answer->upper);
    if (!(m->upper < INFINITY)) return IMP_SUCCESS;
    return clearance_take_witness(c, m->candidate, &m->found, m->t, answer, error);
}

/* A task without a witness has no candidates. */
static imp_reason reason_of_none(const clearance_search *c)
{
    if (c->any_pair && c->asked.within > 0) return IMP_REASON_DECIDED;
    return c->any_pair ? IMP_REASON_NO_TIME : IMP_REASON_NO_PAIRS;
}

/* Whether the search for the distance can end: the bracket answers the query, or a search for
 * contact will. Where two points are known and only a verdict is wanted, that search costs a
 * fraction of a narrow bracket. */
static bool ends_early(const clearance_search *c)
{
    const min_distance *m = &c->distance;
    if (clearance_is_beyond(c)) return true;
    if (!clearance_decides(c) || !(m->upper < INFINITY)) return false;
    return !(c->unresolved || c->takes_turns) ||
           requirement_of(c, lower_of(c), m->upper) != IMP_REQUIREMENT_UNDECIDED;
}

imp_code clearance_search_distance(clearance_search *c, imp_reason *reason, imp_error *error)
{
    min_distance_state state;
    imp_code code = min_distance_advance(&c->distance, &state, error);
    if (code != IMP_SUCCESS) return code;
    const bool running = state == MIN_DISTANCE_RUNNING;
    if (running && !ends_early(c)) {
        if (!c->takes_turns || c->unresolved || !clearance_turn_ends(c)) return IMP_SUCCESS;
        c->stage = STAGE_VIOLATION;
        return clearance_take_bracket(c, &c->answer, error);
    }
    if (state == MIN_DISTANCE_NO_MEMORY) {
        *reason = IMP_REASON_MEMORY;
        return IMP_SUCCESS;
    }
    code = clearance_take_bracket(c, &c->answer, error);
    if (code != IMP_SUCCESS) return code;
    c->answer.reason = state == MIN_DISTANCE_RESOLUTION ? IMP_REASON_RESOLUTION
                       : c->answer.has_witness          ? IMP_REASON_NONE
                                                        : reason_of_none(c);
    const bool violated = c->answer.verdict == IMP_REQUIREMENT_VIOLATED && c->asked.slices == 1;
    if (c->unresolved)
        clearance_finish_task(c, violated ? IMP_REASON_RESOLUTION : c->answer.reason);
    else if (violated && c->takes_turns)
        c->stage = STAGE_VIOLATION;
    else if (violated || (running && c->answer.verdict == IMP_REQUIREMENT_UNDECIDED))
        clearance_begin_violation(c);
    else
        clearance_finish_task(c, c->answer.reason);
    return IMP_SUCCESS;
}
