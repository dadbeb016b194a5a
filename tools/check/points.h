/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_POINTS_H
#define TOOLS_CHECK_POINTS_H

#include "tools/check/subject.h"

/* Checks of single points. */

/* Everything is finite and well formed over the whole domain, at its corners, and one double inside
 * of them. */
void finite_check(const subject *s, uint64_t *random, double effort);

/* Tries to refute the errors that eval reports. The true value is unknown, but neighbouring points
 * can be compared: if their values differ by more than the rates allow, the two errors must cover
 * the rest. The inclusion of a single point must intersect eval's result with its error. */
void errors_check(const subject *s, uint64_t *random, double effort);

#endif
