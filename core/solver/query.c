/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/query_internal.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/rounding.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/scene/tolerances.h"
#include "core/solver/pair_test.h"

/* --- Creation and destruction ----------------------------------------------------------------- */

/* Checks that the baseline is 0, or one kind of volume with at most one form of rates. */
static imp_code check_baseline(uint32_t baseline, imp_error *error)
{
    const uint32_t volume = baseline & (IMP_BASELINE_BOXES | IMP_BASELINE_SPHERES),
                   rates = baseline & (IMP_BASELINE_COLUMN_RATES | IMP_BASELINE_CONSTANT_RATES);
    const bool has_one = volume == IMP_BASELINE_BOXES || volume == IMP_BASELINE_SPHERES;
    const bool has_both = rates == (IMP_BASELINE_COLUMN_RATES | IMP_BASELINE_CONSTANT_RATES);
    if (baseline == IMP_BASELINE_NONE) return IMP_SUCCESS;
    if (baseline == (volume | rates) && has_one && !has_both) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_USAGE,
                     "baseline: got 0x%" PRIx32 ", must be 0, or boxes (1) or spheres (2), with at "
                     "most one of column rates (4) and constant rates (8)",
                     baseline);
}

FP_APART static imp_query *new_query(imp_scene *scene, const imp_options *given, imp_error *error)
{
    imp_options own;
    const imp_options *options = &own;
    scene_options(scene, &own);
    if (sized_read("imp_options", &own, given, SCENE_OPTIONS_FIRST, error) != IMP_SUCCESS)
        return NULL;
    if (tolerances_check(options->gamma, options->gamma_clear, NULL, error) != IMP_SUCCESS)
        return NULL;
    const double gamma_clear = tolerances_clear(options->gamma, options->gamma_clear);
    if (scene_refuse_parameters(scene, "a query", error) != IMP_SUCCESS) return NULL;
    if (scene_check_options(scene, options, error) != IMP_SUCCESS) return NULL;
    if (check_baseline(options->baseline, error) != IMP_SUCCESS) return NULL;
    examined_times examined;
    if (examined_times_find(scene, options->t_start, options->t_end, &examined, error) !=
        IMP_SUCCESS)
        return NULL;
    imp_query *query = malloc(sizeof *query);
    if (query == NULL) {
        error_set_memory(error);
        return NULL;
    }
    *query = (imp_query){.scene = scene,
                         .scene_bytes = scene_bytes(scene),
                         .options = *options,
                         .gamma_clear = gamma_clear,
                         .examined = examined,
                         .impact = {.gamma = options->gamma,
                                    .gamma_clear = gamma_clear,
                                    .baseline = options->baseline,
                                    .t_lower = options->t_start,
                                    .window = {options->t_start, options->t_end},
                                    .stats = &query->stats},
                         .verdict = IMP_VERDICT_UNDECIDED,
                         .reason = IMP_REASON_RUNNING};
    query->peak_bytes = query->scene_bytes + sizeof *query;
    query_begin_watch(query);
    return query;
}

imp_query *imp_query_new(imp_scene *scene, const imp_options *options, imp_error *error)
{
    if (scene == NULL || options == NULL) {
        error_set_missing(error, "imp_query_new");
        return NULL;
    }
    const fp_environment environment = fp_environment_enter();
    imp_query *query = new_query(scene, options, error);
    fp_environment_leave(&environment);
    return query;
}

void imp_query_free(imp_query *query)
{
    if (query == NULL) return;
    impact_clear(&query->impact);
    inside_free(query->insides);
    clearance_free(query->clearance);
    candidates_clear(&query->candidates);
    query_forget_proof(query);
    free(query->parts);
    free(query);
}

void imp_query_cancel(imp_query *query)
{
    if (query != NULL) atomic_store(&query->cancelled, true);
}

/* --- Running ---------------------------------------------------------------------------------- */

