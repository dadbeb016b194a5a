/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/scene/posed_scene.h"
#include "core/survey/survey_proof.h"

/* Ignores, in the query about all other pairs, the pairs of bodies that parameters move: each has
 * boxes of its own. */
static imp_code ignore_moved(const imp_survey *s, imp_scene *scene)
{
    imp_code code = scene_copy_relations(s->scene, scene);
    for (size_t k = 0; k < s->pairs.count && code == IMP_SUCCESS; ++k) {
        const size_t *body = s->pairs.at[k].body;
        if (!box_is_unmoved(&s->pairs.at[k]))
            code = scene_ignore_members(scene, (scene_members){false, body[0]},
                                        (scene_members){false, body[1]});
    }
    return code;
}

imp_code box_scene(imp_survey *s, const survey_box *box, imp_scene **made, imp_error *error)
{
    const survey_pair *pair = &s->pairs.at[box->pair];
    const size_t count = scene_body_count(s->scene);
    size_t *all = NULL;
    imp_code code;
    if (!box_is_unmoved(pair)) {
        code = posed_scene_of_bodies(s->scene, s->box.middle, pair->body, 2, pair->swept, made);
        return code == IMP_SUCCESS ? code : error_set_memory(error);
    }
    all = malloc((count + 1) * sizeof *all);
    if (all == NULL) return error_set_memory(error);
    for (size_t b = 0; b < count; ++b) all[b] = b;
    code = posed_scene_of_bodies(s->scene, s->box.middle, all, count, SIZE_MAX, made);
    free(all);
    if (code == IMP_SUCCESS && ignore_moved(s, *made) != IMP_SUCCESS) {
        imp_scene_free(*made);
        code = IMP_ERROR_MEMORY;
    }
    return code == IMP_SUCCESS ? code : error_set_memory(error);
}

double survey_seconds(const imp_survey *s)
{
    return s->clock.step_from[0] + (clock_seconds() - s->clock.step_from[1]);
}

#define PROGRESS_EVERY 0.1 /* seconds between reports */

/* Adds the survey's own counts to those of a query. */
static bool report(void *context, const imp_progress *of_query)
{
    imp_survey *s = context;
    const survey_box *first = box_queue_first(&s->queue);
    imp_progress all = *of_query;
    if (atomic_load(&s->cancelled)) return false;
    all.pairs += s->counts.stats.pairs;
    all.heap += s->queue.count;
    all.seconds = survey_seconds(s);
    if (s->question.is_distance) {
        all.lower =
            first != NULL && first->key < s->counts.settled ? first->key : s->counts.settled;
        all.upper = s->best.distance;
    } else {
        all.t_lower = first != NULL && first->key < s->box.key ? first->key : s->box.key;
    }
    if (s->question.options.progress == NULL || all.seconds < s->clock.next_report) return true;
    s->clock.next_report = all.seconds + PROGRESS_EVERY;
    return s->question.options.progress(s->question.options.progress_context, &all);
}

/* The pairs that the survey's limit leaves; 0: no limit. */
static uint64_t pairs_left(const imp_survey *s)
{
    const uint64_t most = s->question.options.max_pairs;
    if (most == 0) return 0;
    return s->counts.stats.pairs < most ? most - s->counts.stats.pairs : 1;
}

void box_raise_limit(survey_box *box)
{
    if (box->limit < ROOMY_PAIRS_MOST) box->limit *= 2;
}

bool box_limits_first(const imp_survey *s, uint64_t pairs)
{
    const uint64_t left = pairs_left(s);
    return pairs > 0 && !(left > 0 && left <= pairs);
}

/* `pairs` is a limit of the query's own; 0: none. */
static imp_options options_of_query(imp_survey *s, double t_start, double t_end, uint64_t pairs)
{
    imp_options options = s->question.options;
    options.t_start = t_start;
    options.t_end = t_end;
    options.progress = report;
    options.progress_context = s;
    options.max_pairs = box_limits_first(s, pairs) ? pairs : pairs_left(s);
    if (options.max_seconds > 0) {
        options.max_seconds -= survey_seconds(s);
        if (!(options.max_seconds > 0)) options.max_seconds = 0x1p-1000;
    }
    return options;
}

static void add_stats(imp_survey *s, const imp_stats *of_query)
{
    const uint64_t own = s->queue.count * (sizeof(survey_box) + 2 * s->parameters * sizeof(double));
    s->counts.stats.pairs += of_query->pairs;
    s->counts.stats.nodes += of_query->nodes;
    s->counts.stats.witness_searches += of_query->witness_searches;
    if (of_query->peak_heap > s->counts.stats.peak_heap)
        s->counts.stats.peak_heap = of_query->peak_heap;
    if (of_query->bytes + own > s->counts.stats.bytes)
        s->counts.stats.bytes = of_query->bytes + own;
}

