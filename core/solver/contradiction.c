/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/contradiction.h"

imp_code contradiction_fault(const surface *a, const surface *b, double upper, double t,
                             double lower, imp_error *error)
{
    imp_error other = {IMP_SUCCESS, ""};
    surface_fault(b, &other, "are");
    return surface_fault(
        a, error,
        "and %.400s seen %.10g apart at t = %.10g, but proved to stay %.10g "
        "apart; one of these types breaks a promise: `impinge check TYPE` finds it",
        other.text, upper, t, lower);
}
