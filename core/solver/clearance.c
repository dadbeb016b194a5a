/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/bounds/separation.h"
#include "core/bounds/tuning.h"
#include "core/common/array.h"
#include "core/common/clock.h"
#include "core/scene/tolerances.h"
#include "core/solver/contradiction.h"
#include "core/solver/world.h"

/* --- The minimum distance of a task ----------------------------------------------------------- */

/* Returns the distance that counts as kept: between this and the required one, either verdict is
 * right. */
static double relaxed(const clearance_search *c) { return tolerances_nearly(c->asked.required); }

/* Returns the distance at which the verdict is that it holds: where a proof is kept, half way to
 * what is required, so that the verifier, whose bounds differ, has room. */
static double kept(const clearance_search *c)
{
    return c->proof != NULL ? 0.5 * relaxed(c) + 0.5 * c->asked.required : relaxed(c);
}

/* Returns the distance that the searches have to prove: the required one, plus the slip of pairs
 * that are searched at one moment. */
static double searched(const clearance_search *c)
{
    return c->list->slip > 0 ? sum_upper(kept(c), 2 * c->list->slip) : kept(c);
}

static const clearance_group *group_of(const clearance_search *c)
{
    return &c->groups[c->current / c->asked.slices];
}

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

static void finish_task(clearance_search *c, imp_reason reason);

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
    finish_task(c, IMP_REASON_NONE);
}

static imp_code begin_search(clearance_search *c, const clearance_group *group, imp_error *error)
{
    const double required = c->asked.required;
    c->distance = (min_distance){
        .window = {c->answer.t_start, c->answer.t_end},
        .tolerance = c->asked.tolerance,
        .gamma = required > 0 && required < c->options.gamma ? required : c->options.gamma,
        .required = required,
        .relaxed = searched(c),
        .slip = c->list->slip,
        .candidates = c->list->pairs,
        .stats = c->stats,
        .proof = c->proof != NULL ? &c->proof->distance : NULL};
    const imp_code code = min_distance_begin(&c->distance, group->first, group->count, error);
    if (code == IMP_SUCCESS)
        c->stage = STAGE_DISTANCE;
    else
        min_distance_clear(&c->distance);
    return code;
}

static imp_code begin_task(clearance_search *c, imp_error *error)
{
    if (renew_trees(c, error) != IMP_SUCCESS) return error->code;
    const clearance_group *group = group_of(c);
    imp_clearance *grown =
        array_reserve(c->answers, c->current, &c->answer_capacity, sizeof *c->answers);
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
    return begin_search(c, group, error);
}

/* Returns the lower bound proved for the current task. Lemma. All surfaces that come within
 * asked.within are candidates, so that other pairs are never nearer than that. */
static double lower_of(const clearance_search *c)
{
    const double lower = min_distance_lower(&c->distance), near = clearance_near(c);
    return lower < near ? lower : near;
}

/* Whether the bodies are proved to be farther apart than asked.within. */
static bool is_beyond(const clearance_search *c)
{
    return c->asked.within > 0 && lower_of(c) >= c->asked.within;
}

static imp_requirement requirement_of(const clearance_search *c, double lower, double upper)
{
    if (!(c->asked.required > 0)) return IMP_REQUIREMENT_NONE;
    if (upper <= c->asked.required) return IMP_REQUIREMENT_VIOLATED;
    return lower >= kept(c) ? IMP_REQUIREMENT_HOLDS : IMP_REQUIREMENT_UNDECIDED;
}

/* Takes the witness of candidate k at time t, which gives `upper`. */
static imp_code take_witness(const clearance_search *c, uint32_t k, const witness *w, double t,
                             imp_clearance *answer, imp_error *error)
{
    world_witness told;
    const imp_code code =
        world_witness_of(c->scene, &c->list->pairs[k], w, t, INFINITY, &told, error);
    if (code != IMP_SUCCESS) return code;
    answer->has_witness = true;
    answer->upper = w->gap_upper;
    answer->t = t;
    answer->a = told.side[0];
    answer->b = told.side[1];
    answer->has_normal = w->has_normal;
    memcpy(answer->normal, told.normal, sizeof answer->normal);
    return IMP_SUCCESS;
}

