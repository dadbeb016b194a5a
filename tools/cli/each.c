/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/each_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/common/clock.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/query.h"
#include "tools/cli/result.h"
#include "tools/cli/verbs.h"

/* --- Their order ------------------------------------------------------------------------------ */

static int by_time(const void *p, const void *q)
{
    const timed *x = p, *y = q;
    if (x->t != y->t) return x->t < y->t ? -1 : 1;
    return x->part < y->part ? -1 : 1;
}

/* Sorts the new answers that are not clear, after those that are printed. */
static void collect_timed(printing *p)
{
    size_t waiting = 0;
    for (size_t k = 0; k < p->waiting_count; ++k) {
        const imp_result *r = &p->e->answers[p->waiting[k]];
        if (r->struct_size == 0)
            p->waiting[waiting++] = p->waiting[k];
        else if (r->verdict != IMP_VERDICT_CLEAR)
            p->order[p->count++] = (timed){r->t_lower, p->waiting[k]};
    }
    p->waiting_count = waiting;
    qsort(p->order + p->shown, p->count - p->shown, sizeof *p->order, by_time);
}

/* Prints those before the time up to which all others are clear. */
static bool advance(void *context, double t_lower)
{
    const each *e = context;
    printing *p = e->printing;
    const size_t before = p->shown;
    collect_timed(p);
    for (; p->shown < p->count && p->order[p->shown].t < t_lower; ++p->shown) {
        size_t body[2];
        const size_t part = p->order[p->shown].part;
        if (p->shown == before) progress_wipe();
        each_part_bodies(e, part, body);
        p->status = each_print_line(p, &e->answers[part], body[0], body[1]);
        if (p->status != EXIT_ANSWERED) return false;
    }
    if (p->shown > before) p->status = output_flush(e->args->verb->name);
    return p->status == EXIT_ANSWERED;
}

/* Whether the rest is only counted: with hundreds of millions of lines output would take longer
 * than the search. A list that is asked for has a tenth of the limit, and 0.1 s, after it. */
static bool only_counts(const printing *p)
{
    if (p->list_all) return interrupt_came() || clock_seconds() >= p->e->until_listed;
    return p->rest.verdict == IMP_VERDICT_UNDECIDED || each_is_over(p->e);
}

static bool is_unexamined(const imp_result *r)
{
    return r->struct_size == 0 || r->verdict == IMP_VERDICT_UNDECIDED;
}

/* Prints the line of a pair that has none yet; pairs that were not examined are counted. */
static exit_status print_or_count(printing *p, const imp_result *r, size_t a, size_t b)
{
    if (p->list_all) return each_print_line(p, r->struct_size > 0 ? r : &p->unknown, a, b);
    if (!is_unexamined(r)) return each_print_line(p, r, a, b);
    p->unexamined += 1;
    return EXIT_ANSWERED;
}

/* Counts the pairs that have no line, from this part on; `others` pairs without a part had their
 * turn. */
static void count_rest(printing *p, size_t part, size_t others)
{
    const each *e = p->e;
    const size_t left = imp_scene_pair_count(e->scene) - e->plan.count - others;
    for (; part < e->plan.count; ++part) {
        const imp_result *r = &e->answers[part];
        if (r->struct_size == 0)
            p->unexamined += 1;
        else
            p->clear += r->verdict == IMP_VERDICT_CLEAR;
    }
    *(is_unexamined(&p->rest) ? &p->unexamined : &p->clear) += left;
}

/* Prints the clear parts in the order of the scene. Parts without an answer were not examined. The
 * clock is read now and then. */
static exit_status print_clear(printing *p)
{
    enum { PAIRS_TO_LOOK = 256 };
    const each *e = p->e;
    const size_t bodies = imp_scene_body_count(e->scene), pairs = imp_scene_pair_count(e->scene);
    size_t part = 0, others = 0, looked = 0, of[2];
    exit_status status = EXIT_ANSWERED;
    for (size_t a = 0; a < bodies && part + others < pairs; ++a)
        for (size_t b = a + 1; b < bodies && status == EXIT_ANSWERED; ++b) {
            if (looked++ % PAIRS_TO_LOOK == 0 && only_counts(p)) {
                count_rest(p, part, others);
                return EXIT_ANSWERED;
            }
            const bool is_part = each_part_bodies(e, part, of) && of[0] == a && of[1] == b;
            const imp_result *r = is_part ? &e->answers[part] : &p->rest;
            if (!is_part && imp_scene_ignores(e->scene, a, b)) continue;
            part += is_part, others += !is_part;
            if (!is_part || r->struct_size == 0 || r->verdict == IMP_VERDICT_CLEAR)
                status = print_or_count(p, r, a, b);
        }
    return status;
}

