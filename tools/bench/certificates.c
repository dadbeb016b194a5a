/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/columns.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tools/bench/crowd.h"
#include "tools/cli/input.h"
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
} proving;

static void put(void *context, const void *bytes, size_t size)
{
    fwrite(bytes, 1, size, context); /* write_file looks for failures */
}

static imp_code write_file(FILE *file, const imp_query *query, double *bytes, imp_error *error)
{
    rewind(file);
    imp_code code = imp_query_write_proof(query, NULL, put, file, error);
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
    if (scene == NULL) return error->code;
    imp_options o = imp_options_default(scene);
    o.gamma = p->of->gamma;
    o.gamma_clear = p->of->gamma_clear;
    o.max_bytes = 0;
    imp_query *query = imp_query_new(scene, &o, error);
    imp_code code = query != NULL ? imp_query_keep_proof(query, error) : error->code;
    const double start = bench_seconds_computed();
    if (code == IMP_SUCCESS) code = imp_query_step(query, 0, error);
    *seconds = bench_seconds_computed() - start;
    if (code == IMP_SUCCESS) {
        *result = imp_query_result(query);
        code = write_file(p->file, query, &p->bytes[k], error);
    }
    imp_query_free(query);
    imp_scene_free(scene);
    return code;
}

/* Processor seconds of the programs that have run. */
static double seconds_of_programs(void)
{
    struct rusage used;
    getrusage(RUSAGE_CHILDREN, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/* Verifies the certificate of scene `k`, which was written last. */
static imp_code verify(proving *p, size_t k, imp_error *error)
{
    char path[40];
    snprintf(path, sizeof path, "/dev/fd/%d", fileno(p->file));
    const char *const words[] = {p->verifier, "--quiet", path, NULL};
    const double before = seconds_of_programs();
    const program_end end = program_run(words, PROGRAM_OUTPUT, false);
    p->takes[k] = seconds_of_programs() - before;
    p->hold += end.status == 0 && end.said != NULL && strcmp(end.said, "holds\n") == 0;
    const bool ran = end.error == 0 && end.said != NULL && end.status <= 1;
    if (!ran) {
        error->code = IMP_ERROR_FILE;
        snprintf(error->text, sizeof error->text, "%s: %s", p->verifier,
                 end.error != 0 ? strerror(end.error) : "it ended before its answer");
    }
    free(end.said);
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
        p.file != NULL)
        code = fill(&p, request->repeats, &x, tally, error);
    if (code == IMP_SUCCESS) {
        columns_tally(&x, tally);
        tally->certificates = (bench_certificates){
            c->count, p.hold, columns_spread(p.bytes, c->count), columns_spread(p.takes, c->count)};
    }
    columns_free(&x);
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

/* --- certificates ----------------------------------------------------------------------------- */

static const bench_method solve = {.name = "solve"};
static const bench_method with_proof = {.name = "solve, keeping the proof",
                                        .question = BENCH_CERTIFICATE};
static const bench_method *const methods[] = {&solve, &with_proof, NULL};
enum { SOLVE, WITH_PROOF };

static exit_status add_teapot(bench_cases *list, const bench_request *request)
{
    char *path = input_package_file("teapot.json", request->verb), *text = NULL;
    FILE *file = path != NULL ? input_open(path, request->verb) : NULL;
    size_t size = 0;
    const bool complete = file != NULL && getdelim(&text, &size, '\0', file) > 0;
    if (file != NULL) {
        if (!complete) complain(EXIT_DATA, request->verb, "%s: cannot be read", path);
        input_close(file);
    }
    free(path);
    bench_begin(list, 1e-2, -1, "teapot and torus, gamma 0.01");
    if (complete)
        bench_add_text(list, text);
    else
        free(text);
    return complete ? EXIT_ANSWERED : EXIT_DATA;
}

enum { PATCHES = 4, TRIANGLES = 1000 };

static exit_status build(bench_cases *list, const bench_request *request)
{
    bench_begin(list, 1e-6, -1, "patches, gamma 1e-06");
    bench_add_patches(list, request->seed, PATCHES + request->count);
    bench_begin(list, 1e-4, -1, "shaft, c = 0.001");
    bench_add_pair(list, bench_text("cylinder radius=0.999 height=2 ! rotate rate=1"),
                   bench_text("cylinder height=2"));
    bench_begin(list, 1e-2, -1, "socket, c = 0.1");
    bench_add_pair(list, bench_text("sphere radius=0.9 ! rotate axis=1,2,3 rate=2"),
                   bench_text("sphere"));
    if (TRIANGLES <= request->up_to) {
        bench_begin(list, 1e-3, -1, "%d triangles each, gamma 0.001", TRIANGLES);
        bench_add_text(list, crowd_two_meshes(20, TRIANGLES / 40));
    }
    const exit_status status = add_teapot(list, request);
    return status == EXIT_ANSWERED ? bench_built(list, request) : status;
}

static size_t find(const bench_result *results, size_t count, bench_finding *findings)
{
    const bench_tally *patches = &results[0].rows[WITH_PROOF].tally;
    const double kept = patches->seconds.mean / results[0].rows[SOLVE].tally.seconds.mean;
    size_t all = 0, hold = 0;
    for (size_t k = 0; k < count; ++k) {
        all += results[k].rows[WITH_PROOF].tally.certificates.count;
        hold += results[k].rows[WITH_PROOF].tally.certificates.hold;
    }
    findings[0] = (bench_finding){.key = "keeping_over_solving", .value = kept};
    findings[1] =
        (bench_finding){.key = "verify_over_solve", .value = bench_verify_over_solve(patches)};
    findings[2] = (bench_finding){.key = "refused", .value = (double)(all - hold)};
    snprintf(findings[0].text, sizeof findings[0].text,
             "patches: to search and keep the proof takes %.2f times the search alone", kept);
    snprintf(findings[1].text, sizeof findings[1].text,
             "patches: to verify takes %.0f times the search", findings[1].value);
    snprintf(findings[2].text, sizeof findings[2].text, "%zu of %zu certificates hold", hold, all);
    return 3;
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

const bench_set bench_certificates_set = {
    "certificates",
    "What was proved, as a file (--proof) that impinge-verify proves again: the search without and "
    "with it;\nthe file's bytes, the verifier's processor time, its start included, and how many "
    "times the search that is.",
    methods, build, find};
