/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/impinge.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "couples.h"
#include "status.h"

struct imp_query {
    imp_scene *scene;
    imp_options options;
    impact impact;
    couple_list couples;
    size_t coupled; /* how many couples have been tested */
    uint64_t peak_bytes;
    bool begun, failed;
    imp_verdict verdict;
    imp_reason reason;
    atomic_bool cancelled;
};

/* --- Life ------------------------------------------------------------------------- */

/* gamma > 0 and 0 <= clearance < gamma, clearance < 0 standing for gamma / 2. */
static imp_code tolerances(double gamma, double clearance, impact *im, imp_error *error)
{
    if (!(gamma > 0 && gamma < INFINITY))
        return error_set(error, IMP_ERROR_USAGE, "gamma: found %g, allowed > 0 and finite", gamma);
    if (clearance < 0) clearance = 0.5 * gamma;
    if (!(clearance < gamma))
        return error_set(error, IMP_ERROR_USAGE,
                         "clearance: found %g, allowed from 0 to below gamma = %g", clearance,
                         gamma);
    im->gamma = gamma;
    im->clearance = clearance;
    return IMP_SUCCESS;
}

static imp_code check_choice(const char *name, int found, int last, imp_error *error)
{
    if (found >= 0 && found <= last) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_USAGE, "%s: found %d, allowed from 0 to %d", name, found,
                     last);
}

/* All but the tolerances. */
static imp_code check_options(const imp_options *options, imp_error *error)
{
    if (!(options->t_start <= options->t_end && options->t_start > -INFINITY &&
          options->t_end < INFINITY))
        return error_set(error, IMP_ERROR_USAGE,
                         "time: found [%g, %g], allowed finite and not empty", options->t_start,
                         options->t_end);
    if (!(options->max_seconds >= 0))
        return error_set(error, IMP_ERROR_USAGE, "max_seconds: found %g, allowed >= 0",
                         options->max_seconds);
    imp_code code = check_choice("method", (int)options->method, IMP_METHOD_PAPER, error);
    if (code == IMP_SUCCESS)
        code = check_choice("bounds", (int)options->bounds, IMP_BOUNDS_SPHERE, error);
    if (code == IMP_SUCCESS)
        code = check_choice("rates", (int)options->rates, IMP_RATES_CONSTANT, error);
    return code;
}

imp_query *imp_query_new(imp_scene *scene, const imp_options *options, imp_error *error)
{
    impact im = {.method = options->method, .bounds = options->bounds, .t_lower = options->t_start};
    if (tolerances(options->gamma, options->clearance, &im, error) != IMP_SUCCESS) return NULL;
    if (check_options(options, error) != IMP_SUCCESS) return NULL;
    imp_query *query = calloc(1, sizeof *query);
    if (query == NULL) {
        error_set_memory(error);
        return NULL;
    }
    query->scene = scene;
    query->options = *options;
    query->impact = im;
    query->verdict = IMP_UNDECIDED;
    query->reason = IMP_REASON_RUNNING;
    atomic_init(&query->cancelled, false);
    return query;
}

void imp_query_free(imp_query *query)
{
    if (query == NULL) return;
    impact_clear(&query->impact);
    couples_clear(&query->couples);
    free(query);
}

void imp_query_cancel(imp_query *query) { atomic_store(&query->cancelled, true); }

/* --- Running ------------------------------------------------------------------------------- */

static void finish(imp_query *query, imp_verdict verdict, imp_reason reason)
{
    query->verdict = verdict;
    query->reason = reason;
    if (verdict == IMP_CLEAR) query->impact.t_lower = query->options.t_end;
}

static void conclude(imp_query *query, impact_state state)
{
    switch (state) {
    case IMPACT_RUNNING:
        break;
    case IMPACT_CONTACT:
        finish(query, IMP_CONTACT, IMP_REASON_NONE);
        break;
    case IMPACT_CLEAR:
        finish(query, IMP_CLEAR,
               query->impact.stats.pairs == 0
                   ? couples_reason_of_none(query->scene, &query->options)
                   : IMP_REASON_NONE);
        break;
    case IMPACT_RESOLUTION:
        finish(query, IMP_UNDECIDED, IMP_REASON_RESOLUTION);
        break;
    case IMPACT_NO_MEMORY:
        finish(query, IMP_UNDECIDED, IMP_REASON_MEMORY);
        break;
    }
}

