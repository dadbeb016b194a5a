/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include "tools/cli/output.h"

static json_t *spread_json(const bench_spread *s)
{
    return json_pack("{s:f, s:f, s:f}", "mean", s->mean, "median", s->median, "max", s->max);
}

static json_t *verdicts_json(const bench_tally *t)
{
    return json_pack("{s:I, s:I, s:I}", "contact", (json_int_t)t->verdicts[IMP_VERDICT_CONTACT],
                     "clear", (json_int_t)t->verdicts[IMP_VERDICT_CLEAR], "undecided",
                     (json_int_t)t->verdicts[IMP_VERDICT_UNDECIDED]);
}

static json_t *reference_json(const bench_tally *t)
{
    if (t->references == 0) return json_null();
    return json_pack("{s:I, s:I, s:o, s:o}", "scenes", (json_int_t)t->references, "agreed",
                     (json_int_t)t->agreed, "earliest", output_json_number(t->earliest), "latest",
                     output_json_number(t->latest));
}

static json_t *ratio_json(const bench_tally *t, const bench_row *baseline)
{
    if (baseline == NULL) return json_null();
    return json_pack("{s:o, s:o}", "pairs",
                     output_json_number(baseline->tally.pairs.mean / t->pairs.mean), "seconds",
                     output_json_number(baseline->tally.seconds.mean / t->seconds.mean));
}

/* NULL: the case has no goals. */
static json_t *goal_json(const bench_result *result, size_t row)
{
    static const char *const words[] = {[BENCH_GOAL_NONE] = "not measured",
                                        [BENCH_GOAL_REACHED] = "reached",
                                        [BENCH_GOAL_MISSED] = "missed",
                                        [BENCH_GOAL_OPEN] = "open",
                                        [BENCH_GOAL_REACHED_NOW] = "reached now"};
    if (result->about->goal[row] == 0) return NULL;
    return json_pack("{s:I, s:s}", "pairs", (json_int_t)result->about->goal[row], "outcome",
                     words[bench_goal_of(result, row)]);
}

/* NULL: there is no kernel. */
static json_t *kernel_json(const bench_certificates *c)
{
    if (!c->has_kernel) return NULL;
    return json_pack("{s:I, s:I, s:o*}", "elaborated", (json_int_t)c->elaborated, "proved",
                     (json_int_t)c->proved, "seconds",
                     c->elaborated > 0 ? spread_json(&c->kernel) : NULL);
}

/* NULL: there are none. */
static json_t *certificates_json(const bench_tally *t)
{
    const bench_certificates *c = &t->certificates;
    if (c->count == 0) return NULL;
    return json_pack("{s:I, s:I, s:o, s:o, s:o, s:o, s:o*}", "count", (json_int_t)c->count, "hold",
                     (json_int_t)c->hold, "bytes", spread_json(&c->bytes), "bytes_a_pair",
                     output_json_number(c->bytes.mean / t->pairs.mean), "verify_seconds",
                     spread_json(&c->seconds), "verify_over_solve",
                     output_json_number(bench_verify_over_solve(t)), "kernel", kernel_json(c));
}

static json_t *row_json(const bench_result *result, size_t at)
{
    const bench_row *row = &result->rows[at], *baseline = result->baseline;
    const bench_tally *t = &row->tally;
    json_t *processor = row->method->question == BENCH_STREAM ? json_real(t->processor) : NULL;
    return json_pack("{s:s, s:o, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o*, s:o*, s:o*}",
                     "method", row->method->name, "verdicts", verdicts_json(t), "ended",
                     (json_int_t)t->ended, "pairs", spread_json(&t->pairs), "nodes",
                     spread_json(&t->nodes), "witness_searches", spread_json(&t->searches),
                     "peak_heap", spread_json(&t->heap), "bytes", spread_json(&t->bytes), "seconds",
                     spread_json(&t->seconds), "ratio", ratio_json(t, baseline), "reference",
                     reference_json(t), "processor_seconds", processor, "goal",
                     goal_json(result, at), "certificates", certificates_json(t));
}

json_t *bench_result_json(const bench_result *result)
{
    const bench_case *c = result->about;
    json_t *rows = json_array();
    for (size_t k = 0; k < result->row_count; ++k)
        if (json_array_append_new(rows, row_json(result, k)) != 0) {
            json_decref(rows);
            return NULL;
        }
    return json_pack("{s:s, s:f, s:I, s:o}", "case", c->name, "gamma", c->gamma, "scenes",
                     (json_int_t)(c->count + c->steps), "methods", rows);
}

json_t *bench_set_json(const bench_set *set, json_t *results, const bench_finding *findings,
                       size_t count)
{
    json_t *object = json_object();
    for (size_t k = 0; k < count; ++k)
        if (json_object_set_new(object, findings[k].key, output_json_number(findings[k].value)) !=
            0) {
            json_decref(object);
            object = NULL;
        }
    return json_pack("{s:s, s:s, s:o, s:o}", "set", set->name, "about", set->about, "cases",
                     results, "findings", object);
}
