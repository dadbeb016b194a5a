/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/scene/posed_scene.h"
#include "core/survey/survey_proof.h"

double survey_distance_enough(const imp_survey *s)
{
    const double upper = s->best.distance, required = s->question.clearance.required;
    if (!(upper < INFINITY)) return INFINITY;
    const double narrow = padded_lower(upper * (1 - s->question.clearance.tolerance), 4);
    const double kept = tolerances_nearly(required);
    return upper > required && kept > narrow && kept <= upper ? kept : narrow;
}

double survey_distance_touching(const imp_survey *s)
{
    const double required = s->question.clearance.required, gamma = s->question.gamma;
    return required > 0 && required < gamma ? required : gamma;
}

static bool note_nearest(imp_survey *s, const survey_pair *pair, const double *values,
                         const imp_clearance *found)
{
    if (!found->has_witness || !(found->upper < s->best.distance)) return false;
    s->best.distance = found->upper;
    s->best.nearest = *found;
    box_keep_values(s, pair, values, &s->best.nearest.t);
    box_name_side(pair, &s->best.nearest.a, &s->best.nearest.b);
    return true;
}

/* Closes a box, whose distance is enough or cannot be known better. */
static void settle(imp_survey *s, const survey_box *box)
{
    if (box->key < s->counts.settled) s->counts.settled = box->key;
    survey_add_proved(s, box, box->share);
    survey_record_box(s, box, s->question.options.t_start, s->question.options.t_end,
                      IMP_VERDICT_CLEAR, box->key);
}

static const double LEAST_TOLERANCE = 1e-9; /* that a query takes */
#define DECIDING_TOLERANCE SURVEY_DECIDING_TOLERANCE

/* Whether a box is to be halved whose parameters shift the bodies by this, but for slips. A smaller
 * shift, below 2e-90, may be that of a box of which no range can be halved. */
static bool is_divisible(double shifts) { return shifts > 4 * SURFACE_STILL; }

static bool is_requirement_open(const imp_survey *s)
{
    const double required = s->question.clearance.required;
    return required > 0 && s->best.distance > required;
}

/* Returns the tolerance of the bracket at the middle. A bracket much narrower than the shift gains
 * nothing. Where a distance is required, small boxes have brackets that decide. Any tolerance is
 * sound. */
static double tolerance_of(const imp_survey *s, double shifts)
{
    const double own = 0.5 * s->question.clearance.tolerance, most = 0.25;
    const double usual = own > LEAST_TOLERANCE ? own : LEAST_TOLERANCE;
    if (!is_divisible(shifts)) return usual;
    const double least =
        is_requirement_open(s) && DECIDING_TOLERANCE < usual ? DECIDING_TOLERANCE : usual;
    const double wanted =
        s->best.distance < INFINITY ? 0.5 * shifts / (s->best.distance + shifts) : most;
    return wanted > least ? wanted : least;
}

/* Returns the next tolerance of the bracket at the middle of a box that cannot be halved, where the
 * last one left the requirement undecided with this upper bound.
 *
 * Lemma. Let D be the distance required and h half way from (1 - 1e-6) D, the distance that is
 * enough, to D. A bracket ends with a lower bound of at least (1 - R) of its upper one. With R =
 * 1 - h / upper, it is at least h if the upper bound stays as it is; with R = 0.25e-6, it is above
 * h for any upper bound above D. An upper bound of at most D violates the requirement. So two more
 * brackets decide: if D >= 2^-277, the 0.5e-6 D between h and the distance that is enough covers a
 * shift of 4 SURFACE_STILL = 2^-298, and two slips (survey_pairs.c). For smaller D they may not;
 * such a box is halved where it can be, else it is unresolved. */
static double tolerance_deciding(const imp_survey *s, double before, double upper)
{
    const double required = s->question.clearance.required;
    const double wanted = 1 - (0.5 * required + 0.5 * tolerances_nearly(required)) / upper;
    const bool is_first = before >= 0.5 * s->question.clearance.tolerance;
    return is_first && wanted > DECIDING_TOLERANCE && wanted < before ? wanted : DECIDING_TOLERANCE;
}

