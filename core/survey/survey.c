/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/survey/survey_internal.h"

/* --- What is asked ---------------------------------------------------------------------------- */

/* Sizes of the structs in their first versions. */
#define HOW_FIRST offsetof(imp_survey_options, resume)
#define ASKED_FIRST offsetof(imp_clearance_options, decide)

static const imp_survey_options usual = {.struct_size = (uint32_t)sizeof usual,
                                         .body = {SIZE_MAX, SIZE_MAX}};

imp_code imp_survey_options_get_default(imp_survey_options *how, imp_error *error)
{
    const imp_code code = sized_check("imp_survey_options", how, HOW_FIRST, error);
    if (code == IMP_SUCCESS) sized_write(how, &usual);
    return code;
}

static imp_code check_options(const imp_scene *scene, const imp_options *options, imp_error *error)
{
    const imp_code code = scene_check_options(scene, options, error);
    if (code != IMP_SUCCESS) return code;
    if (options->baseline != 0)
        return error_set(error, IMP_ERROR_USAGE, "baseline: got 0x%lx, must be 0 for a survey",
                         (unsigned long)options->baseline);
    return tolerances_check(options->gamma, options->gamma_clear, NULL, error);
}

static imp_code check_bodies(const imp_scene *scene, const size_t body[2], imp_error *error)
{
    const size_t count = scene_body_count(scene);
    if (body[0] == SIZE_MAX && body[1] == SIZE_MAX) return IMP_SUCCESS;
    if (body[0] >= count || body[1] >= count || body[0] == body[1])
        return error_set(error, IMP_ERROR_USAGE,
                         "body: got %zu and %zu, must be two of the scene's %zu, or SIZE_MAX twice",
                         body[0], body[1], count);
    for (int side = 0; side < 2; ++side)
        if (scene_surface_count(scene, body[side]) == 0)
            return error_set(error, IMP_ERROR_USAGE,
                             "body: got %zu, which has no surfaces and touches nothing",
                             body[side]);
    return IMP_SUCCESS;
}

static imp_code check_asked(const imp_clearance_options *asked, imp_error *error)
{
    if (asked->each || asked->slices != 1 || asked->within > 0)
        return error_set(error, IMP_ERROR_USAGE,
                         "a survey answers one clearance: each must be false, slices 1, within 0");
    return tolerances_check_clearance(asked, error);
}

/* Checks the ranges that are asked about; NULL stands for all. */
static imp_code check_ranges(const imp_survey *s, imp_error *error)
{
    const imp_survey_options *how = &s->how;
    const scene_parameters *all = scene_parameters_read(s->scene);
    if (how->lo == NULL && how->hi == NULL) return IMP_SUCCESS;
    if (how->lo == NULL || how->hi == NULL)
        return error_set(error, IMP_ERROR_USAGE, "lo, hi: one is NULL, must be both or neither");
    for (size_t k = 0; k < all->count; ++k) {
        const scene_parameter *p = &all->at[k];
        if (how->lo[k] >= p->lo && how->lo[k] <= how->hi[k] && how->hi[k] <= p->hi) continue;
        return error_set(error, IMP_ERROR_USAGE,
                         "lo, hi: parameter '%.80s' got [%.17g, %.17g], must be a range within "
                         "[%.17g, %.17g]",
                         p->name, how->lo[k], how->hi[k], p->lo, p->hi);
    }
    return IMP_SUCCESS;
}

/* --- Creation and destruction ----------------------------------------------------------------- */

/* One block of numbers: ranges, the values of the incumbent and of that marked, the box in question
 * (survey_measure.c), and shifts. False: no memory. */
static bool make_room(imp_survey *s)
{
    const size_t n = scene_parameters_read(s->scene)->count;
    double *block = calloc(10 * n + 1, sizeof *block);
    s->cuts = calloc(n + 1, sizeof *s->cuts);
    s->lo = block; /* freed in any case */
    if (block == NULL || s->cuts == NULL) return false;
    s->count = n;
    s->hi = block + n;
    s->best.values = block + 2 * n;
    for (int k = 0; k < 3; ++k) s->shift[k] = block + (3 + (size_t)k) * n;
    s->at = block + 6 * n; /* 3 n numbers: middle, lo and hi of the box that is asked about */
    s->mark.best.values = block + 9 * n;
    for (size_t k = 0; k < n; ++k) {
        const scene_parameter *p = &scene_parameters_read(s->scene)->at[k];
        s->lo[k] = s->how.lo != NULL ? s->how.lo[k] : p->lo;
        s->hi[k] = s->how.hi != NULL ? s->how.hi[k] : p->hi;
    }
    return true;
}

