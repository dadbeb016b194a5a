/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/survey/survey_proof.h"

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
    const imp_survey_options *how = &s->question.how;
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

/* Makes one block of numbers: ranges, the values of the incumbent and of that of the snapshot, the
 * box being asked about, and shifts. False: no memory. */
static bool make_room(imp_survey *s)
{
    const size_t n = scene_parameters_read(s->scene)->count;
    double *block = calloc(10 * n + 1, sizeof *block);
    s->counts.cuts = calloc(n + 1, sizeof *s->counts.cuts);
    s->lo = block; /* freed in any case */
    if (block == NULL || s->counts.cuts == NULL) return false;
    s->parameters = n;
    s->hi = block + n;
    s->best.values = block + 2 * n;
    for (int k = 0; k < 3; ++k) s->box.shift[k] = block + (3 + (size_t)k) * n;
    s->box.middle = block + 6 * n;
    s->before.best.values = block + 9 * n;
    for (size_t k = 0; k < n; ++k) {
        const scene_parameter *p = &scene_parameters_read(s->scene)->at[k];
        s->lo[k] = s->question.how.lo != NULL ? s->question.how.lo[k] : p->lo;
        s->hi[k] = s->question.how.hi != NULL ? s->question.how.hi[k] : p->hi;
    }
    return true;
}

/* A required distance alone is a search for any contact at that distance. */
static void set_aims(survey_question *q)
{
    const bool decides = q->is_clearance && q->clearance.decide && q->clearance.required > 0;
    q->is_distance = q->is_clearance && !decides;
    q->gamma = q->options.gamma;
    q->gamma_clear = tolerances_clear(q->options.gamma, q->options.gamma_clear);
    if (!decides) return;
    q->gamma = q->clearance.required;
    q->gamma_clear = tolerances_nearly(q->clearance.required);
    q->how.any = true;
}

/* Reads what is asked; NULL: what is usual. */
FP_APART static imp_code read_question(const imp_scene *scene, const imp_options *options,
                                       const imp_clearance_options *clearance,
                                       const imp_survey_options *how, survey_question *to,
                                       imp_error *error)
{
    *to = (survey_question){.is_clearance = clearance != NULL,
                            .clearance = imp_clearance_options_default(),
                            .how = usual};
    scene_options(scene, &to->options);
    imp_code code = sized_read("imp_options", &to->options, options, SCENE_OPTIONS_FIRST, error);
    if (code == IMP_SUCCESS && clearance != NULL)
        code = sized_read("imp_clearance_options", &to->clearance, clearance, ASKED_FIRST, error);
    if (code == IMP_SUCCESS && how != NULL)
        code = sized_read("imp_survey_options", &to->how, how, HOW_FIRST, error);
    if (code == IMP_SUCCESS) code = check_options(scene, &to->options, error);
    const double most = to->options.max_seconds;
    double until = most > 0 ? clock_seconds() + most : INFINITY;
    const limit_watch watch = examined_times_until(&until);
    if (code == IMP_SUCCESS)
        code = examined_times_find(scene, to->options.t_start, to->options.t_end, &watch,
                                   &to->examined, error);
    if (code == IMP_SUCCESS) code = check_asked(&to->clearance, error);
    if (code == IMP_SUCCESS) code = check_bodies(scene, to->how.body, error);
    return code;
}

