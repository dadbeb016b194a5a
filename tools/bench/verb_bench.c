/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/spelling.h"
#include "tools/bench/bench.h"
#include "tools/bench/tune.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

typedef struct bench {
    const arguments *args;
    imp_registry *registry;
    bench_request request;
    json_t *sets;        /* --json: what is done so far, else NULL */
    size_t goals_missed; /* of those that are not marked as open */
} bench;

/* --- What is asked ---------------------------------------------------------------------------- */

static exit_status read_request(const arguments *args, bench_request *request)
{
    const option_value *method = arguments_option(args, "method");
    *request = (bench_request){.verb = args->verb->name,
                               .only = method != NULL,
                               .is_paper = method != NULL && method->choice == 1,
                               .max_pairs = arguments_count(args, "max-pairs", 100000),
                               .repeats = arguments_count(args, "repeat", 3),
                               .count = arguments_count(args, "count", 0),
                               .seed = arguments_count(args, "seed", 1),
                               .up_to = arguments_count(args, "up-to", UINT64_MAX)};
    if (request->repeats == 0)
        return complain(EXIT_USAGE, request->verb, "--repeat must be at least 1, not '0'");
    if (request->count == 0 && arguments_option(args, "seed") != NULL)
        return complain(EXIT_USAGE, request->verb, "--seed belongs to --count");
    if (request->up_to < BENCH_SIZE_LEAST)
        return complain(EXIT_USAGE, request->verb, "--up-to must be at least %d, not '%s'",
                        BENCH_SIZE_LEAST, arguments_option(args, "up-to")->text);
    if (arguments_option(args, "tune") != NULL &&
        (request->only || arguments_option(args, "json") != NULL))
        return complain(EXIT_USAGE, request->verb,
                        "--tune measures the default method and prints a table: leave out "
                        "--method and --json");
    return EXIT_ANSWERED;
}

static exit_status unknown_set(const char *speaker, const char *name)
{
    spelling_search near = {.wanted = name};
    char all[256] = "";
    for (const bench_set *const *set = bench_sets_all(); *set != NULL; ++set) {
        spelling_offer(&near, (*set)->name);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", all[0] != '\0' ? ", " : "",
                 (*set)->name);
    }
    if (near.best != NULL)
        return complain(EXIT_USAGE, speaker, "unknown set '%s', did you mean '%s'? There are %s",
                        name, near.best, all);
    return complain(EXIT_USAGE, speaker, "unknown set '%s'; there are %s", name, all);
}

static const char *set_name(size_t index)
{
    const bench_set *set = bench_sets_all()[index];
    return set != NULL ? set->name : NULL;
}

/* --- Running ---------------------------------------------------------------------------------- */

static exit_status run_method(bench *b, const bench_method *m, bench_result *result)
{
    imp_error error = {0};
    bench_row *row = &result->rows[result->row_count];
    result->budget[result->row_count++] = m->capped ? bench_budget(m, &b->request) : 0;
    row->method = m;
    progress_show("%s: %s", result->about->name, m->name);
    const imp_code code =
        bench_measure(b->registry, result->about, m, &b->request, &row->tally, &error);
    if (code != IMP_SUCCESS) return complain_of(&error, b->request.verb);
    if ((m->baseline != IMP_BASELINE_NONE || m->question == BENCH_PROOF || m->is_rebuilt) &&
        result->baseline == NULL)
        result->baseline = row;
    return EXIT_ANSWERED;
}

/* Measures and shows one case. */
static exit_status run_case(bench *b, const bench_set *set, const bench_case *c, json_t *results,
                            bench_result *result)
{
    *result = (bench_result){.about = c};
    for (const bench_method *const *m = set->methods; *m != NULL; ++m) {
        if (b->request.only && ((*m)->baseline != IMP_BASELINE_NONE) != b->request.is_paper)
            continue;
        const exit_status status = run_method(b, *m, result);
        if (status != EXIT_ANSWERED) return status;
    }
    progress_wipe();
    for (size_t k = 0; k < result->row_count; ++k)
        b->goals_missed += bench_goal_of(result, k) == BENCH_GOAL_MISSED;
    if (results == NULL) {
        bench_print_result(result);
        return output_flush(b->request.verb);
    }
    if (json_array_append_new(results, bench_result_json(result)) == 0) return EXIT_ANSWERED;
    return complain_of_memory(b->request.verb);
}

