/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdio.h>

#include "core/common/clock.h"
#include "tools/cli/clearance_measure.h"
#include "tools/cli/clearance_tell.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/proof_output.h"
#include "tools/cli/query.h"
#include "tools/cli/verbs.h"

/* Runs the query of `impinge clearance` and prints its answers, slices as soon as they are
 * there. */

/* Pairs between two checks for finished answers: some milliseconds. */
#define STEP_PAIRS 2048

/* --- While it runs ---------------------------------------------------------------------------- */

/* Adds the next answer to the table. */
static exit_status take_answer(measuring *m)
{
    m->table.count += 1;
    return m->profile ? clearance_tell_slice(m) : EXIT_ANSWERED;
}

/* Whether the answer is final: it is not running, and no limit has ended it. */
static bool is_there(const imp_clearance *answer)
{
    return answer->reason != IMP_REASON_RUNNING &&
           (answer->reason == IMP_REASON_RESOLUTION || !clearance_is_ended(answer->reason));
}

/* Slices that are printed as JSON are printed once more at the end. */
static bool is_over(const measuring *m)
{
    return interrupt_came() || clock_seconds() + (m->json ? m->printing : 0) >= m->until;
}

/* Takes the finished answers, as long as there is time. */
static exit_status take_answers(measuring *m)
{
    enum { ANSWERS_A_LOOK = 64 };
    const double start = clock_seconds() - m->printing;
    const size_t count = imp_clearance_count(m->query);
    exit_status status = EXIT_ANSWERED;
    while (status == EXIT_ANSWERED && m->table.count < count) {
        const imp_clearance next = clearance_table_get(&m->table, m->table.count);
        if (!is_there(&next)) break;
        if (m->table.count % ANSWERS_A_LOOK == ANSWERS_A_LOOK - 1 && is_over(m)) break;
        status = take_answer(m);
        m->printing = clock_seconds() - start;
    }
    return status == EXIT_ANSWERED ? output_flush(m->args->verb->name) : status;
}

/* Takes the rest after a limit or a signal: the current answer, and one for all that follow. */
static exit_status take_rest(measuring *m)
{
    const size_t count = imp_clearance_count(m->query);
    exit_status status = EXIT_ANSWERED;
    if (m->table.count == count) return EXIT_ANSWERED;
    imp_clearance next = clearance_table_get(&m->table, m->table.count);
    if (next.stats.pairs > 0 || next.lower > 0) status = take_answer(m);
    if (status != EXIT_ANSWERED || m->table.count == count) return status;
    next = clearance_table_get(&m->table, m->table.count);
    const double required = m->asked.required;
    m->table.has_rest = true;
    m->table.rest =
        (imp_clearance){.reason = m->table.ended,
                        .verdict = required > 0 ? IMP_REQUIREMENT_UNDECIDED : IMP_REQUIREMENT_NONE,
                        .t_start = next.t_start,
                        .t_end = m->options.t_end,
                        .required = required,
                        .body = {SIZE_MAX, SIZE_MAX},
                        .upper = INFINITY,
                        .t = NAN,
                        .t_violated = NAN};
    return take_answer(m);
}

static exit_status run_query(measuring *m)
{
    imp_error error = {0};
    imp_reason reason = IMP_REASON_RUNNING;
    exit_status status = EXIT_ANSWERED;
    while (reason == IMP_REASON_RUNNING && status == EXIT_ANSWERED && !is_over(m)) {
        if (imp_query_step(m->query, STEP_PAIRS, &error) != IMP_SUCCESS)
            return complain_of(&error, m->args->verb->name);
        reason = imp_query_result(m->query).reason;
        status = take_answers(m);
    }
    const bool is_ended = reason != IMP_REASON_RUNNING && reason != IMP_REASON_NONE;
    m->table.ended = interrupt_came() ? IMP_REASON_CANCELLED
                     : is_ended       ? reason
                                      : IMP_REASON_SECONDS;
    return status == EXIT_ANSWERED ? take_rest(m) : status;
}

/* --- At the end ------------------------------------------------------------------------------- */

static exit_status measure_each(measuring *m)
{
    imp_error error = {0};
    json_object_seed(0); /* before there are threads */
    const clearance_each of = {.scene = m->scene,
                               .query = m->query,
                               .required = m->asked.required,
                               .within = m->asked.within,
                               .threads = query_threads(m->args),
                               .max_bytes = m->options.max_bytes,
                               .until = m->until};
    clearance_answers found;
    const imp_code code = clearance_each_run(&of, &found, &error);
    m->beyond = found.beyond, m->not_examined = found.not_examined, m->stats = found.stats;
    clearance_sort(found.list, found.count);
    m->table.answers = found.list, m->table.count = found.count;
    m->table.advice = found.advice, m->table.advice_count = found.advice_count;
    clearance_table shown = m->table;
    shown.count += found.has_rest;
    const exit_status status = code == IMP_SUCCESS ? clearance_conclude(m, &shown)
                                                   : complain_of(&error, m->args->verb->name);
    clearance_answers_free(&found);
    return status;
}

/* Keeps the advice about a search that a limit ended. */
static exit_status explain(measuring *m)
{
    const imp_clearance all =
        m->table.count > 0 ? clearance_summary(&m->table) : clearance_of_nothing(m);
    const explain_asked asked = explain_asked_of_clearance(m->scene, &all);
    if (!clearance_is_undecided(&all)) return EXIT_ANSWERED;
    return explain_query(m->query, &asked, &m->why) ? EXIT_ANSWERED
                                                    : complain_of_memory(m->args->verb->name);
}

static exit_status measure(measuring *m)
{
    if (m->profile && !m->json) clearance_print_csv_head(&m->table);
    exit_status status = run_query(m);
    m->stats = imp_query_result(m->query).stats;
    if (status == EXIT_ANSWERED) status = proof_output_write(m->query, m->scene, m->args);
    if (status == EXIT_ANSWERED) status = explain(m);
    if (status == EXIT_ANSWERED) status = clearance_conclude(m, &m->table);
    explain_free(&m->why);
    return status;
}

exit_status clearance_measure(imp_scene *scene, const imp_clearance_options *asked,
                              const arguments *args)
{
    imp_error error = {0};
    const imp_options options = query_options(scene, args);
    measuring m = {.args = args,
                   .scene = scene,
                   .options = options,
                   .asked = *asked,
                   .until =
                       options.max_seconds > 0 ? clock_seconds() + options.max_seconds : INFINITY,
                   .json = arguments_option(args, "json") != NULL,
                   .each = arguments_option(args, "each") != NULL,
                   .profile = arguments_option(args, "profile") != NULL};
    m.query = imp_clearance_new(scene, &options, &m.asked, &error);
    if (m.query == NULL) return complain_of(&error, args->verb->name);
    m.table = (clearance_table){.scene = scene, .query = m.query, .ended = IMP_REASON_RUNNING};
    exit_status status = proof_output_begin(m.query, args);
    if (status == EXIT_ANSWERED) status = m.each ? measure_each(&m) : measure(&m);
    imp_query_free(m.query);
    return status;
}