FP_APART static imp_code fill(imp_survey *s, imp_scene *scene, const imp_options *options,
                              const imp_clearance_options *asked, const imp_survey_options *how,
                              imp_error *error)
{
    *s = (imp_survey){.scene = scene,
                      .best = {.t = INFINITY, .distance = INFINITY},
                      .counts = {.settled = INFINITY},
                      .verdict = IMP_VERDICT_UNDECIDED,
                      .reason = IMP_REASON_RUNNING};
    const double start = clock_seconds();
    imp_code code = read_question(scene, options, asked, how, &s->question, error);
    s->counts.stats.seconds = clock_seconds() - start;
    if (code == IMP_SUCCESS) code = check_ranges(s, error);
    if (code == IMP_SUCCESS && !make_room(s)) code = error_set_memory(error);
    if (code != IMP_SUCCESS) return code;
    set_aims(&s->question);
    const char *resume = s->question.how.resume;
    const double key = s->question.is_distance ? 0 : s->question.options.t_start;
    code = survey_find_pairs(s, error);
    if (code == IMP_SUCCESS) code = survey_add_roots(s, key, error);
    if (code == IMP_SUCCESS) code = survey_choose_swept(s, error);
    if (code == IMP_SUCCESS && resume != NULL) code = survey_load(s, resume, error);
    return code;
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
    survey_snapshot_drop(s);
    survey_records_clear(&s->records);
    survey_proof_free(s->proof);
    free(s->pairs.at);
    free(s->extents.of);
    free(s->extents.first);
    free(s->counts.cuts);
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
    const imp_options *options = &s->question.options;
    if (atomic_exchange(&s->cancelled, false)) return IMP_REASON_CANCELLED;
    if (options->max_pairs > 0 && s->counts.stats.pairs >= options->max_pairs)
        return IMP_REASON_PAIRS;
    if (s->question.how.max_boxes > 0 && s->counts.boxes >= s->question.how.max_boxes)
        return IMP_REASON_PAIRS;
    if (options->max_seconds > 0 && s->counts.stats.seconds >= options->max_seconds)
        return IMP_REASON_SECONDS;
    if (options->max_bytes > 0 && s->counts.stats.bytes > options->max_bytes)
        return IMP_REASON_MEMORY;
    return IMP_REASON_NONE;
}

/* Whether no box that waits can change the answer. */
static bool is_decided(const imp_survey *s)
{
    const survey_box *first = box_queue_first(&s->queue);
    if (first == NULL) return true;
    if (!s->question.is_distance)
        return first->key >= s->best.t || (s->question.how.any && s->best.is_known);
    return first->key >= survey_distance_enough(s) ||
           s->best.distance <= survey_distance_touching(s);
}

/* Reports the undecided boxes to the sink; an interrupted box is reported as it was before the
 * interruption. They stay in the queue, since a later step may decide them. The records that an
 * interrupted box has left are put aside meanwhile: they are sent only if this process goes on. */
static imp_code report_waiting(imp_survey *s, imp_error *error)
{
    const survey_records kept = s->records;
    s->records = (survey_records){.failed = kept.failed};
    for (size_t k = 0; k < s->queue.count; ++k) {
        const survey_box *box = survey_box_before(s, s->queue.at[k]);
        const double t_start = s->question.is_distance ? s->question.options.t_start : box->key;
        survey_record_box(s, box, t_start, s->question.options.t_end, IMP_VERDICT_UNDECIDED, 0);
    }
    const imp_code code = survey_records_send(s, error);
    survey_records_clear(&s->records);
    s->records = kept;
    return code;
}

/* Whether some box is done with that is not as far as is enough: doubles could not divide it, or
 * its queries could not measure it. */
static bool is_unresolved(const imp_survey *s)
{
    return s->question.is_distance && s->counts.settled < survey_distance_enough(s) &&
           s->best.distance > survey_distance_touching(s);
}

static void conclude(imp_survey *s)
{
    s->reason = is_unresolved(s) ? IMP_REASON_RESOLUTION : IMP_REASON_NONE;
    s->verdict = s->best.t < INFINITY ? IMP_VERDICT_CONTACT : IMP_VERDICT_CLEAR;
}

/* Asks about the next boxes. */
FP_APART static imp_code step(imp_survey *s, uint64_t boxes, imp_error *error)
{
    const uint64_t last = s->counts.boxes + boxes;
    survey_snapshot_drop(s); /* this process keeps what the interrupted query proved */
    imp_code code = survey_records_send(s, error);
    s->reason = IMP_REASON_RUNNING;
    while (code == IMP_SUCCESS && s->reason == IMP_REASON_RUNNING) {
        s->counts.stats.seconds = survey_seconds(s);
        if (is_decided(s)) {
            conclude(s);
        } else if (boxes > 0 && s->counts.boxes >= last) {
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
    s->counts.stats.seconds = survey_seconds(s);
    return code == IMP_SUCCESS ? report_waiting(s, error) : code;
}

imp_code imp_survey_step(imp_survey *s, uint64_t boxes, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_step");
    if (s->failed)
        return error_set(error, IMP_ERROR_USAGE, "this survey has ended with an error already");
    if (s->reason == IMP_REASON_NONE) return IMP_SUCCESS;
    const fp_environment environment = fp_environment_enter();
    s->clock.step_from[0] = s->counts.stats.seconds;
    s->clock.step_from[1] = clock_seconds();
    const imp_code code = step(s, boxes, error);
    s->failed = code != IMP_SUCCESS;
    fp_environment_leave(&environment);
    return code;
}