/* Copies what the search has found so far into the answer. */
static imp_code take_bracket(const clearance_search *c, imp_clearance *answer, imp_error *error)
{
    const min_distance *m = &c->distance;
    answer->lower = lower_of(c);
    answer->upper = m->upper;
    answer->verdict = requirement_of(c, answer->lower, answer->upper);
    if (!(m->upper < INFINITY)) return IMP_SUCCESS;
    return take_witness(c, m->candidate, &m->found, m->t, answer, error);
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

/* Whether only a verdict is wanted. */
static bool decides(const clearance_search *c) { return c->asked.decide && c->asked.required > 0; }

static bool is_narrow(const clearance_search *c, const imp_clearance *answer)
{
    const double width = answer->upper - answer->lower;
    return width <= c->asked.tolerance * answer->upper || answer->upper <= c->options.gamma;
}

/* Lemma. No points are nearer than `lower` before time t, and those of the witness are at most
 * `upper` apart, up to the slip of pairs that are searched at one moment. */
static imp_code check_witness(const clearance_search *c, const imp_clearance *answer, double lower,
                              double t, imp_error *error)
{
    const double upper = sum_upper(answer->upper, 2 * c->list->slip);
    if (!answer->has_witness || !(upper < lower && answer->t < t)) return IMP_SUCCESS;
    return contradiction_fault(scene_surface(c->scene, answer->a.body, answer->a.surface),
                               scene_surface(c->scene, answer->b.body, answer->b.surface), upper,
                               answer->t, lower, error);
}

static void finish_task(clearance_search *c, imp_reason reason)
{
    if (reason == IMP_REASON_NONE && (decides(c) || is_beyond(c)) && !is_narrow(c, &c->answer))
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
    c->stage = STAGE_NEXT;
}

/* A task without a witness has no candidates. */
static imp_reason reason_of_none(const clearance_search *c)
{
    if (c->any_pair && c->asked.within > 0) return IMP_REASON_DECIDED;
    return c->any_pair ? IMP_REASON_NO_TIME : IMP_REASON_NO_PAIRS;
}

static void begin_violation(clearance_search *c)
{
    const imp_clearance *answer = &c->answer;
    c->violation = (impact){.gamma = c->asked.required,
                            .gamma_clear = searched(c),
                            .window = {answer->t_start, answer->t_end},
                            .baseline = IMP_BASELINE_NONE,
                            .candidate_pairs = c->list->pairs,
                            .stats = c->stats,
                            .proof = c->proof != NULL ? &c->proof->contact : NULL,
                            .t_lower = answer->t_start};
    c->tested = 0;
    c->turn_from = c->stats->pairs;
    c->turn = TUNING_DECIDE_PAIRS + 2 * (uint64_t)group_of(c)->count;
    c->stage = STAGE_VIOLATION;
}

/* Whether the search for the distance can end: the bracket answers the query, or a search for
 * contact will. Where two points are known and only a verdict is wanted, that search costs a
 * fraction of a narrow bracket. */
static bool ends_early(const clearance_search *c)
{
    const min_distance *m = &c->distance;
    if (is_beyond(c)) return true;
    if (!decides(c) || !(m->upper < INFINITY)) return false;
    return !(c->unresolved || c->takes_turns) ||
           requirement_of(c, lower_of(c), m->upper) != IMP_REQUIREMENT_UNDECIDED;
}

/* Whether a turn of one search ends. Where the search for contact takes long, a narrow bracket may
 * be known earlier. So both searches alternate, each turn twice as long: the verdict takes at most
 * about four times the work of the faster one. */
static bool turn_ends(clearance_search *c)
{
    if (c->stats->pairs - c->turn_from <= c->turn) return false;
    c->turn_from = c->stats->pairs;
    if (c->takes_turns && c->stage == STAGE_DISTANCE) c->turn *= 2;
    return true;
}

static imp_code search_distance(clearance_search *c, imp_reason *reason, imp_error *error)
{
    min_distance_state state;
    imp_code code = min_distance_advance(&c->distance, &state, error);
    if (code != IMP_SUCCESS) return code;
    const bool running = state == MIN_DISTANCE_RUNNING;
    if (running && !ends_early(c)) {
        if (!c->takes_turns || c->unresolved || !turn_ends(c)) return IMP_SUCCESS;
        c->stage = STAGE_VIOLATION;
        return take_bracket(c, &c->answer, error);
    }
    if (state == MIN_DISTANCE_NO_MEMORY) {
        *reason = IMP_REASON_MEMORY;
        return IMP_SUCCESS;
    }
    code = take_bracket(c, &c->answer, error);
    if (code != IMP_SUCCESS) return code;
    c->answer.reason = state == MIN_DISTANCE_RESOLUTION ? IMP_REASON_RESOLUTION
                       : c->answer.has_witness          ? IMP_REASON_NONE
                                                        : reason_of_none(c);
    const bool violated = c->answer.verdict == IMP_REQUIREMENT_VIOLATED && c->asked.slices == 1;
    if (c->unresolved)
        finish_task(c, violated ? IMP_REASON_RESOLUTION : c->answer.reason);
    else if (violated && c->takes_turns)
        c->stage = STAGE_VIOLATION;
    else if (violated || (running && c->answer.verdict == IMP_REQUIREMENT_UNDECIDED))
        begin_violation(c);
    else
        finish_task(c, c->answer.reason);
    return IMP_SUCCESS;
}

/* --- The earliest violation, or that there is none -------------------------------------------- */

static imp_code take_violation(const clearance_search *c, imp_clearance *answer, imp_error *error)
{
    const impact *im = &c->violation;
    const uint32_t k = im->found_candidate;
    world_witness told;
    imp_code code = check_witness(c, answer, relaxed(c), im->t_lower, error);
    if (code == IMP_SUCCESS)
        code = world_witness_of(c->scene, &c->list->pairs[k], &im->found, im->t_lower, INFINITY,
                                &told, error);
    answer->verdict = IMP_REQUIREMENT_VIOLATED;
    if (code == IMP_SUCCESS && im->found.gap_upper < answer->upper)
        code = take_witness(c, k, &im->found, im->t_lower, answer, error);
    if (code != IMP_SUCCESS || c->asked.slices > 1) return code;
    answer->t_violated = im->t_lower;
    answer->gap_violated = told.gap;
    answer->a_violated = told.side[0];
    answer->b_violated = told.side[1];
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
        if (answer->verdict != IMP_REQUIREMENT_UNDECIDED || !turn_ends(c)) return code;
        c->takes_turns = true;
        c->stage = STAGE_DISTANCE;
        return code;
    case IMPACT_NO_MEMORY:
        *reason = IMP_REASON_MEMORY;
        return code;
    case IMPACT_CONTACT:
        c->by_violation = true;
        code = take_violation(c, answer, error);
        if (code == IMP_SUCCESS) code = check_witness(c, answer, answer->lower, INFINITY, error);
        break;
    case IMPACT_CLEAR: /* between `relaxed` and `required` both verdicts are right */
        answer->verdict = IMP_REQUIREMENT_HOLDS;
        c->by_violation = true;
        if (answer->lower < relaxed(c)) answer->lower = relaxed(c);
        code = check_witness(c, answer, answer->lower, INFINITY, error);
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
    if (code == IMP_SUCCESS) finish_task(c, answer->reason);
    return code;
}

/* Whether a candidate pair is too far apart to matter; a clearance's list has pairs at any
 * distance. */
static bool is_far(const clearance_search *c, size_t k)
{
    const candidate_pair *both = &c->list->pairs[k];
    const node *a = tree_root(both->side[0]->tree), *b = tree_root(both->side[1]->tree);
    return a->bounded && b->bounded && separation_of_boxes(a, b, searched(c));
}

static imp_code search_violation(clearance_search *c, imp_reason *reason, imp_error *error)
{
    const clearance_group *group = group_of(c);
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

/* --- All tasks -------------------------------------------------------------------------------- */

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
                 candidates_bytes(&c->own) + m->start_capacity * sizeof(pair) +
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
    if (is_current && c->stage == STAGE_DISTANCE) code = take_bracket(c, answer, error);
    if (is_current) answer->stats = cost(c);
    if (c->asked.required > 0 && answer->verdict == IMP_REQUIREMENT_NONE)
        answer->verdict = IMP_REQUIREMENT_UNDECIDED; /* not begun */
    answer->reason = reason;
    return code;
}

/* --- Proofs ----------------------------------------------------------------------------------- */

imp_code clearance_keep_proof(clearance_search *c, proof_logs *logs, imp_error *error)
{
    if (c->asked.each || c->asked.slices != 1)
        return error_set(error, IMP_ERROR_USAGE,
                         "proof: got a clearance with %s, must be one with a single answer",
                         c->asked.each ? "`each`" : "slices");
    c->proof = logs;
    return IMP_SUCCESS;
}

/* The verifier is given room by what it is asked to prove: a part of the bracket, unless a
 * requirement is kept, for which the search had room. */
enum { PART_OF_BRACKET = 16 };

clearance_proved clearance_what_is_proved(const clearance_search *c)
{
    const imp_clearance *answer = &c->answers[0];
    const bool fails = answer->t_violated >= answer->t_start;
    clearance_proved proved = {c->by_violation, 0, answer->t_start,
                               fails ? answer->t_violated : answer->t_end};
    if (c->by_violation) {
        proved.apart = relaxed(c);
        return proved;
    }
    const double room =
        answer->has_witness ? answer->upper - answer->lower : 0.0625 * answer->lower;
    proved.apart = answer->lower - room / PART_OF_BRACKET;
    if (answer->verdict == IMP_REQUIREMENT_HOLDS && proved.apart < relaxed(c))
        proved.apart = relaxed(c);
    if (!(proved.apart > 0)) proved.apart = 0;
    return proved;
}
