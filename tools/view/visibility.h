/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_VISIBILITY_H
#define TOOLS_VIEW_VISIBILITY_H

#include "tools/view/stage.h"

/* From where a spot can be seen
 * =============================
 * The stage stands at the spot's time. From the spot a ray goes to the one who looks; what it meets
 * hides the spot, but for what lies within a small distance, as the two bodies themselves. */

/* From where to look, in degrees. */
typedef struct direction {
    double azimuth, elevation;
} direction;

/* Chooses the direction in which least hides the spot, its normal is seen from the side, and little
 * else is strange. Without a spot, the usual one. */
imp_code visibility_choose(const stage *s, direction *chosen, imp_error *error);

/* Sets hides[b] for each body of the stage that hides the spot from the direction; toward: unit
 * length. */
imp_code visibility_hiding(const stage *s, vec toward, bool *hides, imp_error *error);

/* Length that counts as nothing before the spot. */
double visibility_slack(const stage *s);

#endif
