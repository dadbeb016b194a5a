/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/reading_limit.h"
#include "tools/cli/scene_values.h"
#include "tools/cli/survey.h"
#include "tools/cli/verbs.h"

/* Solves the example of each surface type against that of each other, and under each map. */

typedef struct tally {
    size_t contact, clear, undecided, failed;
    uint64_t pairs;
    double seconds;
} tally;

typedef struct matrix {
    imp_registry *registry;
    const arguments *args;
    json_t *rows; /* NULL: text */
    tally all;
} matrix;

static const char *verdict_name(imp_verdict verdict)
{
    return verdict == IMP_VERDICT_CONTACT ? "contact"
           : verdict == IMP_VERDICT_CLEAR ? "clear"
                                          : "undecided";
}

static void count(tally *t, const imp_result *r)
{
    t->contact += r->verdict == IMP_VERDICT_CONTACT;
    t->clear += r->verdict == IMP_VERDICT_CLEAR;
    t->undecided += r->verdict == IMP_VERDICT_UNDECIDED;
    t->pairs += r->stats.pairs;
    t->seconds += r->stats.seconds;
}

static void add(tally *sum, const tally *t)
{
    sum->contact += t->contact;
    sum->clear += t->clear;
    sum->undecided += t->undecided;
    sum->failed += t->failed;
    sum->pairs += t->pairs;
    sum->seconds += t->seconds;
}

static void tell_cell(matrix *m, const char *a, const char *b, const imp_result *r)
{
    if (m->rows != NULL)
        json_array_append_new(
            m->rows, json_pack("{s:o, s:o, s:s, s:I, s:f}", "a", output_json_text(a), "b",
                               output_json_text(b), "verdict", verdict_name(r->verdict), "pairs",
                               (json_int_t)r->stats.pairs, "seconds", r->stats.seconds));
    else if (arguments_option(m->args, "all") != NULL)
        printf("  %-9s %8llu pairs %10.3g s  %s  |  %s\n", verdict_name(r->verdict),
               (unsigned long long)r->stats.pairs, r->stats.seconds, a, b);
}

static void tell_failure(matrix *m, const char *a, const char *b, const char *why)
{
    if (m->rows != NULL)
        json_array_append_new(m->rows,
                              json_pack("{s:o, s:o, s:o}", "a", output_json_text(a), "b",
                                        output_json_text(b), "error", output_json_text(why)));
    remark(m->args->verb->name, "%s  |  %s: %s", a, b, why);
}

/* Solves at the middle of the parameters' ranges, for a method that knows no parameters. */
static imp_code solve_middle(imp_scene *scene, const arguments *args, imp_result *result,
                             imp_error *error)
{
    double *values = calloc(imp_scene_parameter_count(scene) + 1, sizeof *values);
    if (values == NULL) return error->code = IMP_ERROR_MEMORY;
    scene_values_middle(scene, values);
    imp_scene *posed = imp_scene_at(scene, values, error);
    const imp_code code =
        posed != NULL ? query_solve(posed, args, result, NULL, error) : error->code;
    imp_scene_free(posed);
    free(values);
    return code;
}

/* Solves for all values of the parameters, which a map such as `tolerance` brings along. */
static imp_code solve_scene(imp_scene *scene, const arguments *args, imp_result *result,
                            imp_error *error)
{
    if (!survey_is_needed(scene, args)) return query_solve(scene, args, result, NULL, error);
    if (arguments_choice(args, "method", 0) != 0) return solve_middle(scene, args, result, error);
    json_t *answer = NULL;
    const imp_code code = survey_solve(scene, args, result, &answer, error);
    json_decref(answer);
    return code;
}

/* Solves one pair; a failure is reported at once, with both names. */
static void solve(matrix *m, const char *a, const char *b, tally *t)
{
    imp_error error = {0};
    imp_result result;
    reading_limit_begin(m->args, NULL);
    imp_scene *scene = imp_scene_from_pair(m->registry, a, b, &error);
    reading_limit_end();
    const bool good = scene != NULL && solve_scene(scene, m->args, &result, &error) == IMP_SUCCESS;
    if (good) {
        count(t, &result);
        tell_cell(m, a, b, &result);
    } else {
        t->failed += 1;
        tell_failure(m, a, b, error.text);
    }
    imp_scene_free(scene);
}