/* Shows what the set is about in one number or so. Takes over `results`. */
static exit_status conclude(bench *b, const bench_set *set, const bench_result *measured,
                            size_t count, json_t *results)
{
    bench_finding findings[BENCH_FINDINGS_MAX];
    const bool found = set->find != NULL && !(b->request.only && b->request.is_paper);
    const size_t n = found ? set->find(measured, count, findings) : 0;
    if (results == NULL) {
        bench_print_findings(findings, n);
        return output_flush(b->request.verb);
    }
    if (json_array_append_new(b->sets, bench_set_json(set, results, findings, n)) == 0)
        return EXIT_ANSWERED;
    return complain_of_memory(b->request.verb);
}

static exit_status run_cases(bench *b, const bench_set *set, const bench_cases *list)
{
    exit_status status = EXIT_ANSWERED;
    bench_result *measured = calloc(list->count, sizeof *measured);
    json_t *results = b->sets != NULL ? json_array() : NULL;
    if (measured == NULL || (b->sets != NULL && results == NULL))
        status = complain_of_memory(b->request.verb);
    else if (results == NULL)
        bench_print_head(set, &b->request);
    for (size_t k = 0; k < list->count && status == EXIT_ANSWERED; ++k)
        status = run_case(b, set, &list->cases[k], results, &measured[k]);
    if (status == EXIT_ANSWERED)
        status = conclude(b, set, measured, list->count, results);
    else
        json_decref(results);
    free(measured);
    return status;
}

/* Where all sets are run, those that the method is not for are left out. */
static exit_status run_set(bench *b, const bench_set *set)
{
    bench_cases list = {0};
    if (!bench_set_is_measured(set, &b->request)) {
        remark(b->request.verb, "set '%s' is for the default method only, and left out", set->name);
        return EXIT_ANSWERED;
    }
    const char *lack = bench_set_lack(set);
    if (lack != NULL) {
        remark(b->request.verb, "set '%s' %s; left out", set->name, lack);
        return EXIT_ANSWERED;
    }
    exit_status status = set->build(&list, &b->request);
    if (status == EXIT_ANSWERED) status = run_cases(b, set, &list);
    bench_cases_free(&list);
    return status;
}

/* The sets named, or all. */
static exit_status run_sets(bench *b)
{
    exit_status status = EXIT_ANSWERED;
    const size_t named = b->args->operand_count;
    for (size_t k = 0; k < named && status == EXIT_ANSWERED; ++k)
        status = run_set(b, bench_set_find(b->args->operands[k]));
    for (const bench_set *const *set = bench_sets_all();
         named == 0 && *set != NULL && status == EXIT_ANSWERED; ++set)
        status = run_set(b, *set);
    return status;
}

static exit_status run_and_print(bench *b)
{
    const bool json = arguments_option(b->args, "json") != NULL;
    if (!json) bench_print_request(&b->request);
    b->sets = json ? json_array() : NULL;
    if (json && b->sets == NULL) return complain_of_memory(b->request.verb);
    exit_status status = run_sets(b);
    if (json && status == EXIT_ANSWERED)
        status = output_json(
            json_pack("{s:I, s:o}", "max_pairs", (json_int_t)b->request.max_pairs, "sets", b->sets),
            b->request.verb);
    else
        json_decref(b->sets);
    if (status != EXIT_ANSWERED || b->goals_missed == 0) return status;
    remark(b->request.verb, "%zu goals are missed that were reached before", b->goals_missed);
    return EXIT_CONFORMANCE;
}

/* --- Tuning ----------------------------------------------------------------------------------- */

/* Sweeps one constant over the sets named, or over those that show most of them. */
static exit_status tune(bench *b)
{
    static const char *const usual[] = {"bicubic", "spikes", "tori"};
    const bench_set *sets[65] = {NULL};
    const size_t named = b->args->operand_count;
    for (size_t k = 0; k < (named > 0 ? named : sizeof usual / sizeof *usual); ++k)
        sets[k] = bench_set_find(named > 0 ? b->args->operands[k] : usual[k]);
    b->request.repeats = 1; /* it prints counters only, which every run repeats */
    return bench_tune(b->registry, &b->request, arguments_option(b->args, "tune")->text, sets);
}

