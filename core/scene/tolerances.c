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