query_times box_times(const imp_survey *s, const survey_box *box)
{
    const size_t swept = s->pairs.at[box->pair].swept;
    const double t_end =
        s->best.t < s->question.options.t_end ? s->best.t : s->question.options.t_end;
    if (box_is_swept(&s->pairs.at[box->pair]))
        return (query_times){box->range[2 * swept], box->range[2 * swept + 1]};
    if (s->question.is_distance)
        return (query_times){s->question.options.t_start, s->question.options.t_end};
    return (query_times){box->key, t_end};
}

bool box_is_limit(imp_reason reason)
{
    return reason == IMP_REASON_PAIRS || reason == IMP_REASON_SECONDS ||
           reason == IMP_REASON_MEMORY || reason == IMP_REASON_CANCELLED;
}

bool box_must_end(imp_survey *s, imp_reason reason)
{
    if (!box_is_limit(reason)) return false;
    atomic_store(&s->cancelled, false);
    s->reason = reason;
    return true;
}

/* The seams that solids may have are those of the scene's tolerances, in every box. */
static double seam_of(const imp_survey *s)
{
    const double twice =
        2 * tolerances_clear(s->question.options.gamma, s->question.options.gamma_clear);
    return s->question.options.gamma < twice ? s->question.options.gamma : twice;
}

/* Has the query keep its proof, if that is wanted. */
static imp_code keep_proof(const imp_survey *s, const survey_box *proved, imp_query *query,
                           imp_error *error)
{
    return s->proof != NULL && proved != NULL ? imp_query_keep_proof(query, error) : IMP_SUCCESS;
}

static imp_code take_proof(imp_survey *s, const survey_box *proved, const imp_query *query,
                           query_times times, imp_error *error)
{
    return proved != NULL ? survey_proof_take(s, proved, query, times, error) : IMP_SUCCESS;
}

imp_code box_run_contact(imp_survey *s, const survey_box *proved, imp_scene *scene,
                         query_times times, const double gamma[2], uint64_t pairs,
                         const query_spread *spread, imp_result *result, imp_error *error)
{
    imp_options options = options_of_query(s, times.start, times.end, pairs);
    options.gamma = gamma[0];
    options.gamma_clear = gamma[1];
    *result = (imp_result){.struct_size = (uint32_t)sizeof *result};
    imp_query *query = imp_query_new(scene, &options, error);
    if (query == NULL) return error != NULL ? error->code : IMP_ERROR_USAGE;
    query_use_spread(query, spread);
    query_limit_seams(query, seam_of(s));
    imp_code code = keep_proof(s, proved, query, error);
    if (code == IMP_SUCCESS) code = imp_query_step(query, 0, error);
    if (code == IMP_SUCCESS) code = imp_query_get_result(query, result, error);
    if (code == IMP_SUCCESS) code = take_proof(s, proved, query, times, error);
    if (code == IMP_SUCCESS) add_stats(s, &result->stats);
    imp_query_free(query);
    return code;
}

imp_code box_run_roomy(imp_survey *s, const survey_box *box, imp_scene *scene,
                       const box_bounds *bounds, query_times times, const double coarse[2],
                       const double exact[2], imp_result *result, imp_error *error)
{
    query_spread spread;
    imp_code code = survey_spread_make(s, box, bounds, exact, &spread, error);
    if (code == IMP_SUCCESS)
        code = box_run_contact(s, box, scene, times, coarse, box->limit,
                               spread.is_known ? &spread : NULL, result, error);
    survey_spread_clear(&spread);
    return code;
}

imp_code box_run_distance(imp_survey *s, const survey_box *proved, imp_scene *scene,
                          query_times times, double within, double tolerance, imp_clearance *answer,
                          imp_error *error)
{
    const imp_options options = options_of_query(s, times.start, times.end, 0);
    const double required = s->question.clearance.required;
    imp_clearance_options asked = imp_clearance_options_default();
    if (required > 0 && required < options.gamma)
        asked.required = required; /* not to end at gamma */
    asked.within = within > 0 && within < asked.required ? asked.required : within;
    asked.tolerance = tolerance;
    *answer = (imp_clearance){.struct_size = (uint32_t)sizeof *answer};
    imp_query *query = imp_clearance_new(scene, &options, &asked, error);
    if (query == NULL) return error != NULL ? error->code : IMP_ERROR_USAGE;
    imp_code code = keep_proof(s, proved, query, error);
    if (code == IMP_SUCCESS) code = imp_query_step(query, 0, error);
    if (code == IMP_SUCCESS) code = imp_clearance_get(query, 0, answer, error);
    if (code == IMP_SUCCESS && !box_is_limit(answer->reason))
        code = take_proof(s, proved, query, times, error);
    if (code == IMP_SUCCESS) add_stats(s, &answer->stats);
    imp_query_free(query);
    return code;
}
