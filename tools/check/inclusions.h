/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_INCLUSIONS_H
#define TOOLS_CHECK_INCLUSIONS_H

#include "tools/check/subject.h"

/* Tries to refute inclusions
 * ==========================
 * Tests include of a surface, or apply of a map to models of surfaces that are exactly known: form,
 * polynomial with remainder, range, rates. Regions of all sizes, spread evenly and at random;
 * points at ends, in the middle, where remainders peak, and then climbing towards a violation.
 * Skips types that have neither. */
void inclusions_check(const subject *s, uint64_t *random, double effort);

#endif
