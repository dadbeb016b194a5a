/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/tune.h"

#ifndef IMP_TUNABLE

exit_status bench_tune(imp_registry *registry, const bench_request *request, const char *asked,
                       const bench_set *const *sets)
{
    (void)registry, (void)asked, (void)sets;
    return complain(EXIT_USAGE, request->verb,
                    "this command's constants are fixed; --tune needs the one that `make "
                    "tools/impinge-tunable` builds in a build folder of the sources");
}

#else

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/spelling.h"
#include "core/common/tunable.h"
#include "tools/bench/instructions.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"

/* --- One constant ----------------------------------------------------------------------------- */

typedef struct constant {
    const char *name; /* as asked, up to `length` */
    size_t length;
    int *integer;   /* its variable; */
    double *number; /* one of the two, or NULL both: not found */
    spelling_search near;
} constant;

static void offer(const char *name, int *integer, double *number, void *data)
{
    constant *c = data;
    spelling_offer(&c->near, name);
    if (strlen(name) != c->length || strncmp(name, c->name, c->length) != 0) return;
    c->name = name;
    c->integer = integer;
    c->number = number;
}

static exit_status find(const char *asked, const char *verb, constant *c)
{
    char wanted[SPELLING_NAME_MAX + 1];
    *c = (constant){.name = asked, .length = strcspn(asked, "=")};
    snprintf(wanted, sizeof wanted, "%.*s", (int)c->length, asked);
    c->near.wanted = wanted;
    tunables_visit(offer, c);
    if (c->integer != NULL || c->number != NULL) return EXIT_ANSWERED;
    if (c->near.best != NULL)
        return complain(EXIT_USAGE, verb, "unknown constant '%s', did you mean '%s'?", wanted,
                        c->near.best);
    return complain(EXIT_USAGE, verb, "unknown constant '%s'; core/bounds/tuning.h lists them",
                    wanted);
}

static double value_of(const constant *c) { return c->integer != NULL ? *c->integer : *c->number; }

static void set_value(const constant *c, double value)
{
    if (c->integer != NULL)
        *c->integer = (int)value;
    else
        *c->number = value;
}

/* --- The values to try ------------------------------------------------------------------------ */

enum { VALUES_MAX = 16, VALUE_MAX = 1000000000 };

typedef struct values {
    double value[VALUES_MAX];
    size_t count;
} values;

static bool is_allowed(const constant *c, double value)
{
    return value > 0 && value <= VALUE_MAX && (c->integer == NULL || value == floor(value));
}

/* Adds a value unless it is there. */
static bool add_value(values *all, double value)
{
    for (size_t k = 0; k < all->count; ++k)
        if (all->value[k] == value) return true;
    if (all->count == VALUES_MAX) return false;
    all->value[all->count++] = value;
    return true;
}

static exit_status read_values(const constant *c, const char *text, const char *verb, values *all)
{
    for (const char *at = text; *at != '\0'; at += *at == ',') {
        char *end;
        const double value = strtod(at, &end);
        if (end == at || (*end != ',' && *end != '\0') || !is_allowed(c, value))
            return complain(EXIT_USAGE, verb, "values of %s must be %s %s to %d, not '%s'", c->name,
                            c->integer != NULL ? "whole numbers from" : "numbers above",
                            c->integer != NULL ? "1" : "0 and up", VALUE_MAX, at);
        if (!add_value(all, value))
            return complain(EXIT_USAGE, verb, "--tune takes %d values at most", VALUES_MAX);
        at = end;
    }
    return EXIT_ANSWERED;
}

/* The values asked for. Without any: the usual one, half of it, and twice it or, where that is
 * above 1 and it is not, half-way to 1. */
static exit_status choose_values(const constant *c, const char *asked, const char *verb,
                                 values *all)
{
    const double usual = value_of(c);
    const char *text = strchr(asked, '=');
    *all = (values){.count = 0};
    if (text != NULL && text[1] != '\0') return read_values(c, text + 1, verb, all);
    const double half = c->integer != NULL ? floor(usual / 2) : usual / 2;
    add_value(all, usual);
    if (is_allowed(c, half)) add_value(all, half);
    add_value(all, usual < 1 && 2 * usual > 1 ? (1 + usual) / 2 : 2 * usual);
    return EXIT_ANSWERED;
}

