/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Random biquadratic patches, as those of patches.c; and saddles that lie in one another, ever
 * nearer: the second is the first with each control point moved by a part of the gap, and drifts by
 * as much, so that most are near misses or touch late. */

enum { RANDOM = 100, SADDLES = 6, POINTS = 9 };

static const double gaps[] = {1e-1, 1e-2, 1e-3, 1e-4};
enum { GAPS = sizeof gaps / sizeof *gaps };

/* What the random patches may take in the mean, and the worst saddles. */
static const double MEAN_MOST = 100, WORST_MOST = 20000;

/* --- Drawing ---------------------------------------------------------------------------------- */

static void draw_saddle(uint64_t *state, double x[POINTS][3])
{
    const double bend = random_between(state, 0.2, 1), square[3] = {1, -1, 1};
    for (int k = 0; k < POINTS; ++k) {
        const double at[3] = {k / 3 - 1, k % 3 - 1, bend * (square[k / 3] - square[k % 3])};
        for (int i = 0; i < 3; ++i) x[k][i] = at[i] + random_between(state, -0.2, 0.2);
    }
}

static void write_saddle(FILE *out, double x[POINTS][3])
{
    fputs("{\"surfaces\":[{\"type\":\"bezier\",\"degree\":[2,2],\"points\":[", out);
    for (int k = 0; k < POINTS; ++k)
        fprintf(out, "%s[%.17g,%.17g,%.17g]", k > 0 ? "," : "", x[k][0], x[k][1], x[k][2]);
    fputs("]}]", out);
}

/* Returns two saddles, about `gap` apart, the second of which drifts; NULL: no memory. */
static char *draw(uint64_t *state, double gap)
{
    double x[POINTS][3], drift[3];
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL) return NULL;
    draw_saddle(state, x);
    fputs("{\"bodies\":[", out);
    write_saddle(out, x);
    for (int k = 0; k < POINTS; ++k)
        for (int i = 0; i < 3; ++i) x[k][i] += gap * ((i == 2) + random_between(state, -0.5, 0.5));
    fputs("},", out);
    write_saddle(out, x);
    for (int i = 0; i < 3; ++i) drift[i] = gap * random_between(state, -1, 1);
    fprintf(out, ",\"maps\":[{\"type\":\"translate\",\"velocity\":[%.17g,%.17g,%.17g]}]}]}",
            drift[0], drift[1], drift[2]);
    const bool complete = !ferror(out);
    if (fclose(out) == 0 && complete) return text;
    free(text);
    return NULL;
}

/* --- The set ---------------------------------------------------------------------------------- */

static exit_status build(bench_cases *list, const bench_request *request)
{
    uint64_t state = 22;
    bench_begin(list, 1e-6, -1, "random");
    bench_add_patches(list, 22, 2, RANDOM);
    for (int k = 0; k < GAPS; ++k) {
        bench_begin(list, 1e-6, -1, "saddles, %g apart", gaps[k]);
        for (int scene = 0; scene < SADDLES && !list->no_memory; ++scene)
            bench_add_text(list, draw(&state, gaps[k]));
    }
    return bench_built(list, request);
}

static size_t find(const bench_result *results, size_t count, bench_finding *findings)
{
    const double mean = results[0].rows[0].tally.pairs.mean;
    double worst = 0;
    for (size_t k = 1; k < count; ++k)
        if (results[k].rows[0].tally.pairs.max > worst) worst = results[k].rows[0].tally.pairs.max;
    findings[0] = (bench_finding){.key = "random_mean", .value = mean};
    findings[1] = (bench_finding){.key = "saddles_worst", .value = worst};
    snprintf(findings[0].text, sizeof findings[0].text,
             "random patches take %.1f pairs in the mean (goal %g)", mean, MEAN_MOST);
    snprintf(findings[1].text, sizeof findings[1].text, "the worst saddles take %g pairs (goal %g)",
             worst, WORST_MOST);
    return 2;
}

static const bench_method models = {.name = "models", .capped = true};
static const bench_method *const methods[] = {&models, NULL};

const bench_set bench_saddles = {
    "saddles",
    "Random moving biquadratic patches, and saddles that lie in one another, ever nearer: near "
    "misses\n"
    "all over, where only terms of third order and more are left; gamma 1e-6.",
    methods, build, find};
