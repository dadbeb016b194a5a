/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/tolerances.h"

#include <math.h>

#include "core/base/text.h"

double tolerances_clear(double gamma, double gamma_clear)
{
    return gamma_clear < 0 ? 0.5 * gamma : gamma_clear;
}

imp_code tolerances_check(double gamma, double gamma_clear, const place *document, imp_error *error)
{
    const imp_code code = document != NULL ? IMP_ERROR_SCENE : IMP_ERROR_USAGE;
    const bool is_bad = !(gamma > 0 && gamma < INFINITY);
    const char *name = is_bad ? "gamma" : "gamma_clear";
    const place at = document != NULL ? place_key(document, name) : place_argument(NULL, name);
    if (is_bad)
        return place_error(&at, error, code, "got %s, must be > 0 and finite",
                           text_of_number(gamma).at);
    if (tolerances_clear(gamma, gamma_clear) < gamma) return IMP_SUCCESS;
    return place_error(&at, error, code, "got %s, must be from 0 to below gamma = %s",
                       text_of_number(gamma_clear).at, text_of_number(gamma).at);
}

imp_code tolerances_check_clearance(const imp_clearance_options *asked, imp_error *error)
{
    if (!(asked->tolerance >= 1e-9 && asked->tolerance < 1))
        return error_set(error, IMP_ERROR_USAGE, "tolerance: got %g, must be from 1e-9 to below 1",
                         asked->tolerance);
    if (!(asked->required >= 0 && asked->required < INFINITY))
        return error_set(error, IMP_ERROR_USAGE,
                         "required: got %g, must be > 0 and finite, or 0 for none",
                         asked->required);
    return IMP_SUCCESS;
}
