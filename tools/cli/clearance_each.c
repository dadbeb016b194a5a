/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>

#include "tools/cli/clearance.h"
#include "tools/cli/parts.h"

typedef struct filling {
    imp_clearance *answers;
    size_t *place; /* of each part's answer */
} filling;

static void take(void *context, size_t index, imp_query *part)
{
    const filling *f = context;
    imp_clearance *answer = &f->answers[f->place[index]];
    answer->struct_size = (uint32_t)sizeof *answer;
    imp_clearance_read(part, 0, answer, NULL);
}

/* Of two bodies that are never both there; or, where a limit came before anything was searched, of
 * any two. */
static imp_clearance answer_of_none(const clearance_each *of, const imp_result *whole, size_t a,
                                    size_t b)
{
    const bool ended = whole->verdict == IMP_UNDECIDED;
    return (imp_clearance){.reason = ended ? whole->reason : IMP_REASON_NO_TIME,
                           .verdict = !(of->required > 0) ? IMP_REQUIREMENT_NONE
                                      : ended             ? IMP_REQUIREMENT_UNDECIDED
                                                          : IMP_REQUIREMENT_HOLDS,
                           .t_start = whole->t_start,
                           .t_end = whole->t_end,
                           .body = {a, b},
                           .lower = ended ? 0 : INFINITY,
                           .upper = INFINITY,
                           .t = NAN,
                           .required = of->required,
                           .t_violated = NAN};
}

/* One answer for each pair of bodies that do not ignore each other, as if none had a part. */
static void prepare(const clearance_each *of, filling *f)
{
    const imp_result whole = imp_query_result(of->query);
    const size_t bodies = imp_scene_body_count(of->scene);
    size_t count = 0, part = 0, body[2];
    for (size_t a = 0; a < bodies; ++a)
        for (size_t b = a + 1; b < bodies; ++b) {
            if (imp_scene_ignores(of->scene, a, b)) continue;
            if (imp_query_part_bodies(of->query, part, body) && body[0] == a && body[1] == b)
                f->place[part++] = count;
            f->answers[count++] = answer_of_none(of, &whole, a, b);
        }
}

static size_t pair_count(const imp_scene *scene)
{
    const size_t bodies = imp_scene_body_count(scene);
    size_t count = 0;
    for (size_t a = 0; a < bodies; ++a)
        for (size_t b = a + 1; b < bodies; ++b) count += !imp_scene_ignores(scene, a, b);
    return count;
}

/* Of all answers together. */
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

imp_code clearance_each_run(const clearance_each *of, imp_clearance **answers, size_t *count,
                            imp_stats *stats, imp_error *error)
{
    filling f = {NULL, NULL};
    parts_plan plan = {.whole = of->query, .threads = of->threads, .take = take, .context = &f};
    imp_code code = imp_query_divide(of->query, &plan.count, error);
    if (code != IMP_SUCCESS) return code;
    *count = pair_count(of->scene);
    f.answers = calloc(*count + 1, sizeof *f.answers);
    f.place = calloc(plan.count + 1, sizeof *f.place);
    if (f.answers == NULL || f.place == NULL) {
        code = error->code = IMP_ERROR_MEMORY;
    } else {
        prepare(of, &f);
        code = parts_run(&plan, error);
    }
    if (code == IMP_SUCCESS) {
        *stats = sum(f.answers, *count, imp_query_result(of->query).stats);
        *answers = f.answers;
    } else {
        free(f.answers);
    }
    free(f.place);
    return code;
}
