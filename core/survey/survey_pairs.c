/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/common/array.h"
#include "core/surface/held_values.h"
#include "core/survey/box_question.h"

/* --- Which parameters move two bodies --------------------------------------------------------- */

static bool follows(const surface *s, size_t left_out)
{
    for (size_t k = 0; k <= surface_map_count(s) - left_out; ++k)
        if (surface_origin(s, k)->inner != NULL) return true;
    return false;
}

static bool body_follows(const imp_scene *scene, size_t body, size_t left_out)
{
    for (size_t k = 0; k < scene_surface_count(scene, body); ++k)
        if (follows(scene_surface(scene, body, k), left_out)) return true;
    return false;
}

/* Counts the last rigid maps that all surfaces of the two bodies have in common. It is enough to
 * compare each with the first of the other body: what two lists end with that a third ends with,
 * they have in common. */
static size_t common_motion(const imp_scene *scene, const size_t body[2])
{
    size_t least = SIZE_MAX;
    for (int side = 0; side < 2; ++side) {
        const surface *other = scene_surface(scene, body[1 - side], 0);
        for (size_t k = 0; k < scene_surface_count(scene, body[side]); ++k) {
            const size_t n = surface_common_motion(scene_surface(scene, body[side], k), other);
            if (n < least) least = n;
        }
    }
    return least;
}

static imp_code add_pair(imp_survey *s, survey_pair pair, imp_error *error)
{
    survey_pair *grown =
        array_reserve(s->pairs.at, s->pairs.count, &s->pairs.capacity, sizeof *grown);
    if (grown == NULL) return error_set_memory(error);
    s->pairs.at = grown;
    s->pairs.at[s->pairs.count++] = pair;
    return IMP_SUCCESS;
}

/* Collects two bodies; *rests: it has left them to the pair that stands for all that rest. */
static imp_code collect_pair(imp_survey *s, size_t a, size_t b, bool *rests, imp_error *error)
{
    survey_pair pair = {.body = {a, b}, .swept = SIZE_MAX};
    pair.left_out = common_motion(s->scene, pair.body);
    if (body_follows(s->scene, a, pair.left_out) || body_follows(s->scene, b, pair.left_out) ||
        s->question.how.body[0] != SIZE_MAX)
        return add_pair(s, pair, error);
    *rests = true;
    return IMP_SUCCESS;
}

static imp_code collect_pairs(imp_survey *s, imp_error *error)
{
    const size_t bodies = scene_body_count(s->scene), *of = s->question.how.body;
    const bool is_of_two = of[0] != SIZE_MAX;
    bool any_rests = false;
    if (is_of_two) return collect_pair(s, of[of[0] > of[1]], of[of[0] < of[1]], &any_rests, error);
    imp_code code = IMP_SUCCESS;
    for (size_t a = 0; a < bodies; ++a) {
        if (scene_surface_count(s->scene, a) == 0) continue;
        for (size_t b = a + 1; b < bodies && code == IMP_SUCCESS; ++b)
            if (scene_surface_count(s->scene, b) > 0 && !imp_scene_ignores(s->scene, a, b))
                code = collect_pair(s, a, b, &any_rests, error);
    }
    if (code == IMP_SUCCESS && (any_rests || s->pairs.count == 0)) {
        const survey_pair rest = {.body = {SURVEY_ALL_BODIES, SURVEY_ALL_BODIES},
                                  .swept = SIZE_MAX};
        code = add_pair(s, rest, error);
    }
    return code;
}

/* --- How large surfaces are ------------------------------------------------------------------- */

/* Bodies that the survey asks about: body k of them. A survey of two needs no extents of others. */
static size_t asked_count(const imp_survey *s)
{
    return s->question.how.body[0] == SIZE_MAX ? scene_body_count(s->scene) : 2;
}

static size_t asked_body(const imp_survey *s, size_t k)
{
    return s->question.how.body[0] == SIZE_MAX ? k : s->question.how.body[k];
}

static imp_code make_room_for_extents(imp_survey *s, imp_error *error)
{
    const size_t bodies = scene_body_count(s->scene);
    size_t count = 0;
    s->extents.first = malloc((bodies + 1) * sizeof *s->extents.first);
    if (s->extents.first == NULL) return error_set_memory(error);
    for (size_t k = 0; k < asked_count(s); ++k) {
        s->extents.first[asked_body(s, k)] = count;
        count += scene_surface_count(s->scene, asked_body(s, k));
    }
    s->extents.of = malloc((count + 1) * sizeof *s->extents.of);
    return s->extents.of != NULL ? IMP_SUCCESS : error_set_memory(error);
}

/* Held maps may slip by these parts of gamma - gamma_clear and, for a distance, of the tolerance
 * of a bracket, so that slips decide no answer. */
#define SLIP_OF_CONTACT 0x1p-7
#define SLIP_OF_DISTANCE 0x1p-10

