/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/columns.h"

#include <math.h>
#include <string.h>
#include <time.h>

/* --- One scene -------------------------------------------------------------------------------- */

double bench_seconds_computed(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

imp_scene *bench_scene_of(imp_registry *registry, const bench_scene *s, imp_error *error)
{
    if (s->b != NULL) return imp_scene_from_pair(registry, s->a, s->b, error);
    if (s->is_path) return imp_scene_from_file(registry, s->a, error);
    return imp_scene_from_json(registry, s->a, strlen(s->a), "a scene of the benchmark", error);
}

uint64_t bench_budget(const bench_method *m, const bench_request *request)
{
    const uint64_t most = m->pairs_most;
    if (!m->capped) return 0;
    return most > 0 && (request->max_pairs == 0 || most < request->max_pairs) ? most
                                                                              : request->max_pairs;
}

static imp_options options_of(const imp_scene *scene, const bench_case *c, const bench_method *m,
                              const bench_request *request)
{
    imp_options o = imp_options_default(scene);
    o.gamma = c->gamma;
    o.gamma_clear = c->gamma_clear;
    o.baseline = m->baseline;
    o.max_bytes = 0; /* memory is measured, not limited */
    if (m->capped) o.max_pairs = bench_budget(m, request);
    return o;
}

/* Answers `query`, and frees it; *seconds is the search alone. After an error
 * the result is zero. */
static imp_code run(imp_query *query, imp_result *result, double *seconds, imp_error *error)
{
    *result = (imp_result){0};
    *seconds = 0;
    if (query == NULL) return error->code;
    const double start = bench_seconds_computed();
    const imp_code code = imp_query_step(query, 0, error);
    *seconds = bench_seconds_computed() - start;
    if (code == IMP_SUCCESS) *result = imp_query_result(query);
    imp_query_free(query);
    return code;
}

/* Answers a scene with parameters for all values; the counts are those of all its boxes. */
static imp_code run_survey(imp_scene *scene, const imp_options *options, imp_result *result,
                           double *seconds, imp_error *error)
{
    imp_survey *survey = imp_survey_new(scene, options, NULL, NULL, error);
    if (survey == NULL) return error->code;
    const double start = bench_seconds_computed();
    imp_code code = imp_survey_step(survey, 0, error);
    *seconds = bench_seconds_computed() - start;
    *result = (imp_result){.struct_size = (uint32_t)sizeof *result};
    if (code == IMP_SUCCESS) code = imp_survey_get_result(survey, result, error);
    imp_survey_free(survey);
    return code;
}

imp_verdict bench_verdict_of(const imp_clearance *answer, double gamma)
{
    if (answer->verdict == IMP_REQUIREMENT_HOLDS) return IMP_VERDICT_CLEAR;
    if (answer->verdict == IMP_REQUIREMENT_VIOLATED) return IMP_VERDICT_CONTACT;
    if (answer->reason != IMP_REASON_NONE) return IMP_VERDICT_UNDECIDED;
    return answer->upper > gamma ? IMP_VERDICT_CLEAR : IMP_VERDICT_CONTACT;
}

/* The minimum distance, or, if something is required, whether it is kept; as the result of a
 * search that is clear or not. */
static imp_code run_clearance(imp_scene *scene, const imp_options *options, double required,
                              imp_clearance *least, imp_result *result, double *seconds,
                              imp_error *error)
{
    imp_clearance_options asked = imp_clearance_options_default();
    asked.required = required;
    asked.decide = true;
    imp_query *query = imp_clearance_new(scene, options, &asked, error);
    if (query == NULL) return error->code;
    const double start = bench_seconds_computed();
    imp_code code = imp_query_step(query, 0, error);
    *seconds = bench_seconds_computed() - start;
    *least = (imp_clearance){.struct_size = (uint32_t)sizeof *least};
    if (code == IMP_SUCCESS) code = imp_clearance_get(query, 0, least, error);
    if (code == IMP_SUCCESS) {
        *result = imp_query_result(query);
        result->verdict = bench_verdict_of(least, options->gamma);
    }
    imp_query_free(query);
    return code;
}

/* Ends the interval at c->cut of the time until the first contact, if there is one. */
static imp_code cut_interval(imp_registry *registry, const bench_scene *s, const bench_case *c,
                             imp_options *options, imp_error *error)
{
    if (!(c->cut > 0)) return IMP_SUCCESS;
    imp_scene *scene = bench_scene_of(registry, s, error);
    if (scene == NULL) return error->code;
    imp_result first;
    double seconds;
    const imp_code code = run(imp_query_new(scene, options, error), &first, &seconds, error);
    imp_scene_free(scene);
    if (code == IMP_SUCCESS && first.verdict == IMP_VERDICT_CONTACT)
        options->t_end = options->t_start + c->cut * (first.t - options->t_start);
    return code;
}

/* The minimum distance, sought in a copy of the scene; 0: nothing comes near anything. */
static imp_code find_least(imp_registry *registry, const bench_scene *s, const imp_options *options,
                           double *distance, imp_error *error)
{
    imp_scene *scene = bench_scene_of(registry, s, error);
    if (scene == NULL) return error->code;
    imp_clearance least;
    imp_result result;
    double seconds;
    const imp_code code = run_clearance(scene, options, 0, &least, &result, &seconds, error);
    imp_scene_free(scene);
    *distance = code == IMP_SUCCESS && least.upper < INFINITY ? least.upper : 0;
    return code;
}

/* Answers the scene, made afresh so that no tree is there yet; *seconds is the search alone. */
static imp_code solve_once(imp_registry *registry, const bench_scene *s, const bench_case *c,
                           const bench_method *m, const bench_request *request, imp_result *result,
                           double *seconds, imp_error *error)
{
    imp_scene *scene = bench_scene_of(registry, s, error);
    if (scene == NULL) return error->code;
    imp_options options = options_of(scene, c, m, request);
    imp_clearance answer;
    double least = 0;
    if (imp_scene_parameter_count(scene) > 0) {
        const imp_code surveyed = run_survey(scene, &options, result, seconds, error);
        imp_scene_free(scene);
        return surveyed;
    }
    imp_code code = cut_interval(registry, s, c, &options, error);
    if (code == IMP_SUCCESS && (m->question == BENCH_DECISION || m->question == BENCH_PROOF))
        code = find_least(registry, s, &options, &least, error);
    if (m->question == BENCH_PROOF && least > 0)
        options.gamma = 0.995 * least, options.gamma_clear = 0.99 * least;
    const double required = c->required > 0 ? c->required : 0.99 * least;
    const bool is_distance = m->question == BENCH_CLEARANCE || m->question == BENCH_DECISION;
    if (code == IMP_SUCCESS)
        code = is_distance || c->required > 0
                   ? run_clearance(scene, &options, required, &answer, result, seconds, error)
                   : run(imp_query_new(scene, &options, error), result, seconds, error);
    imp_scene_free(scene);
    return code;
}

/* --- One case --------------------------------------------------------------------------------- */

/* Timed `repeats` times, unless once takes long enough to be told exactly. */
static imp_code solve(imp_registry *registry, const bench_scene *s, const bench_case *c,
                      const bench_method *m, const bench_request *request, imp_result *result,
                      double *seconds, imp_error *error)
{
    const double long_enough = 0.02;
    enum { REPEATS_MAX = 101 };
    double times[REPEATS_MAX];
    size_t count = 0;
    imp_code code = IMP_SUCCESS;
    do {
        code = solve_once(registry, s, c, m, request, result, &times[count++], error);
    } while (code == IMP_SUCCESS && times[count - 1] < long_enough && count < request->repeats &&
             count < REPEATS_MAX);
    *seconds = columns_median(times, count);
    return code;
}

/* fmin and fmax pass over a NaN, which is what these are while there is none. */
static void compare(const bench_scene *s, const imp_result *r, bench_tally *tally)
{
    if (!s->has_reference) return;
    const double late = r->t_lower - s->t;
    tally->references += 1;
    tally->agreed += r->verdict == (s->meets ? IMP_VERDICT_CONTACT : IMP_VERDICT_CLEAR);
    if (!s->meets) return;
    tally->latest = fmax(tally->latest, late);
    if (r->verdict == IMP_VERDICT_CONTACT) tally->earliest = fmin(tally->earliest, late);
}

static imp_code fill(imp_registry *registry, const bench_case *c, const bench_method *m,
                     const bench_request *request, columns *x, bench_tally *tally, imp_error *error)
{
    for (size_t k = 0; k < c->count; ++k) {
        imp_result result = {.struct_size = 0};
        double seconds;
        const imp_code code =
            solve(registry, &c->scenes[k], c, m, request, &result, &seconds, error);
        if (code != IMP_SUCCESS) return code;
        columns_add(x, &result.stats, seconds);
        tally->verdicts[result.verdict] += 1;
        tally->ended +=
            result.verdict == IMP_VERDICT_UNDECIDED && result.reason == IMP_REASON_PAIRS;
        if (!(c->cut > 0)) compare(&c->scenes[k], &result, tally);
    }
    return IMP_SUCCESS;
}

imp_code bench_measure(imp_registry *registry, const bench_case *c, const bench_method *m,
                       const bench_request *request, bench_tally *tally, imp_error *error)
{
    if (m->question == BENCH_STREAM)
        return bench_measure_stream(registry, c, m, request, tally, error);
    if (m->question == BENCH_CHANGES)
        return bench_measure_changes(registry, c, m, request, tally, error);
    if (m->question == BENCH_CERTIFICATE)
        return bench_measure_certificates(registry, c, request, tally, error);
    *tally = (bench_tally){.scenes = c->count, .earliest = NAN, .latest = NAN};
    columns x;
    *error = (imp_error){.code = IMP_ERROR_MEMORY};
    imp_code code = IMP_ERROR_MEMORY;
    if (columns_make(&x, c->count)) code = fill(registry, c, m, request, &x, tally, error);
    if (code == IMP_SUCCESS) columns_tally(&x, tally);
    columns_free(&x);
    return code;
}

bench_goal bench_goal_of(const bench_result *result, size_t row)
{
    const bench_case *c = result->about;
    const bench_tally *t = &result->rows[row].tally;
    const uint64_t goal = c->goal[row], budget = result->budget[row];
    if (goal == 0 || (budget > 0 && budget < goal)) return BENCH_GOAL_NONE;
    const bool reached = t->agreed == t->scenes && t->pairs.max <= (double)goal;
    if (c->goal_is_open[row]) return reached ? BENCH_GOAL_REACHED_NOW : BENCH_GOAL_OPEN;
    return reached ? BENCH_GOAL_REACHED : BENCH_GOAL_MISSED;
}
