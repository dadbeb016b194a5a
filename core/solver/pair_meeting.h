/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_MEETING_H
#define CORE_SOLVER_PAIR_MEETING_H

#include "core/solver/impact.h"

/* Two roots that meet as a point and a face, or as two edges
 * ==========================================================
 * Where corners move linearly, it is computed when they meet (linear_contact.h). One axis then
 * separates them up to that time, and the points there are a witness, mostly: such a pair needs no
 * search, and is never expanded. Not where a proof is kept or values are boxed. */

/* Seeks the time at which the gap of the roots t->p is just above gamma_clear, and proves that they
 * are apart before it: then *found, t->near, the window begins there, and t->meets. Otherwise the
 * pair is to be tested as any other, and only its nets may have been made. */
imp_code pair_meeting_seek(const impact *im, pair_test *t, bool *found, imp_error *error);

/* Evaluates the points at which the pair meets, unless a contact is known up to then; if their gap
 * is within gamma, the contact is known from now on. */
imp_code pair_meeting_try(impact *im, const pair_test *t, imp_error *error);

#endif
