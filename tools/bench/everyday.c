/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/everyday.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/bench/bench.h"

enum { PAIRS_MOST = 20000, CLEARANCE_TIMES = 3 };

static const bench_method contact = {
    .name = "contact", .question = BENCH_CONTACT, .capped = true, .pairs_most = PAIRS_MOST};
static const bench_method clearance = {.name = "clearance",
                                       .question = BENCH_CLEARANCE,
                                       .capped = true,
                                       .pairs_most = CLEARANCE_TIMES * PAIRS_MOST};
static const bench_method *const methods[] = {&contact, &clearance, NULL};
enum { CONTACT, CLEARANCE };

/* Returns the scene's text from its parts, each expanded; NULL: no memory. */
static char *scene_of(const everyday_family *f, char *const part[4])
{
    const bool twice = f->bond == BOND_TWICE;
    const char *comma = twice && *part[3] != '\0' && *part[1] != '\0' ? "," : "";
    for (int k = 0; k < 4; ++k)
        if (part[k] == NULL) return NULL;
    return bench_text("{\"time\":[0,%.17g],\"bodies\":[{\"name\":\"a\",\"surfaces\":[%s],"
                      "\"maps\":[%s]},{\"name\":\"b\",%s\"surfaces\":[%s],\"maps\":[%s%s%s]}]}",
                      f->t_end > 0 ? f->t_end : 1, part[0], part[1],
                      f->bond == BOND_PARENT ? "\"parent\":\"a\"," : "", part[2], part[3], comma,
                      twice ? part[1] : "");
}

static void set_goals(bench_case *made, const everyday_family *f, char gap)
{
    made->goal[CONTACT] = f->goal;
    made->goal[CLEARANCE] = CLEARANCE_TIMES * f->goal;
    made->goal_is_open[CONTACT] = strchr(f->open_contact, gap) != NULL;
    made->goal_is_open[CLEARANCE] = strchr(f->open_clearance, gap) != NULL;
}

static void add_gap(bench_cases *list, const everyday_family *f, char gap)
{
    const char *const texts[4] = {f->a, f->a_maps, f->b, f->b_maps};
    char *part[4];
    double c = 1;
    for (int k = 0; k < gap - '0'; ++k) c /= 10;
    for (int k = 0; k < 4; ++k) part[k] = everyday_expand(texts[k], c);
    bench_begin(list, c / 10, -1, "%s, c = %g", f->name, c);
    bench_scene *scene = bench_add_text(list, scene_of(f, part));
    if (scene != NULL) {
        scene->has_reference = true;
        scene->meets = f->meets;
        scene->t = f->t_end > 0 ? 0.5 * f->t_end : 0.5;
        set_goals(&list->cases[list->count - 1], f, gap);
    }
    for (int k = 0; k < 4; ++k) free(part[k]);
}

static exit_status build(bench_cases *list, const bench_request *request)
{
    for (const everyday_family *f = everyday_families; f->name != NULL; ++f)
        for (const char *gap = f->gaps; *gap != '\0'; ++gap) add_gap(list, f, *gap);
    return bench_built(list, request);
}

/* Counts goals that are reached, those that are open, and those of these that are reached now. */
static size_t find(const bench_result *results, size_t count, bench_finding *findings)
{
    size_t goals = 0, reached = 0, open = 0, now = 0;
    for (size_t k = 0; k < count; ++k)
        for (size_t m = 0; m < results[k].row_count; ++m) {
            const bench_goal goal = bench_goal_of(&results[k], m);
            goals += goal != BENCH_GOAL_NONE;
            reached += goal == BENCH_GOAL_REACHED || goal == BENCH_GOAL_REACHED_NOW;
            open += goal == BENCH_GOAL_OPEN || goal == BENCH_GOAL_REACHED_NOW;
            now += goal == BENCH_GOAL_REACHED_NOW;
        }
    findings[0] = (bench_finding){.key = "reached", .value = (double)reached};
    findings[1] = (bench_finding){.key = "goals", .value = (double)goals};
    snprintf(findings[0].text, sizeof findings[0].text, "%zu of %zu goals are reached", reached,
             goals);
    snprintf(findings[1].text, sizeof findings[1].text,
             "%zu goals are marked as open, of which %zu are reached now", open, now);
    return 2;
}

const bench_set bench_everyday = {
    "everyday",
    "Machines as they are built: parts that are carried, slide, roll and turn, c apart; gamma c / "
    "10.\nEach scene has a goal in pairs, clearance three times that of contact. Ends at 20000 "
    "pairs a scene, clearance at 60000.",
    methods, build, find};
