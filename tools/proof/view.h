/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_VIEW_H
#define TOOLS_PROOF_VIEW_H

#include "tools/proof/branch.h"

/* A region, and bounds over boxes in it
 * ===========================================
 * Boxes are in the normalized numbers s, so that linear terms are exact. Of p = c + d s, only the
 * part in the region counts: claims hold there, possibly without slack. */

typedef struct frame {
    const branch_field *field;
    const branch_claims *claims;
    ld_interval whole[BOX_DIMS]; /* s over the region, or a little more */
} frame;

frame frame_make(const branch_field *field, const branch_claims *claims);

/* x, y, z and, where wanted, how far they are off the model's quadratic: over the box, and at one
 * point of the region, at or near its middle, from which `offset` leads into the box. */
typedef struct view {
    ld_interval offset[BOX_DIMS], middle[BOX_DIMS];
    jet box[3], centre[3], off_box[3], off_centre[3];
    long double point[BOX_DIMS]; /* p of the middle, exactly */
} view;

void frame_evaluate(const frame *f, const ld_interval x[BOX_DIMS], const bool off_wanted[3],
                    view *v);

#endif
