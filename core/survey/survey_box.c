/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/common/clock.h"
#include "core/scene/posed_scene.h"
#include "core/survey/survey_internal.h"

static bool is_rest(const survey_pair *pair) { return pair->body[0] == SURVEY_ALL_BODIES; }

static bool is_swept(const survey_pair *pair) { return pair->swept != SIZE_MAX; }

/* --- Scenes and queries at the middle --------------------------------------------------------- */

/* The pairs that parameters move are searched on their own. */
static imp_code ignore_moved(const imp_survey *s, imp_scene *scene)
{
    imp_code code = scene_copy_relations(s->scene, scene);
    for (size_t k = 0; k < s->pair_count && code == IMP_SUCCESS; ++k) {
        const size_t *body = s->pairs[k].body;
        if (!is_rest(&s->pairs[k]))
            code = scene_ignore_members(scene, (scene_members){false, body[0]},
                                        (scene_members){false, body[1]});
    }
    return code;
}

static imp_code scene_of_box(imp_survey *s, const survey_box *box, imp_scene **made,
                             imp_error *error)
{
    const survey_pair *pair = &s->pairs[box->pair];
    const size_t count = scene_body_count(s->scene);
    size_t *all = NULL;
    imp_code code;
    if (!is_rest(pair)) {
        code = posed_scene_of_bodies(s->scene, s->at, pair->body, 2, pair->swept, made);
        return code == IMP_SUCCESS ? code : error_set_memory(error);
    }
    all = malloc((count + 1) * sizeof *all);
    if (all == NULL) return error_set_memory(error);
    for (size_t b = 0; b < count; ++b) all[b] = b;
    code = posed_scene_of_bodies(s->scene, s->at, all, count, SIZE_MAX, made);
    free(all);
    if (code == IMP_SUCCESS && ignore_moved(s, *made) != IMP_SUCCESS) {
        imp_scene_free(*made);
        code = IMP_ERROR_MEMORY;
    }
    return code == IMP_SUCCESS ? code : error_set_memory(error);
}

double survey_seconds(const imp_survey *s)
{
    return s->step_from[0] + (clock_seconds() - s->step_from[1]);
}

#define PROGRESS_EVERY 0.1 /* seconds between reports */

/* Adds the survey's own to what a query reports. */
static bool report(void *context, const imp_progress *of_query)
{
    imp_survey *s = context;
    const survey_box *first = box_queue_first(&s->queue);
    imp_progress all = *of_query;
    if (atomic_load(&s->cancelled)) return false;
    all.pairs += s->stats.pairs;
    all.heap += s->queue.count;
    all.seconds = survey_seconds(s);
    if (s->is_distance) {
        all.lower = first != NULL && first->key < s->settled ? first->key : s->settled;
        all.upper = s->best.distance;
    } else {
        all.t_lower = first != NULL && first->key < s->key_asked ? first->key : s->key_asked;
    }
    if (s->options.progress == NULL || all.seconds < s->next_report) return true;
    s->next_report = all.seconds + PROGRESS_EVERY;
    return s->options.progress(s->options.progress_context, &all);
}

/* `pairs` is a limit of the query's own; 0: none. */
static imp_options options_of_query(imp_survey *s, double t_start, double t_end, uint64_t pairs)
{
    imp_options options = s->options;
    options.t_start = t_start;
    options.t_end = t_end;
    options.progress = report;
    options.progress_context = s;
    if (options.max_pairs > 0) /* 0 would be no limit */
        options.max_pairs =
            s->stats.pairs < options.max_pairs ? options.max_pairs - s->stats.pairs : 1;
    if (pairs > 0 && !(options.max_pairs > 0 && options.max_pairs <= pairs))
        options.max_pairs = pairs;
    if (options.max_seconds > 0) {
        options.max_seconds -= survey_seconds(s);
        if (!(options.max_seconds > 0)) options.max_seconds = 0x1p-1000;
    }
    return options;
}

static void add_stats(imp_survey *s, const imp_stats *of_query)
{
    const uint64_t own = s->queue.count * (sizeof(survey_box) + 2 * s->count * sizeof(double));
    s->stats.pairs += of_query->pairs;
    s->stats.nodes += of_query->nodes;
    s->stats.witness_searches += of_query->witness_searches;
    if (of_query->peak_heap > s->stats.peak_heap) s->stats.peak_heap = of_query->peak_heap;
    if (of_query->bytes + own > s->stats.bytes) s->stats.bytes = of_query->bytes + own;
}

