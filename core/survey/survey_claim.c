/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/survey/survey_proof.h"

/* What the certificate of a survey states. */

/* A contact is the earliest only where the survey has looked for that, and then of times after the
 * first; else the two points are all that is claimed: nothing is nearer than 0. */
static proof_claim claim_of_contact(const imp_survey *s)
{
    const bool is_contact = s->verdict == IMP_VERDICT_CONTACT;
    const double to = survey_time_lower(s);
    const bool is_earliest =
        s->verdict == IMP_VERDICT_CLEAR ||
        (to > s->question.options.t_start && !(is_contact && s->question.how.any));
    const char *word = is_contact                        ? "contact"
                       : s->verdict == IMP_VERDICT_CLEAR ? "clear"
                                                         : "undecided";
    proof_claim claim = {.verdict = word,
                         .apart = is_earliest ? s->question.gamma_clear : 0,
                         .from = s->question.options.t_start,
                         .to = is_earliest ? to : s->question.options.t_end};
    if (s->question.is_clearance)
        claim.verdict = s->verdict == IMP_VERDICT_CLEAR ? "holds"
                        : is_contact                    ? "violated"
                                                        : "undecided";
    if (is_contact)
        proof_claim_points(&claim, &s->best.contact.a, &s->best.contact.b, s->best.contact.t,
                           s->question.gamma);
    return claim;
}

static imp_code claim_of_distance(const imp_survey *s, proof_claim *claim, imp_error *error)
{
    imp_clearance c = {.struct_size = (uint32_t)sizeof c};
    const imp_code code = imp_survey_get_clearance(s, &c, error);
    if (code != IMP_SUCCESS) return code;
    *claim = (proof_claim){.verdict = c.verdict == IMP_REQUIREMENT_HOLDS      ? "holds"
                                      : c.verdict == IMP_REQUIREMENT_VIOLATED ? "violated"
                                                                              : "distance",
                           .apart = proof_apart_lower(&c, &s->question.clearance),
                           .from = s->question.options.t_start,
                           .to = s->question.options.t_end};
    if (c.has_witness) proof_claim_points(claim, &c.a, &c.b, c.t, proof_within_upper(&c));
    return IMP_SUCCESS;
}

FP_APART static imp_code write_proof(const imp_survey *s, const char *stated, const proof_sink *to,
                                     imp_error *error)
{
    proof_claim claim = claim_of_contact(s);
    imp_code code = IMP_SUCCESS;
    if (s->proof == NULL || s->reason == IMP_REASON_RUNNING)
        return error_set(error, IMP_ERROR_USAGE, "proof: this survey %s",
                         s->proof == NULL ? "keeps none" : "has not ended");
    if (s->question.is_distance) code = claim_of_distance(s, &claim, error);
    if (code != IMP_SUCCESS) return code;
    double *ranges = malloc((2 * s->parameters + 1) * sizeof *ranges);
    if (ranges == NULL) return error_set_memory(error);
    for (size_t k = 0; k < s->parameters; ++k)
        ranges[2 * k] = s->lo[k], ranges[2 * k + 1] = s->hi[k];
    claim.ranges = ranges;
    claim.values = s->best.values;
    code = survey_proof_write(s, &claim, stated, to, error);
    free(ranges);
    return code;
}

imp_code imp_survey_write_proof(const imp_survey *s, const char *stated, imp_proof_sink write,
                                void *context, imp_error *error)
{
    if (s == NULL || write == NULL) return error_set_missing(error, "imp_survey_write_proof");
    const fp_environment environment = fp_environment_enter();
    const proof_sink to = {write, context};
    const imp_code code = write_proof(s, stated, &to, error);
    fp_environment_leave(&environment);
    return code;
}
