/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/active_callback.h"
#include "core/common/clock.h"
#include "core/solver/pair_step.h"
#include "core/solver/query_internal.h"

/* The limits of a query, and the progress that it reports. */

void query_note_bytes(imp_query *query, uint64_t of_candidates)
{
    uint64_t bytes = query->scene_bytes + query->stats.bytes + sizeof *query +
                     query->impact.heap.capacity * PAIR_HEAP_BYTES + of_candidates;
    if (query->proof != NULL)
        bytes += (query->proof->contact.capacity + query->proof->distance.capacity) *
                 sizeof(proof_record);
    if (query->clearance != NULL) bytes += clearance_look(query->clearance).bytes;
    if (bytes > query->peak_bytes) query->peak_bytes = bytes;
}

imp_reason query_exhausted_limit(imp_query *query, double seconds)
{
    const imp_options *options = &query->options;
    if (atomic_load_explicit(&query->cancelled, memory_order_relaxed) &&
        atomic_exchange(&query->cancelled, false))
        return IMP_REASON_CANCELLED;
    if (pairs_are_spent(&query->stats, options->max_pairs)) return IMP_REASON_PAIRS;
    if (options->max_seconds > 0 && seconds >= options->max_seconds) return IMP_REASON_SECONDS;
    if (options->max_bytes > 0 && query->peak_bytes > options->max_bytes) return IMP_REASON_MEMORY;
    return IMP_REASON_NONE;
}

double query_limit_callbacks(const imp_query *query, double start)
{
    const double most = query->options.max_seconds;
    return active_callback_limit(most > 0 ? start + (most - query->stats.seconds) : 0);
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

void query_read_clock(imp_query *query, double seconds_before, double start)
{
    query->stats.seconds = seconds_before + (clock_seconds() - start);
    report(query, query->stats.seconds);
}