/* The times of the queries of a box: what is left of the parameter that is swept, or of time. */
typedef struct query_times {
    double start, end;
} query_times;

static query_times times_of(const imp_survey *s, const survey_box *box)
{
    const size_t swept = s->pairs[box->pair].swept;
    const double t_end = s->best.t < s->options.t_end ? s->best.t : s->options.t_end;
    if (is_swept(&s->pairs[box->pair]))
        return (query_times){box->range[2 * swept], box->range[2 * swept + 1]};
    if (s->is_distance) return (query_times){s->options.t_start, s->options.t_end};
    return (query_times){box->key, t_end};
}

static bool is_limit(imp_reason reason)
{
    return reason == IMP_REASON_PAIRS || reason == IMP_REASON_SECONDS ||
           reason == IMP_REASON_MEMORY || reason == IMP_REASON_CANCELLED;
}

/* Notes why the survey ends, where a query met a limit. */
static bool must_end(imp_survey *s, imp_reason reason)
{
    if (!is_limit(reason)) return false;
    atomic_store(&s->cancelled, false);
    s->reason = reason;
    return true;
}

static imp_code run_contact(imp_survey *s, imp_scene *scene, query_times times,
                            const double gamma[2], uint64_t pairs, const query_spread *spread,
                            imp_result *result, imp_error *error)
{
    imp_options options = options_of_query(s, times.start, times.end, pairs);
    options.gamma = gamma[0];
    options.gamma_clear = gamma[1];
    *result = (imp_result){.struct_size = (uint32_t)sizeof *result};
    imp_query *query = imp_query_new(scene, &options, error);
    if (query == NULL) return error != NULL ? error->code : IMP_ERROR_USAGE;
    query_use_spread(query, spread);
    imp_code code = imp_query_step(query, 0, error);
    if (code == IMP_SUCCESS) code = imp_query_get_result(query, result, error);
    if (code == IMP_SUCCESS) add_stats(s, &result->stats);
    imp_query_free(query);
    return code;
}

static imp_code run_distance(imp_survey *s, imp_scene *scene, query_times times, double within,
                             double tolerance, imp_clearance *answer, imp_error *error)
{
    const imp_options options = options_of_query(s, times.start, times.end, 0);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.within = within;
    asked.tolerance = tolerance;
    *answer = (imp_clearance){.struct_size = (uint32_t)sizeof *answer};
    imp_query *query = imp_clearance_new(scene, &options, &asked, error);
    if (query == NULL) return error != NULL ? error->code : IMP_ERROR_USAGE;
    imp_code code = imp_query_step(query, 0, error);
    if (code == IMP_SUCCESS) code = imp_clearance_get(query, 0, answer, error);
    if (code == IMP_SUCCESS) add_stats(s, &answer->stats);
    imp_query_free(query);
    return code;
}

/* --- What becomes of a box -------------------------------------------------------------------- */

/* Notes that nothing comes near in the box before t, of the parameter that is swept. */
static void prove_swept(imp_survey *s, survey_box *box, double t)
{
    double *range = box->range + 2 * s->pairs[box->pair].swept;
    const double lo = range[0], hi = range[1];
    const double part = t < hi ? box->share * ((t - lo) / (hi - lo)) : box->share;
    s->proved += part;
    box->share -= part;
    range[1] = t;
    survey_tell(s, box, s->options.t_start, s->options.t_end, IMP_VERDICT_CLEAR, s->gamma_clear);
    range[0] = t, range[1] = hi;
}

/* Notes that nothing comes near in the box before a time of its queries. */
static void prove_until(imp_survey *s, survey_box *box, double t, bool is_clear)
{
    const double all = s->options.t_end - s->options.t_start;
    if (!(t > times_of(s, box).start) && !is_clear) return;
    if (is_swept(&s->pairs[box->pair])) {
        prove_swept(s, box, t);
        return;
    }
    s->proved += all > 0 ? box->share * ((t - box->key) / all) : box->share;
    survey_tell(s, box, box->key, t, IMP_VERDICT_CLEAR, s->gamma_clear);
    box->key = t;
}

