/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/rounding.h"
#include "core/survey/survey_proof.h"

/* Records that nothing comes near while the swept parameter is below t, and cuts that part off the
 * box. */
static void prove_swept(imp_survey *s, survey_box *box, double t)
{
    double *range = box->range + 2 * s->pairs.at[box->pair].swept;
    const double lo = range[0], hi = range[1];
    const double part = t < hi ? box->share * ((t - lo) / (hi - lo)) : box->share;
    survey_add_proved(s, box, part);
    box->share -= part;
    range[1] = t;
    survey_record_box(s, box, s->question.options.t_start, s->question.options.t_end,
                      IMP_VERDICT_CLEAR, s->question.gamma_clear);
    range[0] = t, range[1] = hi;
}

/* Records that nothing comes near in the box before t, a time of its queries, and cuts that part
 * off the box. */
static void prove_until(imp_survey *s, survey_box *box, double t, bool is_clear)
{
    const double all = s->question.options.t_end - s->question.options.t_start;
    if (!(t > box_times(s, box).start) && !is_clear) return;
    if (box_is_swept(&s->pairs.at[box->pair])) {
        prove_swept(s, box, t);
        return;
    }
    survey_add_proved(s, box, all > 0 ? box->share * ((t - box->key) / all) : box->share);
    survey_record_box(s, box, box->key, t, IMP_VERDICT_CLEAR, s->question.gamma_clear);
    box->key = t;
}

static void note_contact(imp_survey *s, const survey_box *box, const imp_result *found)
{
    const double t = box_is_swept(&s->pairs.at[box->pair]) ? s->question.options.t_start : found->t;
    if (!(t < s->best.t)) return;
    s->best.t = t;
    s->best.contact = *found;
    box_keep_values(s, &s->pairs.at[box->pair], s->box.middle, &s->best.contact.t);
    box_name_side(&s->pairs.at[box->pair], &s->best.contact.a, &s->best.contact.b);
    if (s->question.how.any) s->reason = IMP_REASON_NONE;
}

/* Runs the query at the middle without room for the shift: a contact there bounds the earliest from
 * above. Where the middle lies on the edge of the values that touch, gaps of about gamma last along
 * whole edges, and this search can take a thousand times the `pairs` of the one with room. Its
 * number of pairs is limited, since boxes beside this one have contacts that are easier to find:
 * at that limit the box stays open, and nothing is concluded. */
enum { ROOMLESS_PAIRS_LEAST = 1024, ROOMLESS_PAIRS_TIMES = 8 };

static imp_code ask_without_room(imp_survey *s, const survey_box *box, imp_scene *scene,
                                 uint64_t pairs, box_state *state, imp_error *error)
{
    const double without_room[2] = {s->question.gamma, s->question.gamma_clear};
    const uint64_t limit = ROOMLESS_PAIRS_LEAST + ROOMLESS_PAIRS_TIMES * pairs;
    const bool is_own = box_limits_first(s, limit);
    imp_result found;
    const imp_code code = box_run_contact(s, NULL, scene, box_times(s, box), without_room, limit,
                                          NULL, &found, error);
    if (code != IMP_SUCCESS) return code;
    if (found.verdict == IMP_VERDICT_CONTACT) note_contact(s, box, &found);
    if (found.verdict != IMP_VERDICT_UNDECIDED) return IMP_SUCCESS;
    if (found.reason == IMP_REASON_PAIRS && is_own) return IMP_SUCCESS;
    if (box_must_end(s, found.reason)) *state = BOX_WAITING;
    return IMP_SUCCESS;
}

/* Reports the times after a known contact to the sink as undecided: they are not searched. */
static void record_later(imp_survey *s, const survey_box *box)
{
    if (box_is_swept(&s->pairs.at[box->pair]) || !(box->key < s->question.options.t_end)) return;
    survey_record_box(s, box, box->key, s->question.options.t_end, IMP_VERDICT_UNDECIDED, 0);
}

