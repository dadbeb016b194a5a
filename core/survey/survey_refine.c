/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/survey/survey_internal.h"

static imp_code check(const imp_survey *s, double gamma, double gamma_clear, imp_error *error)
{
    if (s->question.is_clearance)
        return error_set(error, IMP_ERROR_USAGE, "refine: this survey asks for a minimum distance");
    if (s->failed)
        return error_set(error, IMP_ERROR_USAGE, "this survey has ended with an error already");
    const imp_code code = tolerances_check(gamma, gamma_clear, NULL, error);
    if (code != IMP_SUCCESS) return code;
    const double clear = tolerances_clear(gamma, gamma_clear);
    if (gamma <= s->question.gamma && clear <= s->question.gamma_clear) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_USAGE,
                     "refine: gamma %g and gamma_clear %g may not exceed those in force, %g and %g",
                     gamma, clear, s->question.gamma, s->question.gamma_clear);
}

/* Begins again with the whole box of values of each pair.
 *
 * Lemma. Before t no points are nearer than the gamma_clear of before at any values, and so none
 * are nearer than a smaller one: t is a key of every box (survey_box). */
FP_APART static imp_code begin_at(imp_survey *s, double t, imp_error *error)
{
    const double all = s->question.options.t_end - s->question.options.t_start;
    const double share = all > 0 ? (t - s->question.options.t_start) / all : 0;
    box_queue_clear(&s->queue);
    survey_snapshot_drop(s);
    survey_records_clear(&s->records);
    s->best.is_known = false;
    s->best.t = INFINITY;
    s->verdict = IMP_VERDICT_UNDECIDED;
    s->reason = IMP_REASON_RUNNING;
    s->counts.proved = share * (double)s->pairs.count;
    for (size_t k = 0; k < s->pairs.count; ++k) s->pairs.at[k].proved = share;
    return survey_add_roots(s, t, error);
}

imp_code imp_survey_refine(imp_survey *s, double gamma, double gamma_clear, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_refine");
    const fp_environment environment = fp_environment_enter();
    imp_code code = check(s, gamma, gamma_clear, error);
    if (code == IMP_SUCCESS) {
        const bool is_clear = s->reason == IMP_REASON_NONE && s->verdict == IMP_VERDICT_CLEAR;
        s->question.gamma = s->question.options.gamma = gamma;
        s->question.gamma_clear = s->question.options.gamma_clear =
            tolerances_clear(gamma, gamma_clear);
        if (!is_clear) code = begin_at(s, survey_time_lower(s), error);
        if (code == IMP_SUCCESS && !is_clear) code = survey_choose_swept(s, error);
        s->failed = code != IMP_SUCCESS;
    }
    fp_environment_leave(&environment);
    return code;
}
