/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>

#include "tools/bench/bench.h"
#include "tools/bench/crowd.h"

/* Scenes whose certificates are measured: patches, what slides in each other, meshes, an arm, and
 * scenes with parameters. */

static const bench_method solve = {.name = "solve"};
static const bench_method with_proof = {.name = "solve, keeping the proof",
                                        .question = BENCH_CERTIFICATE};
static const bench_method *const methods[] = {&solve, &with_proof, NULL};
enum { SOLVE, WITH_PROOF };

enum { PATCHES = 4, TRIANGLES = 1000 };

/* Scene files that come with the command. */
static const struct packaged {
    const char *file, *name;
    double gamma, required;
} files[] = {{"teapot.json", "teapot and torus, gamma 0.01", 1e-2, 0},
             {"arm.json", "arm beside a fixture, 2 required", 1e-6, 2},
             {"door.json", "door, all places of its hinge", 1, 0},
             {"spindle.json", "spindle, all angles", 1, 0}};

static exit_status add_files(bench_cases *list, const bench_request *request)
{
    exit_status status = EXIT_ANSWERED;
    for (size_t k = 0; k < sizeof files / sizeof *files && status == EXIT_ANSWERED; ++k) {
        bench_begin(list, files[k].gamma, -1, "%s", files[k].name);
        if (list->no_memory) break;
        list->cases[list->count - 1].required = files[k].required;
        status = bench_add_package_file(list, files[k].file, request->verb);
    }
    return status;
}

static exit_status build(bench_cases *list, const bench_request *request)
{
    bench_begin(list, 1e-6, -1, "patches, gamma 1e-06");
    bench_add_patches(list, request->seed, 3, PATCHES + request->count);
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
    const exit_status status = add_files(list, request);
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

const bench_set bench_certificates_set = {
    "certificates",
    "What was proved, as a file (--proof) that impinge-verify proves again: the search without and "
    "with it;\nthe file's bytes, the verifier's processor time, its start included, and how many "
    "times the search that is;\nand that of impinge-verify-kernel for what is elaborated in 3 s.",
    methods, build, find};
