/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>

#include "tools/cli/clearance_measure.h"
#include "tools/cli/clearance_tell.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/query.h"
#include "tools/cli/survey_parts.h"
#include "tools/cli/verbs.h"

/* clearance --each and --profile of a scene with parameters (survey_parts.h). */

/* Returns the answer that stands for all that were not asked about, or are beyond --within. */
static imp_clearance rest_of(const measuring *m, bool is_beyond)
{
    imp_clearance rest = clearance_of_nothing(m);
    rest.reason = is_beyond          ? IMP_REASON_DECIDED
                  : interrupt_came() ? IMP_REASON_CANCELLED
                                     : IMP_REASON_SECONDS;
    rest.lower = is_beyond ? m->asked.within : 0;
    if (m->asked.required > 0 && !is_beyond) rest.verdict = IMP_REQUIREMENT_UNDECIDED;
    return rest;
}

/* --- Pairs of bodies -------------------------------------------------------------------------- */

/* Lists the answers that are there, the nearest first; behind them one for those that are not. The
 * caller frees the list. NULL: no memory. */
static imp_clearance *list_answers(measuring *m, const survey_parts *p, bool *has_rest)
{
    imp_clearance *list = calloc(p->count + 1, sizeof *list);
    size_t count = 0;
    for (size_t k = 0; list != NULL && k < p->count; ++k) {
        const imp_clearance *c = &p->nearest[k];
        if (c->struct_size == 0) {
            m->not_examined += 1;
            continue;
        }
        clearance_add_stats(&m->stats, &c->stats);
        if (m->asked.within > 0 && c->lower >= m->asked.within)
            m->beyond += 1;
        else
            list[count++] = *c;
    }
    if (list == NULL) return NULL;
    clearance_sort(list, count);
    *has_rest = m->not_examined > 0 || (count == 0 && m->beyond > 0);
    if (*has_rest) list[count] = rest_of(m, m->not_examined == 0);
    m->table.answers = list;
    m->table.count = count;
    return list;
}

static exit_status measure_each(measuring *m, survey_parts *p)
{
    imp_error error = {0};
    bool has_rest = false;
    json_object_seed(0); /* before there are threads */
    exit_status status = survey_parts_each(p, p->scene, &m->asked, m->args, query_threads(m->args));
    if (status != EXIT_ANSWERED) return status;
    if (survey_parts_run(p, &error) != IMP_SUCCESS) return complain_of(&error, m->args->verb->name);
    imp_clearance *list = list_answers(m, p, &has_rest);
    if (list == NULL) return complain_of_memory(m->args->verb->name);
    clearance_table shown = m->table;
    shown.count += has_rest;
    status = clearance_conclude(m, &shown);
    free(list);
    return status;
}

/* --- Slices ----------------------------------------------------------------------------------- */

/* Tells that slices from k on are not measured. */
static exit_status tell_rest(measuring *m, survey_parts *p, size_t k)
{
    p->rest = k;
    p->nearest[k] = rest_of(m, false);
    if (!survey_parts_are_over(p)) p->nearest[k].reason = IMP_REASON_PAIRS;
    if (p->over == SIZE_MAX) p->nearest[k].t_start = survey_parts_slice(p, k).lo;
    m->table.count += 1;
    return clearance_tell_slice(m);
}

static exit_status measure_slice(measuring *m, survey_parts *p, size_t k)
{
    imp_error error = {0};
    if (survey_parts_ask(p, k, &error) != IMP_SUCCESS)
        return complain_of(&error, m->args->verb->name);
    clearance_add_stats(&m->stats, &p->nearest[k].stats);
    m->table.count += 1;
    const exit_status status = clearance_tell_slice(m);
    return status == EXIT_ANSWERED ? output_flush(m->args->verb->name) : status;
}

static exit_status measure_slices(measuring *m, survey_parts *p)
{
    exit_status status = survey_parts_slices(p, p->scene, &m->asked, m->args);
    const uint64_t most = p->options.max_pairs; /* of all together */
    if (status != EXIT_ANSWERED) return status;
    m->table.answers = p->nearest;
    if (!m->json) clearance_print_csv_head(&m->table);
    for (size_t k = 0; k < p->count && p->rest == SIZE_MAX && status == EXIT_ANSWERED; ++k) {
        if (most > 0) p->options.max_pairs = most - m->stats.pairs;
        const bool is_spent = most > 0 && m->stats.pairs >= most;
        status = is_spent || survey_parts_are_over(p) ? tell_rest(m, p, k) : measure_slice(m, p, k);
    }
    return status == EXIT_ANSWERED ? clearance_conclude(m, &m->table) : status;
}

exit_status clearance_survey(imp_scene *scene, const imp_clearance_options *asked,
                             const arguments *args)
{
    survey_parts parts = {.scene = scene};
    measuring m = {.args = args,
                   .scene = scene,
                   .options = query_options(scene, args),
                   .asked = *asked,
                   .until = INFINITY,
                   .json = arguments_option(args, "json") != NULL,
                   .each = arguments_option(args, "each") != NULL,
                   .profile = arguments_option(args, "profile") != NULL};
    m.table = (clearance_table){.scene = scene, .survey = &parts, .ended = IMP_REASON_RUNNING};
    const exit_status status = m.each ? measure_each(&m, &parts) : measure_slices(&m, &parts);
    survey_parts_end(&parts);
    return status;
}
