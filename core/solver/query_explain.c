/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/solver/query_internal.h"

imp_code imp_query_explain(imp_query *query, imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_query_explain");
    if (query->clearance != NULL || query->impact.baseline != IMP_BASELINE_NONE)
        return error_set(error, IMP_ERROR_USAGE,
                         "explain: this query must ask for a contact, without a baseline");
    if (query->candidates_tested > 0)
        return error_set(error, IMP_ERROR_USAGE, "explain: this query has been stepped already");
    query->impact.explains = true;
    return IMP_SUCCESS;
}

/* --- Of pairs that wait ----------------------------------------------------------------------- */

enum { PENDING_MOST = 1000 };

/* Returns the pairs that wait, and the distance that would part them; NULL: there is no search. */
static const pair_heap *waiting(const imp_query *query, double *apart)
{
    if (query->clearance != NULL) return clearance_waiting(query->clearance, apart);
    *apart = query->impact.gamma_clear;
    return &query->impact.heap;
}

/* Adds the obstacles of waiting pairs of these two surfaces: of all, or of 1000 spread over the
 * heap. */
static void explain_pending(const imp_query *query, size_t index, imp_explanation *row)
{
    double apart;
    const pair_heap *heap = waiting(query, &apart);
    if (heap == NULL) return;
    const size_t every = heap->count / PENDING_MOST + 1;
    for (size_t k = 0; k < heap->count; k += every) {
        const pair p = pair_heap_at(heap, k);
        if (p.candidate_pair != index) continue;
        const candidate_pair *both = &query->candidates.pairs[index];
        row->divided += 1;
        row->by[explanation_of(&p, both, apart)] += 1;
    }
}

FP_APART static void explain(const imp_query *query, size_t index, imp_explanation *row)
{
    const impact *im = &query->impact;
    *row = im->explained != NULL ? im->explained[index] : (imp_explanation){.tested = 0};
    explanation_describe(&query->candidates.pairs[index], row);
    if (im->explained == NULL) explain_pending(query, index, row);
}

bool imp_query_explanation(const imp_query *query, size_t index, imp_explanation *row)
{
    if (query == NULL || row == NULL) return false;
    if (index >= query->candidates.pair_count || !query->candidates.complete) return false;
    const fp_environment environment = fp_environment_enter();
    explain(query, index, row);
    fp_environment_leave(&environment);
    return true;
}