/* Chooses the parameter that shifts most; where several have no bound, the one whose range is
 * widest beside that of the scene. Returns s->count if no range can be halved. */
static size_t choose_split(const imp_survey *s, const survey_view *view)
{
    size_t best = s->count;
    double most = 0, widest = 0;
    for (size_t j = 0; j < s->count; ++j) {
        const double wide = (view->hi[j] - view->lo[j]) / (s->hi[j] - s->lo[j]);
        const double shift = s->shift[0][j] >= 0 ? s->shift[0][j] : INFINITY;
        if (!(view->lo[j] < s->at[j] && s->at[j] < view->hi[j]) || shift == 0) continue;
        if (best < s->count && !(shift > most || (shift == most && wide > widest))) continue;
        best = j;
        most = shift;
        widest = wide;
    }
    return best;
}

/* Queues the halves of the box, which share the middle. *done false: it cannot be halved. */
static imp_code split(imp_survey *s, const survey_box *box, const survey_view *view, bool *done,
                      imp_error *error)
{
    const size_t j = choose_split(s, view), size = sizeof *box + 2 * s->count * sizeof *box->range;
    *done = j < s->count;
    for (int side = 0; *done && side < 2; ++side) {
        survey_box *half = malloc(size);
        if (half == NULL) return error_set_memory(error);
        memcpy(half, box, size);
        half->number = s->made++;
        half->share = 0.5 * box->share;
        half->range[2 * j + (side == 0)] = s->at[j];
        if (!box_queue_push(&s->queue, half)) return error_set_memory(error);
    }
    return IMP_SUCCESS;
}

/* Measures the box over the times in question: for a contact, those that are left. */
static imp_code measure(imp_survey *s, const survey_box *box, survey_view *view, imp_error *error)
{
    const survey_pair *pair = &s->pairs[box->pair];
    const query_times all = {s->options.t_start, s->options.t_end};
    const query_times times = is_swept(pair) ? all : times_of(s, box);
    return survey_measure(s, box, pair->left_out, times.start, times.end, view, error);
}

/* What is left of a box that was asked about. */
typedef enum box_rest {
    BOX_OPEN,   /* to be halved */
    BOX_DONE,   /* nothing, or nothing that could change the answer */
    BOX_WAITING /* all of it: a limit came, or double precision resolves no more */
} box_rest;

/* --- The earliest contact --------------------------------------------------------------------- */

static void in_scene(const survey_pair *pair, imp_side *a, imp_side *b)
{
    if (is_rest(pair)) return;
    a->body = pair->body[a->body];
    b->body = pair->body[b->body];
}

/* Keeps the values of a witness at a time of its query, and replaces that by the scene's time. */
static void keep_values(imp_survey *s, const survey_box *box, double *t)
{
    const survey_pair *pair = &s->pairs[box->pair];
    memcpy(s->best.values, s->at, s->count * sizeof *s->at);
    s->best.is_known = true;
    if (!is_swept(pair)) return;
    s->best.values[pair->swept] = *t;
    *t = s->options.t_start;
}

static void note_contact(imp_survey *s, const survey_box *box, const imp_result *found)
{
    const double t = is_swept(&s->pairs[box->pair]) ? s->options.t_start : found->t;
    if (!(t < s->best.t)) return;
    s->best.t = t;
    s->best.contact = *found;
    keep_values(s, box, &s->best.contact.t);
    in_scene(&s->pairs[box->pair], &s->best.contact.a, &s->best.contact.b);
    if (s->how.any) s->reason = IMP_REASON_NONE;
}

/* Asks without room for the shift: a contact bounds the earliest from above. Where the middle lies
 * on the edge of the values that touch, gaps of about gamma last along whole edges, and such a
 * search would take a thousand times the pairs of the one with room, which took `pairs`; beside the
 * contact there are others that are easier to find, and so it is given up. */
enum { OWN_PAIRS_LEAST = 1024, OWN_PAIRS_TIMES = 8 };