void query_finish(imp_query *query, imp_verdict verdict, imp_reason reason)
{
    query->verdict = verdict;
    query->reason = reason;
    if (verdict == IMP_VERDICT_CLEAR) query->impact.t_lower = query->options.t_end;
}

imp_reason query_reason_of_clear(const imp_query *query)
{
    if (!query->examined.any_pair) return IMP_REASON_NO_PAIRS;
    return query->examined.lo <= query->examined.hi ? IMP_REASON_NONE : IMP_REASON_NO_TIME;
}

/* Whether one surface of the contact is at rest during all of the query's times. Rates are computed
 * only if no point of it was seen to move. */
static bool is_at_rest(const imp_query *query, int side)
{
    const candidate *c = query->candidates.pairs[query->impact.found_candidate].side[side];
    const surface *s = scene_surface(query->scene, c->body, c->surface);
    const imp_region *times = &tree_root(c->tree)->region;
    double lo[3], hi[3];
    imp_rate_matrix rates;
    if (c->moves && c->left_out == 0) return false;
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

static void note_bytes(imp_query *query, uint64_t of_candidates)
{
    uint64_t bytes = query->scene_bytes + query->stats.bytes + sizeof *query +
                     query->impact.heap.capacity * PAIR_HEAP_BYTES + of_candidates;
    if (query->proof != NULL)
        bytes += (query->proof->contact.capacity + query->proof->distance.capacity) *
                 sizeof(proof_record);
    if (query->clearance != NULL) bytes += clearance_look(query->clearance).bytes;
    if (bytes > query->peak_bytes) query->peak_bytes = bytes;
}

/* Returns the budget that is exhausted, or IMP_REASON_NONE. A cancellation ends one step: it is
 * cleared here, the only place that acts on it, so that none is lost. */
static imp_reason exhausted(imp_query *query, double seconds)
{
    const imp_options *options = &query->options;
    if (atomic_load_explicit(&query->cancelled, memory_order_relaxed) &&
        atomic_exchange(&query->cancelled, false))
        return IMP_REASON_CANCELLED;
    if (options->max_pairs > 0 && query->stats.pairs >= options->max_pairs) return IMP_REASON_PAIRS;
    if (options->max_seconds > 0 && seconds >= options->max_seconds) return IMP_REASON_SECONDS;
    if (options->max_bytes > 0 && query->peak_bytes > options->max_bytes) return IMP_REASON_MEMORY;
    return IMP_REASON_NONE;
}

/* Does one unit of work: tests the roots of the next candidate pair or, after all of them, expands
 * a pair of the heap. */
static imp_code search_contact(imp_query *query, imp_error *error)
{
    impact_state state = IMPACT_RUNNING;
    imp_code code = IMP_SUCCESS;
    if (query_may_be_inside(query)) return query_look_inside(query, error);
    if (query->candidates_tested < query->candidates.pair_count) {
        pair_test_look_ahead(&query->impact, (uint32_t)query->candidates_tested,
                             query->candidates.pair_count, &query->options);
        code =
            impact_add_candidate(&query->impact, (uint32_t)query->candidates_tested, &state, error);
        if (state == IMPACT_RUNNING) query->candidates_tested += 1;
    } else {
        code = impact_advance(&query->impact, &state, error);
    }
    return code == IMP_SUCCESS ? conclude(query, state, error) : code;
}

static imp_code work(imp_query *query, imp_error *error)
{
    return query->clearance == NULL ? search_contact(query, error)
                                    : clearance_work(query->clearance, &query->reason, error);
}

/* Units of work between readings of the clock. With many candidates, a slice of time begins with
 * all of them in one unit, which takes tenths of a second: then the clock is read after each
 * unit. */
enum { CLOCK_EVERY = 64, MANY_CANDIDATES = 1000 };

static unsigned units_per_reading(const imp_query *query)
{
    const bool many = query->candidates.pair_count > MANY_CANDIDATES;
    return query->clearance != NULL && many ? 1 : CLOCK_EVERY;
}
#define PROGRESS_EVERY 0.1 /* seconds between calls of options.progress */

/* Calls options.progress if it is due; the program may end the step. */
static void report(imp_query *query, double seconds)
{
    const imp_options *options = &query->options;
    if (options->progress == NULL || seconds < query->next_report) return;
    query->next_report = seconds + PROGRESS_EVERY;
    imp_progress progress = {.struct_size = (uint32_t)sizeof progress,
                             .reason = query->reason,
                             .t_lower = query->impact.t_lower,
                             .pairs = query->stats.pairs,
                             .heap = query->impact.heap.count,
                             .seconds = seconds,
                             .lower = NAN,
                             .upper = NAN,
                             .gap = query->impact.any_gap ? query->impact.least_gap : NAN};
    if (query->clearance != NULL) {
        const clearance_state state = clearance_look(query->clearance);
        progress.t_lower = state.t_lower;
        progress.heap = state.heap;
        progress.lower = state.lower;
        progress.upper = state.upper;
        progress.gap = state.upper < INFINITY ? state.upper : NAN;
    }
    if (!options->progress(options->progress_context, &progress)) imp_query_cancel(query);
}

/* Reads the clock every few units, and reports progress. */
static void tick(imp_query *query, double seconds_before, double start)
{
    query->stats.seconds = seconds_before + (clock_seconds() - start);
    report(query, query->stats.seconds);
}

typedef struct collecting {
    imp_query *query;
    double seconds_before, start; /* of this step */
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
    tick(c->query, c->seconds_before, c->start);
    note_bytes(c->query, bytes);
    c->reason = exhausted(c->query, c->query->stats.seconds);
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
           (most > 0 && query->candidates.pair_count + pairs > most) ||
           (options->max_bytes > 0 && query->peak_bytes + bytes > options->max_bytes) ||
           (options->max_seconds > 0 &&
            c->seconds_before + (clock_seconds() - c->start) >= options->max_seconds);
}

/* Returns the gamma_clear of the search: the requested one, plus the slip of pairs that are
 * searched at one moment. */
static double searched_gamma_clear(const imp_query *query, double gamma_clear)
{
    const double slip = query->candidates.slip;
    gamma_clear += query_proof_room(query);
    return slip > 0 ? sum_upper(gamma_clear, slip) : gamma_clear;
}

/* If a limit ends it, the next step starts it again. For a minimum distance without `within`, all
 * surfaces are candidates, however far apart. */
imp_code query_collect(imp_query *query, double start, imp_error *error)
{
    const double near =
        query->clearance == NULL ? query->impact.gamma_clear : clearance_near(query->clearance);
    collecting c = {query, query->stats.seconds, start, IMP_REASON_NONE};
    const candidate_limit limit = {limit_is_reached, limit_is_near, &c};
    const bool may_rest = query->clearance == NULL || clearance_is_of_all_times(query->clearance);
    const imp_code code = candidates_find(&query->candidates, query->scene, &query->options, near,
                                          may_rest, &limit, &query->stats, error);
    query->impact.gamma_clear = searched_gamma_clear(query, query->gamma_clear);
    query->impact.candidate_pairs = query->candidates.pairs;
    query->impact.candidate_pair_count = query->candidates.pair_count;
    if (code == IMP_SUCCESS && !query->candidates.complete)
        query_finish(query, IMP_VERDICT_UNDECIDED, c.reason);
    return code;
}

static imp_code begin(imp_query *query, double start, imp_error *error)
{
    imp_code code = query_collect(query, start, error);
    if (query->candidates.complete && query->clearance != NULL)
        code = clearance_begin(query->clearance, &query->candidates, &query->stats, error);
    return code;
}

FP_APART static imp_code step(imp_query *query, uint64_t pairs, imp_error *error)
{
    if (query->failed)
        return error_set(error, IMP_ERROR_USAGE, "this query has ended with an error already");
    if (query->verdict != IMP_VERDICT_UNDECIDED || query->reason == IMP_REASON_NONE)
        return IMP_SUCCESS;
    const double start = clock_seconds(), before = query->stats.seconds;
    query->step_from[0] = before, query->step_from[1] = start;
    const uint64_t done = query->stats.pairs;
    const uint64_t until = pairs == 0 || pairs > UINT64_MAX - done ? UINT64_MAX : done + pairs;
    imp_code code = IMP_SUCCESS;
    query->reason = IMP_REASON_RUNNING;
    if (!query->candidates.complete) code = begin(query, start, error);
    const uint64_t of_candidates = candidates_bytes(&query->candidates);
    const unsigned look_after = units_per_reading(query);
    for (unsigned k = 0; code == IMP_SUCCESS && query->reason == IMP_REASON_RUNNING; ++k) {
        if (k % look_after == 0 || query->watch_ended) tick(query, before, start);
        query->watch_ended = false;
        note_bytes(query, of_candidates);
        const imp_reason reason = exhausted(query, query->stats.seconds);
        if (reason != IMP_REASON_NONE)
            query_finish(query, IMP_VERDICT_UNDECIDED, reason);
        else if (query->stats.pairs >= until)
            break;
        else
            code = work(query, error);
    }
    query->stats.seconds = before + (clock_seconds() - start);
    note_bytes(query, of_candidates);
    if (code == IMP_ERROR_MEMORY) {
        query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_MEMORY);
        return IMP_SUCCESS;
    }
    query->failed = code != IMP_SUCCESS;
    return code;
}

