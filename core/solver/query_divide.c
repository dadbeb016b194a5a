/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/active_callback.h"
#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/solver/query_internal.h"

static size_t part_count(const imp_query *query)
{
    return query->parts != NULL ? query->parts->count : 0;
}

/* --- Dividing --------------------------------------------------------------------------------- */

/* Lists the parts. The list of candidates is in the order of the scene, so that those of two bodies
 * are neighbours. */
static imp_code find_parts(imp_query *query, imp_error *error)
{
    const candidate_list *list = &query->candidates;
    size_t count = 0;
    for (size_t k = 0; k < list->pair_count; ++k) count += candidate_pair_is_first(list->pairs, k);
    query_parts *parts = malloc(sizeof *parts + (count + 1) * sizeof parts->first[0]);
    if (parts == NULL) return error_set_memory(error);
    *parts = (query_parts){.count = 0};
    for (size_t k = 0; k < list->pair_count; ++k)
        if (candidate_pair_is_first(list->pairs, k)) parts->first[parts->count++] = k;
    parts->first[count] = list->pair_count;
    query->parts = parts;
    return IMP_SUCCESS;
}

/* Sets the result of the query itself, which covers the bodies that have no candidates. */
static imp_code conclude(imp_query *query, imp_error *error)
{
    static const candidate_list none = {.complete = true};
    imp_reason reason = IMP_REASON_RUNNING;
    imp_code code = IMP_SUCCESS;
    query->candidates_tested = query->candidates.pair_count;
    query_finish(query, IMP_VERDICT_CLEAR, query_reason_of_clear(query));
    if (query->clearance == NULL) return IMP_SUCCESS;
    code = clearance_begin(query->clearance, &none, &query->stats, error);
    while (code == IMP_SUCCESS && reason == IMP_REASON_RUNNING)
        code = clearance_work(query->clearance, &reason, error);
    return code;
}

FP_APART static imp_code divide(imp_query *query, imp_error *error)
{
    if (query->candidates.complete || query->failed)
        return error_set(error, IMP_ERROR_USAGE, "divide: this query has been stepped already");
    if (query->proof != NULL)
        return error_set(error, IMP_ERROR_USAGE, "divide: this query keeps a proof");
    if (query->clearance != NULL && clearance_is_each(query->clearance))
        return error_set(error, IMP_ERROR_USAGE,
                         "divide: got a clearance with `each`, must be one without: its parts are "
                         "of two bodies each");
    query->divided = clock_seconds();
    const double limit_before = query_limit_callbacks(query, query->divided);
    imp_code code = query_collect(query, query->divided, error);
    active_callback_limit(limit_before);
    if (code == IMP_SUCCESS && query->candidates.complete) {
        code = find_parts(query, error);
        if (code == IMP_SUCCESS) code = conclude(query, error);
    }
    if (query->parts == NULL) query->divided = 0;
    query->stats.seconds += query->parts == NULL ? 0 : clock_seconds() - query->divided;
    query->failed = code != IMP_SUCCESS;
    return code;
}

imp_code imp_query_divide(imp_query *query, size_t *count, imp_error *error)
{
    if (query == NULL || count == NULL) return error_set_missing(error, "imp_query_divide");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = divide(query, error);
    fp_environment_leave(&environment);
    *count = code == IMP_SUCCESS ? part_count(query) : 0;
    return code;
}

/* --- Parts ------------------------------------------------------------------------------------ */

bool imp_query_part_bodies(const imp_query *query, size_t index, size_t body[2])
{
    if (query == NULL || body == NULL || index >= part_count(query)) return false;
    const candidate_pair *first = &query->candidates.pairs[query->parts->first[index]];
    for (int side = 0; side < 2; ++side) body[side] = first->side[side]->body;
    return true;
}

/* Makes a query with the options of the divided one, in its initial state. */
static imp_query *fresh_query(const imp_query *whole, imp_error *error)
{
    imp_query *query = arena_store_zeroed(scene_store(whole->scene), sizeof *query);
    if (query == NULL) {
        error_set_memory(error);
        return NULL;
    }
    query->scene = whole->scene;
    scene_begin_use(query->scene);
    query->options = whole->options;
    query->gamma_clear = whole->gamma_clear;
    query->options.parallel = NULL;
    query->examined = whole->examined;
    query->verdict = IMP_VERDICT_UNDECIDED;
    query->reason = IMP_REASON_RUNNING;
    query->impact = (impact){.gamma = whole->impact.gamma,
                             .window = whole->impact.window,
                             .baseline = whole->impact.baseline,
                             .max_pairs = whole->impact.max_pairs,
                             .spread = whole->impact.spread,
                             .stats = &query->stats,
                             .apart_until = INFINITY,
                             .t_lower = whole->options.t_start};
    atomic_init(&query->cancelled, false);
    query_begin_watch(query);
    return query;
}

/* Returns the time left: max_seconds limits all parts together. It is never 0, which would mean no
 * limit. */
static double seconds_left(const imp_query *whole)
{
    const double left = whole->options.max_seconds - (clock_seconds() - whole->divided);
    return left > 0 ? left : 0x1p-1000;
}

FP_APART static imp_query *part_of(const imp_query *whole, size_t index, imp_error *error)
{
    size_t body[2];
    if (!imp_query_part_bodies(whole, index, body)) {
        error_set(error, IMP_ERROR_USAGE, "part: got %zu, must be below the number of parts, %zu",
                  index, whole != NULL ? part_count(whole) : 0);
        return NULL;
    }
    imp_query *query = fresh_query(whole, error);
    if (query == NULL) return NULL;
    if (query->options.max_seconds > 0) query->options.max_seconds = seconds_left(whole);
    imp_code code = query_collect_part(query, whole, index, error);
    if (code == IMP_SUCCESS && whole->clearance != NULL)
        code = clearance_part(whole->clearance, body, &query->watch, &query->clearance, error);
    if (code == IMP_SUCCESS && query->clearance != NULL)
        code = clearance_begin(query->clearance, &query->candidates, &query->stats, error);
    if (code == IMP_SUCCESS) return query;
    imp_query_free(query);
    return NULL;
}

imp_query *imp_query_part(const imp_query *whole, size_t index, imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    imp_query *query = part_of(whole, index, error);
    fp_environment_leave(&environment);
    return query;
}
