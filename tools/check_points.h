/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_POINTS_H
#define TOOLS_CHECK_POINTS_H

#include "check_subject.h"

/* What can be asked of single points. */

/* Everything is finite and well formed over the whole domain, its corners, and one double inside
 * of them. */
void finite_check(const subject *s, uint64_t *random, double effort);

/* Tries to refute the errors that eval reports. The true value is not to be had from outside, but
 * points next to each other are: where rates allow them less than their values differ, both
 * errors have to make up for it. And the inclusion of a single point must meet its value. */
void errors_check(const subject *s, uint64_t *random, double effort);

#endif
