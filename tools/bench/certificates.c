/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/columns.h"
#include "tools/bench/kernel_time.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tools/cli/program.h"

/* Certificates: what keeping the proof costs, how large the file is, and what impinge-verify takes
 * to prove it again. */

#define VERIFIER "impinge-verify"

/* --- One scene -------------------------------------------------------------------------------- */

typedef struct proving {
    imp_registry *registry;
    const bench_case *of;
    const char *verifier;
    FILE *file;            /* of one certificate after the other, removed when it is closed */
    double *bytes, *takes; /* of each scene: size, processor seconds of the verifier */
    size_t hold;
    kernel_time kernel;
} proving;

static void put(void *context, const void *bytes, size_t size)
{
    fwrite(bytes, 1, size, context); /* write_file looks for failures */
}

/* What is asked of a scene: of one with parameters about all their values. */
typedef struct question {
    imp_query *query;
    imp_survey *survey; /* or this */
    bool has_requirement;
} question;

static imp_code ask(const bench_case *c, imp_scene *scene, question *q, imp_error *error)
{
    imp_options o = imp_options_default(scene);
    imp_clearance_options wanted = imp_clearance_options_default();
    o.gamma = c->gamma;
    o.gamma_clear = c->gamma_clear;
    o.max_bytes = 0;
    wanted.required = c->required;
    wanted.decide = true;
    q->has_requirement = c->required > 0;
    if (imp_scene_parameter_count(scene) > 0)
        q->survey = imp_survey_new(scene, &o, q->has_requirement ? &wanted : NULL, NULL, error);
    else
        q->query = q->has_requirement ? imp_clearance_new(scene, &o, &wanted, error)
                                      : imp_query_new(scene, &o, error);
    if (q->survey != NULL) return imp_survey_keep_proof(q->survey, error);
    return q->query != NULL ? imp_query_keep_proof(q->query, error) : error->code;
}

static imp_code answer(const question *q, const bench_case *c, imp_result *result, imp_error *error)
{
    imp_clearance least = {.struct_size = (uint32_t)sizeof least};
    imp_code code = IMP_SUCCESS;
    *result = (imp_result){.struct_size = (uint32_t)sizeof *result};
    if (q->survey != NULL)
        code = imp_survey_get_result(q->survey, result, error);
    else
        *result = imp_query_result(q->query);
    if (!q->has_requirement || code != IMP_SUCCESS) return code;
    code = q->survey != NULL ? imp_survey_get_clearance(q->survey, &least, error)
                             : imp_clearance_get(q->query, 0, &least, error);
    if (code == IMP_SUCCESS) result->verdict = bench_verdict_of(&least, c->gamma);
    return code;
}

static imp_code write_file(FILE *file, const question *q, double *bytes, imp_error *error)
{
    rewind(file);
    imp_code code = q->survey != NULL ? imp_survey_write_proof(q->survey, NULL, put, file, error)
                                      : imp_query_write_proof(q->query, NULL, put, file, error);
    const off_t size = ftello(file);
    *bytes = (double)size;
    if (code == IMP_SUCCESS &&
        (ferror(file) || fflush(file) != 0 || ftruncate(fileno(file), size) != 0)) {
        code = error->code = IMP_ERROR_FILE;
        snprintf(error->text, sizeof error->text, "a temporary certificate: %s", strerror(errno));
    }
    return code;
}

/* Searches scene `k` and writes its certificate; *seconds is the search alone. */
static imp_code prove(proving *p, size_t k, imp_result *result, double *seconds, imp_error *error)
{
    imp_scene *scene = bench_scene_of(p->registry, &p->of->scenes[k], error);
    question q = {.query = NULL};
    if (scene == NULL) return error->code;
    imp_code code = ask(p->of, scene, &q, error);
    const double start = bench_seconds_computed();
    if (code == IMP_SUCCESS)
        code = q.survey != NULL ? imp_survey_step(q.survey, 0, error)
                                : imp_query_step(q.query, 0, error);
    *seconds = bench_seconds_computed() - start;
    if (code == IMP_SUCCESS) code = answer(&q, p->of, result, error);
    if (code == IMP_SUCCESS) code = write_file(p->file, &q, &p->bytes[k], error);
    imp_survey_free(q.survey);
    imp_query_free(q.query);
    imp_scene_free(scene);
    return code;
}