/* A required distance alone is a search for any contact at that distance. */
static void set_aims(imp_survey *s)
{
    const bool decides = s->is_clearance && s->asked.decide && s->asked.required > 0;
    s->is_distance = s->is_clearance && !decides;
    s->gamma = s->options.gamma;
    s->gamma_clear = tolerances_clear(s->options.gamma, s->options.gamma_clear);
    if (!decides) return;
    s->gamma = s->asked.required;
    s->gamma_clear = tolerances_nearly(s->asked.required);
    s->how.any = true;
}

FP_APART static imp_code fill(imp_survey *s, imp_scene *scene, const imp_options *options,
                              const imp_clearance_options *asked, const imp_survey_options *how,
                              imp_error *error)
{
    *s = (imp_survey){.scene = scene,
                      .is_clearance = asked != NULL,
                      .asked = imp_clearance_options_default(),
                      .how = usual,
                      .best = {.t = INFINITY, .distance = INFINITY},
                      .settled = INFINITY,
                      .verdict = IMP_VERDICT_UNDECIDED,
                      .reason = IMP_REASON_RUNNING};
    scene_options(scene, &s->options);
    imp_code code = sized_read("imp_options", &s->options, options, SCENE_OPTIONS_FIRST, error);
    if (code == IMP_SUCCESS && asked != NULL)
        code = sized_read("imp_clearance_options", &s->asked, asked, ASKED_FIRST, error);
    if (code == IMP_SUCCESS && how != NULL)
        code = sized_read("imp_survey_options", &s->how, how, HOW_FIRST, error);
    if (code == IMP_SUCCESS) code = check_options(scene, &s->options, error);
    if (code == IMP_SUCCESS)
        code =
            examined_times_find(scene, s->options.t_start, s->options.t_end, &s->examined, error);
    if (code == IMP_SUCCESS) code = check_asked(&s->asked, error);
    if (code == IMP_SUCCESS) code = check_bodies(scene, s->how.body, error);
    if (code == IMP_SUCCESS) code = check_ranges(s, error);
    if (code == IMP_SUCCESS && !make_room(s)) code = error_set_memory(error);
    if (code != IMP_SUCCESS) return code;
    set_aims(s);
    code = survey_find_pairs(s, error);
    if (code == IMP_SUCCESS)
        code = survey_add_roots(s, s->is_distance ? 0 : s->options.t_start, error);
    if (code == IMP_SUCCESS) code = survey_choose_swept(s, error);
    return code == IMP_SUCCESS && s->how.resume != NULL ? survey_load(s, s->how.resume, error)
                                                        : code;
}

imp_survey *imp_survey_new(imp_scene *scene, const imp_options *options,
                           const imp_clearance_options *asked, const imp_survey_options *how,
                           imp_error *error)
{
    imp_survey *s = scene != NULL && options != NULL ? malloc(sizeof *s) : NULL;
    if (scene == NULL || options == NULL) return error_set_missing(error, "imp_survey_new"), NULL;
    if (s == NULL) return error_set_memory(error), NULL;
    scene_begin_use(scene);
    const fp_environment environment = fp_environment_enter();
    const imp_code code = fill(s, scene, options, asked, how, error);
    fp_environment_leave(&environment);
    if (code == IMP_SUCCESS) return s;
    imp_survey_free(s);
    return NULL;
}

void imp_survey_free(imp_survey *s)
{
    if (s == NULL) return;
    box_queue_clear(&s->queue);
    survey_mark_drop(s);
    survey_told_clear(s);
    free(s->pairs);
    free(s->extents);
    free(s->first);
    free(s->cuts);
    free(s->lo);
    scene_end_use(s->scene);
    free(s);
}

