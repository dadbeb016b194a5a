/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_parts.h"

#include <string.h>

#include "core/common/clock.h"

/* --- The minimum distance of a part --------------------------------------------------------- */

/* Part of what is required that counts as kept: between this and what is required, either answer
 * is right. */
static double relaxed(const clearance_search *c) { return c->asked.required * (1 - 1e-6); }

static imp_code begin_part(clearance_search *c, imp_error *error)
{
    const part *p = &c->parts[c->current];
    const double required = c->asked.required;
    c->before = *c->stats;
    c->before.seconds = clock_seconds();
    c->distance = (min_distance){
        .window = {p->answer.t_start, p->answer.t_end},
        .tolerance = c->asked.tolerance,
        .gamma = required > 0 && required < c->options.gamma ? required : c->options.gamma,
        .required = required,
        .relaxed = relaxed(c),
        .candidates = c->list->pairs,
        .stats = c->stats};
    const imp_code code = min_distance_begin(&c->distance, p->first, p->count, error);
    if (code == IMP_SUCCESS)
        c->stage = STAGE_DISTANCE;
    else
        min_distance_clear(&c->distance);
    return code;
}

static imp_side side_of(const clearance_search *c, uint32_t k, const witness *w, int side)
{
    const candidate *of = c->list->pairs[k].side[side];
    imp_side s = {of->body, of->surface, w->piece[side], w->u[side], w->v[side], {0, 0, 0}};
    memcpy(s.point, w->point[side].x, sizeof s.point);
    return s;
}

static imp_requirement requirement_of(const clearance_search *c, double lower, double upper)
{
    if (!(c->asked.required > 0)) return IMP_REQUIREMENT_NONE;
    if (upper <= c->asked.required) return IMP_REQUIREMENT_VIOLATED;
    return lower >= relaxed(c) ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_UNDECIDED;
}

/* What the search has found so far, into the answer. */
static void take_bracket(const clearance_search *c, imp_clearance *answer)
{
    const min_distance *m = &c->distance;
    answer->lower = min_distance_lower(m);
    answer->upper = m->upper;
    answer->verdict = requirement_of(c, answer->lower, answer->upper);
    answer->has_witness = m->upper < INFINITY;
    if (!answer->has_witness) return;
    answer->t = m->t;
    answer->a = side_of(c, m->candidate, &m->found, 0);
    answer->b = side_of(c, m->candidate, &m->found, 1);
    answer->has_normal = m->found.has_normal;
    memcpy(answer->normal, m->found.normal.x, sizeof answer->normal);
}

/* What the current part has cost. */
static imp_stats cost(const clearance_search *c)
{
    imp_stats s = *c->stats;
    s.seconds = clock_seconds() - c->before.seconds;
    s.pairs -= c->before.pairs;
    s.nodes -= c->before.nodes;
    s.witness_searches -= c->before.witness_searches;
    return s;
}

static void finish_part(clearance_search *c, imp_reason reason)
{
    part *p = &c->parts[c->current++];
    p->answer.reason = reason;
    p->answer.stats = cost(c);
    p->done = true;
    min_distance_clear(&c->distance);
    impact_clear(&c->violation);
    c->stage = STAGE_NEXT;
}

/* A part without a witness has no candidates. */
static imp_reason reason_of_none(const clearance_search *c)
{
    return c->any_pair ? IMP_REASON_NO_TIME : IMP_REASON_NO_PAIRS;
}

static void begin_violation(clearance_search *c)
{
    const imp_clearance *answer = &c->parts[c->current].answer;
    c->violation = (impact){.gamma = c->asked.required,
                            .clearance = relaxed(c),
                            .window = {answer->t_start, answer->t_end},
                            .method = IMP_METHOD_MODELS,
                            .candidate_pairs = c->list->pairs,
                            .stats = c->stats,
                            .t_lower = answer->t_start};
    c->tested = 0;
    c->stage = STAGE_VIOLATION;
}

