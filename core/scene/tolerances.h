/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_TOLERANCES_H
#define CORE_SCENE_TOLERANCES_H

#include "core/base/place.h"

/* gamma and gamma_clear, as a program or a scene file gives them: a gamma_clear below 0 stands for
 * half of gamma. */

double tolerances_clear(double gamma, double gamma_clear);

/* Checks that 0 < gamma < infinity and gamma_clear < gamma, and that neither is NaN. Otherwise it
 * fails: IMP_ERROR_SCENE with the key of the scene at `document`, or IMP_ERROR_USAGE if `document`
 * is NULL. */
imp_code tolerances_check(double gamma, double gamma_clear, const place *document,
                          imp_error *error);

/* Checks the tolerance and the distance required of a clearance. */
imp_code tolerances_check_clearance(const imp_clearance_options *asked, imp_error *error);

/* A distance that is proved to be at least this large counts as `required`: two bodies that are
 * exactly as far apart as required could not be decided otherwise. */
static inline double tolerances_nearly(double required) { return required * (1 - 1e-6); }

#endif
