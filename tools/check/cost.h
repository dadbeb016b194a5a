/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_COST_H
#define TOOLS_CHECK_COST_H

#include "tools/check/subject.h"

/* These are reported only. The effort has no influence. */

/* Bound / observed, medians over regions of 1/64, 1/8 and 1 of the domain along each dimension. */
void tightness_check(const subject *s, uint64_t *random, double effort);

/* Nanoseconds per point and per region, and pairs of regions with a plane (clearance_cost.h). */
void cost_check(const subject *s, uint64_t *random, double effort);

#endif
