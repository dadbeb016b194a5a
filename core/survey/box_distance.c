/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/rounding.h"
#include "core/survey/survey_proof.h"

double survey_distance_enough(const imp_survey *s)
{
    const double upper = s->best.distance, required = s->question.clearance.required;
    if (!(upper < INFINITY)) return INFINITY;
    const double narrow = padded_lower(upper * (1 - s->question.clearance.tolerance), 4);
    const double kept = tolerances_nearly(required);
    return upper > required && kept > narrow && kept <= upper ? kept : narrow;
}

static void note_nearest(imp_survey *s, const survey_box *box, const imp_clearance *found)
{
    if (!found->has_witness || !(found->upper < s->best.distance)) return;
    s->best.distance = found->upper;
    s->best.nearest = *found;
    box_keep_values(s, box, &s->best.nearest.t);
    box_name_side(&s->pairs.at[box->pair], &s->best.nearest.a, &s->best.nearest.b);
}

/* Closes a box, whose distance is enough or cannot be known better. */
static void settle(imp_survey *s, const survey_box *box)
{
    if (box->key < s->counts.settled) s->counts.settled = box->key;
    survey_add_proved(s, box, box->share);
    survey_record_box(s, box, s->question.options.t_start, s->question.options.t_end,
                      IMP_VERDICT_CLEAR, box->key);
}

/* Returns the tolerance of the bracket at the middle. A bracket much narrower than the shift gains
 * nothing; 1e-9 is the least tolerance that a query takes. Any other is sound. */
static double tolerance_of(const imp_survey *s, double total)
{
    const double own = 0.5 * s->question.clearance.tolerance, least = own > 1e-9 ? own : 1e-9,
                 most = 0.25;
    if (!(total > 4 * SURFACE_STILL)) return least; /* no parameter can be halved */
    const double wanted =
        s->best.distance < INFINITY ? 0.5 * total / (s->best.distance + total) : most;
    return wanted > least ? wanted : least;
}

static imp_code measure_distance(imp_survey *s, survey_box *box, double total, box_state *state,
                                 imp_error *error)
{
    const double enough = survey_distance_enough(s);
    const double within = enough < INFINITY ? sum_upper(enough, total) : 0;
    imp_scene *scene;
    imp_clearance found;
    imp_code code = box_scene(s, box, &scene, error);
    if (code != IMP_SUCCESS) return code;
    code = box_run_distance(s, box, scene, box_times(s, box), within, tolerance_of(s, total),
                            &found, error);
    imp_scene_free(scene);
    if (code != IMP_SUCCESS) return code;
    const double lower = total > 0 ? difference_lower(found.lower, total) : found.lower;
    survey_proof_note(s, -INFINITY, lower);
    if (lower > box->key) box->key = lower;
    note_nearest(s, box, &found);
    if (box_must_end(s, found.reason)) *state = BOX_WAITING;
    return IMP_SUCCESS;
}

imp_code box_ask_distance(imp_survey *s, survey_box *box, box_state *state, imp_error *error)
{
    box_bounds bounds;
    bool is_split = false;
    imp_code code = box_measure(s, box, &bounds, error);
    if (code != IMP_SUCCESS) return code;
    if (bounds.apart > box->key) box->key = bounds.apart;
    if (bounds.total < INFINITY && !(box->key >= survey_distance_enough(s)))
        code = measure_distance(s, box, bounds.total, state, error);
    if (code != IMP_SUCCESS || *state != BOX_OPEN) return code;
    if (!(box->key >= survey_distance_enough(s)))
        code = box_split(s, box, &bounds, &is_split, error);
    if (code == IMP_SUCCESS && !is_split) settle(s, box);
    return code;
}