static imp_code ask_own(imp_survey *s, const survey_box *box, imp_scene *scene, uint64_t pairs,
                        box_rest *rest, imp_error *error)
{
    const double own[2] = {s->gamma, s->gamma_clear};
    const uint64_t limit = OWN_PAIRS_LEAST + OWN_PAIRS_TIMES * pairs;
    imp_result found;
    const imp_code code = run_contact(s, scene, times_of(s, box), own, limit, NULL, &found, error);
    if (code != IMP_SUCCESS) return code;
    if (found.verdict == IMP_VERDICT_CONTACT) note_contact(s, box, &found);
    if (found.verdict != IMP_VERDICT_UNDECIDED) return IMP_SUCCESS;
    if (found.reason == IMP_REASON_PAIRS && found.stats.pairs >= limit) return IMP_SUCCESS;
    if (must_end(s, found.reason)) *rest = BOX_WAITING;
    return IMP_SUCCESS;
}

/* Tells the sink about the times after a contact that is known: nobody asks about them. */
static void tell_later(imp_survey *s, const survey_box *box)
{
    if (is_swept(&s->pairs[box->pair]) || !(box->key < s->options.t_end)) return;
    survey_tell(s, box, box->key, s->options.t_end, IMP_VERDICT_UNDECIDED, 0);
}

/* Asks the query with room for the shift; what is excluded along the way the values move the bodies
 * counts, too, unless a contact is to be one of the scene (is_fine). */
static imp_code run_box(imp_survey *s, const survey_box *box, imp_scene *scene,
                        const survey_view *view, const double gamma[2], bool is_fine,
                        imp_result *found, imp_error *error)
{
    const query_times times = times_of(s, box);
    query_spread spread;
    if (is_fine || is_rest(&s->pairs[box->pair]))
        return run_contact(s, scene, times, gamma, 0, NULL, found, error);
    imp_code code = survey_spread_make(s, box, view, &spread, error);
    if (code == IMP_SUCCESS)
        code =
            run_contact(s, scene, times, gamma, 0, spread.is_known ? &spread : NULL, found, error);
    survey_spread_clear(&spread);
    return code;
}

/* Asks the query with room for the shift, then, where a contact is too coarse to be one of the
 * scene, the query without. */
static imp_code ask_queries(imp_survey *s, survey_box *box, imp_scene *scene,
                            const survey_view *view, box_rest *rest, imp_error *error)
{
    const double total = view->total;
    const double between = s->gamma - s->gamma_clear;
    const bool is_fine = total <= 0.5 * between;
    const double clear = total > 0 ? sum_upper(s->gamma_clear, total) : s->gamma_clear;
    const double coarse[2] = {is_fine ? s->gamma : clear + 0.25 * (total + between), clear};
    imp_result found;
    imp_code code = run_box(s, box, scene, view, coarse, is_fine, &found, error);
    if (code != IMP_SUCCESS) return code;
    prove_until(s, box, found.t_lower, found.verdict == IMP_VERDICT_CLEAR);
    if (found.verdict == IMP_VERDICT_CLEAR) {
        tell_later(s, box);
        return *rest = BOX_DONE, IMP_SUCCESS;
    }
    if (found.verdict == IMP_VERDICT_UNDECIDED) {
        const bool is_stuck = is_fine && found.reason == IMP_REASON_RESOLUTION;
        if (is_stuck) s->reason = IMP_REASON_RESOLUTION;
        if (is_stuck || must_end(s, found.reason)) return *rest = BOX_WAITING, IMP_SUCCESS;
    }
    if (!is_fine) return ask_own(s, box, scene, found.stats.pairs, rest, error);
    if (found.verdict == IMP_VERDICT_CONTACT) note_contact(s, box, &found);
    return IMP_SUCCESS;
}

static imp_code ask_contact(imp_survey *s, survey_box *box, box_rest *rest, imp_error *error)
{
    survey_view view;
    imp_scene *scene;
    bool is_split;
    imp_code code = measure(s, box, &view, error);
    if (code != IMP_SUCCESS) return code;
    if (view.apart > s->gamma_clear) {
        prove_until(s, box, times_of(s, box).end, true);
        tell_later(s, box);
        return *rest = BOX_DONE, IMP_SUCCESS;
    }
    if (view.total < INFINITY) {
        code = scene_of_box(s, box, &scene, error);
        if (code != IMP_SUCCESS) return code;
        code = ask_queries(s, box, scene, &view, rest, error);
        imp_scene_free(scene);
        if (code != IMP_SUCCESS || *rest != BOX_OPEN) return code;
    }
    if (s->best.t <= box->key) {
        survey_tell(s, box, box->key, s->options.t_end, IMP_VERDICT_CONTACT, 0);
        return *rest = BOX_DONE, IMP_SUCCESS;
    }
    code = split(s, box, &view, &is_split, error);
    *rest = is_split ? BOX_DONE : BOX_WAITING;
    if (!is_split) s->reason = IMP_REASON_RESOLUTION;
    return code;
}

