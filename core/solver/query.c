/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/query_internal.h"

#include <inttypes.h>
#include <stdlib.h>

#include "core/base/active_callback.h"
#include "core/base/fp_mode.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/scene/tolerances.h"

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
    const double start = clock_seconds();
    double until = options->max_seconds > 0 ? start + options->max_seconds : INFINITY;
    const limit_watch watch = examined_times_until(&until);
    if (examined_times_find(scene, options->t_start, options->t_end, &watch, &examined, error) !=
        IMP_SUCCESS)
        return NULL;
    arena_store *store = scene_store(scene);
    imp_query *query = arena_store_room(store, sizeof *query);
    if (query == NULL) {
        error_set_memory(error);
        return NULL;
    }
    *query = (imp_query){.scene = scene,
                         .scene_bytes = scene_bytes(scene),
                         .options = *options,
                         .gamma_clear = gamma_clear,
                         .examined = examined,
                         .stats = {.seconds = clock_seconds() - start},
                         .impact = {.gamma = options->gamma,
                                    .gamma_clear = gamma_clear,
                                    .baseline = options->baseline,
                                    .max_pairs = options->max_pairs,
                                    .t_lower = options->t_start,
                                    .apart_until = INFINITY,
                                    .window = {options->t_start, options->t_end},
                                    .stats = &query->stats,
                                    .heap = {.store = store}},
                         .candidates = {.store = store},
                         .seam = INFINITY,
                         .verdict = IMP_VERDICT_UNDECIDED,
                         .reason = IMP_REASON_RUNNING};
    scene_begin_use(scene);
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
    imp_scene *scene = query->scene;
    arena_store_free_room(scene_store(scene), query);
    scene_end_use(scene);
}

void imp_query_cancel(imp_query *query)
{
    if (query != NULL) atomic_store(&query->cancelled, true);
}

void query_limit_seams(imp_query *query, double seam) { query->seam = seam; }

void query_use_spread(imp_query *query, const query_spread *spread)
{
    query->impact.spread = spread;
}

/* --- Running ---------------------------------------------------------------------------------- */

void query_finish(imp_query *query, imp_verdict verdict, imp_reason reason)
{
    query->verdict = verdict;
    query->reason = reason;
    if (verdict == IMP_VERDICT_CLEAR) query->impact.t_lower = query->options.t_end;
}

static imp_code work(imp_query *query, imp_error *error)
{
    return query->clearance == NULL ? query_search_contact(query, error)
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
    const double limit_before = query_limit_callbacks(query, start);
    if (!query->candidates.complete) code = begin(query, start, error);
    const unsigned look_after = units_per_reading(query);
    for (unsigned k = 0; code == IMP_SUCCESS && query->reason == IMP_REASON_RUNNING; ++k) {
        if (k % look_after == 0 || query->watch_ended) query_read_clock(query, before, start);
        query->watch_ended = false;
        query_note_bytes(query, candidates_bytes(&query->candidates));
        const imp_reason reason = query_exhausted_limit(query, query->stats.seconds);
        if (reason != IMP_REASON_NONE)
            query_finish(query, IMP_VERDICT_UNDECIDED, reason);
        else if (query->stats.pairs >= until)
            break;
        else
            code = work(query, error);
    }
    active_callback_limit(limit_before);
    query->stats.seconds = before + (clock_seconds() - start);
    query_note_bytes(query, candidates_bytes(&query->candidates));
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
