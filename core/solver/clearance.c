/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

#include "core/base/status.h"
#include "core/common/array.h"
#include "core/common/clock.h"
#include "core/scene/tolerances.h"
#include "core/solver/pair_step.h"

/* --- One task --------------------------------------------------------------------------------- */

/* Trees are replaced once their nodes have this many bytes. A smaller value costs time; without a
 * limit, 1000000 slices of two spheres would take 80 GB. */
#define SLICES_BYTES ((uint64_t)4 << 20)

/* Replaces large trees by new ones with the same roots: a slice needs few of the nodes that earlier
 * slices made. Nodes depend on their regions alone, so that no answer changes. */
static imp_code renew_trees(clearance_search *c, imp_error *error)
{
    const uint64_t fresh = c->fresh_bytes - c->shared_bytes;
    if (c->asked.slices == 1 || c->stats->bytes - c->fresh_bytes <= SLICES_BYTES + fresh)
        return IMP_SUCCESS;
    if (c->own.complete)
        c->stats->bytes = c->shared_bytes;
    else
        c->shared_bytes = c->stats->bytes;
    candidates_clear(&c->own);
    const imp_code code =
        candidates_part(&c->own, c->whole, 0, c->whole->pair_count, c->stats, error);
    c->fresh_bytes = c->stats->bytes;
    c->list = code == IMP_SUCCESS ? &c->own : c->whole;
    return code;
}

/* Answers a task at whose start one body is inside another. */
static void finish_inside(clearance_search *c, const inside_answer *found)
{
    imp_clearance *answer = &c->answer;
    answer->kind = IMP_CONTACT_INSIDE;
    answer->has_witness = true;
    answer->lower = answer->upper = 0;
    answer->t = answer->t_start;
    answer->a = found->side[0];
    answer->b = found->side[1];
    if (c->asked.required > 0) answer->verdict = IMP_REQUIREMENT_VIOLATED;
    if (c->asked.required > 0 && c->asked.slices == 1) {
        answer->t_violated = answer->t_start;
        answer->gap_violated = 0;
        answer->a_violated = answer->a;
        answer->b_violated = answer->b;
    }
    clearance_finish_task(c, IMP_REASON_NONE);
}

static imp_code begin_task(clearance_search *c, imp_error *error)
{
    if (renew_trees(c, error) != IMP_SUCCESS) return error->code;
    const clearance_group *group = clearance_group_of(c);
    imp_clearance *grown = arena_store_reserve(scene_store(c->scene), c->answers, c->current,
                                               &c->answer_capacity, sizeof *c->answers);
    if (grown == NULL) return error_set_memory(error);
    c->answers = grown;
    c->answer = clearance_blank_answer(c, c->current);
    c->before = *c->stats;
    c->before.seconds = clock_seconds();
    c->unresolved = c->takes_turns = false;
    inside_answer inside;
    const imp_code code = clearance_look_inside(c, group, &inside, error);
    if (code != IMP_SUCCESS || inside.state == INSIDE_STOPPED) return code;
    if (inside.state == INSIDE_FOUND) {
        finish_inside(c, &inside);
        return code;
    }
    const time_window times = {c->answer.t_start, c->answer.t_end};
    for (size_t k = 0; k < group->count && c->asked.slices > 1; ++k)
        pair_look_anew(&c->list->pairs[group->first + k]);
    if (candidates_rest(c->list, group->first, group->count, &times, clearance_slip_most(c),
                        &c->moments, c->stats, error) != IMP_SUCCESS)
        return error->code;
    const imp_code begun = clearance_begin_distance(c, group, error);
    if (begun != IMP_SUCCESS) candidates_wake(c->list, &c->moments, c->stats);
    return begun;
}

/* Returns the counts and time of the current task. */
static imp_stats cost(const clearance_search *c)
{
    imp_stats s = *c->stats;
    s.seconds = clock_seconds() - c->before.seconds;
    s.pairs -= c->before.pairs;
    s.nodes -= c->before.nodes;
    s.witness_searches -= c->before.witness_searches;
    return s;
}

