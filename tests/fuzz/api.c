/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/fuzz_registry.h"

#include <impinge/impinge.h>
#include <math.h>

/* Any sequence of calls that the header allows is answered, whatever came before it: queries are
 * begun, stepped, refined, divided, read and freed in any order. Each two bytes are a call and its
 * argument. */

const char fuzz_target[] = "api";

enum { SCENES = 3, QUERIES = 6, STEP = 40, PAIRS = 400, NONE = -1 };

typedef struct held_query {
    imp_query *query; /* NULL: the place is free */
    int divided;      /* the place of the query that this is a part of, or NONE */
} held_query;

typedef struct session {
    imp_scene *const *scenes;
    held_query at[QUERIES];
} session;

/* --- Answers ---------------------------------------------------------------------------------- */

static void judge_error(imp_code code, const imp_error *error)
{
    FUZZ_REQUIRE(code != IMP_ERROR_PLUGIN && code != IMP_ERROR_SCENE && code != IMP_ERROR_FILE);
    FUZZ_REQUIRE(code == IMP_SUCCESS || error->text[0] != '\0');
}

static void judge(const imp_query *query)
{
    const imp_result r = imp_query_result(query);
    FUZZ_REQUIRE(r.t_lower >= r.t_start && r.t_lower <= r.t_end);
    FUZZ_REQUIRE(r.verdict != IMP_VERDICT_CLEAR || r.t_lower == r.t_end);
    FUZZ_REQUIRE(r.verdict != IMP_VERDICT_CONTACT || (r.t == r.t_lower && r.gap <= r.gamma));
    FUZZ_REQUIRE(r.verdict == IMP_VERDICT_CONTACT || isnan(r.t));
}

static void judge_distance(const imp_query *query, size_t index)
{
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    imp_error error = {IMP_SUCCESS, ""};
    const imp_code code = imp_clearance_get(query, index, &answer, &error);
    judge_error(code, &error);
    FUZZ_REQUIRE((code == IMP_SUCCESS) == (index < imp_clearance_count(query)));
    if (code == IMP_SUCCESS) FUZZ_REQUIRE(answer.lower <= answer.upper);
}

/* --- Calls ------------------------------------------------------------------------------------ */

/* Parts go before the query that was divided. */
static void drop(session *s, int place)
{
    for (int k = 0; k < QUERIES; ++k)
        if (s->at[k].query != NULL && s->at[k].divided == place) drop(s, k);
    imp_query_free(s->at[place].query);
    s->at[place] = (held_query){NULL, NONE};
}

static imp_options options_of(const imp_scene *scene, unsigned argument)
{
    imp_options options = imp_options_default(scene);
    options.gamma = ldexp(1, -(int)(argument % 32));
    options.max_pairs = argument % 3 == 0 ? PAIRS : 0;
    options.max_bytes = argument % 5 == 0 ? 1 << 16 : 0;
    options.audit = argument % 7 == 0;
    options.t_end = argument % 11 == 0 ? options.t_start : options.t_end;
    return options;
}

static void begin(session *s, int place, unsigned argument, bool distance)
{
    imp_scene *scene = s->scenes[argument % SCENES];
    const imp_options options = options_of(scene, argument);
    imp_clearance_options asked = imp_clearance_options_default();
    imp_error error = {IMP_SUCCESS, ""};
    asked.each = argument % 2 == 1;
    asked.slices = 1 + argument % 4;
    asked.required = argument % 3 == 0 ? 0.5 : 0;
    asked.decide = argument % 13 == 0;
    drop(s, place);
    s->at[place].query = distance ? imp_clearance_new(scene, &options, &asked, &error)
                                  : imp_query_new(scene, &options, &error);
    FUZZ_REQUIRE(s->at[place].query != NULL);
}

static void take_part(session *s, int place, unsigned argument)
{
    const int to = (int)(argument % QUERIES);
    imp_error error = {IMP_SUCCESS, ""};
    if (to == place) return;
    for (int up = place; up != NONE; up = s->at[up].divided)
        if (up == to) return; /* it would free what it is a part of */
    drop(s, to);
    s->at[to] = (held_query){imp_query_part(s->at[place].query, argument / QUERIES, &error), NONE};
    if (s->at[to].query == NULL) judge_error(error.code, &error);
    if (s->at[to].query != NULL) s->at[to].divided = place;
}

static void call(session *s, unsigned what, int place, unsigned argument)
{
    imp_query *query = s->at[place].query;
    imp_error error = {IMP_SUCCESS, ""};
    imp_pending pending;
    size_t count, body[2];
    switch (what) {
    case 0:
    case 1:
        begin(s, place, argument, what == 1);
        break;
    case 2:
        drop(s, place);
        break;
    case 3:
        judge_error(imp_query_step(query, 1 + argument % STEP, &error), &error);
        break;
    case 4:
        judge_error(imp_query_refine(query, ldexp(1, -(int)(argument % 40)), -1, &error), &error);
        break;
    case 5:
        judge_error(imp_query_exclude_pair(query, &error), &error);
        break;
    case 6:
        for (int k = 0; k < QUERIES; ++k)
            if (s->at[k].query != NULL && s->at[k].divided == place) return;
        judge_error(imp_query_divide(query, &count, &error), &error);
        break;
    case 7:
        take_part(s, place, argument);
        break;
    case 8:
        imp_query_cancel(query);
        break;
    case 9:
        (void)imp_query_pending(query, argument, &pending);
        break;
    case 10:
        (void)imp_query_part_bodies(query, argument, body);
        break;
    default:
        judge_distance(query, argument % 8);
    }
}

/* --- Sessions --------------------------------------------------------------------------------- */

static void make_scenes(imp_registry *registry, imp_scene *scenes[SCENES])
{
    static const char *const pairs[SCENES][2] = {
        {"sphere", "sphere center=3,0,0 ! translate velocity=-2,0,0"},
        {"torus ! rotate rate=2", "sphere radius=0.2 center=2,0,0.1 ! translate velocity=-1,0,0"},
        {"bezier degree=1,1 points=[[0,0,0],[0,1,0],[1,0,0],[1,1,1]]", "ripple speed=1"}};
    imp_error error;
    for (int k = 0; k < SCENES; ++k) {
        scenes[k] = imp_scene_from_pair(registry, pairs[k][0], pairs[k][1], &error);
        if (scenes[k] == NULL) fprintf(stderr, "%s\n", error.text);
        FUZZ_REQUIRE(scenes[k] != NULL);
    }
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    enum { CALLS = 12 };
    static imp_registry *registry;
    imp_scene *scenes[SCENES];
    session s = {.scenes = scenes};
    if (registry == NULL) registry = fuzz_registry(false);
    make_scenes(registry, scenes);
    for (int k = 0; k < QUERIES; ++k) s.at[k].divided = NONE;
    for (size_t k = 0; k + 1 < length && k < 512; k += 2) {
        const int place = bytes[k] / CALLS % QUERIES;
        call(&s, bytes[k] % CALLS, place, bytes[k + 1]);
        if (s.at[place].query != NULL) judge(s.at[place].query);
    }
    for (int k = 0; k < QUERIES; ++k) drop(&s, k);
    for (int k = 0; k < SCENES; ++k) imp_scene_free(scenes[k]);
    return 0;
}
