/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_RATES_H
#define TOOLS_CHECK_RATES_H

#include "tools/check/subject.h"

/* Tries to refute rates
 * =====================
 * No single search finds every error:
 *   - tiny regions, spread evenly: bounds that are low in one place, even a little
 *   - climbing from where bounds are tightest
 *   - pairs of far points, halved towards the steeper half: jumps, edges
 *   - regions of all sizes, split towards the largest bound, then climbing: maxima inside a
 *     region that its bound has missed, as when it was taken from corners or a grid */
void rates_check(const subject *s, uint64_t *random, double effort);

#endif
