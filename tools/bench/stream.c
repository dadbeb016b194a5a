/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/columns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/clock.h"
#include "tools/cli/batch.h"
#include "tools/cli/ordered_pool.h"
#include "tools/cli/verbs.h"

/* Streams of scenes: what `impinge batch` costs beside solving alone, and what threads win. */

/* --- Runs ------------------------------------------------------------------------------------- */

/* One pass over the scenes of a case. */
typedef struct stream {
    imp_registry *registry;
    const bench_case *of;
    imp_result *results; /* of each scene; a batch's are read from its answers */
    batch batch;
    char **answers;
    size_t answered;
    double seconds, processor; /* of the clock; of all threads */
} stream;

static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Reads and solves one scene after the other. */
static imp_code solve_all(stream *s, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; code == IMP_SUCCESS && k < s->of->count; ++k) {
        const char *text = s->of->scenes[k].a;
        imp_scene *scene =
            imp_scene_from_json(s->registry, text, strlen(text), "a scene of the benchmark", error);
        if (scene == NULL) return error->code;
        const imp_options options = imp_options_default(scene);
        s->results[k].struct_size = sizeof s->results[k];
        code = imp_scene_solve(scene, &options, &s->results[k], error);
        imp_scene_free(scene);
    }
    return code;
}

static void work_on_line(void *context, void *of)
{
    const stream *s = context;
    batch_answer(&s->batch, of);
}

static bool keep_answer(void *context, void *of)
{
    stream *s = context;
    const batch_item *item = of;
    s->answers[s->answered++] = item->answer;
    return item->answer != NULL && !item->failed;
}

/* Answers all scenes as verb_batch.c does, without files. */
static imp_code answer_all(stream *s, size_t threads, imp_error *error)
{
    const arguments none = {.verb = verb_find("batch")};
    s->batch = (batch){.args = &none, .registry = s->registry, .name = "bench"};
    s->answered = 0;
    const ordered_pool_plan plan = {.threads = threads,
                                    .items = BATCH_ITEMS_PER_THREAD * threads,
                                    .item_size = sizeof(batch_item),
                                    .work = work_on_line,
                                    .finish = keep_answer,
                                    .context = s};
    ordered_pool *pool = ordered_pool_new(&plan);
    if (pool == NULL) return error->code = IMP_ERROR_MEMORY;
    batch_item *item;
    for (size_t k = 0; k < s->of->count && (item = ordered_pool_next(pool)) != NULL; ++k) {
        char *text = s->of->scenes[k].a;
        *item = (batch_item){.text = {.text = text, .length = strlen(text)}, .line = k + 1};
        ordered_pool_submit(pool);
    }
    ordered_pool_join(pool);
    ordered_pool_free(pool);
    return IMP_SUCCESS;
}

/* --- What was answered ------------------------------------------------------------------------ */

static uint64_t count_of(const json_t *stats, const char *key)
{
    return (uint64_t)json_integer_value(json_object_get(stats, key));
}

/* What the tally needs of one answer. An error is the library's. */
static imp_code read_answer(const char *text, imp_result *result, imp_error *error)
{
    json_t *answer = text != NULL ? json_loads(text, 0, NULL) : NULL;
    const char *verdict = json_string_value(json_object_get(answer, "verdict"));
    const char *why = json_string_value(json_object_get(answer, "error"));
    const json_t *stats = json_object_get(answer, "stats");
    *error = (imp_error){.code = verdict != NULL ? IMP_SUCCESS
                                 : why != NULL   ? IMP_ERROR_SCENE
                                                 : IMP_ERROR_MEMORY};
    snprintf(error->text, sizeof error->text, "%s", why != NULL ? why : "");
    if (verdict != NULL) {
        result->verdict = strcmp(verdict, "contact") == 0 ? IMP_VERDICT_CONTACT
                          : strcmp(verdict, "clear") == 0 ? IMP_VERDICT_CLEAR
                                                          : IMP_VERDICT_UNDECIDED;
        result->stats = (imp_stats){.pairs = count_of(stats, "pairs"),
                                    .nodes = count_of(stats, "nodes"),
                                    .peak_heap = count_of(stats, "peak_heap"),
                                    .witness_searches = count_of(stats, "witness_searches"),
                                    .bytes = count_of(stats, "bytes")};
    }
    json_decref(answer);
    return error->code;
}

/* Reads and frees the answers, in any case all. */
static imp_code read_answers(stream *s, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < s->answered; ++k) {
        if (code == IMP_SUCCESS) code = read_answer(s->answers[k], &s->results[k], error);
        free(s->answers[k]);
    }
    if (code == IMP_SUCCESS && s->answered < s->of->count) code = error->code = IMP_ERROR_MEMORY;
    return code;
}

/* --- One method ------------------------------------------------------------------------------- */

static imp_code run_once(stream *s, size_t threads, imp_error *error)
{
    const double start = clock_seconds(), processor = processor_seconds();
    imp_code code = threads == 0 ? solve_all(s, error) : answer_all(s, threads, error);
    s->seconds = clock_seconds() - start;
    s->processor = processor_seconds() - processor;
    if (code == IMP_SUCCESS && threads > 0) code = read_answers(s, error);
    return code;
}