static double slip_enough(const imp_survey *s)
{
    const survey_question *q = &s->question;
    const double narrow = q->clearance.tolerance < SURVEY_DECIDING_TOLERANCE
                              ? q->clearance.tolerance
                              : SURVEY_DECIDING_TOLERANCE;
    return q->is_distance ? SLIP_OF_DISTANCE * narrow * survey_distance_touching(s)
                          : SLIP_OF_CONTACT * (q->gamma - q->gamma_clear);
}

static imp_code find_extent(const imp_survey *s, const surface *of, const value_box *whole,
                            surface_extent *extent, imp_error *error)
{
    imp_status status = surface_extent_find(of, whole, extent);
    if (status == IMP_STATUS_OK && s->proof == NULL)
        status = surface_held_values(of, extent, whole, slip_enough(s), &extent->held);
    if (status == IMP_STATUS_OK) return IMP_SUCCESS;
    surface_fault(of, error, ": %s", surface_status_message(of, status).text);
    return surface_set_code(status, error);
}

static imp_code find_extents(imp_survey *s, double t_start, double t_end, imp_error *error)
{
    const value_box whole = {s->parameters, s->lo, s->hi, s->lo, t_start, t_end};
    for (size_t j = 0; j < asked_count(s); ++j) {
        const size_t body = asked_body(s, j);
        for (size_t k = 0; k < scene_surface_count(s->scene, body); ++k) {
            const imp_code code = find_extent(s, scene_surface(s->scene, body, k), &whole,
                                              &s->extents.of[s->extents.first[body] + k], error);
            if (code != IMP_SUCCESS) return code;
        }
    }
    return IMP_SUCCESS;
}

imp_code survey_find_pairs(imp_survey *s, imp_error *error)
{
    const imp_code code = collect_pairs(s, error);
    return code == IMP_SUCCESS ? make_room_for_extents(s, error) : code;
}

imp_code survey_add_roots(imp_survey *s, double key, imp_error *error)
{
    for (size_t k = 0; k < s->pairs.count; ++k) {
        survey_box *box = malloc(sizeof *box + 2 * s->parameters * sizeof *box->range);
        if (box == NULL) return error_set_memory(error);
        box->key = key;
        box->number = s->counts.made++;
        box->pair = k;
        box->share = 1;
        box->near = INFINITY;
        box->cost = 0;
        box->limit = ROOMY_PAIRS_LEAST;
        for (size_t j = 0; j < s->parameters; ++j) {
            box->range[2 * j] = s->lo[j];
            box->range[2 * j + 1] = s->hi[j];
        }
        if (!box_queue_push(&s->queue, box)) return error_set_memory(error);
    }
    return IMP_SUCCESS;
}

/* --- What queries take for their time --------------------------------------------------------- */

/* The last maps that both bodies share are included, since queries apply them. */
static imp_code choose_swept(imp_survey *s, const survey_box *box, double t_start, double t_end,
                             imp_error *error)
{
    survey_pair *pair = &s->pairs.at[box->pair];
    box_bounds bounds;
    pair->swept = SIZE_MAX;
    pair->drift = 0;
    if (pair->body[0] == SURVEY_ALL_BODIES) return IMP_SUCCESS;
    imp_code code = survey_measure(s, box, 0, t_start, t_end, &bounds, error);
    if (code != IMP_SUCCESS || bounds.follows_time) return code;
    pair->drift = bounds.drift;
    code = survey_measure(s, box, pair->left_out, t_start, t_end, &bounds, error);
    if (code != IMP_SUCCESS) return code;
    double most = 0;
    for (size_t j = 0; j < s->parameters; ++j)
        if (s->box.shift[0][j] > most) most = s->box.shift[0][j], pair->swept = j;
    return IMP_SUCCESS;
}

/* Lemma. Where a parameter takes the place of time, stages that follow time are evaluated at the
 * values of the parameter, too. That moves points by at most the drift over the times and all these
 * values, which is added to the shift of each box. It is below 2^-299, far below what witnesses are
 * padded by, and 0 where all rates in t are. */
imp_code survey_choose_swept(imp_survey *s, imp_error *error)
{
    double t_start = s->question.options.t_start, t_end = s->question.options.t_end;
    for (size_t j = 0; j < s->parameters; ++j) {
        if (s->lo[j] < t_start) t_start = s->lo[j];
        if (s->hi[j] > t_end) t_end = s->hi[j];
    }
    imp_code code = find_extents(s, t_start, t_end, error);
    for (size_t k = 0; k < s->queue.count && code == IMP_SUCCESS; ++k)
        code = choose_swept(s, s->queue.at[k], t_start, t_end, error);
    return code == IMP_SUCCESS
               ? find_extents(s, s->question.options.t_start, s->question.options.t_end, error)
               : code;
}
