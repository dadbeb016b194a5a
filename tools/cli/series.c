/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/series.h"

#include <math.h>
#include <stdlib.h>

#include "tools/cli/output.h"
#include "tools/cli/proof_output.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

const option options_series[] = {
    {.name = "each", .help = "print the first contact of each pair of bodies, in order of time"},
    {.name = "list-all",
     .help = "with --each: a line for each pair of bodies, also those that were not examined"},
    {.name = "threads",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "by N threads, the same answers (1; with --each all processors)"},
    {.name = "refine",
     .kind = OPTION_TEXT,
     .argument = "G1,G2,...",
     .help = "answer at each of these ever smaller gammas, from one search"},
    {.name = NULL}};

/* --- Gammas ----------------------------------------------------------------------------------- */

double series_next_gamma(const char **text, double before)
{
    char *end;
    const double gamma = strtod(*text, &end);
    const bool ends = *end == '\0' || (*end == ',' && end[1] != '\0');
    if (end == *text || !ends || !(gamma > 0 && gamma < before)) return NAN;
    *text = *end == ',' ? end + 1 : end;
    return gamma;
}

exit_status series_check(const arguments *args)
{
    const char *speaker = args->verb->name;
    const option_value *refine = arguments_option(args, "refine");
    const bool each = arguments_option(args, "each") != NULL;
    if (!each && arguments_option(args, "list-all") != NULL)
        return complain(EXIT_USAGE, speaker, "--list-all belongs to --each");
    if ((each || refine != NULL) && arguments_option(args, "explain") != NULL)
        return complain(EXIT_USAGE, speaker, "--%s and --explain exclude each other",
                        each ? "each" : "refine");
    const exit_status proof = proof_output_check(args);
    if (proof != EXIT_ANSWERED) return proof;
    if (refine == NULL) return EXIT_ANSWERED;
    if (each) return complain(EXIT_USAGE, speaker, "--each and --refine exclude each other");
    const char *const excluded[] = {"gamma", "gamma-clear"};
    for (int k = 0; k < 2; ++k)
        if (arguments_option(args, excluded[k]) != NULL)
            return complain(EXIT_USAGE, speaker, "--refine and --%s exclude each other",
                            excluded[k]);
    double gamma = INFINITY;
    const char *text = refine->text;
    do {
        gamma = series_next_gamma(&text, gamma);
        if (isnan(gamma))
            return complain(EXIT_USAGE, speaker,
                            "--refine must be numbers above 0 with commas between, each smaller "
                            "than the one before, not '%s'",
                            refine->text);
    } while (*text != '\0');
    return EXIT_ANSWERED;
}

typedef struct series {
    const arguments *args;
    const imp_scene *scene;
    imp_query *query;
    exit_status worst; /* that answers have earned */
} series;

/* --- Finer and finer -------------------------------------------------------------------------- */

static exit_status answer_refined(series *s)
{
    imp_error error = {0};
    const char *text = arguments_option(s->args, "refine")->text;
    series_next_gamma(&text, INFINITY);
    for (;;) {
        imp_result r;
        if (query_run(s->query, &r, &error) != IMP_SUCCESS)
            return complain_of(&error, s->args->verb->name);
        const exit_status status = query_print(s->scene, s->query, &r, s->args);
        if (status != EXIT_ANSWERED) return status;
        s->worst = query_status(&r, s->args);
        if (r.verdict == IMP_VERDICT_UNDECIDED || *text == '\0') return EXIT_ANSWERED;
        if (imp_query_refine(s->query, series_next_gamma(&text, INFINITY), -1, &error) !=
            IMP_SUCCESS)
            return complain_of(&error, s->args->verb->name);
    }
}

exit_status series_answer(imp_scene *scene, const arguments *args)
{
    imp_error error = {0};
    const char *text = arguments_option(args, "refine")->text;
    imp_options options = query_options(scene, args);
    options.gamma = series_next_gamma(&text, INFINITY);
    options.gamma_clear = -1;
    crew threads = {query_threads_asked(args)};
    query_lend_threads(&options, &threads);
    series s = {.args = args, .scene = scene};
    s.query = imp_query_new(scene, &options, &error);
    const exit_status status =
        s.query != NULL ? answer_refined(&s) : complain_of(&error, args->verb->name);
    imp_query_free(s.query);
    return status != EXIT_ANSWERED ? status : s.worst;
}