/* All runs: their medians to `s`. */
static imp_code run_all(stream *s, size_t threads, size_t repeats, double *times, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < repeats && code == IMP_SUCCESS; ++k) {
        code = run_once(s, threads, error);
        times[k] = s->seconds;
        times[repeats + k] = s->processor;
    }
    if (code != IMP_SUCCESS) return code;
    s->seconds = columns_median(times, repeats);
    s->processor = columns_median(times + repeats, repeats);
    return code;
}

static void tally_all(const stream *s, columns *x, bench_tally *tally)
{
    const double scenes = (double)s->of->count;
    for (size_t k = 0; k < s->of->count; ++k) {
        columns_add(x, &s->results[k].stats, s->seconds / scenes);
        tally->verdicts[s->results[k].verdict] += 1;
    }
    tally->processor = s->processor / scenes;
    columns_tally(x, tally);
}

imp_code bench_measure_stream(imp_registry *registry, const bench_case *c, const bench_method *m,
                              const bench_request *request, bench_tally *tally, imp_error *error)
{
    enum { REPEATS_MAX = 101 };
    const size_t repeats = request->repeats < REPEATS_MAX ? request->repeats : REPEATS_MAX;
    stream s = {.registry = registry,
                .of = c,
                .results = calloc(c->count, sizeof *s.results),
                .answers = calloc(c->count, sizeof *s.answers)};
    double times[2 * REPEATS_MAX];
    columns x;
    *tally = (bench_tally){.scenes = c->count, .earliest = NAN, .latest = NAN};
    *error = (imp_error){.code = IMP_ERROR_MEMORY};
    imp_code code = IMP_ERROR_MEMORY;
    json_object_seed(0); /* before there are threads */
    if (columns_make(&x, c->count) && s.results != NULL && s.answers != NULL)
        code = run_all(&s, m->threads, repeats, times, error);
    if (code == IMP_SUCCESS) tally_all(&s, &x, tally);
    columns_free(&x);
    free(s.results);
    free(s.answers);
    return code;
}

/* --- batch ------------------------------------------------------------------------------------ */

static const bench_method one_by_one = {.name = "solve, one by one", .question = BENCH_STREAM};
static const bench_method one_thread = {
    .name = "batch, 1 thread", .question = BENCH_STREAM, .threads = 1};
static const bench_method two_threads = {
    .name = "batch, 2 threads", .question = BENCH_STREAM, .threads = 2};
static const bench_method *const methods[] = {&one_by_one, &one_thread, &two_threads, NULL};
enum { ONE_BY_ONE, ONE_THREAD, TWO_THREADS };

/* Scenes that cost next to nothing to solve, so that it is seen what else a batch does. */
static void add_spheres(bench_cases *list, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        bench_add_text(list,
                       bench_text("{\"bodies\":[{\"surfaces\":[{\"type\":\"sphere\"}]},"
                                  "{\"surfaces\":[{\"type\":\"sphere\",\"center\":[%zu,3,0]}]}]}",
                                  k));
}

static exit_status build(bench_cases *list, const bench_request *request)
{
    for (size_t count = 100; count <= 1000 && count <= request->up_to; count *= 10) {
        bench_begin(list, 1e-6, -1, "%zu pairs of spheres", count);
        add_spheres(list, count);
        bench_begin(list, 1e-6, -1, "%zu pairs of patches", count);
        bench_add_patches(list, 14, 3, count);
    }
    return bench_built(list, request);
}

/* From the largest cases: spheres tell the overhead, patches what the threads win. */
static size_t find(const bench_result *results, size_t count, bench_finding *findings)
{
    const bench_row *spheres = results[count - 2].rows, *patches = results[count - 1].rows;
    const double overhead =
        1e6 * (spheres[ONE_THREAD].tally.processor - spheres[ONE_BY_ONE].tally.processor);
    const double ratio =
        patches[ONE_THREAD].tally.seconds.mean / patches[TWO_THREADS].tally.seconds.mean;
    const double processor =
        patches[TWO_THREADS].tally.processor / patches[ONE_THREAD].tally.processor;
    findings[0] = (bench_finding){.key = "overhead_us", .value = overhead};
    findings[1] = (bench_finding){.key = "two_threads_faster", .value = ratio};
    findings[2] = (bench_finding){.key = "two_threads_processor", .value = processor};
    snprintf(findings[0].text, sizeof findings[0].text,
             "a batch takes %.1f us a scene beyond reading and solving it", overhead);
    snprintf(findings[1].text, sizeof findings[1].text,
             "patches: two threads are %.2f times as fast as one", ratio);
    snprintf(findings[2].text, sizeof findings[2].text,
             "and take %.2f times the processor time of one", processor);
    return 3;
}

const bench_set bench_batch = {"batch",
                               "Streams of scenes, one a line: read and solved one by one, and "
                               "answered as `impinge batch` does "
                               "by one\nthread and by two. Times are a scene's share, by the "
                               "clock, reading included. Memory is "
                               "a scene's,\nby the library's own count.",
                               methods, build, find};
