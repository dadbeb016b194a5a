/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_TOLERANCES_H
#define CORE_SCENE_TOLERANCES_H

#include "core/base/place.h"

/* gamma and gamma_clear, as a program or a scene file gives them: a gamma_clear below 0 stands for
 * half of gamma. */

double tolerances_clear(double gamma, double gamma_clear);

/* 0 < gamma < infinity and gamma_clear < gamma. Otherwise, or where one is NaN, IMP_ERROR_SCENE,
 * with the key of the scene at `document`, or, where that is NULL, IMP_ERROR_USAGE. */
imp_code tolerances_check(double gamma, double gamma_clear, const place *document,
                          imp_error *error);

#endif