static imp_reason reason_of_cut(const printing *p)
{
    if (interrupt_came()) return IMP_REASON_CANCELLED;
    return p->rest.verdict == IMP_VERDICT_UNDECIDED ? p->rest.reason : IMP_REASON_SECONDS;
}

/* Prints one line that counts all pairs of bodies without a line. */
static exit_status print_counts(printing *p)
{
    const imp_reason reason = reason_of_cut(p);
    if (p->clear + p->unexamined == 0) return EXIT_ANSWERED;
    if (p->unexamined > 0 && p->worst < EXIT_UNDECIDED) p->worst = EXIT_UNDECIDED;
    if (p->json)
        return output_json(json_pack("{s:{s:I, s:I}, s:o}", "not_listed", "clear",
                                     (json_int_t)p->clear, "not_examined",
                                     (json_int_t)p->unexamined, "reason",
                                     result_reason_json(reason)),
                           p->e->args->verb->name);
    if (p->clear > 0) printf("clear, and not listed: %zu pairs of bodies\n", p->clear);
    if (p->unexamined > 0)
        printf("not examined: %zu pairs of bodies (%s)%s\n", p->unexamined,
               result_excuse(reason).why,
               p->list_all ? "; there was no time to list them" : "; --list-all lists them");
    return EXIT_ANSWERED;
}

/* --- All -------------------------------------------------------------------------------------- */

static void printing_end(printing *p)
{
    for (size_t k = 0; p->names != NULL && k < imp_scene_body_count(p->e->scene); ++k)
        free(p->names[k]);
    free(p->names);
    free(p->head);
    free(p->waiting);
    free(p->order);
}

static exit_status printing_begin(printing *p, each *e)
{
    *p = (printing){.e = e,
                    .json = arguments_option(e->args, "json") != NULL,
                    .list_all = arguments_option(e->args, "list-all") != NULL,
                    .rest = each_answer_of_rest(e),
                    .waiting = calloc(e->plan.count + 1, sizeof *p->waiting),
                    .order = calloc(e->plan.count + 1, sizeof *p->order)};
    e->printing = p;
    p->unknown = p->rest;
    p->unknown.verdict = IMP_VERDICT_UNDECIDED;
    p->unknown.reason = interrupt_came() ? IMP_REASON_CANCELLED : IMP_REASON_SECONDS;
    p->unknown.t_lower = p->rest.t_start;
    if (p->waiting == NULL || p->order == NULL || (p->json && !each_prepare_lines(p)))
        return complain_of_memory(e->args->verb->name);
    for (; p->waiting_count < e->plan.count; ++p->waiting_count)
        p->waiting[p->waiting_count] = p->waiting_count;
    return EXIT_ANSWERED;
}

/* Prints the remaining lines once all answers are known. */
static exit_status print_rest(printing *p)
{
    advance(p->e, INFINITY);
    if (p->status == EXIT_ANSWERED) p->status = print_clear(p);
    if (p->status == EXIT_ANSWERED) p->status = print_counts(p);
    if (p->status == EXIT_ANSWERED) p->status = output_flush(p->e->args->verb->name);
    return p->status != EXIT_ANSWERED ? p->status : p->worst;
}

exit_status each_print(each *e)
{
    printing p;
    exit_status status = printing_begin(&p, e);
    if (status == EXIT_ANSWERED) status = print_rest(&p);
    printing_end(&p);
    return status;
}

/* Solves the parts, and prints each answer as soon as no other can come before it. */
static exit_status solve_and_print(each *e)
{
    printing p;
    imp_error error = {0};
    if (e->survey != NULL)
        return survey_parts_run(e->survey, &error) == IMP_SUCCESS
                   ? each_print(e)
                   : complain_of(&error, e->args->verb->name);
    exit_status status = printing_begin(&p, e);
    e->plan.advance = advance;
    if (status == EXIT_ANSWERED && parts_run(&e->plan, &error) != IMP_SUCCESS)
        status = complain_of(&error, e->args->verb->name);
    if (status == EXIT_ANSWERED) status = p.status == EXIT_ANSWERED ? print_rest(&p) : p.status;
    printing_end(&p);
    return status;
}

exit_status each_answer(imp_scene *scene, const arguments *args)
{
    each e;
    exit_status status = each_begin(&e, scene, args, query_threads(args));
    if (status == EXIT_ANSWERED) status = solve_and_print(&e);
    each_end(&e);
    return status;
}