imp_code imp_query_step(imp_query *query, uint64_t pairs, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_step");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = step(query, pairs, error);
    fp_environment_leave(&environment);
    return code;
}

/* --- Refinement ------------------------------------------------------------------------------- */

FP_APART static imp_code refine(imp_query *query, double gamma, double gamma_clear,
                                imp_error *error)
{
    if (query->clearance != NULL)
        return error_set(error, IMP_ERROR_USAGE, "refine: this query asks for a minimum distance");
    if (query->proof != NULL)
        return error_set(error, IMP_ERROR_USAGE, "refine: this query keeps a proof");
    const imp_code code = tolerances_check(gamma, gamma_clear, NULL, error);
    if (code != IMP_SUCCESS) return code;
    gamma_clear = tolerances_clear(gamma, gamma_clear);
    if (gamma > query->impact.gamma || gamma_clear > query->gamma_clear)
        return error_set(
            error, IMP_ERROR_USAGE,
            "refine: gamma %g and gamma_clear %g may not exceed those in force, %g and %g", gamma,
            gamma_clear, query->impact.gamma, query->gamma_clear);
    if (!impact_refine(&query->impact, gamma, searched_gamma_clear(query, gamma_clear),
                       query->candidates.pair_count))
        return error_set_memory(error);
    query->gamma_clear = gamma_clear;
    query_forget_insides(query);
    if (query->verdict == IMP_VERDICT_CONTACT)
        query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_RUNNING);
    return IMP_SUCCESS;
}

imp_code imp_query_refine(imp_query *query, double gamma, double gamma_clear, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_refine");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = refine(query, gamma, gamma_clear, error);
    fp_environment_leave(&environment);
    return code;
}

/* --- Exclusion of two bodies ------------------------------------------------------------------ */

imp_code imp_query_exclude_pair(imp_query *query, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_exclude_pair");
    const bool found =
        query->verdict == IMP_VERDICT_CONTACT || query->reason == IMP_REASON_RESOLUTION;
    if (!found || query->clearance != NULL)
        return error_set(error, IMP_ERROR_USAGE,
                         "pass: this query has found no contact, and nothing that is unresolved");
    if (query->proof != NULL)
        return error_set(error, IMP_ERROR_USAGE, "pass: this query keeps a proof");
    if (!impact_pass(&query->impact, query->candidates.pair_count)) return error_set_memory(error);
    query_forget_insides(query);
    query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_RUNNING);
    return IMP_SUCCESS;
}
