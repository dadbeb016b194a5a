/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/survey_explain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/message.h"
#include "tools/cli/output.h"
#include "tools/cli/result.h"
#include "tools/cli/survey_boxes.h"

/* Rows of text; JSON has all. */
#define ROWS_PRINTED 10

typedef struct survey_costs {
    imp_survey_cost *row; /* those with most boxes first */
    size_t count;
    uint64_t *cuts; /* of each parameter */
    uint64_t boxes, halved;
} survey_costs;

static int by_boxes(const void *x, const void *y)
{
    const imp_survey_cost *a = x, *b = y;
    if (a->boxes != b->boxes) return a->boxes > b->boxes ? -1 : 1;
    if (a->body[0] != b->body[0]) return a->body[0] < b->body[0] ? -1 : 1;
    return a->body[1] < b->body[1] ? -1 : a->body[1] > b->body[1];
}

static void costs_free(survey_costs *c)
{
    free(c->row);
    free(c->cuts);
}

/* False: no memory; *c is to be freed in any case. */
static bool costs_read(const imp_scene *scene, const imp_survey *survey, survey_costs *c)
{
    const size_t parameters = imp_scene_parameter_count(scene);
    imp_survey_state state = {.struct_size = (uint32_t)sizeof state};
    imp_survey_get_state(survey, &state, NULL);
    *c = (survey_costs){.row = calloc(state.pairs_of_bodies + 1, sizeof *c->row),
                        .cuts = calloc(parameters + 1, sizeof *c->cuts)};
    if (c->row == NULL || c->cuts == NULL) return false;
    imp_survey_cuts(survey, c->cuts);
    for (size_t k = 0; k < parameters; ++k) c->halved += c->cuts[k];
    for (size_t k = 0; k < state.pairs_of_bodies; ++k) {
        imp_survey_cost *row = &c->row[c->count++];
        row->struct_size = (uint32_t)sizeof *row;
        imp_survey_get_cost(survey, k, row, NULL);
        c->boxes += row->boxes;
    }
    qsort(c->row, c->count, sizeof *c->row, by_boxes);
    return true;
}

/* Returns the parameter along which boxes were halved most; the count of parameters: none was. */
static size_t most_halved(const imp_scene *scene, const survey_costs *c)
{
    const size_t count = imp_scene_parameter_count(scene);
    size_t best = count;
    for (size_t k = 0; k < count; ++k)
        if (c->cuts[k] > (best < count ? c->cuts[best] : 0)) best = k;
    return best;
}

/* What takes fewer boxes than it does, beside narrower ranges. */
static const char *const lighter[] = {
    [EXPLAIN_CONTACT] = "more room between --gamma-clear and --gamma",
    [EXPLAIN_DISTANCE] = "a larger --tolerance, or --require D",
    [EXPLAIN_REQUIREMENT] = "a smaller --require",
};

/* Writes a sentence about what would help; empty: nothing is known to help. A range that a map has
 * of its own, whose name has a '#', is not one that --parameter sets. */
static void advise(const imp_scene *scene, const survey_costs *c, explain_goal goal, char *text,
                   size_t size)
{
    imp_scene_parameter_info info;
    text[0] = '\0';
    if (!imp_scene_parameter(scene, most_halved(scene, c), &info)) return;
    snprintf(
        text, size,
        "boxes were halved along '%.80s' most often: a narrower range of it (%s), or %s, takes "
        "fewer",
        message_shown(info.name).text,
        strchr(info.name, '#') != NULL ? "which a map has of its own: impinge-scene(5)"
                                       : "--parameter",
        lighter[goal]);
}

enum { ADVICE_BYTES = 512 };

/* --- For people ------------------------------------------------------------------------------- */

static void print_rows(const imp_scene *scene, const survey_costs *c)
{
    for (size_t k = 0; k < c->count && k < ROWS_PRINTED && c->row[k].boxes > 0; ++k) {
        const imp_survey_cost *row = &c->row[k];
        result_print_label(k == 0 ? "where" : "");
        printf("%.3g %% of the boxes, %ju pairs, %.3g %% proved: ",
               100.0 * (double)row->boxes / (double)c->boxes, (uintmax_t)row->pairs,
               100.0 * row->proved);
        if (row->body[0] == SIZE_MAX)
            puts("bodies that no parameter moves");
        else
            printf("%s, %s\n", imp_scene_body_name(scene, row->body[0]),
                   imp_scene_body_name(scene, row->body[1]));
    }
}

static void print_halved(const imp_scene *scene, const survey_costs *c)
{
    imp_scene_parameter_info info;
    if (c->halved == 0) return;
    result_print_label("halved");
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        printf("%s%s: %ju", k > 0 ? ", " : "", message_shown(info.name).text,
               (uintmax_t)c->cuts[k]);
    putchar('\n');
}

bool survey_explain_print(const imp_scene *scene, const imp_survey *survey, survey_explaining what)
{
    survey_costs c;
    char advice[ADVICE_BYTES] = "";
    const bool read = costs_read(scene, survey, &c);
    if (read && what.table) print_rows(scene, &c);
    if (read && what.table) print_halved(scene, &c);
    if (read && what.advice) advise(scene, &c, what.goal, advice, sizeof advice);
    if (advice[0] != '\0') {
        result_print_label("advice");
        puts(advice);
    }
    costs_free(&c);
    return read;
}

/* --- For programs ----------------------------------------------------------------------------- */

static json_t *rows_json(const imp_scene *scene, const survey_costs *c)
{
    json_t *list = json_array();
    for (size_t k = 0; k < c->count; ++k) {
        const imp_survey_cost *row = &c->row[k];
        json_t *item =
            json_pack("{s:o, s:I, s:I, s:o}", "bodies", survey_bodies_json(scene, row->body),
                      "boxes", (json_int_t)row->boxes, "pairs", (json_int_t)row->pairs, "proved",
                      output_json_number(row->proved));
        if (json_array_append_new(list, item) != 0) return json_decref(list), NULL;
    }
    return list;
}

static json_t *halved_json(const imp_scene *scene, const survey_costs *c)
{
    imp_scene_parameter_info info;
    json_t *object = json_object();
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        if (json_object_set_new(object, info.name, json_integer((json_int_t)c->cuts[k])) != 0)
            return json_decref(object), NULL;
    return object;
}

static bool set_table(json_t *object, const imp_scene *scene, const survey_costs *c)
{
    return json_object_set_new(object, "survey",
                               json_pack("{s:o, s:o}", "bodies", rows_json(scene, c), "halved",
                                         halved_json(scene, c))) == 0;
}

bool survey_explain_set_json(json_t *object, const imp_scene *scene, const imp_survey *survey,
                             survey_explaining what)
{
    survey_costs c;
    char advice[ADVICE_BYTES] = "";
    bool done = costs_read(scene, survey, &c);
    if (done && what.table) done = set_table(object, scene, &c);
    if (done && what.advice) advise(scene, &c, what.goal, advice, sizeof advice);
    if (done) done = result_set_advice(object, advice[0] != '\0' ? advice : NULL);
    costs_free(&c);
    return done;
}
