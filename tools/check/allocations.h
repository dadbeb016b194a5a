/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_ALLOCATIONS_H
#define TOOLS_CHECK_ALLOCATIONS_H

#include "tools/check/subject.h"

/* That eval, rate, include, apply, net, rigid, distance, symmetry and tube allocate and free
 * nothing, neither themselves nor by what they call. */
void allocations_check(const subject *s, uint64_t *random, double effort);

#endif
