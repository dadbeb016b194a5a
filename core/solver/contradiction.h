/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CONTRADICTION_H
#define CORE_SOLVER_CONTRADICTION_H

#include "core/surface/surface.h"

/* Two facts that exclude each other
 * =================================
 * Evaluated points are never nearer than a proved lower bound, unless a type breaks a promise of
 * the ABI. Where a search has both for the same surfaces and times it compares them, so that a
 * contradiction is an error and not an answer. */

/* Returns IMP_ERROR_PLUGIN and names both surfaces: two of their points are at most `upper` apart
 * at time t, although `lower` is proved (lengths). */
imp_code contradiction_fault(const surface *a, const surface *b, double upper, double t,
                             double lower, imp_error *error);

#endif
