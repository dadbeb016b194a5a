/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/survey/survey_internal.h"

double survey_time_lower(const imp_survey *s)
{
    const survey_box *first = box_queue_first(&s->queue);
    double t = s->best.t < s->question.options.t_end ? s->best.t : s->question.options.t_end;
    if (first != NULL && first->key < t) t = first->key;
    return t;
}

FP_APART static imp_result result_of(const imp_survey *s)
{
    imp_result r = s->best.contact;
    const bool is_contact = s->verdict == IMP_VERDICT_CONTACT;
    if (!is_contact) r = (imp_result){.t = NAN, .gap = NAN};
    r.struct_size = (uint32_t)sizeof r;
    r.verdict = s->verdict;
    r.reason = s->reason;
    r.t_lower = survey_time_lower(s); /* with `any`, another contact may be earlier than t */
    r.gamma = s->question.gamma;
    r.gamma_clear = s->question.gamma_clear;
    r.stats = s->counts.stats;
    r.t_start = s->question.options.t_start;
    r.t_end = s->question.options.t_end;
    const bool any = s->question.examined.lo <= s->question.examined.hi;
    r.t_examined[0] = any ? s->question.examined.lo : NAN;
    r.t_examined[1] = any ? s->question.examined.hi : NAN;
    return r;
}

static imp_code refuse_kind(const char *wanted, imp_error *error)
{
    return error_set(error, IMP_ERROR_USAGE, "this survey is for %s", wanted);
}

imp_code imp_survey_get_result(const imp_survey *s, imp_result *result, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_get_result");
    const imp_code code = sized_check("imp_result", result, offsetof(imp_result, kind), error);
    if (code != IMP_SUCCESS) return code;
    if (s->question.is_clearance)
        return refuse_kind("a clearance: imp_survey_get_clearance", error);
    const fp_environment environment = fp_environment_enter();
    const imp_result own = result_of(s);
    fp_environment_leave(&environment);
    sized_write(result, &own);
    return IMP_SUCCESS;
}

/* --- Clearances ------------------------------------------------------------------------------- */

static double lower_of(const imp_survey *s)
{
    const survey_box *first = box_queue_first(&s->queue);
    double lower = s->counts.settled < s->best.distance ? s->counts.settled : s->best.distance;
    if (first != NULL && first->key < lower) lower = first->key;
    return lower;
}

FP_APART static imp_clearance bracket_of(const imp_survey *s)
{
    imp_clearance c = s->best.nearest;
    const double required = s->question.clearance.required;
    if (!s->best.is_known) c = (imp_clearance){.t = NAN, .has_witness = false};
    c.lower = lower_of(s);
    c.upper = s->best.distance;
    c.verdict = !(required > 0)                          ? IMP_REQUIREMENT_NONE
                : c.upper <= required                    ? IMP_REQUIREMENT_VIOLATED
                : c.lower >= tolerances_nearly(required) ? IMP_REQUIREMENT_HOLDS
                                                         : IMP_REQUIREMENT_UNDECIDED;
    c.t_violated = c.gap_violated = NAN;
    if (c.verdict != IMP_REQUIREMENT_VIOLATED) return c;
    c.t_violated = c.t;
    c.gap_violated = c.upper;
    c.a_violated = c.a;
    c.b_violated = c.b;
    return c;
}

/* Returns the answer of a search for any contact at the required distance. */
FP_APART static imp_clearance decision_of(const imp_survey *s)
{
    const imp_result *r = &s->best.contact;
    imp_clearance c = {.t = NAN, .upper = INFINITY, .t_violated = NAN, .gap_violated = NAN};
    c.verdict = s->verdict == IMP_VERDICT_CLEAR     ? IMP_REQUIREMENT_HOLDS
                : s->verdict == IMP_VERDICT_CONTACT ? IMP_REQUIREMENT_VIOLATED
                                                    : IMP_REQUIREMENT_UNDECIDED;
    if (c.verdict == IMP_REQUIREMENT_HOLDS) c.lower = s->question.gamma_clear;
    if (c.verdict != IMP_REQUIREMENT_VIOLATED) return c;
    c.has_witness = true;
    c.has_normal = r->has_normal;
    memcpy(c.normal, r->normal, sizeof c.normal);
    c.t = c.t_violated = r->t;
    c.gap_violated = r->gap;
    c.upper = r->kind == IMP_CONTACT_INSIDE ? 0 : s->question.gamma;
    c.kind = r->kind;
    c.a = c.a_violated = r->a;
    c.b = c.b_violated = r->b;
    return c;
}