/* --- Measuring -------------------------------------------------------------------------------- */

/* Sums over all scenes of a set. */
typedef struct sums {
    double pairs, nodes, searches, instructions;
} sums;

static exit_status measure_case(imp_registry *registry, const bench_request *request,
                                const bench_set *set, const bench_case *c, sums *all)
{
    imp_error error = {0};
    for (const bench_method *const *m = set->methods; *m != NULL; ++m) {
        bench_tally tally;
        if ((*m)->baseline != IMP_BASELINE_NONE) continue;
        const int counter = instructions_start();
        const imp_code code = bench_measure(registry, c, *m, request, &tally, &error);
        all->instructions += instructions_stop(counter);
        if (code != IMP_SUCCESS) return complain_of(&error, request->verb);
        const double scenes = (double)tally.scenes;
        all->pairs += scenes * tally.pairs.mean;
        all->nodes += scenes * tally.nodes.mean;
        all->searches += scenes * tally.searches.mean;
    }
    return EXIT_ANSWERED;
}

static exit_status measure_set(imp_registry *registry, const bench_request *request,
                               const bench_set *set, sums *all)
{
    bench_cases list = {0};
    *all = (sums){0};
    exit_status status = set->build(&list, request);
    for (size_t k = 0; k < list.count && status == EXIT_ANSWERED; ++k)
        status = measure_case(registry, request, set, &list.cases[k], all);
    bench_cases_free(&list);
    return status;
}

/* --- Telling ---------------------------------------------------------------------------------- */

static void print_change(double x, double first)
{
    if (!(first > 0))
        printf(" %9s", "-");
    else
        printf(" %+8.2f%%", 100 * (x / first - 1));
}

static void print_row(const bench_set *set, double value, const sums *x, const sums *first)
{
    printf("%-10s %12g %10.0f", set->name, value, x->pairs);
    print_change(x->pairs, first->pairs);
    printf(" %10.0f %8.0f", x->nodes, x->searches);
    if (isnan(x->instructions))
        printf(" %14s %9s\n", "-", "-");
    else {
        printf(" %14.0f", x->instructions);
        print_change(x->instructions, first->instructions);
        printf("\n");
    }
}

static exit_status sweep_set(imp_registry *registry, const bench_request *request,
                             const bench_set *set, const constant *c, const values *all)
{
    sums first, x;
    const double usual = value_of(c);
    exit_status status = EXIT_ANSWERED;
    for (size_t k = 0; k < all->count && status == EXIT_ANSWERED; ++k) {
        progress_show("%s: %s %g", set->name, c->name, all->value[k]);
        set_value(c, all->value[k]);
        status = measure_set(registry, request, set, &x);
        progress_wipe();
        if (status != EXIT_ANSWERED) break;
        if (k == 0) first = x;
        print_row(set, all->value[k], &x, &first);
        status = output_flush(request->verb);
    }
    set_value(c, usual);
    return status;
}

static void tell_of_counter(const char *verb)
{
    const int counter = instructions_start();
    if (!isnan(instructions_stop(counter))) return;
    remark(verb, "this machine has no counter of instructions; `valgrind --tool=cachegrind "
                 "--cache-sim=no` counts those of a run with one value");
}

exit_status bench_tune(imp_registry *registry, const bench_request *request, const char *asked,
                       const bench_set *const *sets)
{
    constant c;
    values all;
    exit_status status = find(asked, request->verb, &c);
    if (status == EXIT_ANSWERED) status = choose_values(&c, asked, request->verb, &all);
    if (status != EXIT_ANSWERED) return status;
    tell_of_counter(request->verb);
    printf("%s is %g. Sums over all scenes; changes against that value.\n\n", c.name, all.value[0]);
    printf("%-10s %12s %10s %9s %10s %8s %14s\n", "set", "value", "pairs", "", "nodes", "searches",
           "instructions");
    for (; *sets != NULL && status == EXIT_ANSWERED; ++sets)
        status = sweep_set(registry, request, *sets, &c, &all);
    return status;
}

#endif
