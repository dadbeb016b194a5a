/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <stdio.h>
#include <string.h>

#include "tools/bench/scenes.h"

/* --- Methods ---------------------------------------------------------------------------------- */

#define PAPER(ID, NAME, BASELINE)                                                                  \
    static const bench_method ID = {                                                               \
        .name = "paper" NAME, .baseline = IMP_BASELINE_##BASELINE, .capped = true}
static const bench_method models = {.name = "models"};
PAPER(boxes, "", BOXES);
PAPER(boxes_column, ", column", BOXES | IMP_BASELINE_COLUMN_RATES);
PAPER(boxes_constant, ", constant", BOXES | IMP_BASELINE_CONSTANT_RATES);
PAPER(balls, ", spheres", SPHERES);
PAPER(balls_column, ", spheres, column", SPHERES | IMP_BASELINE_COLUMN_RATES);
PAPER(balls_constant, ", spheres, constant", SPHERES | IMP_BASELINE_CONSTANT_RATES);

static const bench_method clearance_method = {.name = "clearance", .question = BENCH_CLEARANCE};
static const bench_method decision_method = {.name = "require 0.99 of it",
                                             .question = BENCH_DECISION};
static const bench_method proof_method = {.name = "solve, 0.99 of it", .question = BENCH_PROOF};

static const bench_method *const usual[] = {&models, &boxes, &balls, NULL};
static const bench_method *const all_rates[] = {
    &models, &boxes, &boxes_column, &boxes_constant, &balls, &balls_column, &balls_constant, NULL};

/* --- Findings --------------------------------------------------------------------------------- */

/* Returns the default method's pairs a scene. */
static double pairs_of(const bench_result *result) { return result->rows[0].tally.pairs.mean; }

/* Returns what the last `step` cases cost beyond the `step` before them, over what those cost
 * beyond the `step` before; `end` counts the cases. 1 is a cost like the logarithm; 0: they cost no
 * more. */
static double growth(const bench_result *results, size_t end, size_t step)
{
    const double last = pairs_of(&results[end - 1]), middle = pairs_of(&results[end - 1 - step]),
                 first = pairs_of(&results[end - 1 - 2 * step]);
    return last > middle ? (last - middle) / (middle - first) : 0;
}

/* --- figure7: two spheres --------------------------------------------------------------------- */

static const double gaps[] = {2, 1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
enum { GAPS = sizeof gaps / sizeof *gaps };

static exit_status build_figure7(bench_cases *list, const bench_request *request)
{
    for (int k = 0; k < GAPS; ++k) {
        bench_begin(list, gaps[k] / 2, -1, "axis, S = %g", gaps[k]);
        bench_add_gap(list, gaps[k], (double[3]){1, 0, 0});
    }
    for (int k = 0; k < GAPS; ++k) {
        uint64_t state = 1990;
        bench_begin(list, gaps[k] / 2, -1, "oblique, S = %g", gaps[k]);
        for (int d = 0; d < BENCH_DIRECTIONS; ++d) {
            double n[3];
            bench_direction(&state, n);
            bench_add_gap(list, gaps[k], n);
        }
    }
    return bench_built(list, request);
}

static size_t find_figure7(const bench_result *results, size_t count, bench_finding *findings)
{
    findings[0] = (bench_finding){.key = "growth_to_1e-6", .value = growth(results, count - 2, 2)};
    findings[1] = (bench_finding){.key = "growth_to_1e-8", .value = growth(results, count, 2)};
    for (int k = 0; k < 2; ++k)
        snprintf(
            findings[k].text, sizeof findings[k].text,
            "oblique: two more decades, to S = %s, take %.2f times the pairs of the two before",
            k == 0 ? "1e-6" : "1e-8", findings[k].value);
    return 2;
}

static const bench_set figure7 = {
    "figure7",
    "Two unit spheres, S apart, proved not to touch (gamma S/2, gamma_clear S/4): the line of "
    "centres\n"
    "along x, and along 20 random directions. After the paper's figure 7.",
    usual, build_figure7, find_figure7};

/* --- bicubic: random moving patches ----------------------------------------------------------- */

static exit_status build_bicubic(bench_cases *list, const bench_request *request)
{
    const double gamma[2] = {1e-3, 1e-6};
    exit_status status = EXIT_ANSWERED;
    for (int k = 0; k < 2 && status == EXIT_ANSWERED; ++k) {
        bench_begin(list, gamma[k], -1, "gamma %g", gamma[k]);
        if (!list->no_memory) status = bench_add_file(list, request->verb);
        if (request->count == 0) continue;
        bench_begin(list, gamma[k], -1, "seed %llu, gamma %g", (unsigned long long)request->seed,
                    gamma[k]);
        bench_add_patches(list, request->seed, 3, request->count);
    }
    return status == EXIT_ANSWERED ? bench_built(list, request) : status;
}

static const bench_set bicubic = {
    "bicubic",
    "Two random bicubic Bezier patches whose control points move linearly: 100 scenes with the\n"
    "answers of another solver, good to about 1e-6 in time (Chen et al., SIGGRAPH Asia 2024).",
    usual, build_bicubic, NULL};

/* --- spikes ----------------------------------------------------------------------------------- */

static const double widths[] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
enum { WIDTHS = sizeof widths / sizeof *widths };

static exit_status build_spikes(bench_cases *list, const bench_request *request)
{
    for (int k = 0; k < WIDTHS; ++k) {
        bench_begin(list, 1e-6, -1, "head-on, width %g", widths[k]);
        bench_add_head_on(list, widths[k]);
    }
    for (int k = 0; k < WIDTHS; ++k) {
        bench_begin(list, 1e-6, -1, "swing, width %g", widths[k]);
        bench_add_swing(list, widths[k]);
    }
    return bench_built(list, request);
}

static size_t find_spikes(const bench_result *results, size_t count, bench_finding *findings)
{
    const double head_on = pairs_of(&results[WIDTHS - 1]) / pairs_of(&results[0]);
    const double swing = pairs_of(&results[count - 1]) / pairs_of(&results[WIDTHS]);
    findings[0] = (bench_finding){.key = "narrowest_over_widest_head_on", .value = head_on};
    findings[1] = (bench_finding){.key = "narrowest_over_widest_swing", .value = swing};
    snprintf(findings[0].text, sizeof findings[0].text,
             "head-on, the narrowest spikes take %.2f times the pairs of the widest", head_on);
    snprintf(findings[1].text, sizeof findings[1].text, "swung into the flank, %.2f times", swing);
    return 2;
}

static const bench_set spikes = {"spikes",
                                 "Two spheres with two spikes each, one of which meets the "
                                 "other's: head-on, and swung into its\n"
                                 "flank; gamma 1e-6. After the paper's figure 8.",
                                 usual, build_spikes, find_spikes};

/* --- tori: rotating --------------------------------------------------------------------------- */

static exit_status build_tori(bench_cases *list, const bench_request *request)
{
    const double gamma[] = {1e-2, 1e-4, 1e-6, 1e-8};
    for (int k = 0; k < BENCH_TORI; ++k)
        for (size_t g = 0; g < sizeof gamma / sizeof *gamma; ++g) {
            bench_begin(list, gamma[g], -1, "%s, gamma %g", bench_tori_name(k), gamma[g]);
            bench_add_tori(list, k);
        }
    return bench_built(list, request);
}

static const bench_set tori = {
    "tori", "Two tori that turn and drift: in flight, in a fast tumble, linked like a chain.",
    usual, build_tori, NULL};

/* --- moving: spheres in flight ---------------------------------------------------------------- */

static exit_status build_moving(bench_cases *list, const bench_request *request)
{
    const double gamma[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
    for (size_t k = 0; k < sizeof gamma / sizeof *gamma; ++k) {
        bench_begin(list, gamma[k], -1, "gamma %g", gamma[k]);
        bench_add_flights(list);
    }
    return bench_built(list, request);
}

static const bench_set moving = {
    "moving",
    "A sphere flies at another from 20 random directions; the reference is the closed form.", usual,
    build_moving, NULL};

/* --- rates: bounds side by side --------------------------------------------------------------- */

static exit_status build_rates(bench_cases *list, const bench_request *request)
{
    const double gamma[2] = {0.1, 0.01};
    for (int k = 0; k < 2; ++k) {
        bench_begin(list, gamma[k], -1, "spheres, gamma %g", gamma[k]);
        bench_add_flights(list);
        bench_begin(list, gamma[k], -1, "tori, gamma %g", gamma[k]);
        for (int scene = 0; scene < BENCH_TORI; ++scene) bench_add_tori(list, scene);
        bench_begin(list, gamma[k], -1, "spikes, gamma %g", gamma[k]);
        bench_add_head_on(list, widths[0]);
        bench_add_swing(list, widths[0]);
        bench_begin(list, gamma[k], -1, "patches, gamma %g", gamma[k]);
        bench_add_patches(list, 1, 3, 10);
    }
    return bench_built(list, request);
}

static const bench_set rates = {"rates",
                                "What bounds are made of: models; boxes and spheres from the rate "
                                "matrix, from its columns, and\n"
                                "from one constant (the paper's section 5).",
                                all_rates, build_rates, NULL};

/* --- clearance: least distances --------------------------------------------------------------- */

static const bench_method *const distances[] = {&clearance_method, &decision_method, &proof_method,
                                                NULL};

static void cut_last(bench_cases *list, double cut)
{
    if (!list->no_memory) list->cases[list->count - 1].cut = cut;
}

static exit_status build_clearance(bench_cases *list, const bench_request *request)
{
    const double cuts[] = {0.5, 0.9, 0.99};
    exit_status status = EXIT_ANSWERED;
    for (int k = 0; k < 3 && status == EXIT_ANSWERED; ++k) {
        bench_begin(list, 1e-6, -1, "patches, to %g of contact", cuts[k]);
        if (!list->no_memory) status = bench_add_file(list, request->verb);
        cut_last(list, cuts[k]);
    }
    bench_begin(list, 1e-6, -1, "tori, to 0.9 of contact");
    for (int k = 0; k < BENCH_TORI; ++k) bench_add_tori(list, k);
    cut_last(list, 0.9);
    uint64_t state = 2026;
    bench_begin(list, 1e-6, -1, "arms, to 0.9 of contact");
    for (int k = 0; k < 12; ++k) bench_add_arm(list, &state);
    cut_last(list, 0.9);
    return status == EXIT_ANSWERED ? bench_built(list, request) : status;
}

static const bench_set clearance_set = {
    "clearance",
    "How near bodies come, to a thousandth; whether they keep 0.99 of that; and a search for "
    "contact\n"
    "that proves as much, which ratios are against. Intervals end before the first contact.",
    distances, build_clearance, NULL};

/* --- All -------------------------------------------------------------------------------------- */

static const bench_set *const all[] = {&figure7,
                                       &bicubic,
                                       &spikes,
                                       &tori,
                                       &rates,
                                       &moving,
                                       &clearance_set,
                                       &bench_conformal,
                                       &bench_saddles,
                                       &bench_parameters,
                                       &bench_everyday,
                                       &bench_bodies,
                                       &bench_surfaces,
                                       &bench_batch,
                                       &bench_changes,
                                       &bench_certificates_set,
                                       NULL};

const bench_set *const *bench_sets_all(void) { return all; }

bool bench_set_is_measured(const bench_set *set, const bench_request *request)
{
    const bench_method *const *m = set->methods;
    while (request->only && *m != NULL &&
           ((*m)->baseline != IMP_BASELINE_NONE) != request->is_paper)
        ++m;
    return *m != NULL;
}

const bench_set *bench_set_find(const char *name)
{
    for (const bench_set *const *set = all; *set != NULL; ++set)
        if (strcmp((*set)->name, name) == 0) return *set;
    return NULL;
}