static bool is_narrow(const clearance_search *c, const imp_clearance *answer)
{
    const double width = answer->upper - answer->lower;
    return width <= c->asked.tolerance * answer->upper || answer->upper <= c->options.gamma;
}

void clearance_finish_task(clearance_search *c, imp_reason reason)
{
    if (reason == IMP_REASON_NONE && (clearance_decides(c) || clearance_is_beyond(c)) &&
        !is_narrow(c, &c->answer))
        reason = IMP_REASON_DECIDED;
    if (c->inside_unknown && c->answer.lower > 0) {
        c->answer.lower = 0;
        reason = IMP_REASON_RESOLUTION;
        if (c->answer.verdict == IMP_REQUIREMENT_HOLDS)
            c->answer.verdict = IMP_REQUIREMENT_UNDECIDED;
    }
    const double clear = tolerances_clear(c->options.gamma, c->options.gamma_clear);
    c->known_outside = c->answer.lower > 0 && c->answer.lower >= clear &&
                       scene_is_defined(c->scene, c->options.t_start, c->options.t_end);
    c->answer.reason = reason;
    c->answer.stats = cost(c);
    c->answers[c->current++] = c->answer;
    min_distance_clear(&c->distance);
    impact_clear(&c->violation);
    candidates_wake(c->list, &c->moments, c->stats);
    c->stage = STAGE_NEXT;
}

/* --- All tasks -------------------------------------------------------------------------------- */

imp_code clearance_work(clearance_search *c, imp_reason *reason, imp_error *error)
{
    *reason = IMP_REASON_RUNNING;
    switch (c->stage) {
    case STAGE_DISTANCE:
        return clearance_search_distance(c, reason, error);
    case STAGE_VIOLATION:
        return clearance_search_violation(c, reason, error);
    case STAGE_NEXT:
        break;
    }
    if (c->current < clearance_count(c)) return begin_task(c, error);
    *reason = IMP_REASON_NONE;
    return IMP_SUCCESS;
}

clearance_state clearance_look(const clearance_search *c)
{
    const min_distance *m = &c->distance;
    const bool searched = c->stage == STAGE_DISTANCE;
    return (clearance_state){
        .lower = searched ? min_distance_lower(m) : NAN,
        .upper = searched ? m->upper : NAN,
        .t_lower = c->stage == STAGE_VIOLATION ? c->violation.t_lower : NAN,
        .heap = searched ? m->heap.count + m->start_count : c->violation.heap.count,
        .bytes = sizeof *c + c->group_count * sizeof *c->groups + c->current * sizeof *c->answers +
                 candidates_bytes(&c->own) + c->moments.capacity * sizeof *c->moments.at +
                 m->start_capacity * sizeof(pair) +
                 (m->heap.capacity + c->violation.heap.capacity) * PAIR_HEAP_BYTES};
}

const pair_heap *clearance_waiting(const clearance_search *c, double *apart)
{
    switch (c->stage) {
    case STAGE_DISTANCE:
        *apart = min_distance_enough(&c->distance);
        return &c->distance.heap;
    case STAGE_VIOLATION:
        *apart = c->violation.gamma_clear;
        return &c->violation.heap;
    case STAGE_NEXT:
        break;
    }
    return NULL;
}

imp_code clearance_answer(const clearance_search *c, size_t index, imp_reason reason,
                          imp_clearance *answer, imp_error *error)
{
    const bool is_current = index == c->current && c->stage != STAGE_NEXT;
    imp_code code = IMP_SUCCESS;
    if (index < c->current) {
        *answer = c->answers[index];
        return code;
    }
    *answer = is_current ? c->answer : clearance_blank_answer(c, index);
    if (is_current && c->stage == STAGE_DISTANCE) code = clearance_take_bracket(c, answer, error);
    if (is_current) answer->stats = cost(c);
    if (c->asked.required > 0 && answer->verdict == IMP_REQUIREMENT_NONE)
        answer->verdict = IMP_REQUIREMENT_UNDECIDED; /* not begun */
    answer->reason = reason;
    return code;
}