/* --- Nearer values ---------------------------------------------------------------------------- */

/* Returns the distance of the two points of a witness at other values: they stay where they are on
 * their surfaces. INFINITY: they cannot be evaluated. */
static imp_code distance_at(const imp_survey *s, const survey_pair *pair, const double *values,
                            const imp_clearance *of, double *distance, imp_error *error)
{
    const imp_side *side[2] = {&of->a, &of->b};
    double x[2][3], sum = 0;
    imp_scene *scene;
    *distance = INFINITY;
    if (posed_scene_of_bodies(s->scene, values, pair->body, 2, pair->swept, &scene) != IMP_SUCCESS)
        return error_set_memory(error);
    bool is_known = true;
    for (int k = 0; k < 2; ++k) {
        const double at[3] = {side[k]->u, side[k]->v, of->t};
        const imp_place where = {side[k]->body, side[k]->surface, side[k]->piece};
        is_known = is_known && imp_piece_eval(scene, where, 1, at, x[k], NULL, NULL) == IMP_SUCCESS;
    }
    imp_scene_free(scene);
    for (int i = 0; i < 3 && is_known; ++i) sum += (x[0][i] - x[1][i]) * (x[0][i] - x[1][i]);
    if (is_known) *distance = sqrt(sum);
    return IMP_SUCCESS;
}

/* Moves each value to the end of its range, in the whole survey, where the two points are nearer.
 * *moved: any was. The least distance over small ranges is at a corner, mostly. */
static imp_code move_values(imp_survey *s, const survey_pair *pair, const imp_clearance *of,
                            double *values, bool *moved, imp_error *error)
{
    double least, d;
    *moved = false;
    imp_code code = distance_at(s, pair, values, of, &least, error);
    for (size_t j = 0; j < s->parameters; ++j)
        for (int end = 0; end < 2 && code == IMP_SUCCESS && j != pair->swept; ++end) {
            const double before = values[j];
            values[j] = end == 0 ? s->lo[j] : s->hi[j];
            code = distance_at(s, pair, values, of, &d, error);
            if (d < least)
                least = d, *moved = true;
            else
                values[j] = before;
        }
    return code;
}

enum { DESCENTS_MOST = 4 };

/* Looks for nearer bodies from a witness at the box's middle: at the corner of all values to which
 * its points lead, and on from there. Any values are sound, since they bound the answer from above
 * only. */
static imp_code descend(imp_survey *s, const survey_pair *pair, const imp_clearance *from,
                        box_state *state, imp_error *error)
{
    const query_times times =
        box_is_swept(pair) ? (query_times){s->lo[pair->swept], s->hi[pair->swept]}
                           : (query_times){s->question.options.t_start, s->question.options.t_end};
    double *values = malloc((s->parameters + 1) * sizeof *values);
    imp_clearance at = *from;
    imp_code code = values != NULL ? IMP_SUCCESS : error_set_memory(error);
    bool goes_on = code == IMP_SUCCESS;
    if (goes_on) memcpy(values, s->box.middle, s->parameters * sizeof *values);
    for (int k = 0; k < DESCENTS_MOST && goes_on; ++k) {
        imp_scene *scene = NULL;
        code = move_values(s, pair, &at, values, &goes_on, error);
        if (code != IMP_SUCCESS || !goes_on) break;
        if (posed_scene_of_bodies(s->scene, values, pair->body, 2, pair->swept, &scene) !=
            IMP_SUCCESS)
            code = error_set_memory(error);
        else
            code = box_run_distance(s, NULL, scene, times, s->best.distance, tolerance_of(s, 0),
                                    &at, error);
        imp_scene_free(scene);
        goes_on = code == IMP_SUCCESS && note_nearest(s, pair, values, &at);
        if (code == IMP_SUCCESS && box_must_end(s, at.reason))
            *state = BOX_WAITING, goes_on = false;
    }
    free(values);
    return code;
}