static void tell_row(const matrix *m, const char *name, const tally *t)
{
    if (m->rows != NULL) return;
    printf("%-15s %5zu contact %5zu clear %5zu undecided %3zu failed %10llu pairs %8.3f s\n", name,
           t->contact, t->clear, t->undecided, t->failed, (unsigned long long)t->pairs, t->seconds);
}

/* Moves to the next type of that kind that is not shadowed. */
static bool next_type(const matrix *m, imp_type_kind kind, size_t *index, imp_type_info *info)
{
    while (imp_registry_type(m->registry, (*index)++, info))
        if (info->kind == kind && info->shadowed_by == NULL) return true;
    return false;
}

static void row_of_surface(matrix *m, const imp_type_info *a)
{
    imp_type_info b;
    tally t = {0};
    for (size_t k = 0; next_type(m, IMP_TYPE_SURFACE, &k, &b) && !interrupt_came();)
        solve(m, a->example, b.example, &t);
    tell_row(m, a->name, &t);
    add(&m->all, &t);
}

static void row_of_map(matrix *m, const imp_type_info *map)
{
    imp_type_info b;
    tally t = {0};
    for (size_t k = 0; next_type(m, IMP_TYPE_SURFACE, &k, &b) && !interrupt_came();) {
        char *moved;
        if (asprintf(&moved, "%s ! %s", b.example, map->example) < 0) continue;
        solve(m, moved, b.example, &t);
        free(moved);
    }
    char name[80];
    snprintf(name, sizeof name, "! %s", map->name);
    tell_row(m, name, &t);
    add(&m->all, &t);
}

static void tell_end(const matrix *m)
{
    tell_row(m, "all", &m->all);
    if (m->all.undecided > 0)
        puts("undecided: given up at the limit (--max-pairs and the like); --all shows which");
}

static exit_status finish(matrix *m)
{
    exit_status status = EXIT_ANSWERED;
    if (m->rows != NULL)
        status = output_json(
            json_pack("{s:o, s:I}", "cells", m->rows, "failed", (json_int_t)m->all.failed),
            m->args->verb->name);
    else
        tell_end(m);
    if (status != EXIT_ANSWERED) return status;
    if (m->all.failed > 0) return EXIT_PLUGIN;
    return interrupt_came() ? EXIT_UNDECIDED : EXIT_ANSWERED;
}

static exit_status run(const arguments *args)
{
    const exit_status checked = query_check(args);
    if (checked != EXIT_ANSWERED) return checked;
    imp_registry *registry = query_registry(args);
    if (registry == NULL) return EXIT_DATA;
    matrix m = {.registry = registry, .args = args};
    if (arguments_option(args, "json") != NULL) m.rows = json_array();
    imp_type_info info;
    interrupt_prepare();
    for (size_t k = 0; next_type(&m, IMP_TYPE_SURFACE, &k, &info) && !interrupt_came();)
        row_of_surface(&m, &info);
    for (size_t k = 0; next_type(&m, IMP_TYPE_MAP, &k, &info) && !interrupt_came();)
        row_of_map(&m, &info);
    const exit_status status = finish(&m);
    query_registry_free(registry);
    return status;
}

static const option own[] = {
    {.name = "all", .help = "print every pair, not only a line for each type"},
    {.name = NULL},
};
static const option *const tables[] = {
    own, options_search, options_query, options_registry, options_always, NULL};

const verb verb_matrix = {
    .name = "matrix",
    .operands = "",
    .summary = "Try every surface type against every other, and under every map",
    .details =
        "The examples of `impinge info` meet: each ordered pair of surface types, then, for each\n"
        "map, each surface under it against itself at rest. A failure names the two and ends\n"
        "with status 5; `undecided` is none: each pair has 10000 pairs of regions, unless\n"
        "--max-pairs says otherwise (0: no limit).\n",
    .example = "impinge matrix --gamma 1e-2 --max-pairs 2000",
    .operand_min = 0,
    .operand_max = 0,
    .max_pairs = 10000,
    .options = tables,
    .run = run};
