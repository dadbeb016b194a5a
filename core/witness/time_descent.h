/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_TIME_DESCENT_H
#define CORE_WITNESS_TIME_DESCENT_H

#include "core/bounds/time_window.h"
#include "core/witness/witness.h"

/* Descent of a witness to the time where its gap is least
 * =======================================================
 * The gap of the nearest points changes at the rate normal.(velocity of b's point - velocity of a's
 * point). A root of that rate, sought by the secant method within the nodes' times, is a time of
 * least gap. Finding none proves nothing: the result is a witness like any other. */

/* Replaces *found, a witness at *t, and *t by a witness of smaller gap at another time of `times`;
 * goes on as long as that promises to save more than this `part` of the gap. Precondition: `times`
 * lies in both nodes' times, neither of which is a cluster. *searches counts witness searches.
 * IMP_ERROR_PLUGIN: an evaluation failed. */
imp_code witness_descend_in_time(const node *const nodes[2], const time_window *times, double part,
                                 double *t, witness *found, size_t *searches, imp_error *error);

#endif
