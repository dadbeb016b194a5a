/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PARAMETERS_H
#define PLUGINS_PATCH_PARAMETERS_H

#include "plugins/patch/patch.h"

#include <impinge/plugin.h>

/* Rows of parameter tables that patches and curves share, within the limits of patch.h. */

#define ROW_PATCH_DEGREE(DEFAULT, DOC)                                                             \
    IMP_ROW_OF(IMP_KIND_INTEGER, "degree", "1", DEFAULT, 0, 1, 2, 0, 1, PATCH_DEGREE_MAX, DOC)

/* Lists of vectors: control points, or how fast they move. */
#define ROW_PATCH_POINTS(NAME, UNIT, DEFAULT, WIDTH, FLAGS, DOC)                                   \
    IMP_ROW(NAME, UNIT, DEFAULT, FLAGS, 2, 0, WIDTH, -PATCH_FAR, PATCH_FAR, DOC)
#define ROW_PATCH_VELOCITIES                                                                       \
    ROW_PATCH_POINTS("velocities", "length/time", NULL, 3, IMP_PARAMETER_OPTIONAL,                 \
                     "one per point: it moves as point + t*velocity; left out: at rest")

#define ROW_PATCH_WEIGHTS(NAME, DOC)                                                               \
    IMP_ROW(NAME, "1", NULL, IMP_PARAMETER_OPTIONAL, 1, 0, 0, PATCH_LIGHT, PATCH_HEAVY, DOC)

#endif
