/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_VISIBILITY_H
#define TOOLS_VIEW_VISIBILITY_H

#include "tools/view/stage.h"

/* From where a spot can be seen
 * =============================
 * The stage is at the spot's time. Triangles on the ray from the spot to the viewer hide the spot,
 * except within a small distance, since the two bodies meet there. */

/* The direction toward the viewer, in degrees. */
typedef struct direction {
    double azimuth, elevation;
} direction;

/* Chooses a direction in which the spot is least hidden and its normal is seen from the side, near
 * the default. Without a spot, the default one. */
imp_code visibility_choose(const stage *s, direction *chosen, imp_error *error);

/* Sets hides[b] for each body of the stage that hides the spot from the direction; toward: unit
 * length. */
imp_code visibility_hiding(const stage *s, vec toward, bool *hides, imp_error *error);

/* Returns the distance in front of the spot within which triangles do not hide it. */
double visibility_slack(const stage *s);

#endif