static imp_code search_distance(clearance_search *c, imp_reason *reason, imp_error *error)
{
    part *p = &c->parts[c->current];
    min_distance_state state;
    const imp_code code = min_distance_advance(&c->distance, &state, error);
    if (code != IMP_SUCCESS || state == MIN_DISTANCE_RUNNING) return code;
    if (state == MIN_DISTANCE_NO_MEMORY) {
        *reason = IMP_REASON_MEMORY;
        return IMP_SUCCESS;
    }
    take_bracket(c, &p->answer);
    p->answer.reason = state == MIN_DISTANCE_RESOLUTION ? IMP_REASON_RESOLUTION
                       : p->answer.has_witness          ? IMP_REASON_NONE
                                                        : reason_of_none(c);
    if (p->answer.verdict == IMP_REQUIREMENT_VIOLATED && c->asked.slices == 1)
        begin_violation(c);
    else
        finish_part(c, p->answer.reason);
    return IMP_SUCCESS;
}

/* --- The earliest violation ------------------------------------------------------------------ */

static void take_violation(const clearance_search *c, imp_clearance *answer)
{
    const impact *im = &c->violation;
    answer->t_violated = im->t_lower;
    answer->gap_violated = im->found.gap;
    answer->a_violated = side_of(c, im->found_candidate, &im->found, 0);
    answer->b_violated = side_of(c, im->found_candidate, &im->found, 1);
}

static void conclude_violation(clearance_search *c, impact_state state, imp_reason *reason)
{
    imp_clearance *answer = &c->parts[c->current].answer;
    switch (state) {
    case IMPACT_RUNNING:
        return;
    case IMPACT_NO_MEMORY:
        *reason = IMP_REASON_MEMORY;
        return;
    case IMPACT_CONTACT:
        take_violation(c, answer);
        break;
    case IMPACT_CLEAR: /* in the band both are right; a violation needs its time */
        answer->verdict = IMP_REQUIREMENT_HOLDS;
        break;
    case IMPACT_RESOLUTION:
        answer->reason = IMP_REASON_RESOLUTION;
        break;
    }
    finish_part(c, answer->reason);
}

static imp_code search_violation(clearance_search *c, imp_reason *reason, imp_error *error)
{
    const part *p = &c->parts[c->current];
    impact_state state = IMPACT_RUNNING;
    imp_code code;
    if (c->tested < p->count) {
        code = impact_add_candidate(&c->violation, (uint32_t)(p->first + c->tested), &state, error);
        if (state == IMPACT_RUNNING) c->tested += 1;
    } else {
        code = impact_advance(&c->violation, &state, error);
    }
    if (code == IMP_SUCCESS) conclude_violation(c, state, reason);
    return code;
}

/* --- All parts ------------------------------------------------------------------------------- */

imp_code clearance_work(clearance_search *c, imp_reason *reason, imp_error *error)
{
    *reason = IMP_REASON_RUNNING;
    switch (c->stage) {
    case STAGE_DISTANCE:
        return search_distance(c, reason, error);
    case STAGE_VIOLATION:
        return search_violation(c, reason, error);
    case STAGE_NEXT:
        break;
    }
    if (c->current < c->count) return begin_part(c, error);
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
        .bytes =
            sizeof *c + c->count * sizeof *c->parts + m->start_capacity * sizeof(pair) +
            (m->heap.capacity + c->violation.heap.capacity) * PAIR_HEAP_BYTES};
}

size_t clearance_count(const clearance_search *c) { return c->count; }

imp_clearance clearance_answer(const clearance_search *c, size_t index, imp_reason reason)
{
    imp_clearance answer = c->parts[index].answer;
    if (c->parts[index].done) return answer;
    if (index == c->current && c->stage == STAGE_DISTANCE) take_bracket(c, &answer);
    if (index == c->current && c->stage != STAGE_NEXT) answer.stats = cost(c);
    if (c->asked.required > 0 && answer.verdict == IMP_REQUIREMENT_NONE)
        answer.verdict = IMP_REQUIREMENT_UNDECIDED; /* not begun */
    answer.reason = reason;
    return answer;
}