/* --- Boxes ------------------------------------------------------------------------------------ */

static const double CONTACT_BEYOND = 1e-6; /* part of `enough`; what is nearer ends the search */

/* Proves that the box is apart by what is enough, if that is known, by a search for a contact at
 * that distance.
 *
 * Lemma. A query for contact that is clear at `enough` with room, or whose pairs are excluded by
 * ways and rest (pair_spread.c), proves that nothing comes nearer than `enough` at any values of
 * the box: the lemmas of a contact with `enough` for gamma_clear (survey_internal.h). It says so by
 * bounds of second order, where the bracket at the middle loses the whole shift. Times that one
 * query has proved are left out of the next, so that together they cover all. */
static imp_code prove_enough(imp_survey *s, survey_box *box, imp_scene *scene,
                             const box_bounds *bounds, box_state *state, imp_error *error)
{
    const double enough = survey_distance_enough(s), total = bounds->total;
    const double gap = fmin(CONTACT_BEYOND * enough, s->best.distance - enough);
    const double exact[2] = {enough + gap, enough};
    const double clear = sum_upper(enough, total);
    const double coarse[2] = {clear + 0.25 * (total + gap), clear};
    imp_result found;
    if (!(gap > 0 && enough > 0 && exact[0] > enough && s->best.distance < INFINITY))
        return IMP_SUCCESS;
    query_times times = box_times(s, box);
    for (;;) {
        const bool is_limited = box_limits_first(s, box->limit);
        const imp_code code =
            box_run_roomy(s, box, scene, bounds, times, coarse, exact, &found, error);
        if (code != IMP_SUCCESS) return code;
        const bool is_clear = found.verdict == IMP_VERDICT_CLEAR;
        survey_proof_note(s, -INFINITY, is_clear ? enough : 0);
        if (is_clear) box->key = enough;
        if (found.verdict != IMP_VERDICT_UNDECIDED) return IMP_SUCCESS;
        if (!(found.reason == IMP_REASON_PAIRS && is_limited)) {
            if (box_must_end(s, found.reason)) *state = BOX_WAITING;
            return IMP_SUCCESS;
        }
        const double left = 0.5 * (times.end - times.start);
        times.start = found.t_lower;
        if (s->proof != NULL || !(times.end - times.start <= left)) {
            box_raise_limit(box);
            return IMP_SUCCESS;
        }
    }
}

/* Asks for the bracket at the middle. If its points are the nearest so far, it becomes *nearest and
 * *is_nearer true. */
static imp_code ask_middle(imp_survey *s, survey_box *box, imp_scene *scene, double total,
                           double tolerance, imp_clearance *found, imp_clearance *nearest,
                           bool *is_nearer, imp_error *error)
{
    const double enough = survey_distance_enough(s);
    const double within = enough < INFINITY ? sum_upper(enough, total) : 0;
    const imp_code code =
        box_run_distance(s, box, scene, box_times(s, box), within, tolerance, found, error);
    if (code != IMP_SUCCESS) return code;
    box->near = found->upper;
    box->cost = found->stats.pairs;
    const double lower = total > 0 ? difference_lower(found->lower, total) : found->lower;
    survey_proof_note(s, -INFINITY, lower);
    if (lower > box->key) box->key = lower;
    if (note_nearest(s, &s->pairs.at[box->pair], s->box.middle, found)) {
        *nearest = *found;
        *is_nearer = true;
    }
    return IMP_SUCCESS;
}

/* Whether only a narrower bracket at the middle can tell if the box is as far as required. */
static bool must_narrow(const imp_survey *s, const survey_box *box, double shifts, double tolerance)
{
    return is_requirement_open(s) && !is_divisible(shifts) && tolerance > DECIDING_TOLERANCE &&
           !(box->key >= survey_distance_enough(s));
}

