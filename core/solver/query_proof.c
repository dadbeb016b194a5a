/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/scene/tolerances.h"
#include "core/solver/query_internal.h"
#include "core/solver/query_proof.h"

/* --- Keeping ---------------------------------------------------------------------------------- */

/* Part of what is between gamma and gamma_clear that the search leaves to the verifier. */
enum { ROOM_SHARE = 16 };

double query_proof_room(const imp_query *query)
{
    const double room = query->impact.gamma - query->gamma_clear;
    return query->proof != NULL && query->clearance == NULL ? room / ROOM_SHARE : 0;
}

imp_code imp_query_keep_proof(imp_query *query, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_keep_proof");
    if (query->candidates.complete || query->failed || query->parts != NULL)
        return error_set(error, IMP_ERROR_USAGE, "proof: this query has been stepped already");
    if (scene_has_solids(query->scene))
        return error_set(error, IMP_ERROR_USAGE,
                         "proof: a body is solid; certificates are about surfaces alone");
    if (query->proof != NULL) return IMP_SUCCESS;
    proof_logs *logs = calloc(1, sizeof *logs);
    if (logs == NULL) return error_set_memory(error);
    imp_code code = IMP_SUCCESS;
    if (query->clearance != NULL) code = clearance_keep_proof(query->clearance, logs, error);
    if (code != IMP_SUCCESS) return free(logs), code;
    query->proof = logs;
    query->impact.proof = &logs->contact;
    return IMP_SUCCESS;
}

void query_forget_proof(imp_query *query)
{
    if (query->proof == NULL) return;
    proof_log_clear(&query->proof->contact);
    proof_log_clear(&query->proof->distance);
    free(query->proof);
}

/* --- What is claimed -------------------------------------------------------------------------- */

static proof_point point_of(const imp_side *side)
{
    return (proof_point){side->body, side->surface, side->piece, side->u, side->v};
}

void proof_claim_points(proof_claim *claim, const imp_side *a, const imp_side *b, double t,
                        double within)
{
    claim->has_points = true;
    claim->point[0] = point_of(a);
    claim->point[1] = point_of(b);
    claim->t = t;
    claim->within = within;
}

/* Nothing is proved before a contact at the start; then the two points are all that is claimed:
 * nothing is nearer than 0. */
static proof_claim claim_of_contact(const imp_query *query)
{
    const impact *im = &query->impact;
    const bool is_proved =
        query->verdict == IMP_VERDICT_CLEAR || im->t_lower > query->options.t_start;
    proof_claim claim = {.verdict = query->verdict == IMP_VERDICT_CONTACT ? "contact"
                                    : query->verdict == IMP_VERDICT_CLEAR ? "clear"
                                                                          : "undecided",
                         .apart = is_proved ? query->gamma_clear : 0,
                         .from = query->options.t_start,
                         .to = im->t_lower};
    if (query->verdict == IMP_VERDICT_CONTACT)
        proof_claim_points(&claim, &query->contact.side[0], &query->contact.side[1], im->t_lower,
                           im->gamma);
    return claim;
}

static const char *word_of(imp_requirement verdict)
{
    switch (verdict) {
    case IMP_REQUIREMENT_HOLDS:
        return "holds";
    case IMP_REQUIREMENT_VIOLATED:
        return "violated";
    default:
        return "distance";
    }
}

/* Part of the points' coordinates that is added to their distance for the verifier's rounding. */
#define WITHIN_ROUNDING 0x1p-44

double proof_within_upper(const imp_clearance *answer)
{
    double size = answer->upper;
    for (int i = 0; i < 3; ++i) size += fabs(answer->a.point[i]) + fabs(answer->b.point[i]);
    return answer->upper + WITHIN_ROUNDING * size;
}

/* A bracket may be far narrower than what was asked for. Then a claim of its lower end can be too
 * tight for the verifier, which encloses by other means; so it has room as though the bracket were
 * as wide as the tolerance. Where a limit left it wider than its lower end, the room is that of the
 * lower end. A requirement that is kept is claimed in any case: the search for it had room. */
