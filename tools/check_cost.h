/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_COST_H
#define TOOLS_CHECK_COST_H

#include "check_subject.h"

/* Reported, not judged. Effort makes no difference. */

/* Bound / observed, medians over regions of 1/64, 1/8 and 1 of the domain along each dimension. */
void tightness_check(const subject *s, uint64_t *random, double effort);

/* Nanoseconds per point and per region, and pairs of regions with a plane (check_reach.h). */
void cost_check(const subject *s, uint64_t *random, double effort);

#endif
