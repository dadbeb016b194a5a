/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PROOF_H
#define TOOLS_CHECK_PROOF_H

#include "check_subject.h"

/* Proves, or refutes, what a type claims of a formula that is known
 * ==================================================================
 * Claims are asked for over the domain, over the regions that halving it makes first, as a solver
 * does, and over regions drawn from the seed: rates, ranges, remainders, and the errors of points;
 * rates also over thousands of tiny regions, spread evenly. Each holds in all of its region, or
 * not, by branch and bound (check_branch.h). Regions that were not asked about are not proved. A
 * map's models are asked for on surfaces that are exactly known (check_under.h).
 *
 * This is not circular. That bounds follow from a formula is what plugins and the SDK do, in
 * double precision, by models and rates. Here nothing of it is used: the text is read by another
 * reader, computed as it stands, by another arithmetic with more digits and other functions of
 * libm, and bounds come from first and second derivatives over boxes that get ever smaller.
 * Skips what has no known formula. */
void proof_check(const subject *s, uint64_t *random, double effort);

#endif
