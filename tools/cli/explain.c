/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/explain_internal.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/result.h"

const explain_kind explain_kinds[IMP_OBSTACLES] = {
    [IMP_OBSTACLE_REMAINDER_A] = {CAUSE_REMAINDER, 0, "remainder_a", "the remainder of "},
    [IMP_OBSTACLE_REMAINDER_B] = {CAUSE_REMAINDER, 1, "remainder_b", "the remainder of "},
    [IMP_OBSTACLE_TIME_A] = {CAUSE_TIME, 0, "time_a", "the remainder in time of "},
    [IMP_OBSTACLE_TIME_B] = {CAUSE_TIME, 1, "time_b", "the remainder in time of "},
    [IMP_OBSTACLE_BOUNDS_A] = {CAUSE_BOUNDS, 0, "bounds_a", "no bounds from "},
    [IMP_OBSTACLE_BOUNDS_B] = {CAUSE_BOUNDS, 1, "bounds_b", "no bounds from "},
    [IMP_OBSTACLE_DISTANCE] = {CAUSE_DISTANCE, -1, "distance",
                               "they lie along each other, and no distance is known"},
    [IMP_OBSTACLE_RESOLUTION] = {CAUSE_RESOLUTION, -1, "resolution",
                                 "the resolution of double precision"},
    [IMP_OBSTACLE_SIZE] = {CAUSE_SIZE, -1, "size", "the size of the regions beside the gap"},
};

/* --- Reading ---------------------------------------------------------------------------------- */

static int by_divided(const void *x, const void *y)
{
    const imp_explanation *a = x, *b = y;
    if (a->divided != b->divided) return a->divided < b->divided ? 1 : -1;
    if (a->tested != b->tested) return a->tested < b->tested ? 1 : -1;
    for (int side = 0; side < 2; ++side) {
        if (a->body[side] != b->body[side]) return a->body[side] < b->body[side] ? -1 : 1;
        if (a->surface[side] != b->surface[side])
            return a->surface[side] < b->surface[side] ? -1 : 1;
    }
    return 0;
}

bool explain_query(const imp_query *query, const explain_asked *asked, explanation *e)
{
    imp_explanation row;
    size_t room = 0;
    *e = (explanation){.row = NULL};
    for (size_t k = 0; imp_query_explanation(query, k, &row); ++k) {
        e->is_counted = e->is_counted || row.tested > 0;
        if (row.divided == 0) continue;
        if (e->count == room) {
            room = 2 * room + 16;
            imp_explanation *grown = realloc(e->row, room * sizeof *grown);
            if (grown == NULL) return explain_free(e), false;
            e->row = grown;
        }
        e->row[e->count++] = row;
    }
    if (e->count > 0) qsort(e->row, e->count, sizeof *e->row, by_divided);
    explain_advise(asked, e);
    return true;
}

void explain_free(explanation *e)
{
    free(e->row);
    *e = (explanation){.row = NULL};
}

char *explain_advice(const imp_query *query, const explain_asked *asked)
{
    explanation e;
    if (!explain_query(query, asked, &e)) return NULL;
    char *advice = e.advice[0] != '\0' ? strdup(e.advice) : NULL;
    explain_free(&e);
    return advice;
}

explain_asked explain_asked_of_contact(const imp_scene *scene, const imp_result *result)
{
    return (explain_asked){scene, result->reason, EXPLAIN_CONTACT, NAN};
}

explain_asked explain_asked_of_clearance(const imp_scene *scene, const imp_clearance *answer)
{
    if (answer->verdict != IMP_REQUIREMENT_NONE)
        return (explain_asked){scene, answer->reason, EXPLAIN_REQUIREMENT, NAN};
    const bool is_bracket = answer->lower > 0 && answer->upper < INFINITY;
    return (explain_asked){scene, answer->reason, EXPLAIN_DISTANCE,
                           is_bracket ? 1 - answer->lower / answer->upper : NAN};
}

/* --- For people ------------------------------------------------------------------------------- */

enum { ROWS_PRINTED = 8 };

static void print_row(const imp_scene *scene, const imp_explanation *row)
{
    printf("    %8" PRIu64 " %8" PRIu64 "  ", row->tested, row->divided);
    for (int side = 0; side < 2; ++side)
        printf("%ssurface %zu of \"%s\" (%s)", side == 0 ? "" : " and ", row->surface[side],
               imp_scene_body_name(scene, row->body[side]), row->type[side]);
    putchar('\n');
    for (int k = 0; k < IMP_OBSTACLES; ++k) {
        const int side = explain_kinds[k].side;
        if (row->by[k] == 0) continue;
        printf("             %8" PRIu64 "    %s", row->by[k], explain_kinds[k].text);
        if (side >= 0) printf("%s, %s", side == 0 ? "a" : "b", row->type[side]);
        putchar('\n');
    }
}

void explain_print(const imp_scene *scene, const explanation *e)
{
    if (e->is_counted) {
        result_print_label("work");
        puts(e->count > 0 ? "pairs of regions tested, and those that nothing parted, by what "
                            "held them together"
                          : "each pair of regions tested was parted, or met, at once");
    }
    for (size_t k = 0; e->is_counted && k < e->count && k < ROWS_PRINTED; ++k)
        print_row(scene, &e->row[k]);
    if (e->is_counted && e->count > ROWS_PRINTED)
        printf("    and %zu more pairs of surfaces\n", e->count - ROWS_PRINTED);
    if (e->advice[0] == '\0') return;
    result_print_label("advice");
    puts(e->advice);
}

/* --- For programs ----------------------------------------------------------------------------- */

static json_t *side_json(const imp_scene *scene, const imp_explanation *row, int side)
{
    return json_pack("{s:o, s:I, s:o, s:b, s:b}", "body",
                     output_json_text(imp_scene_body_name(scene, row->body[side])), "surface",
                     (json_int_t)row->surface[side], "type", output_json_text(row->type[side]),
                     "has_inclusions", row->without_order_2[side] == NULL, "knows_distance",
                     row->knows_distance[side]);
}

static json_t *row_json(const imp_scene *scene, const imp_explanation *row)
{
    json_t *by = json_object();
    bool kept = by != NULL;
    for (int k = 0; kept && k < IMP_OBSTACLES; ++k)
        kept = json_object_set_new(by, explain_kinds[k].name,
                                   json_integer((json_int_t)row->by[k])) == 0;
    json_t *object = json_pack("{s:o, s:o, s:I, s:I}", "a", side_json(scene, row, 0), "b",
                               side_json(scene, row, 1), "tested", (json_int_t)row->tested,
                               "divided", (json_int_t)row->divided);
    if (kept && object != NULL && json_object_set(object, "by", by) == 0) {
        json_decref(by);
        return object;
    }
    json_decref(by);
    json_decref(object);
    return NULL;
}

bool explain_set_json(json_t *object, const imp_scene *scene, const explanation *e)
{
    json_t *list = json_array();
    bool kept = list != NULL;
    for (size_t k = 0; kept && k < e->count; ++k)
        kept = json_array_append_new(list, row_json(scene, &e->row[k])) == 0;
    if (kept && e->is_counted) kept = json_object_set(object, "explanation", list) == 0;
    kept = kept && result_set_advice(object, e->advice[0] != '\0' ? e->advice : NULL);
    json_decref(list);
    return kept;
}