/* Complains of a set named that cannot be measured. */
static exit_status check_named(const char *name, const bench_request *request)
{
    const bench_set *set = bench_set_find(name);
    if (set == NULL) return unknown_set(request->verb, name);
    if (!bench_set_is_measured(set, request))
        return complain(EXIT_USAGE, request->verb,
                        "set '%s' is for the default method only: leave out --method, or the set",
                        name);
    const char *lack = bench_set_lack(set);
    return lack == NULL ? EXIT_ANSWERED
                        : complain(EXIT_USAGE, request->verb, "set '%s' %s", name, lack);
}

static exit_status run(const arguments *args)
{
    bench b = {.args = args};
    exit_status status = read_request(args, &b.request);
    for (size_t k = 0; k < args->operand_count && status == EXIT_ANSWERED; ++k)
        status = check_named(args->operands[k], &b.request);
    if (status != EXIT_ANSWERED) return status;
    b.registry = query_registry(args);
    if (b.registry == NULL) return EXIT_DATA;
    status = arguments_option(args, "tune") != NULL ? tune(&b) : run_and_print(&b);
    imp_registry_free(b.registry);
    return status;
}

static const char *const methods[] = {"models", "paper", NULL};

static const option bench_options[] = {
    {.name = "method",
     .kind = OPTION_CHOICE,
     .argument = "NAME",
     .choices = methods,
     .help = "measure this method alone"},
    {.name = "max-pairs",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "end the paper's method, and conformal and everyday scenes, at N pairs a scene (K, M, "
             "G: thousands); 0: never (100K)"},
    {.name = "repeat",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "take times of short searches N times, and their median (3)"},
    {.name = "count",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "bicubic, certificates: add N random scenes of patches (0)"},
    {.name = "up-to",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "bodies, surfaces, batch, certificates: leave out cases of more than N bodies, "
             "triangles, scenes"},
    {.name = "seed",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "seed of these random scenes (1)"},
    {.name = "tune",
     .kind = OPTION_TEXT,
     .argument = "NAME[=V,...]",
     .help = "of tools/impinge-tunable: try other values of a constant of core/bounds/tuning.h"},
    {.name = NULL}};

static const option *const tables[] = {bench_options, options_registry, options_always, NULL};

const verb verb_bench = {
    .name = "bench",
    .operands = "[SET]...",
    .operand_word = set_name,
    .summary = "Measure the methods side by side",
    .details = "Each SET of scenes (all, if none is named) is answered by the default method and, "
               "but for the last\n"
               "ten, by the paper's, each scene afresh:\n"
               "\n"
               "  figure7  two spheres, ever nearer, proved not to touch\n"
               "  bicubic  100 pairs of random moving patches, with reference answers\n"
               "  spikes   spheres with ever narrower spikes that meet\n"
               "  tori     tori that turn and drift\n"
               "  rates    boxes and spheres from rates of three forms\n"
               "  moving   spheres in flight, at ever smaller gamma\n"
               "  clearance  least distances, and whether 0.99 of them is kept\n"
               "  conformal  machine parts that slide in each other, ever tighter\n"
               "  saddles  random patches, and saddles that lie in one another, ever nearer\n"
               "  parameters  all values of 1 to 4 joints at once, required ever more closely\n"
               "  everyday  machines as they are built, each with a goal; ends with status 6 where "
               "one is missed\n"
               "  bodies   100 to 100,000 bodies that drift\n"
               "  surfaces  two meshes of 100 to 20,000 triangles each\n"
               "  batch    streams of scenes, by one thread and by two\n"
               "  changes  a scene whose numbers change, beside one built anew\n"
               "  certificates  what --proof adds to a search, and impinge-verify takes for it\n"
               "\n"
               "Counters are the same in every run; only times differ.\n",
    .example = "impinge bench moving --method models",
    .operand_max = 64,
    .options = tables,
    .run = run};
