/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/explain.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output.h"
#include "tools/cli/result.h"

/* --- Advice ----------------------------------------------------------------------------------- */

/* An obstacle that took this part of the split pairs is to be removed first. */
static const double STANDS_OUT = 0.3;

/* What the obstacles have in common: which side's, and of which kind. */
typedef enum cause {
    CAUSE_REMAINDER,
    CAUSE_TIME,
    CAUSE_BOUNDS,
    CAUSE_DISTANCE,
    CAUSE_RESOLUTION,
    CAUSE_SIZE
} cause;

static const struct kind {
    cause cause;
    int side;
    const char *name, *text; /* of --json; for people, followed by the surface's type */
} kinds[IMP_OBSTACLES] = {
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

static void advise_on_remainder(const imp_explanation *row, int side, int part, explanation *e)
{
    const char *lacks = row->without_order_2[side], *type = row->type[side];
    if (lacks != NULL)
        snprintf(e->advice, sizeof e->advice,
                 "'%s' has no inclusions, and bounds by rates alone take far more pairs: give it "
                 "include (a map: apply), as <impinge/formula.h> does by itself",
                 lacks);
    else
        snprintf(e->advice, sizeof e->advice,
                 "the remainders of '%s' hold %d %% of these pairs together: `impinge check %s` "
                 "tells how much wider than necessary they are",
                 type, part, type);
}

/* What helps if no surface can be improved. */
static const struct resort {
    const char *resolution, *size;
} resorts[] = {
    [EXPLAIN_CONTACT] = {"raise --gamma, or lower --gamma-clear: the room between the two is near "
                         "the rounding errors",
                         "a larger --gamma takes fewer pairs"},
    [EXPLAIN_DISTANCE] = {"raise --tolerance: the bracket is near the rounding errors",
                          "a larger --tolerance takes fewer pairs"},
    [EXPLAIN_REQUIREMENT] = {"require a little more or less: the distance is within rounding "
                             "errors of what is required",
                             "a smaller --require takes fewer pairs"},
};

static void advise_on(const imp_explanation *row, imp_obstacle worst, explain_goal goal,
                      explanation *e)
{
    const int side = kinds[worst].side;
    const bool is_one_type = strcmp(row->type[0], row->type[1]) == 0;
    const int part = (int)(100 * (double)row->by[worst] / (double)row->divided);
    switch (kinds[worst].cause) {
    case CAUSE_REMAINDER:
        advise_on_remainder(row, side, part, e);
        break;
    case CAUSE_TIME:
        snprintf(
            e->advice, sizeof e->advice,
            "'%s' bends in time, which holds %d %% of these pairs together: give a map that is "
            "rigid its pose; else `impinge check` tells how wide the remainders are",
            row->type[side], part);
        break;
    case CAUSE_BOUNDS:
        snprintf(e->advice, sizeof e->advice,
                 "'%s' has no bounds over the regions of %d %% of these pairs "
                 "(IMP_STATUS_UNBOUNDED): shrink its domain, or bound it there",
                 row->type[side], part);
        break;
    case CAUSE_DISTANCE:
        snprintf(e->advice, sizeof e->advice,
                 "the surfaces lie along each other: if '%s'%s%s%s bounds the distance of points "
                 "(callback distance), one test parts what now takes many",
                 row->type[0], is_one_type ? "" : " or '", is_one_type ? "" : row->type[1],
                 is_one_type ? "" : "'");
        break;
    case CAUSE_RESOLUTION:
        snprintf(e->advice, sizeof e->advice, "%s", resorts[goal].resolution);
        break;
    case CAUSE_SIZE:
        snprintf(e->advice, sizeof e->advice,
                 "no bound of '%s'%s%s%s is to blame: the surfaces come near each other in many "
                 "places; %s",
                 row->type[0], is_one_type ? "" : " or '", is_one_type ? "" : row->type[1],
                 is_one_type ? "" : "'", resorts[goal].size);
        break;
    }
}

static imp_obstacle worst_of(const imp_explanation *row)
{
    imp_obstacle worst = IMP_OBSTACLE_SIZE;
    const double least = STANDS_OUT * (double)row->divided;
    for (int k = 0; k < IMP_OBSTACLE_SIZE; ++k) {
        const bool first = worst == IMP_OBSTACLE_SIZE && (double)row->by[k] >= least;
        if (first || (worst != IMP_OBSTACLE_SIZE && row->by[k] > row->by[worst]))
            worst = (imp_obstacle)k;
    }
    return worst;
}

/* Fewer pairs than these are no cost, or too few to judge by. */
enum { TESTED_FEW = 200, WAITING_FEW = 16 };

static void advise(imp_reason why, explain_goal goal, explanation *e)
{
    const imp_explanation *row = &e->row[0];
    const bool is_resolution = why == IMP_REASON_RESOLUTION;
    if (is_resolution && goal != EXPLAIN_CONTACT) { /* whose pairs are not kept */
        snprintf(e->advice, sizeof e->advice, "%s", resorts[goal].resolution);
        return;
    }
    if (e->count == 0 || (!is_resolution && !e->is_counted && row->divided < WAITING_FEW)) return;
    if (!is_resolution && e->is_counted && row->tested < TESTED_FEW)
        snprintf(e->advice, sizeof e->advice, "these are few pairs: there is nothing to mend");
    else
        advise_on(row, is_resolution ? IMP_OBSTACLE_RESOLUTION : worst_of(row), goal, e);
}

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

bool explain_query(const imp_query *query, imp_reason why, explain_goal goal, explanation *e)
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
    advise(why, goal, e);
    return true;
}

void explain_free(explanation *e)
{
    free(e->row);
    *e = (explanation){.row = NULL};
}

char *explain_advice(const imp_query *query, imp_reason why, explain_goal goal)
{
    explanation e;
    if (!explain_query(query, why, goal, &e)) return NULL;
    char *advice = e.advice[0] != '\0' ? strdup(e.advice) : NULL;
    explain_free(&e);
    return advice;
}

explain_goal explain_goal_of(imp_requirement verdict)
{
    return verdict == IMP_REQUIREMENT_NONE ? EXPLAIN_DISTANCE : EXPLAIN_REQUIREMENT;
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
        const int side = kinds[k].side;
        if (row->by[k] == 0) continue;
        printf("             %8" PRIu64 "    %s", row->by[k], kinds[k].text);
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
        kept = json_object_set_new(by, kinds[k].name, json_integer((json_int_t)row->by[k])) == 0;
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
