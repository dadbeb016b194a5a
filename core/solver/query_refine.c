/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/scene/tolerances.h"
#include "core/solver/query_internal.h"

/* How a program continues a query that has found a contact: with a smaller gamma, or without the
 * two bodies. */

FP_APART static imp_code refine(imp_query *query, double gamma, double gamma_clear,
                                imp_error *error)
{
    if (query->clearance != NULL)
        return error_set(error, IMP_ERROR_USAGE, "refine: this query asks for a minimum distance");
    if (query->proof != NULL)
        return error_set(error, IMP_ERROR_USAGE, "refine: this query keeps a proof");
    const imp_code code = tolerances_check(gamma, gamma_clear, NULL, error);
    if (code != IMP_SUCCESS) return code;
    gamma_clear = tolerances_clear(gamma, gamma_clear);
    if (gamma > query->impact.gamma || gamma_clear > query->gamma_clear)
        return error_set(
            error, IMP_ERROR_USAGE,
            "refine: gamma %g and gamma_clear %g may not exceed those in force, %g and %g", gamma,
            gamma_clear, query->impact.gamma, query->gamma_clear);
    if (!impact_refine(&query->impact, gamma, query_searched_gamma_clear(query, gamma_clear),
                       query->candidates.pair_count))
        return error_set_memory(error);
    query->gamma_clear = gamma_clear;
    query_forget_insides(query);
    if (query->verdict == IMP_VERDICT_CONTACT)
        query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_RUNNING);
    return IMP_SUCCESS;
}

imp_code imp_query_refine(imp_query *query, double gamma, double gamma_clear, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_refine");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = refine(query, gamma, gamma_clear, error);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_query_exclude_pair(imp_query *query, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_exclude_pair");
    const bool found =
        query->verdict == IMP_VERDICT_CONTACT || query->reason == IMP_REASON_RESOLUTION;
    if (!found || query->clearance != NULL)
        return error_set(error, IMP_ERROR_USAGE,
                         "pass: this query has found no contact, and nothing that is unresolved");
    if (query->proof != NULL)
        return error_set(error, IMP_ERROR_USAGE, "pass: this query keeps a proof");
    if (!impact_pass(&query->impact)) return error_set_memory(error);
    query_forget_insides(query);
    query_finish(query, IMP_VERDICT_UNDECIDED, IMP_REASON_RUNNING);
    return IMP_SUCCESS;
}