enum { PART_OF_BRACKET = 16 };

double proof_apart_lower(const imp_clearance *answer, const imp_clearance_options *asked)
{
    const double width = answer->upper - answer->lower, least = asked->tolerance * answer->upper;
    const double wanted = width > least ? width : least;
    const double room = !answer->has_witness     ? 0.0625 * answer->lower
                        : wanted < answer->lower ? wanted
                                                 : answer->lower;
    const double claimed = answer->lower - room / PART_OF_BRACKET;
    const double kept =
        answer->verdict == IMP_REQUIREMENT_HOLDS ? tolerances_nearly(asked->required) : 0;
    return claimed > kept ? claimed : kept;
}

static imp_code claim_of_clearance(const imp_query *query, proof_claim *claim, imp_error *error)
{
    imp_clearance answer;
    const imp_code code = clearance_answer(query->clearance, 0, query->reason, &answer, error);
    if (code != IMP_SUCCESS) return code;
    const clearance_proved proved = clearance_what_is_proved(query->clearance, &answer);
    *claim = (proof_claim){.verdict = word_of(answer.verdict),
                           .apart = proved.apart,
                           .from = proved.from,
                           .to = proved.to};
    if (answer.t_violated >= proved.from)
        proof_claim_points(claim, &answer.a_violated, &answer.b_violated, answer.t_violated,
                           answer.required);
    else if (answer.has_witness)
        proof_claim_points(claim, &answer.a, &answer.b, answer.t, proof_within_upper(&answer));
    else if (!(proved.apart > 0))
        return error_set(error, IMP_ERROR_USAGE,
                         "proof: this query was ended by a limit before anything was proved");
    return IMP_SUCCESS;
}

/* --- Writing ---------------------------------------------------------------------------------- */

/* Whether there is something that can be written: the answer of a contact, or a bracket, at any
 * time. */
static imp_code check_ended(const imp_query *query, imp_error *error)
{
    const imp_reason unknown = query->clearance == NULL ? IMP_REASON_RUNNING : IMP_REASON_MEMORY;
    if (query->proof != NULL && query->candidates.complete && query->reason != unknown)
        return IMP_SUCCESS;
    if (query->proof != NULL && query->reason == IMP_REASON_MEMORY) return error_set_memory(error);
    return error_set(error, IMP_ERROR_USAGE, "proof: this query %s",
                     query->proof == NULL ? "keeps none"
                     : query->reason == IMP_REASON_RUNNING && query->clearance == NULL
                         ? "has not ended"
                         : "was ended by a limit before anything was proved");
}

proof_search query_proof_search(const imp_query *query)
{
    const clearance_search *c = query->clearance;
    const bool contact = c == NULL || clearance_is_by_violation(c);
    return (proof_search){&query->candidates,
                          contact ? &query->proof->contact : &query->proof->distance};
}

FP_APART static imp_code write_proof(const imp_query *query, const char *stated,
                                     const proof_sink *to, imp_error *error)
{
    imp_code code = check_ended(query, error);
    if (code != IMP_SUCCESS) return code;
    proof_claim claim = claim_of_contact(query);
    if (query->clearance != NULL) code = claim_of_clearance(query, &claim, error);
    if (code != IMP_SUCCESS) return code;
    const proof_search search = query_proof_search(query);
    proof_pairs pairs;
    if (search.log->failed ||
        !proof_pairs_begin(&pairs, query->scene, &search, claim.from, claim.to))
        return error_set_memory(error);
    const proof_source trees = {&pairs, proof_pairs_put};
    code = proof_file_write(query->scene, &trees, &claim, stated, to, error);
    proof_pairs_end(&pairs);
    return code;
}

imp_code imp_query_write_proof(const imp_query *query, const char *stated, imp_proof_sink write,
                               void *context, imp_error *error)
{
    if (query == NULL || write == NULL) return error_set_missing(error, "imp_query_write_proof");
    const fp_environment environment = fp_environment_enter();
    const proof_sink to = {write, context};
    const imp_code code = write_proof(query, stated, &to, error);
    fp_environment_leave(&environment);
    return code;
}