/* Runs the query with room for the shift. If its contact is too coarse to be one of the scene, runs
 * the query without that room. is_fine: a contact at gamma is one of the scene in spite of the
 * shift (survey_internal.h). Else any gamma above gamma_clear + shift is sound, since a contact
 * then only ends the query. */
static imp_code ask_queries(imp_survey *s, survey_box *box, imp_scene *scene,
                            const box_bounds *bounds, box_state *state, imp_error *error)
{
    const double total = bounds->total;
    const double between = s->question.gamma - s->question.gamma_clear;
    const bool is_fine = total <= 0.5 * between;
    const double clear =
        total > 0 ? sum_upper(s->question.gamma_clear, total) : s->question.gamma_clear;
    const double coarse[2] = {is_fine ? s->question.gamma : clear + 0.25 * (total + between),
                              clear};
    const double share = box->share;
    const bool is_limited =
        !is_fine && !box_is_unmoved(&s->pairs.at[box->pair]) && box_limits_first(s, box->limit);
    const double exact[2] = {s->question.gamma, s->question.gamma_clear};
    imp_result found;
    imp_code code =
        is_fine || box_is_unmoved(&s->pairs.at[box->pair])
            ? box_run_contact(s, box, scene, box_times(s, box), coarse, 0, NULL, &found, error)
            : box_run_roomy(s, box, scene, bounds, box_times(s, box), coarse, exact, &found, error);
    if (code != IMP_SUCCESS) return code;
    survey_proof_note(s, found.verdict == IMP_VERDICT_CLEAR ? INFINITY : found.t_lower, 0);
    prove_until(s, box, found.t_lower, found.verdict == IMP_VERDICT_CLEAR);
    if (found.verdict == IMP_VERDICT_CLEAR) {
        record_later(s, box);
        return *state = BOX_DONE, IMP_SUCCESS;
    }
    if (found.verdict == IMP_VERDICT_UNDECIDED) {
        if (is_limited && found.reason == IMP_REASON_PAIRS) {
            const bool is_half_proved = box->share <= 0.5 * share; /* it is asked about again */
            if (!is_half_proved) box_raise_limit(box);
            return *state = is_half_proved ? BOX_WAITING : BOX_OPEN, IMP_SUCCESS;
        }
        const bool is_stuck = is_fine && found.reason == IMP_REASON_RESOLUTION;
        if (is_stuck) s->reason = IMP_REASON_RESOLUTION;
        if (is_stuck || box_must_end(s, found.reason)) return *state = BOX_WAITING, IMP_SUCCESS;
    }
    if (!is_fine) return ask_without_room(s, box, scene, found.stats.pairs, state, error);
    if (found.verdict == IMP_VERDICT_CONTACT) note_contact(s, box, &found);
    return IMP_SUCCESS;
}

imp_code box_ask_contact(imp_survey *s, survey_box *box, box_state *state, imp_error *error)
{
    box_bounds bounds;
    imp_scene *scene;
    bool is_split;
    imp_code code = box_measure(s, box, &bounds, error);
    if (code != IMP_SUCCESS) return code;
    if (bounds.apart > s->question.gamma_clear) {
        prove_until(s, box, box_times(s, box).end, true);
        record_later(s, box);
        return *state = BOX_DONE, IMP_SUCCESS;
    }
    if (bounds.total < INFINITY) {
        code = box_scene(s, box, &scene, error);
        if (code != IMP_SUCCESS) return code;
        code = ask_queries(s, box, scene, &bounds, state, error);
        imp_scene_free(scene);
        if (code != IMP_SUCCESS || *state != BOX_OPEN) return code;
    }
    if (s->best.t <= box->key) {
        survey_record_box(s, box, box->key, s->question.options.t_end, IMP_VERDICT_CONTACT, 0);
        return *state = BOX_DONE, IMP_SUCCESS;
    }
    code = box_split(s, box, &bounds, &is_split, error);
    *state = is_split ? BOX_DONE : BOX_WAITING;
    if (!is_split) s->reason = IMP_REASON_RESOLUTION;
    return code;
}