static imp_code begin(imp_query *query, imp_error *error)
{
    const imp_code code = couples_find(&query->couples, query->scene, &query->options,
                                       query->impact.clearance, &query->impact.stats, error);
    query->impact.couples = query->couples.couples;
    query->begun = code == IMP_SUCCESS;
    return code;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void note_bytes(imp_query *query)
{
    const uint64_t bytes = query->impact.stats.bytes + sizeof *query +
                           query->impact.heap.capacity * sizeof(pair) +
                           query->couples.capacity * sizeof(couple);
    if (bytes > query->peak_bytes) query->peak_bytes = bytes;
}

/* The budget that is used up, or IMP_REASON_NONE. */
static imp_reason exhausted(const imp_query *query, double seconds)
{
    const imp_options *options = &query->options;
    if (atomic_load_explicit(&query->cancelled, memory_order_relaxed)) return IMP_REASON_CANCELLED;
    if (options->max_pairs > 0 && query->impact.stats.pairs >= options->max_pairs)
        return IMP_REASON_PAIRS;
    if (options->max_seconds > 0 && seconds >= options->max_seconds) return IMP_REASON_SECONDS;
    if (options->max_bytes > 0 && query->peak_bytes > options->max_bytes) return IMP_REASON_MEMORY;
    return IMP_REASON_NONE;
}

/* One unit of work: a couple's roots, as long as there are any left, then pairs from the heap. */
static imp_code work(imp_query *query, imp_error *error)
{
    impact_state state = IMPACT_RUNNING;
    imp_code code = IMP_SUCCESS;
    if (query->coupled < query->couples.count) {
        code = impact_add_couple(&query->impact, (uint32_t)query->coupled, &state, error);
        if (state == IMPACT_RUNNING) query->coupled += 1;
    } else {
        code = impact_advance(&query->impact, &state, error);
    }
    if (code == IMP_SUCCESS) conclude(query, state);
    return code;
}

enum { CLOCK_EVERY = 64 }; /* units of work between looks at the clock */

imp_code imp_query_step(imp_query *query, uint64_t pairs, imp_error *error)
{
    if (query->failed)
        return error_set(error, IMP_ERROR_USAGE, "this query has ended with an error already");
    if (query->verdict != IMP_UNDECIDED) return IMP_SUCCESS;
    const double start = now(), before = query->impact.stats.seconds;
    const uint64_t until = pairs == 0 ? UINT64_MAX : query->impact.stats.pairs + pairs;
    imp_code code = IMP_SUCCESS;
    query->reason = IMP_REASON_RUNNING;
    if (!query->begun) code = begin(query, error);
    for (unsigned tick = 0; code == IMP_SUCCESS && query->reason == IMP_REASON_RUNNING; ++tick) {
        if (tick % CLOCK_EVERY == 0) query->impact.stats.seconds = before + (now() - start);
        note_bytes(query);
        const imp_reason reason = exhausted(query, query->impact.stats.seconds);
        if (reason != IMP_REASON_NONE)
            finish(query, IMP_UNDECIDED, reason);
        else if (query->impact.stats.pairs >= until)
            break;
        else
            code = work(query, error);
    }
    query->impact.stats.seconds = before + (now() - start);
    note_bytes(query);
    atomic_store(&query->cancelled, false);
    if (code == IMP_ERROR_MEMORY) {
        finish(query, IMP_UNDECIDED, IMP_REASON_MEMORY);
        return IMP_SUCCESS;
    }
    query->failed = code != IMP_SUCCESS;
    return code;
}

/* --- Answers ------------------------------------------------------------------------------ */

static imp_side side_of(const imp_query *query, int side)
{
    const couple *both = &query->couples.couples[query->impact.found_couple];
    const witness *w = &query->impact.found;
    imp_side s = {both->body[side], both->surface[side], w->u[side], w->v[side], {0, 0, 0}};
    memcpy(s.point, w->point[side].x, sizeof s.point);
    return s;
}

imp_result imp_query_result(const imp_query *query)
{
    const impact *im = &query->impact;
    imp_result r = {.verdict = query->verdict,
                    .reason = query->reason,
                    .t = NAN,
                    .t_lower = im->t_lower,
                    .gap = NAN,
                    .gamma = im->gamma,
                    .gamma_clear = im->clearance,
                    .stats = im->stats};
    r.stats.bytes = query->peak_bytes;
    if (r.verdict != IMP_CONTACT) return r;
    r.t = im->t_lower;
    r.gap = im->found.gap;
    r.a = side_of(query, 0);
    r.b = side_of(query, 1);
    r.has_normal = im->found.has_normal;
    memcpy(r.normal, im->found.normal.x, sizeof r.normal);
    return r;
}

/* Lemma. Everything pruned so far is farther apart than the old clearance, and windows were cut by
 * it; for a smaller one both still hold. So the heap and t_lower carry over. */
imp_code imp_query_refine(imp_query *query, double gamma, double clearance, imp_error *error)
{
    impact finer = {0};
    if (tolerances(gamma, clearance, &finer, error) != IMP_SUCCESS) return IMP_ERROR_USAGE;
    if (finer.gamma > query->impact.gamma || finer.clearance > query->impact.clearance)
        return error_set(
            error, IMP_ERROR_USAGE,
            "refine: gamma %g and clearance %g may not exceed those in force, %g and %g",
            finer.gamma, finer.clearance, query->impact.gamma, query->impact.clearance);
    query->impact.gamma = finer.gamma;
    query->impact.clearance = finer.clearance;
    if (query->verdict == IMP_CONTACT) finish(query, IMP_UNDECIDED, IMP_REASON_RUNNING);
    return IMP_SUCCESS;
}

imp_code imp_solve(imp_scene *scene, const imp_options *options, imp_result *result,
                   imp_error *error)
{
    imp_error why;
    if (error == NULL) error = &why;
    imp_query *query = imp_query_new(scene, options, error);
    if (query == NULL) return error->code;
    const imp_code code = imp_query_step(query, 0, error);
    *result = imp_query_result(query);
    imp_query_free(query);
    return code;
}
