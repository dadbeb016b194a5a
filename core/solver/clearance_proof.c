/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

#include "core/base/status.h"
#include "core/solver/query_proof.h"

/* What the certificate of a clearance states. */

imp_code clearance_keep_proof(clearance_search *c, proof_logs *logs, imp_error *error)
{
    if (c->asked.each || c->asked.slices != 1)
        return error_set(error, IMP_ERROR_USAGE,
                         "proof: got a clearance with %s, must be one with a single answer",
                         c->asked.each ? "`each`" : "slices");
    c->proof = logs;
    return IMP_SUCCESS;
}

bool clearance_is_by_violation(const clearance_search *c) { return c->by_violation; }

clearance_proved clearance_what_is_proved(const clearance_search *c, const imp_clearance *answer)
{
    const bool fails = answer->t_violated >= answer->t_start;
    clearance_proved proved = {0, answer->t_start, fails ? answer->t_violated : answer->t_end};
    if (c->by_violation) { /* before one at the start, nothing is proved */
        proved.apart = fails && !(proved.to > proved.from) ? 0 : clearance_relaxed(c);
        return proved;
    }
    proved.apart = proof_apart_lower(answer, &c->asked);
    return proved;
}
