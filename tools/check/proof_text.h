/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PROOF_TEXT_H
#define TOOLS_CHECK_PROOF_TEXT_H

#include "tools/check/subject.h"
#include "tools/proof/branch.h"

/* Claims that are refuted, or stay unsettled, in words */

/* Fails the check for the claim that `o` says is refuted: names the claim, the place, what the
 * formula gives there, and how many ulps are missing if rounding explains it. Returns false, if the
 * check has failed for this. */
bool proof_refute(const subject *s, const branch_field *field, const branch_claims *c,
                  const branch_outcome *o);

/* Keeps the text of the claim that `o` says is unsettled, if it is the first of the check. */
void proof_tell_open(const subject *s, const branch_field *field, const branch_claims *c,
                     const branch_outcome *o);

#endif
