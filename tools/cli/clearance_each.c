/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "core/common/clock.h"
#include "tools/cli/clearance.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/parts.h"

typedef struct filling {
    const clearance_each *of;
    imp_clearance *answers;   /* of the parts; all bytes 0: not there yet */
    atomic_size_t bytes;      /* of those that are there */
    _Atomic imp_reason ended; /* why parts were left out; NONE: none was */
} filling;

static void take(void *context, size_t index, imp_query *part)
{
    filling *f = context;
    imp_clearance *answer = &f->answers[index];
    answer->struct_size = (uint32_t)sizeof *answer;
    imp_clearance_get(part, 0, answer, NULL);
    atomic_fetch_add(&f->bytes, sizeof *answer);
}

/* The memory of answers counts, too: they are sorted, so that all are there before the first is
 * printed. */
static bool is_over(void *context)
{
    filling *f = context;
    const clearance_each *of = f->of;
    imp_reason reason = IMP_REASON_NONE;
    if (of->max_bytes > 0 && atomic_load(&f->bytes) > of->max_bytes) reason = IMP_REASON_MEMORY;
    if (clock_seconds() >= of->until) reason = IMP_REASON_SECONDS;
    if (interrupt_came()) reason = IMP_REASON_CANCELLED;
    if (reason != IMP_REASON_NONE) atomic_store(&f->ended, reason);
    return reason != IMP_REASON_NONE;
}

/* The answer for two bodies that are never both there or, where `reason` ended the search, for any
 * that were not examined. */
static imp_clearance answer_of_none(const clearance_each *of, imp_reason reason, size_t a, size_t b)
{
    const imp_result whole = imp_query_result(of->query);
    const bool ended = reason != IMP_REASON_NO_TIME;
    return (imp_clearance){.struct_size = (uint32_t)sizeof(imp_clearance),
                           .reason = reason,
                           .verdict = !(of->required > 0) ? IMP_REQUIREMENT_NONE
                                      : ended             ? IMP_REQUIREMENT_UNDECIDED
                                                          : IMP_REQUIREMENT_HOLDS,
                           .t_start = whole.t_start,
                           .t_end = whole.t_end,
                           .body = {a, b},
                           .lower = ended ? 0 : INFINITY,
                           .upper = INFINITY,
                           .t = NAN,
                           .required = of->required,
                           .t_violated = NAN};
}

static size_t pair_count(const imp_scene *scene)
{
    const size_t bodies = imp_scene_body_count(scene);
    size_t count = 0;
    for (size_t a = 0; a < bodies; ++a)
        for (size_t b = a + 1; b < bodies; ++b) count += !imp_scene_ignores(scene, a, b);
    return count;
}

/* Sums up the counters of all answers. */
static imp_stats sum(const imp_clearance *answers, size_t count, imp_stats all)
{
    for (size_t k = 0; k < count; ++k) {
        const imp_stats *s = &answers[k].stats;
        all.seconds += s->seconds;
        all.pairs += s->pairs;
        all.nodes += s->nodes;
        all.witness_searches += s->witness_searches;
        if (s->peak_heap > all.peak_heap) all.peak_heap = s->peak_heap;
        if (s->bytes > all.bytes) all.bytes = s->bytes;
    }
    return all;
}

/* Closes the gaps of parts without an answer. */
static void keep_answers(const filling *f, size_t parts, clearance_answers *found)
{
    for (size_t k = 0; k < parts; ++k)
        if (f->answers[k].struct_size != 0) found->list[found->count++] = f->answers[k];
}

/* Pairs of bodies that are never both there have no part. */
static imp_code add_absent(const clearance_each *of, size_t parts, clearance_answers *found)
{
    const size_t bodies = imp_scene_body_count(of->scene), pairs = pair_count(of->scene);
    size_t part = 0, body[2];
    if (pairs == parts) return IMP_SUCCESS;
    imp_clearance *grown =
        realloc(found->list, (found->count + pairs - parts + 1) * sizeof *found->list);
    if (grown == NULL) return IMP_ERROR_MEMORY;
    found->list = grown;
    for (size_t a = 0; a < bodies; ++a)
        for (size_t b = a + 1; b < bodies; ++b) {
            if (imp_scene_ignores(of->scene, a, b)) continue;
            if (imp_query_part_bodies(of->query, part, body) && body[0] == a && body[1] == b)
                part += 1;
            else
                found->list[found->count++] = answer_of_none(of, IMP_REASON_NO_TIME, a, b);
        }
    return IMP_SUCCESS;
}

/* What is known when no more parts are measured: where a limit came, one answer stands for the
 * rest. */
static imp_code conclude(filling *f, size_t parts, clearance_answers *found)
{
    const imp_result whole = imp_query_result(f->of->query);
    const imp_reason ended =
        whole.verdict == IMP_VERDICT_UNDECIDED ? whole.reason : atomic_load(&f->ended);
    imp_code code = IMP_SUCCESS;
    found->list = f->answers;
    keep_answers(f, parts, found);
    found->stats = sum(found->list, found->count, whole.stats);
    if (ended == IMP_REASON_NONE)
        code = add_absent(f->of, parts, found);
    else
        found->not_examined = pair_count(f->of->scene) - found->count;
    if (found->not_examined > 0)
        found->list[found->count] = answer_of_none(f->of, ended, SIZE_MAX, SIZE_MAX);
    return code;
}

imp_code clearance_each_run(const clearance_each *of, clearance_answers *found, imp_error *error)
{
    filling f = {.of = of, .ended = IMP_REASON_NONE};
    parts_plan plan = {.whole = of->query,
                       .threads = of->threads,
                       .take = take,
                       .is_over = is_over,
                       .context = &f};
    *found = (clearance_answers){.list = NULL};
    imp_code code = imp_query_divide(of->query, &plan.count, error);
    if (code != IMP_SUCCESS) return code;
    f.answers = calloc(plan.count + 1, sizeof *f.answers); /* takes memory as it is filled */
    if (f.answers == NULL) return error->code = IMP_ERROR_MEMORY;
    code = parts_run(&plan, error);
    found->list = f.answers;
    if (code == IMP_SUCCESS) code = error->code = conclude(&f, plan.count, found);
    return code;
}
