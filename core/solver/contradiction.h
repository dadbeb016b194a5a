/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CONTRADICTION_H
#define CORE_SOLVER_CONTRADICTION_H

#include "core/surface/surface.h"

/* Two facts that exclude each other
 * =================================
 * Points that are evaluated are no nearer than what is proved, unless a type breaks a promise of
 * the ABI. Where a search has both for the same surfaces and times it compares them, so that a
 * broken promise that shows is an error and no answer. */

/* Answers IMP_ERROR_PLUGIN and names both surfaces: points of them are no farther than `upper`
 * apart at time t, though `lower` is proved, lengths. */
imp_code contradiction_fault(const surface *a, const surface *b, double upper, double t,
                             double lower, imp_error *error);

#endif
