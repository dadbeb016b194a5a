/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/clearance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/result.h"

const char *clearance_verdict_name(imp_requirement verdict)
{
    switch (verdict) {
    case IMP_REQUIREMENT_HOLDS:
        return "holds";
    case IMP_REQUIREMENT_VIOLATED:
        return "violated";
    case IMP_REQUIREMENT_UNDECIDED:
        return "undecided";
    case IMP_REQUIREMENT_NONE:
        break;
    }
    return NULL;
}

/* Takes over `value`; 0: done. */
static int set(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value);
}

static int set_required(json_t *object, const imp_scene *scene, const imp_clearance *r)
{
    if (r->verdict == IMP_REQUIREMENT_NONE) return 0;
    int failed = set(object, "verdict", json_string(clearance_verdict_name(r->verdict)));
    failed |= set(object, "required", output_json_number(r->required));
    if (r->verdict != IMP_REQUIREMENT_VIOLATED) return failed;
    const bool known = !isnan(r->t_violated);
    failed |= set(object, "t_violated", output_json_number(r->t_violated));
    failed |=
        set(object, "a_violated", known ? result_side_json(scene, &r->a_violated) : json_null());
    failed |=
        set(object, "b_violated", known ? result_side_json(scene, &r->b_violated) : json_null());
    return failed;
}

static json_t *pair_json(const imp_scene *scene, const size_t body[2])
{
    return json_pack("[o,o]", output_json_text(imp_scene_body_name(scene, body[0])),
                     output_json_text(imp_scene_body_name(scene, body[1])));
}

static json_t *checked(json_t *object, int failed)
{
    if (!failed) return object;
    json_decref(object);
    return NULL;
}

json_t *clearance_json(const imp_scene *scene, const imp_clearance *r)
{
    json_t *object = json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "reason", result_reason_json(r->reason),
        "time", result_times_json(r->t_start, r->t_end), "lower", output_json_number(r->lower),
        "upper", output_json_number(r->upper), "t", output_json_number(r->t), "a",
        r->has_witness ? result_side_json(scene, &r->a) : json_null(), "b",
        r->has_witness ? result_side_json(scene, &r->b) : json_null(), "normal",
        r->has_normal ? result_vector_json(r->normal) : json_null(), "stats",
        result_stats_json(&r->stats));
    if (object == NULL) return NULL;
    int failed = set_required(object, scene, r);
    if (r->kind == IMP_CONTACT_INSIDE)
        failed |= set(object, "kind", json_string(result_kind_name(r->kind)));
    if (r->body[0] != SIZE_MAX) failed |= set(object, "bodies", pair_json(scene, r->body));
    return checked(object, failed);
}

/* Adds what answer k of a survey says of values: all of it, but nothing where it is not there. */
static int set_values(json_t *object, const clearance_table *table, size_t k)
{
    if (table->survey == NULL || table->survey->answers[k].state.struct_size == 0) return 0;
    return survey_parts_set_json(object, table->survey, k);
}

/* Adds the range of the parameter that is sliced. */
static int set_over(json_t *object, const clearance_table *table, size_t k)
{
    imp_scene_parameter_info info;
    if (table->survey == NULL || !imp_scene_parameter(table->scene, table->survey->over, &info))
        return 0;
    const value_range slice = survey_parts_slice(table->survey, k);
    json_t *over = json_object();
    int failed = over == NULL || set(over, info.name, result_times_json(slice.lo, slice.hi)) != 0;
    return set(object, "over", over) != 0 || failed;
}

json_t *clearance_slice_json(const clearance_table *table, size_t k, const imp_clearance *r)
{
    const imp_scene *scene = table->scene;
    json_t *object =
        json_pack("{s:o, s:o, s:o, s:o, s:o}", "t0", output_json_number(r->t_start), "t1",
                  output_json_number(r->t_end), "lower", output_json_number(r->lower), "upper",
                  output_json_number(r->upper), "t", output_json_number(r->t));
    if (object == NULL) return NULL;
    int failed = 0;
    if (r->verdict != IMP_REQUIREMENT_NONE)
        failed |= set(object, "verdict", json_string(clearance_verdict_name(r->verdict)));
    if (r->has_witness)
        failed |= set(object, "bodies", pair_json(scene, (size_t[]){r->a.body, r->b.body}));
    failed |= set_over(object, table, k) | set_values(object, table, k);
    return checked(object, failed);
}

static json_t *answer_json(const clearance_table *table, const imp_clearance *answer)
{
    json_t *object = clearance_json(table->scene, answer);
    const char *advice = clearance_table_advice(table, answer);
    int failed = object == NULL || !result_set_advice(object, advice);
    if (!failed && table->survey != NULL && answer->body[0] != SIZE_MAX)
        failed = set_values(object, table, survey_parts_find(table->survey, answer->body));
    return checked(object, failed);
}

exit_status clearance_print_json(json_t *object, const clearance_table *table, bool slices,
                                 const char *verb)
{
    enum { ANSWERS_TO_FLUSH = 1024 };
    const bool ended = interrupt_came();
    size_t k = 0;
    char *line = output_json_line(object);
    if (line == NULL) return output_line(line, verb);
    printf("%.*s,\"%s\":[", (int)strlen(line) - 1, line, slices ? "slices" : "pairs");
    free(line);
    for (; k < table->count && interrupt_came() == ended; ++k) {
        const imp_clearance answer = clearance_table_get(table, k);
        line = output_json_line(slices ? clearance_slice_json(table, k, &answer)
                                       : answer_json(table, &answer));
        if (line == NULL) return output_line(line, verb);
        printf("%s%s", k > 0 ? "," : "", line);
        free(line);
        if (k % ANSWERS_TO_FLUSH == ANSWERS_TO_FLUSH - 1 && output_flush(verb) != EXIT_ANSWERED)
            return EXIT_DATA;
    }
    puts("]}");
    const exit_status status = output_flush(verb);
    if (status != EXIT_ANSWERED || k == table->count) return status;
    remark(verb, "interrupted: the last %zu of %zu %s were not printed", table->count - k,
           table->count, slices ? "slices" : "pairs of bodies");
    return EXIT_UNDECIDED;
}
