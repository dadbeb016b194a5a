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

#endif