/* Verifies the certificate of scene `k`, which was written last. */
static imp_code verify(proving *p, size_t k, imp_error *error)
{
    char path[40];
    snprintf(path, sizeof path, "/dev/fd/%d", fileno(p->file));
    const char *const words[] = {p->verifier, "--quiet", path, NULL};
    const double before = kernel_time_of_programs();
    const program_end end = program_run(words, PROGRAM_OUTPUT, false);
    p->takes[k] = kernel_time_of_programs() - before;
    p->hold += end.status == 0 && end.said != NULL && strcmp(end.said, "holds\n") == 0;
    const bool ran = end.error == 0 && end.said != NULL && end.status <= 1;
    if (!ran) {
        error->code = IMP_ERROR_FILE;
        snprintf(error->text, sizeof error->text, "%s: %s", p->verifier,
                 end.error != 0 ? strerror(end.error) : "it ended before its answer");
    }
    free(end.said);
    if (ran) kernel_time_add(&p->kernel, p->verifier, path);
    return ran ? IMP_SUCCESS : error->code;
}

/* --- One case --------------------------------------------------------------------------------- */

/* Timed `repeats` times, but for the verifier, whose runs are long. */
static imp_code fill(proving *p, size_t repeats, columns *x, bench_tally *tally, imp_error *error)
{
    enum { REPEATS_MAX = 101 };
    double times[REPEATS_MAX];
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < p->of->count && code == IMP_SUCCESS; ++k) {
        imp_result result = {.struct_size = 0};
        size_t count = 0;
        do {
            code = prove(p, k, &result, &times[count++], error);
        } while (code == IMP_SUCCESS && count < repeats && count < REPEATS_MAX);
        if (code == IMP_SUCCESS) code = verify(p, k, error);
        if (code != IMP_SUCCESS) break;
        columns_add(x, &result.stats, columns_median(times, count));
        tally->verdicts[result.verdict] += 1;
    }
    return code;
}

imp_code bench_measure_certificates(imp_registry *registry, const bench_case *c,
                                    const bench_request *request, bench_tally *tally,
                                    imp_error *error)
{
    char *verifier = program_beside(VERIFIER);
    proving p = {.registry = registry,
                 .of = c,
                 .verifier = verifier,
                 .file = tmpfile(),
                 .bytes = calloc(c->count + 1, sizeof *p.bytes),
                 .takes = calloc(c->count + 1, sizeof *p.takes)};
    columns x;
    *tally = (bench_tally){.scenes = c->count, .earliest = NAN, .latest = NAN};
    *error = (imp_error){.code = p.file != NULL ? IMP_ERROR_MEMORY : IMP_ERROR_FILE};
    if (p.file == NULL) snprintf(error->text, sizeof error->text, "no temporary file can be made");
    imp_code code = error->code;
    if (columns_make(&x, c->count) && p.bytes != NULL && p.takes != NULL && verifier != NULL &&
        p.file != NULL && kernel_time_begin(&p.kernel, c->count))
        code = fill(&p, request->repeats, &x, tally, error);
    if (code == IMP_SUCCESS) {
        columns_tally(&x, tally);
        tally->certificates =
            (bench_certificates){.count = c->count,
                                 .hold = p.hold,
                                 .bytes = columns_spread(p.bytes, c->count),
                                 .seconds = columns_spread(p.takes, c->count),
                                 .has_kernel = p.kernel.program != NULL,
                                 .elaborated = p.kernel.elaborated,
                                 .proved = p.kernel.proved,
                                 .kernel = columns_spread(p.kernel.takes, p.kernel.elaborated)};
    }
    columns_free(&x);
    kernel_time_end(&p.kernel);
    free(p.bytes);
    free(p.takes);
    free(verifier);
    if (p.file != NULL) fclose(p.file);
    return code;
}

double bench_verify_over_solve(const bench_tally *tally)
{
    return tally->certificates.seconds.mean / tally->seconds.mean;
}

const char *bench_set_lack(const bench_set *set)
{
    const bench_method *const *m = set->methods;
    while (*m != NULL && (*m)->question != BENCH_CERTIFICATE) ++m;
    if (*m == NULL) return NULL;
    char *verifier = program_beside(VERIFIER);
    const bool there = verifier != NULL;
    free(verifier);
    return there ? NULL
                 : "needs " VERIFIER ", which is neither beside this command nor on PATH: it is "
                   "built where configure finds MPFI (Debian: libmpfi-dev)";
}