imp_code imp_survey_get_clearance(const imp_survey *s, imp_clearance *answer, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_get_clearance");
    const imp_code code = sized_check("imp_clearance", answer, sizeof *answer, error);
    if (code != IMP_SUCCESS) return code;
    if (!s->question.is_clearance) return refuse_kind("a contact: imp_survey_get_result", error);
    const fp_environment environment = fp_environment_enter();
    imp_clearance own = s->question.is_distance ? bracket_of(s) : decision_of(s);
    fp_environment_leave(&environment);
    own.struct_size = (uint32_t)sizeof own;
    const bool is_decision = !s->question.is_distance && s->reason == IMP_REASON_NONE;
    own.reason = is_decision ? IMP_REASON_DECIDED : s->reason;
    own.body[0] = s->question.how.body[0], own.body[1] = s->question.how.body[1];
    own.t_start = s->question.options.t_start, own.t_end = s->question.options.t_end;
    own.required = s->question.clearance.required;
    own.stats = s->counts.stats;
    sized_write(answer, &own);
    return IMP_SUCCESS;
}

/* --- Values ----------------------------------------------------------------------------------- */

bool imp_survey_values(const imp_survey *s, double *values)
{
    if (s == NULL || values == NULL || !s->best.is_known) return false;
    memcpy(values, s->best.values, s->parameters * sizeof *values);
    return true;
}

/* Returns the share that is proved: 1 if the search is decided, whatever boxes still wait. */
FP_APART static double share_of(const imp_survey *s)
{
    const bool is_all = s->reason == IMP_REASON_NONE &&
                        (s->question.is_distance || s->verdict == IMP_VERDICT_CLEAR);
    return is_all || s->pairs.count == 0 ? 1 : s->counts.proved / (double)s->pairs.count;
}

imp_code imp_survey_get_state(const imp_survey *s, imp_survey_state *state, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_get_state");
    const imp_code code = sized_check("imp_survey_state", state, sizeof *state, error);
    if (code != IMP_SUCCESS) return code;
    const survey_box *first = box_queue_first(&s->queue);
    const fp_environment environment = fp_environment_enter();
    const double proved = share_of(s);
    fp_environment_leave(&environment);
    imp_survey_state own = {.struct_size = (uint32_t)sizeof own,
                            .reason = s->reason,
                            .boxes = s->counts.boxes_before + s->counts.boxes,
                            .waiting = s->queue.count,
                            .proved = proved,
                            .t_upper = s->best.t,
                            .pairs_of_bodies = s->pairs.count,
                            .has_worst = first != NULL};
    if (first != NULL) {
        memcpy(own.worst_body, s->pairs.at[first->pair].body, sizeof own.worst_body);
        own.worst_time[0] = s->question.is_distance ? s->question.options.t_start : first->key;
        own.worst_time[1] = s->question.options.t_end;
    }
    sized_write(state, &own);
    return IMP_SUCCESS;
}

bool imp_survey_worst(const imp_survey *s, double *lo, double *hi)
{
    const survey_box *first = s != NULL ? box_queue_first(&s->queue) : NULL;
    if (first == NULL || lo == NULL || hi == NULL) return false;
    for (size_t k = 0; k < s->parameters; ++k) {
        lo[k] = first->range[2 * k];
        hi[k] = first->range[2 * k + 1];
    }
    return true;
}