/* --- The least distance ----------------------------------------------------------------------- */

double survey_distance_enough(const imp_survey *s)
{
    const double upper = s->best.distance, required = s->asked.required;
    if (!(upper < INFINITY)) return INFINITY;
    const double narrow = padded_lower(upper * (1 - s->asked.tolerance), 4);
    const double kept = tolerances_nearly(required);
    return upper > required && kept > narrow && kept <= upper ? kept : narrow;
}

static void note_nearest(imp_survey *s, const survey_box *box, const imp_clearance *found)
{
    if (!found->has_witness || !(found->upper < s->best.distance)) return;
    s->best.distance = found->upper;
    s->best.nearest = *found;
    keep_values(s, box, &s->best.nearest.t);
    in_scene(&s->pairs[box->pair], &s->best.nearest.a, &s->best.nearest.b);
}

/* Closes a box, whose distance is enough or cannot be known better. */
static void settle(imp_survey *s, const survey_box *box)
{
    if (box->key < s->settled) s->settled = box->key;
    s->proved += box->share;
    survey_tell(s, box, s->options.t_start, s->options.t_end, IMP_VERDICT_CLEAR, box->key);
}

/* Returns how narrow the bracket at the middle is to be: the shift blurs it anyhow. */
static double tolerance_of(const imp_survey *s, double total)
{
    const double own = 0.5 * s->asked.tolerance, least = own > 1e-9 ? own : 1e-9, most = 0.25;
    if (!(total > 0)) return least;
    const double wanted =
        s->best.distance < INFINITY ? 0.5 * total / (s->best.distance + total) : most;
    return wanted > least ? wanted : least;
}

static imp_code measure_distance(imp_survey *s, survey_box *box, double total, box_rest *rest,
                                 imp_error *error)
{
    const double enough = survey_distance_enough(s);
    const double within = enough < INFINITY ? sum_upper(enough, total) : 0;
    imp_scene *scene;
    imp_clearance found;
    imp_code code = scene_of_box(s, box, &scene, error);
    if (code != IMP_SUCCESS) return code;
    code = run_distance(s, scene, times_of(s, box), within, tolerance_of(s, total), &found, error);
    imp_scene_free(scene);
    if (code != IMP_SUCCESS) return code;
    const double lower = total > 0 ? difference_lower(found.lower, total) : found.lower;
    if (lower > box->key) box->key = lower;
    note_nearest(s, box, &found);
    if (must_end(s, found.reason)) *rest = BOX_WAITING;
    return IMP_SUCCESS;
}

static imp_code ask_distance(imp_survey *s, survey_box *box, box_rest *rest, imp_error *error)
{
    survey_view view;
    bool is_split = false;
    imp_code code = measure(s, box, &view, error);
    if (code != IMP_SUCCESS) return code;
    if (view.apart > box->key) box->key = view.apart;
    if (view.total < INFINITY && !(box->key >= survey_distance_enough(s)))
        code = measure_distance(s, box, view.total, rest, error);
    if (code != IMP_SUCCESS || *rest != BOX_OPEN) return code;
    if (!(box->key >= survey_distance_enough(s))) code = split(s, box, &view, &is_split, error);
    if (code == IMP_SUCCESS && !is_split) settle(s, box);
    return code;
}

imp_code survey_ask(imp_survey *s, survey_box *box, imp_error *error)
{
    box_rest rest = BOX_OPEN;
    imp_code code = survey_mark_take(s, box, error);
    if (code != IMP_SUCCESS) return free(box), code;
    s->boxes += 1;
    s->key_asked = s->is_distance ? s->options.t_start : box->key;
    code = s->is_distance ? ask_distance(s, box, &rest, error) : ask_contact(s, box, &rest, error);
    if (!is_limit(s->reason)) {
        survey_mark_drop(s);
        if (code == IMP_SUCCESS) code = survey_flush(s, error);
    }
    if (code != IMP_SUCCESS || rest != BOX_WAITING) return free(box), code;
    return box_queue_push(&s->queue, box) ? IMP_SUCCESS : error_set_memory(error);
}
