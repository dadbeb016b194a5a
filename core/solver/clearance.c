/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/common/clock.h"

/* A pair of bodies, or all, during a slice of time. */
typedef struct part {
    imp_clearance answer;
    size_t first, count; /* its candidates in the list */
    bool done;
} part;

typedef enum stage { STAGE_NEXT, STAGE_DISTANCE, STAGE_VIOLATION } stage;

struct clearance_search {
    const imp_scene *scene;
    bool any_pair;
    imp_options options;
    imp_clearance_options asked;
    part *parts;
    size_t count, current;
    stage stage;
    const candidate_list *list;
    imp_stats *stats;
    imp_stats before; /* when the current part began; seconds: of the clock */
    min_distance distance;
    impact violation;
    size_t tested; /* of the current part's candidates, while the violation is searched for */
};

/* --- What is asked ------------------------------------------------------------------------ */

enum { SLICES_MAX = 1000000 };

static imp_code check(const imp_clearance_options *asked, imp_error *error)
{
    if (!(asked->tolerance >= 1e-9 && asked->tolerance < 1))
        return error_set(error, IMP_ERROR_USAGE, "tolerance: got %g, must be from 1e-9 to below 1",
                         asked->tolerance);
    if (!(asked->required >= 0 && asked->required < INFINITY))
        return error_set(error, IMP_ERROR_USAGE,
                         "required: got %g, must be > 0 and finite, or 0 for none",
                         asked->required);
    if (asked->slices < 1 || asked->slices > SLICES_MAX)
        return error_set(error, IMP_ERROR_USAGE, "slices: got %llu, must be from 1 to %d",
                         (unsigned long long)asked->slices, SLICES_MAX);
    return IMP_SUCCESS;
}

static size_t body_pair_count(const clearance_search *c)
{
    if (!c->asked.each) return 1;
    const size_t n = imp_scene_body_count(c->scene);
    size_t count = 0;
    for (size_t a = 0; a < n; ++a)
        for (size_t b = a + 1; b < n; ++b) count += !scene_ignores(c->scene, a, b);
    return count;
}

/* The slices of one pair of bodies, from parts[c->count] on. Neighbours share the moment between. */
static void add_slices(clearance_search *c, size_t a, size_t b)
{
    const double n = (double)c->asked.slices;
    double start = c->options.t_start;
    for (uint64_t k = 1; k <= c->asked.slices; ++k) {
        const double share = (double)k / n;
        const double end = k == c->asked.slices
                               ? c->options.t_end
                               : (1 - share) * c->options.t_start + share * c->options.t_end;
        imp_clearance *answer = &c->parts[c->count++].answer;
        *answer = (imp_clearance){.struct_size = (uint32_t)sizeof *answer,
                                  .t_start = start,
                                  .t_end = end,
                                  .body = {a, b},
                                  .required = c->asked.required,
                                  .upper = INFINITY,
                                  .t = NAN,
                                  .t_violated = NAN};
        start = end;
    }
}

static imp_code add_parts(clearance_search *c, imp_error *error)
{
    const size_t n = imp_scene_body_count(c->scene);
    c->parts = calloc(body_pair_count(c) * c->asked.slices + 1, sizeof *c->parts);
    if (c->parts == NULL) return error_set_memory(error);
    if (!c->asked.each) add_slices(c, SIZE_MAX, SIZE_MAX);
    for (size_t a = 0; c->asked.each && a < n; ++a)
        for (size_t b = a + 1; b < n; ++b)
            if (!scene_ignores(c->scene, a, b)) add_slices(c, a, b);
    return IMP_SUCCESS;
}

imp_code clearance_new(const imp_scene *scene, bool any_pair, const imp_options *options,
                       const imp_clearance_options *asked, clearance_search **made,
                       imp_error *error)
{
    if (check(asked, error) != IMP_SUCCESS) return IMP_ERROR_USAGE;
    if (options->method != IMP_METHOD_MODELS)
        return error_set(error, IMP_ERROR_USAGE, "method: clearance takes models only");
    clearance_search *c = calloc(1, sizeof *c);
    if (c == NULL) return error_set_memory(error);
    c->scene = scene;
    c->any_pair = any_pair;
    c->options = *options;
    c->asked = *asked;
    const imp_code code = add_parts(c, error);
    if (code == IMP_SUCCESS)
        *made = c;
    else
        clearance_free(c);
    return code;
}

imp_code clearance_part(const clearance_search *whole, const size_t body[2],
                        clearance_search **made, imp_error *error)
{
    clearance_search *c = calloc(1, sizeof *c);
    if (c == NULL) return error_set_memory(error);
    *c = (clearance_search){.scene = whole->scene,
                            .any_pair = true,
                            .options = whole->options,
                            .asked = whole->asked,
                            .parts = calloc(whole->asked.slices, sizeof *c->parts)};
    if (c->parts == NULL) {
        clearance_free(c);
        return error_set_memory(error);
    }
    add_slices(c, body[0], body[1]);
    *made = c;
    return IMP_SUCCESS;
}

bool clearance_is_each(const clearance_search *c) { return c->asked.each; }

void clearance_free(clearance_search *c)
{
    if (c == NULL) return;
    min_distance_clear(&c->distance);
    impact_clear(&c->violation);
    free(c->parts);
    free(c);
}

static bool is_of(const candidate_pair *both, const size_t body[2])
{
    return both->side[0]->body == body[0] && both->side[1]->body == body[1];
}

/* The list is in the order of the scene, so that the candidates of two bodies stand together. */
static void find_candidates(const candidate_list *list, part *p)
{
    const size_t *body = p->answer.body;
    size_t first = 0, end = list->pair_count;
    if (body[0] != SIZE_MAX) {
        while (first < list->pair_count && !is_of(&list->pairs[first], body)) ++first;
        for (end = first; end < list->pair_count && is_of(&list->pairs[end], body);) ++end;
    }
    p->first = first;
    p->count = end - first;
}

void clearance_begin(clearance_search *c, const candidate_list *list, imp_stats *stats)
{
    c->list = list;
    c->stats = stats;
    for (size_t k = 0; k < c->count; ++k) {
        part *p = &c->parts[k];
        if (k % c->asked.slices == 0) {
            find_candidates(list, p);
        } else {
            p->first = p[-1].first;
            p->count = p[-1].count;
        }
    }
}

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
            sizeof *c + c->count * sizeof *c->parts +
            (m->start_capacity + m->heap.capacity + c->violation.heap.capacity) * sizeof(pair)};
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