void imp_survey_cancel(imp_survey *survey)
{
    if (survey != NULL) atomic_store(&survey->cancelled, true);
}

/* --- Stepping --------------------------------------------------------------------------------- */

/* Returns the limit that is reached, or NONE. */
static imp_reason exhausted(imp_survey *s)
{
    const imp_options *options = &s->options;
    if (atomic_exchange(&s->cancelled, false)) return IMP_REASON_CANCELLED;
    if (options->max_pairs > 0 && s->stats.pairs >= options->max_pairs) return IMP_REASON_PAIRS;
    if (s->how.max_boxes > 0 && s->boxes >= s->how.max_boxes) return IMP_REASON_PAIRS;
    if (options->max_seconds > 0 && s->stats.seconds >= options->max_seconds)
        return IMP_REASON_SECONDS;
    if (options->max_bytes > 0 && s->stats.bytes > options->max_bytes) return IMP_REASON_MEMORY;
    return IMP_REASON_NONE;
}

/* Whether no box that waits can change the answer. */
static bool is_decided(const imp_survey *s)
{
    const survey_box *first = box_queue_first(&s->queue);
    if (first == NULL) return true;
    if (!s->is_distance) return first->key >= s->best.t || (s->how.any && s->best.is_known);
    return first->key >= survey_distance_enough(s) || s->best.distance <= s->gamma;
}

/* Reports the undecided boxes to the sink; an interrupted box is reported as it was before the
 * interruption. They stay in the queue, since a later step may decide them. What s->told keeps back
 * of an interrupted box is put aside meanwhile: it is reported only if this process goes on. */
static imp_code tell_rest(imp_survey *s, imp_error *error)
{
    survey_told **kept = s->told;
    const size_t count = s->told_count, capacity = s->told_capacity;
    s->told = NULL, s->told_count = 0;
    for (size_t k = 0; k < s->queue.count; ++k) {
        const survey_box *box = survey_marked(s, s->queue.at[k]);
        survey_tell(s, box, s->is_distance ? s->options.t_start : box->key, s->options.t_end,
                    IMP_VERDICT_UNDECIDED, 0);
    }
    const imp_code code = survey_flush(s, error);
    survey_told_clear(s);
    s->told = kept, s->told_count = count, s->told_capacity = capacity;
    return code;
}

static void conclude(imp_survey *s)
{
    s->reason = IMP_REASON_NONE;
    s->verdict = s->best.t < INFINITY ? IMP_VERDICT_CONTACT : IMP_VERDICT_CLEAR;
}

/* Asks about the next boxes. */
FP_APART static imp_code step(imp_survey *s, uint64_t boxes, imp_error *error)
{
    const uint64_t last = s->boxes + boxes;
    survey_mark_drop(s); /* this process keeps what the interrupted query proved */
    imp_code code = survey_flush(s, error);
    s->reason = IMP_REASON_RUNNING;
    while (code == IMP_SUCCESS && s->reason == IMP_REASON_RUNNING) {
        s->stats.seconds = survey_seconds(s);
        if (is_decided(s)) {
            conclude(s);
        } else if (boxes > 0 && s->boxes >= last) {
            return IMP_SUCCESS;
        } else {
            const imp_reason limit = exhausted(s);
            if (limit != IMP_REASON_NONE)
                s->reason = limit;
            else
                code = survey_ask(s, box_queue_pop(&s->queue), error);
        }
    }
    if (code == IMP_SUCCESS && s->reason == IMP_REASON_NONE) conclude(s);
    s->stats.seconds = survey_seconds(s);
    return code == IMP_SUCCESS ? tell_rest(s, error) : code;
}

imp_code imp_survey_step(imp_survey *s, uint64_t boxes, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_step");
    if (s->failed)
        return error_set(error, IMP_ERROR_USAGE, "this survey has ended with an error already");
    if (s->reason == IMP_REASON_NONE) return IMP_SUCCESS;
    const fp_environment environment = fp_environment_enter();
    s->step_from[0] = s->stats.seconds;
    s->step_from[1] = clock_seconds();
    const imp_code code = step(s, boxes, error);
    s->failed = code != IMP_SUCCESS;
    fp_environment_leave(&environment);
    return code;
}
