/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PROOF_H
#define TOOLS_CHECK_PROOF_H

#include "tools/check/subject.h"

/* Proves or refutes the claims of a type whose formula is known
 * =============================================================
 * Claims are tested over the domain, over the first regions that halving it makes, as in a solver,
 * and over random regions: rates, ranges, remainders, and the errors of points; rates also over
 * thousands of tiny regions, spread evenly. Branch and bound (tools/proof/branch.h) proves or
 * refutes each claim over all of its region. Other regions are not proved. A map's models are
 * tested on surfaces that are exactly known (map_operand.h).
 *
 * This is not circular. Plugins and the SDK derive bounds from a formula in double precision, with
 * models and rates. None of that code is used here: another reader parses the text, it is computed
 * without rewriting, by another arithmetic with more digits and other functions of libm, and bounds
 * come from first and second derivatives over ever smaller boxes. Skips types without a known
 * formula. */
void proof_check(const subject *s, uint64_t *random, double effort);

#endif