static imp_code measure_middle(imp_survey *s, survey_box *box, imp_scene *scene,
                               const box_bounds *bounds, box_state *state, imp_error *error)
{
    const double total = bounds->total, shifts = bounds->shifts;
    const bool is_moved = shifts > 0 && !box_is_unmoved(&s->pairs.at[box->pair]);
    double tolerance = tolerance_of(s, shifts);
    imp_clearance found, nearest;
    bool is_nearer = false;
    imp_code code =
        ask_middle(s, box, scene, total, tolerance, &found, &nearest, &is_nearer, error);
    while (code == IMP_SUCCESS && !box_is_limit(found.reason) &&
           must_narrow(s, box, shifts, tolerance)) {
        tolerance = tolerance_deciding(s, tolerance, found.upper);
        code = ask_middle(s, box, scene, total, tolerance, &found, &nearest, &is_nearer, error);
    }
    if (code != IMP_SUCCESS) return code;
    if (box_must_end(s, found.reason)) return *state = BOX_WAITING, IMP_SUCCESS;
    return is_nearer && is_moved ? descend(s, &s->pairs.at[box->pair], &nearest, state, error)
                                 : code;
}

/* Below so many pairs, brackets at the middles of smaller boxes cost less than a search by ways,
 * which takes 100 to 1000; so far that two halvings are enough. core/MEASUREMENTS.md has what other
 * limits cost. */
static const double CHEAP_PAIRS = 128, EXCESS_LEAST = 0.25;

/* Whether a box is better halved until brackets at middles close it. Where the bodies are as far
 * apart as at the middle of the box it is a half of, a box is closed once its shift is no more than
 * what that exceeds the distance that is enough by. With k parameters that shift alike, this makes
 * (shift / excess)^k boxes; each takes about the pairs that the middle took. */
static bool is_better_halved(const imp_survey *s, const survey_box *box, double total)
{
    const double excess = box->near - survey_distance_enough(s);
    double most = 0;
    for (size_t j = 0; j < s->parameters; ++j)
        if (s->box.shift[0][j] > most) most = s->box.shift[0][j];
    if (!(excess > EXCESS_LEAST * total && excess < INFINITY && most > 0)) return false;
    const double boxes = excess < total ? pow(total / excess, total / most) : 1;
    return boxes * (double)box->cost < CHEAP_PAIRS;
}

static imp_code measure_distance(imp_survey *s, survey_box *box, const box_bounds *bounds,
                                 box_state *state, imp_error *error)
{
    const bool is_moved = bounds->shifts > 0 && !box_is_unmoved(&s->pairs.at[box->pair]);
    imp_scene *scene;
    imp_code code = box_scene(s, box, &scene, error);
    if (code != IMP_SUCCESS) return code;
    if (is_moved && !is_better_halved(s, box, bounds->total))
        code = prove_enough(s, box, scene, bounds, state, error);
    if (code == IMP_SUCCESS && *state == BOX_OPEN && !(box->key >= survey_distance_enough(s)))
        code = measure_middle(s, box, scene, bounds, state, error);
    imp_scene_free(scene);
    return code;
}

imp_code box_ask_distance(imp_survey *s, survey_box *box, box_state *state, imp_error *error)
{
    box_bounds bounds;
    bool is_split = false;
    imp_code code = box_measure(s, box, &bounds, error);
    if (code != IMP_SUCCESS) return code;
    if (bounds.apart > box->key) box->key = bounds.apart;
    if (bounds.total < INFINITY && !(box->key >= survey_distance_enough(s)))
        code = measure_distance(s, box, &bounds, state, error);
    if (code != IMP_SUCCESS || *state != BOX_OPEN) return code;
    if (!(box->key >= survey_distance_enough(s)))
        code = box_split(s, box, &bounds, &is_split, error);
    if (code == IMP_SUCCESS && !is_split) settle(s, box);
    return code;
}
